//! What a finished compilation read and wrote, so that the next one can find that nothing changed, or only texts.
//!
//! A record lies in the cache, under a name made of this very program, the folder, the scene, the
//! output and the options. It holds the hash of every file that was read and the names of the pack.
//! The pack is up to date when all files have the same bytes and the pack is still that one, whole.
//! Compilations that had anything to warn of are never up to date: warnings are said every time. What else the next
//! compilation may use is in the cache under the hash of its bytes.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

use pack::Pack;
use rayon::prelude::*;
use serde_json::{Value, json};

use super::mapped;
use crate::cache::Cache;
use crate::input::Root;
use crate::lower::Trees;
use crate::pipeline::{EncodedRoster, Memory};
use crate::reuse::{Reuse, Stamp};

/// Which compilation it is.
#[derive(Clone, Copy, Debug)]
pub(super) struct Job<'a> {
    pub(super) scene: &'a Path,
    /// Where its files may lie.
    pub(super) root: &'a Root,
    pub(super) output: &'a Path,
    pub(super) defines: &'a [(String, String)],
    pub(super) trees: Trees<'a>,
}

/// A compilation whose result may still be there.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Record {
    /// Files that it read, in order.
    pub(super) files: Vec<PathBuf>,
    hashes: Vec<String>,
    /// Which of the files are texts of the scene.
    texts: Vec<PathBuf>,
    /// `render_id` and `recipe_id` of the pack.
    pack: [String; 2],
    /// It had nothing to warn of.
    silent: bool,
    /// Name of what else is remembered of it.
    memory: Option<String>,
}

/// What is there of the last compilation of a job.
pub(super) enum Before {
    /// Nothing that is of use.
    Nothing,
    /// The pack is what compiling would give.
    UpToDate(Record),
    /// Some of its files are others now.
    Edited(Edited),
}

/// The last compilation, and its files as they are now.
pub(super) struct Edited {
    record: Record,
    now: FilesNow,
}

/// Files with what they were a moment ago.
#[derive(Default)]
pub(super) struct FilesNow(BTreeMap<PathBuf, (Stamp, Option<String>)>);

/// A finished compilation, to be kept.
pub(super) struct Done<'a> {
    /// Texts of the scene.
    pub(super) texts: Vec<PathBuf>,
    /// `render_id` and `recipe_id` of the pack.
    pub(super) pack: [[u8; 32]; 2],
    /// It had nothing to warn of.
    pub(super) silent: bool,
    /// What is left for the next one.
    pub(super) memory: Option<&'a Memory>,
    /// What is left of each thing, if that is new.
    pub(super) roster: Option<&'a EncodedRoster>,
    /// What is known of files already.
    pub(super) now: FilesNow,
}

impl Job<'_> {
    /// `None` where nobody can say which program this is.
    fn key(&self) -> Option<blake3::Hash> {
        let program = std::env::current_exe().ok()?;
        let data = std::fs::metadata(&program).ok()?;
        let built = data.modified().ok()?.duration_since(SystemTime::UNIX_EPOCH).ok()?;
        let folder = std::env::current_dir().ok()?;
        let mut hasher = blake3::Hasher::new();
        let mut field = |bytes: &[u8]| {
            // The length first: no two lists of fields hash the same bytes.
            hasher.update(&(bytes.len() as u64).to_le_bytes()).update(bytes);
        };
        field(b"record 2");
        for path in [&program, &folder, self.scene, self.output] {
            field(path.as_os_str().as_encoded_bytes());
        }
        field(&data.len().to_le_bytes());
        field(&built.as_nanos().to_le_bytes());
        field(self.trees.recipe().as_bytes());
        for (name, value) in self.defines {
            field(name.as_bytes());
            field(value.as_bytes());
        }
        Some(hasher.finalize())
    }

    /// What is there of the last compilation.
    pub(super) fn before(&self, cache: &Cache) -> Before {
        let record = || Record::decode(&cache.record(&self.key()?)?);
        let Some(record) = record() else { return Before::Nothing };
        let now = FilesNow::look_at(&record.files, self.root);
        let mut files = record.files.iter().zip(&record.hashes);
        let same = files.all(|(path, hash)| now.hash(path) == Some(hash));
        if same && record.silent && self.pack_of(&record).is_some() {
            return Before::UpToDate(record);
        }
        Before::Edited(Edited { record, now })
    }

    /// The pack of a record, whole and verified.
    fn pack_of(&self, record: &Record) -> Option<Pack> {
        let pack = mapped::map(self.output).ok()?;
        pack.verify_hashes().ok()?;
        (names(&[pack.render_id(), pack.recipe_id()]) == record.pack).then_some(pack)
    }

    /// The pack of the last compilation and what is remembered of it, if `fits` the scene and only texts have
    /// changed since.
    pub(super) fn earlier(
        &self,
        cache: &Cache,
        edited: &Edited,
        fits: impl Fn(&Memory) -> bool,
    ) -> Option<(Pack, Memory)> {
        let Edited { record, now } = edited;
        let mut files = record.files.iter().zip(&record.hashes);
        let same = |(path, hash)| now.hash(path) == Some(hash);
        if !files.all(|(path, hash)| record.texts.contains(path) || same((path, hash))) {
            return None;
        }
        let name = blake3::Hash::from_hex(record.memory.as_ref()?).ok()?;
        let bytes = cache.record(&name)?;
        let memory = Memory::decode(&bytes).filter(|_| blake3::hash(&bytes) == name)?;
        if !fits(&memory) {
            return None;
        }
        Some((self.pack_of(record)?, memory))
    }

    /// Keeps what `reuse` says was read, unless a file changed meanwhile.
    pub(super) fn keep(&self, cache: &Cache, reuse: &Reuse, done: &Done<'_>) {
        let record = |memory: Option<String>| {
            let reads: Vec<(PathBuf, Stamp)> = reuse.reads().into_iter().collect();
            let hash = |(path, stamp): &(PathBuf, Stamp)| {
                if let Some((known, hash)) = done.now.0.get(path)
                    && known == stamp
                {
                    return hash.clone();
                }
                let hash = file_hash(path, self.root)?;
                (Stamp::of(path) == *stamp).then_some(hash)
            };
            let hashes = reads.par_iter().map(hash).collect::<Option<_>>()?;
            let files = reads.into_iter().map(|(path, _)| path).collect();
            let (texts, silent) = (done.texts.clone(), done.silent);
            let record = Record { files, hashes, texts, pack: names(&done.pack), silent, memory };
            Some((self.key()?, record.encode()?))
        };
        if cache.root().is_none() {
            return;
        }
        if let Some(roster) = done.roster {
            roster.store(cache);
        }
        let memory = done.memory.and_then(Memory::encode).and_then(|bytes| {
            let name = blake3::hash(&bytes);
            cache.store_record(&name, &bytes).then(|| name.to_hex().to_string())
        });
        if let Some((key, bytes)) = record(memory) {
            cache.store_record(&key, &bytes);
        }
    }
}

