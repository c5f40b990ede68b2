//! Compilation as a table of stages: a result is found under the key of all that it was made from, or made.
//!
//! A stage is a pure function. Its key is the BLAKE3 of its name, of the keys or contents of what it reads, and of its
//! own parameters; so a result that is found is the one that would be made, to the last bit. Small results are kept as
//! bytes, from one compilation to the next of a scene (see `cli::last`). Large ones are sections of the pack that the
//! last compilation wrote: there the kept bytes say that the pack has them, and what else belongs to them. Nothing else
//! decides what is made again. It does not know what the stages make, nor where results are kept.

use std::collections::BTreeMap;
use std::convert::Infallible;
use std::fmt;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use pack::Pack;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

/// Name of a result: what it was made from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub struct Key([u8; 32]);

/// Collects what a stage reads; every entry has a length or a type, so that no two lists give the same bytes.
#[derive(Clone)]
pub struct KeyOf(blake3::Hasher);

impl KeyOf {
    /// For the stage with this name.
    #[must_use]
    pub fn stage(name: &str) -> Self {
        let mut key = Self(blake3::Hasher::new());
        key.text(name);
        key
    }

    /// Adds bytes.
    pub fn bytes(&mut self, bytes: &[u8]) -> &mut Self {
        self.0.update(&(bytes.len() as u64).to_le_bytes()).update(bytes);
        self
    }

    /// Adds a text.
    pub fn text(&mut self, text: &str) -> &mut Self {
        self.bytes(text.as_bytes())
    }

    /// Adds a number.
    pub fn number(&mut self, number: impl Into<u64>) -> &mut Self {
        self.0.update(&number.into().to_le_bytes());
        self
    }

    /// Adds a list of numbers.
    pub fn floats(&mut self, numbers: &[f64]) -> &mut Self {
        self.number(numbers.len() as u64);
        for number in numbers {
            self.number(number.to_bits());
        }
        self
    }

    /// Adds another key.
    pub fn key(&mut self, key: Key) -> &mut Self {
        self.0.update(&key.0);
        self
    }

    /// The key.
    #[must_use]
    pub fn end(&self) -> Key {
        Key(*self.0.finalize().as_bytes())
    }
}

impl From<[u8; 32]> for Key {
    fn from(hash: [u8; 32]) -> Self {
        Self(hash)
    }
}

impl From<Key> for blake3::Hash {
    fn from(key: Key) -> Self {
        key.0.into()
    }
}

/// A small result, as it is kept.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Bytes(#[serde(with = "plain")] Vec<u8>);

/// Small results by key.
pub type Values = BTreeMap<Key, Bytes>;

/// What the last compilation noted of the parts of large results.
#[derive(Default)]
enum Parts {
    #[default]
    None,
    /// To be read when somebody asks.
    Asleep(Box<dyn Fn() -> Option<Values> + Send>),
    There(Values),
}

/// How much of something was there already.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Share {
    /// Found.
    pub reused: usize,
    /// Needed.
    pub all: usize,
}

impl Share {
    /// One more, which was found or not.
    pub fn count(&mut self, reused: bool) {
        self.all += 1;
        self.reused += usize::from(reused);
    }
}

/// What a compilation leaves for the next one.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Results {
    /// Small results.
    pub small: Values,
    /// The small parts of results whose large parts are in the pack.
    pub in_pack: Values,
}

/// The results of the last compilation, and those of this one.
#[derive(Default)]
pub struct Stages {
    /// Results of the last compilation.
    last: Results,
    /// What it noted of the parts of large results, see [`Stages::part`]; read at the first question.
    parts: Mutex<Parts>,
    /// The pack that it wrote.
    pack: Option<Arc<Pack>>,
    state: Mutex<State>,
}

impl fmt::Debug for Stages {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.debug_struct("Stages").field("last", &self.last.small.len()).finish_non_exhaustive()
    }
}

#[derive(Debug, Default)]
struct State {
    made: Results,
    parts: Values,
    keeps_all: bool,
    used_parts: bool,
}

impl Stages {
    /// Nothing is known.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// What the last compilation left: its results, and its `pack`, whole, if it is still there.
    #[must_use]
    pub fn after(last: Results, pack: Option<Arc<Pack>>) -> Self {
        Self { last, pack, ..Self::default() }
    }

