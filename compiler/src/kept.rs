//! What compilations of one process leave in memory for each other: meshes, by the key of what they were read from.

use std::any::Any;
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

use crate::stage::Key;

/// A result, and whether somebody had a use for it in this compilation.
type Value = (Arc<dyn Any + Send + Sync>, bool);

/// Results that no file holds, such as meshes and images in memory, for as long as `rtc --watch` runs.
#[derive(Debug, Default)]
pub struct Kept {
    keep: bool,
    values: Mutex<BTreeMap<Key, Value>>,
}

impl Kept {
    /// For one compilation: nothing is kept.
    #[must_use]
    pub fn once() -> Self {
        Self::default()
    }

    /// For compilations one after the other.
    #[must_use]
    pub fn keeping() -> Self {
        Self { keep: true, ..Self::default() }
    }

    /// A compilation begins; what the last one had no use for is forgotten.
    pub fn begin(&self) {
        let mut values = self.values.lock().unwrap_or_else(PoisonError::into_inner);
        values.retain(|_, (_, used)| std::mem::take(used));
    }

    /// The result under `key`.
    pub fn get<T: Any + Send + Sync>(&self, key: Key) -> Option<Arc<T>> {
        let mut values = self.values.lock().unwrap_or_else(PoisonError::into_inner);
        let (value, used) = values.get_mut(&key)?;
        *used = true;
        Arc::clone(value).downcast().ok()
    }

    /// Says that the result under `key` is of use still, without asking for it.
    pub fn touch(&self, key: Key) {
        let mut values = self.values.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, used)) = values.get_mut(&key) {
            *used = true;
        }
    }

    /// Keeps a result.
    pub fn put<T: Any + Send + Sync>(&self, key: Key, value: &Arc<T>) {
        if self.keep {
            let mut values = self.values.lock().unwrap_or_else(PoisonError::into_inner);
            values.insert(key, (Arc::clone(value) as Arc<dyn Any + Send + Sync>, true));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stage::KeyOf;

    #[test]
    fn what_a_watch_has_no_use_for_is_forgotten() {
        let (key, kept) = (KeyOf::stage("mesh").end(), Kept::keeping());
        kept.put(key, &Arc::new(5_u32));
        kept.begin();
        assert_eq!(kept.get::<u32>(key).as_deref(), Some(&5));
        kept.begin();
        kept.begin();
        assert_eq!(kept.get::<u32>(key), None);
        let once = Kept::once();
        once.put(key, &Arc::new(5_u32));
        assert_eq!(once.get::<u32>(key), None);
    }
}