impl Edited {
    /// Files that are no texts of the scene.
    pub(super) fn data(&self) -> impl Iterator<Item = &PathBuf> {
        self.record.files.iter().filter(|path| !self.record.texts.contains(path))
    }

    /// The files as they are now.
    pub(super) fn now(self) -> FilesNow {
        self.now
    }
}

impl FilesNow {
    fn look_at(files: &[PathBuf], root: &Root) -> Self {
        // The time first: a file that changes meanwhile will be seen to have another.
        let look = |path: &PathBuf| (path.clone(), (Stamp::of(path), file_hash(path, root)));
        Self(files.par_iter().map(look).collect())
    }

    fn hash(&self, path: &Path) -> Option<&String> {
        self.0.get(path).and_then(|(_, hash)| hash.as_ref())
    }
}

impl Record {
    /// `None` when a name is not UTF-8.
    fn encode(&self) -> Option<Vec<u8>> {
        fn names(paths: &[PathBuf]) -> Option<Vec<&str>> {
            paths.iter().map(|path| path.to_str()).collect()
        }
        let value = json!({
            "files": names(&self.files)?,
            "hashes": self.hashes,
            "texts": names(&self.texts)?,
            "pack": self.pack,
            "silent": self.silent,
            "memory": self.memory,
        });
        Some(value.to_string().into_bytes())
    }

    fn decode(bytes: &[u8]) -> Option<Self> {
        let value: Value = serde_json::from_slice(bytes).ok()?;
        let texts = |name: &str| -> Option<Vec<String>> {
            let list = value.get(name)?.as_array()?;
            list.iter().map(|text| Some(text.as_str()?.to_owned())).collect()
        };
        let paths = |name: &str| -> Option<Vec<PathBuf>> {
            Some(texts(name)?.into_iter().map(PathBuf::from).collect())
        };
        let (files, hashes) = (paths("files")?, texts("hashes")?);
        let memory = value.get("memory")?.as_str().map(str::to_owned);
        (files.len() == hashes.len()).then_some(Self {
            files,
            hashes,
            texts: paths("texts")?,
            pack: texts("pack")?.try_into().ok()?,
            silent: value.get("silent")?.as_bool()?,
            memory,
        })
    }
}

/// BLAKE3 of a regular file in the root; a file that is outside is not known, and reading it says why.
fn file_hash(path: &Path, root: &Root) -> Option<String> {
    let file = root.open(path).ok()?;
    let mut hasher = blake3::Hasher::new();
    std::io::copy(&mut std::io::BufReader::with_capacity(1 << 20, file), &mut hasher).ok()?;
    Some(hasher.finalize().to_hex().to_string())
}

/// `render_id` and `recipe_id` as texts.
fn names(ids: &[[u8; 32]; 2]) -> [String; 2] {
    ids.map(|id| blake3::Hash::from(id).to_hex().to_string())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_record_survives_and_damage_is_no_record() {
        let record = Record {
            files: vec!["a \"b\".rts".into(), "c.obj".into()],
            hashes: vec!["00".to_owned(), "11".to_owned()],
            texts: vec!["a \"b\".rts".into()],
            pack: ["22".to_owned(), "33".to_owned()],
            silent: true,
            memory: Some("44".to_owned()),
        };
        let bytes = record.encode().unwrap();
        assert_eq!(Record::decode(&bytes), Some(record));
        for len in 0..bytes.len() {
            assert_eq!(Record::decode(&bytes[..len]), None);
        }
        let text = String::from_utf8(bytes).unwrap();
        for (from, to) in [("\"00\",", ""), ("\"22\",", ""), ("[\"00", "[7,\"00")] {
            assert_eq!(Record::decode(text.replacen(from, to, 1).as_bytes()), None, "{from}");
        }
    }
}