    /// With what the last compilation noted of the parts of large results, which `load` reads.
    #[must_use]
    pub fn with_parts(self, load: impl Fn() -> Option<Values> + Send + 'static) -> Self {
        Self { parts: Mutex::new(Parts::Asleep(Box::new(load))), ..self }
    }

    fn lock(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The small result under `key`, of this compilation or the last.
    pub fn get<T: DeserializeOwned>(&self, key: Key) -> Option<T> {
        let mut state = self.lock();
        if let Some(made) = state.made.small.get(&key) {
            return decode(&made.0);
        }
        let bytes = self.last.small.get(&key)?;
        state.made.small.insert(key, bytes.clone());
        decode(&bytes.0)
    }

    /// Keeps a small result.
    pub fn put<T: Serialize>(&self, key: Key, value: &T) {
        if let Some(bytes) = encode(value) {
            self.lock().made.small.insert(key, Bytes(bytes));
        }
    }

    /// Keeps the small part of a result whose large part is in the pack that is being made.
    pub fn put_in_pack<T: Serialize>(&self, key: Key, value: &T) {
        if let Some(bytes) = encode(value) {
            self.lock().made.in_pack.insert(key, Bytes(bytes));
        }
    }

    /// The small result under `key`, which `make` makes where it is not there.
    ///
    /// # Errors
    /// Those of `make`.
    pub fn try_value<T: Serialize + DeserializeOwned, E>(
        &self,
        key: Key,
        make: impl FnOnce() -> Result<T, E>,
    ) -> Result<T, E> {
        if let Some(found) = self.get(key) {
            return Ok(found);
        }
        let made = make()?;
        self.put(key, &made);
        Ok(made)
    }

    /// As [`Stages::try_value`], for what cannot fail.
    pub fn value<T: Serialize + DeserializeOwned>(&self, key: Key, make: impl FnOnce() -> T) -> T {
        let Ok(value) = self.try_value(key, || Ok::<T, Infallible>(make()));
        value
    }

    /// The pack of the last compilation and the small part of a result whose large part it has.
    pub fn in_pack<T: DeserializeOwned>(&self, key: Key) -> Option<(T, &Arc<Pack>)> {
        let (pack, bytes) = (self.pack.as_ref()?, self.last.in_pack.get(&key)?);
        let value = decode(&bytes.0)?;
        self.lock().made.in_pack.insert(key, bytes.clone());
        Some((value, pack))
    }

    /// The pack of the last compilation and what it noted of a part, of some records of the pack.
    pub fn part<T: DeserializeOwned>(&self, key: Key) -> Option<(T, &Arc<Pack>)> {
        let pack = self.pack.as_ref()?;
        let mut parts = self.parts.lock().unwrap_or_else(PoisonError::into_inner);
        if let Parts::Asleep(load) = &*parts {
            *parts = load().map_or(Parts::None, Parts::There);
        }
        let Parts::There(parts) = &*parts else { return None };
        let part = decode(&parts.get(&key)?.0)?;
        self.lock().used_parts = true;
        Some((part, pack))
    }

    /// The pack of the last compilation.
    #[must_use]
    pub fn pack(&self) -> Option<&Arc<Pack>> {
        self.pack.as_ref()
    }

    /// Whether the last pack had a part that was asked for.
    #[must_use]
    pub fn used_parts(&self) -> bool {
        self.lock().used_parts
    }

    /// No part of the last pack is needed any more: what was read of it only takes room.
    pub fn release_parts(&self) {
        *self.parts.lock().unwrap_or_else(PoisonError::into_inner) = Parts::None;
        if let Some(pack) = &self.pack {
            pack.release_pages();
        }
    }

    /// Notes which records of the pack that is being made are a part of a large result.
    pub fn put_part<T: Serialize>(&self, key: Key, part: &T) {
        if let Some(bytes) = encode(part) {
            self.lock().parts.insert(key, Bytes(bytes));
        }
    }

    /// What the results of the last compilation were made from need not be asked for; it is kept for the next one.
    pub fn keep_all(&self) {
        self.lock().keeps_all = true;
    }

    /// What is left for the next compilation: results, and what was noted of parts if that is new.
    #[must_use]
    pub fn results(&self) -> (Results, Option<Values>) {
        let state = self.lock();
        let mut results = state.made.clone();
        if state.keeps_all {
            for (key, bytes) in &self.last.small {
                results.small.entry(*key).or_insert_with(|| bytes.clone());
            }
        }
        (results, (!state.keeps_all).then(|| state.parts.clone()))
    }
}

/// A value as bytes; `None` for numbers that cannot be written.
pub fn encode<T: Serialize>(value: &T) -> Option<Vec<u8>> {
    bincode::serde::encode_to_vec(value, bincode::config::standard()).ok()
}

/// `None` for bytes that are no such value.
#[must_use]
pub fn decode<T: DeserializeOwned>(bytes: &[u8]) -> Option<T> {
    let (value, used) =
        bincode::serde::decode_from_slice(bytes, bincode::config::standard()).ok()?;
    (used == bytes.len()).then_some(value)
}

/// Lists of plain records as their bytes, for results: quicker than one by one.
pub mod plain {
    use std::fmt;

