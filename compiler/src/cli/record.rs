//! What a finished compilation read and wrote, so that the next one can find that nothing changed.
//!
//! A record lies in the cache, under a name made of this very program, the folder, the scene, the
//! output and the options. It holds the hash of every file that was read and the names of the pack.
//! The pack is up to date when all files have the same bytes and the pack is still that one, whole.
//! Compilations that had anything to warn of leave no record: warnings are said every time.

use std::fs::File;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

use pack::{MapMode, Pack};
use rayon::prelude::*;
use serde_json::{Value, json};

use crate::cache::Cache;
use crate::lower::Trees;
use crate::reuse::{Reuse, Stamp};

/// Which compilation it is.
#[derive(Clone, Copy, Debug)]
pub(super) struct Job<'a> {
    pub(super) scene: &'a Path,
    pub(super) output: &'a Path,
    pub(super) defines: &'a [(String, String)],
    pub(super) trees: Trees<'a>,
}

/// A compilation whose result is still there.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Record {
    /// Files that it read, in order.
    pub(super) files: Vec<PathBuf>,
    hashes: Vec<String>,
    /// `render_id` and `recipe_id` of the pack.
    pack: [String; 2],
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
        field(b"record 1");
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

    /// The record, if the pack is what compiling would give.
    pub(super) fn up_to_date(&self, cache: &Cache) -> Option<Record> {
        let record = Record::decode(&cache.record(&self.key()?)?)?;
        let same = |(path, hash): (&PathBuf, &String)| file_hash(path).as_ref() == Some(hash);
        let current = record.files.par_iter().zip(&record.hashes).all(same);
        (current && pack_names(self.output)? == record.pack).then_some(record)
    }

    /// Keeps what `reuse` says was read, unless a file changed meanwhile.
    pub(super) fn keep(&self, cache: &Cache, reuse: &Reuse) {
        let record = || {
            let reads: Vec<(PathBuf, Stamp)> = reuse.reads().into_iter().collect();
            let hash = |(path, stamp): &(PathBuf, Stamp)| {
                let hash = file_hash(path)?;
                (Stamp::of(path) == *stamp).then_some(hash)
            };
            let hashes = reads.par_iter().map(hash).collect::<Option<_>>()?;
            let files = reads.into_iter().map(|(path, _)| path).collect();
            let record = Record { files, hashes, pack: pack_names(self.output)? };
            Some((self.key()?, record.encode()?))
        };
        if cache.root().is_some()
            && let Some((key, bytes)) = record()
        {
            cache.store_record(&key, &bytes);
        }
    }
}

impl Record {
    /// `None` when a name is not UTF-8.
    fn encode(&self) -> Option<Vec<u8>> {
        let names: Vec<&str> =
            self.files.iter().map(|path| path.to_str()).collect::<Option<_>>()?;
        let value = json!({ "files": names, "hashes": self.hashes, "pack": self.pack });
        Some(value.to_string().into_bytes())
    }

    fn decode(bytes: &[u8]) -> Option<Self> {
        let value: Value = serde_json::from_slice(bytes).ok()?;
        let texts = |name: &str| -> Option<Vec<String>> {
            let list = value.get(name)?.as_array()?;
            list.iter().map(|text| Some(text.as_str()?.to_owned())).collect()
        };
        let files: Vec<PathBuf> = texts("files")?.into_iter().map(PathBuf::from).collect();
        let (hashes, pack) = (texts("hashes")?, texts("pack")?.try_into().ok()?);
        (files.len() == hashes.len()).then_some(Self { files, hashes, pack })
    }
}

/// BLAKE3 of a regular file.
fn file_hash(path: &Path) -> Option<String> {
    if !std::fs::metadata(path).ok()?.is_file() {
        return None;
    }
    let mut hasher = blake3::Hasher::new();
    std::io::copy(
        &mut std::io::BufReader::with_capacity(1 << 20, File::open(path).ok()?),
        &mut hasher,
    )
    .ok()?;
    Some(hasher.finalize().to_hex().to_string())
}

/// The names of a pack whose sections are what was written.
fn pack_names(path: &Path) -> Option<[String; 2]> {
    let pack = Pack::open(path, MapMode::Map).ok()?;
    pack.verify_hashes().ok()?;
    Some([pack.render_id(), pack.recipe_id()].map(|id| blake3::Hash::from(id).to_hex().to_string()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_record_survives_and_damage_is_no_record() {
        let record = Record {
            files: vec!["a \"b\".rts".into(), "c.obj".into()],
            hashes: vec!["00".to_owned(), "11".to_owned()],
            pack: ["22".to_owned(), "33".to_owned()],
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