    use bytemuck::{AnyBitPattern, NoUninit};
    use serde::de::{Error, Visitor};
    use serde::{Deserializer, Serializer};

    /// Writes the bytes of a list.
    pub fn serialize<T: NoUninit, S: Serializer>(
        list: &[T],
        serializer: S,
    ) -> Result<S::Ok, S::Error> {
        serializer.serialize_bytes(bytemuck::cast_slice(list))
    }

    /// Reads a list.
    pub fn deserialize<'de, T: AnyBitPattern + NoUninit, D: Deserializer<'de>>(
        deserializer: D,
    ) -> Result<Vec<T>, D::Error> {
        let bytes = deserializer.deserialize_byte_buf(Bytes)?;
        if bytes.len() % size_of::<T>().max(1) != 0 {
            return Err(D::Error::custom("another length"));
        }
        Ok(bytemuck::pod_collect_to_vec(&bytes))
    }

    /// Takes bytes as they are.
    struct Bytes;

    impl Visitor<'_> for Bytes {
        type Value = Vec<u8>;

        fn expecting(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
            out.write_str("bytes")
        }

        fn visit_bytes<E: Error>(self, bytes: &[u8]) -> Result<Vec<u8>, E> {
            Ok(bytes.to_vec())
        }

        fn visit_byte_buf<E: Error>(self, bytes: Vec<u8>) -> Result<Vec<u8>, E> {
            Ok(bytes)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_two_lists_have_one_key() {
        let key = |fill: &dyn Fn(&mut KeyOf)| {
            let mut key = KeyOf::stage("a");
            fill(&mut key);
            key.end()
        };
        let keys = [
            key(&|_| ()),
            key(&|k| _ = k.text("ab").text("c")),
            key(&|k| _ = k.text("a").text("bc")),
            key(&|k| _ = k.floats(&[0.0])),
            key(&|k| _ = k.floats(&[-0.0])),
            key(&|k| _ = k.floats(&[0.0, 0.0])),
            key(&|k| _ = k.number(0_u32)),
            KeyOf::stage("b").end(),
        ];
        for (i, a) in keys.iter().enumerate() {
            assert!(keys[..i].iter().all(|b| a != b), "{i}");
        }
    }

    #[test]
    fn a_result_is_made_once_and_found_by_the_next_compilation() {
        let key = KeyOf::stage("number").end();
        let stages = Stages::new();
        assert_eq!(stages.value(key, || 7_u32), 7);
        assert_eq!(stages.value(key, || 8_u32), 7);
        let next = Stages::after(stages.results().0, None);
        assert_eq!(next.try_value(key, || Err::<u32, _>("asked again")), Ok(7));
        // Without a pack no large part is there.
        assert!(next.in_pack::<u32>(key).is_none());
        // What nobody asks for is forgotten, unless it is to be kept.
        let last = next.results().0;
        assert_eq!(Stages::after(last.clone(), None).results().0, Results::default());
        let idle = Stages::after(last.clone(), None);
        idle.keep_all();
        assert_eq!(idle.results(), (last, None));
    }

    #[test]
    fn bytes_of_another_type_are_no_result() {
        let key = KeyOf::stage("text").end();
        let small = [(key, Bytes(vec![255, 255, 255]))].into();
        let stages = Stages::after(Results { small, ..Results::default() }, None);
        assert_eq!(stages.value(key, || "made".to_owned()), "made");
        assert_eq!(stages.get::<String>(key).as_deref(), Some("made"));
    }
}
