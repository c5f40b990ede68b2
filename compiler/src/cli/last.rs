//! The last compilation of a scene to a pack: what it read and wrote, and the small results of its stages.
//!
//! It lies in the cache, under a name made of this very program, the folder, the scene and the output. The pack is up
//! to date when all files have the same bytes, the same was asked for, and the pack is still that one, whole. Where it
//! is not, stages find their results here, or in the pack.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::SystemTime;

use pack::Pack;
use serde::{Deserialize, Serialize};

use super::mapped;
use crate::cache::Cache;
use crate::input::Root;
use crate::lower::Trees;
use crate::reads::{Content, Reads};
use crate::stage::{self, Key, KeyOf, Results, Stages};

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

/// See the module.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Last {
    /// Files that it read, in order, and what they held.
    files: Vec<(PathBuf, Content)>,
    /// What else was asked for.
    options: Key,
    /// `render_id` and `recipe_id` of the pack.
    pack: [[u8; 32]; 2],
    /// It had nothing to warn of.
    pub(super) silent: bool,
    results: Results,
    /// Name of what is noted of the parts of its pack.
    parts: Option<[u8; 32]>,
}

impl Job<'_> {
    /// `None` where nobody can say which program this is.
    fn key(&self) -> Option<blake3::Hash> {
        let program = std::env::current_exe().ok()?;
        let data = std::fs::metadata(&program).ok()?;
        let built = data.modified().ok()?.duration_since(SystemTime::UNIX_EPOCH).ok()?;
        let folder = std::env::current_dir().ok()?;
        let mut key = KeyOf::stage("last 1");
        for path in [&program, &folder, self.scene, self.output] {
            key.bytes(path.as_os_str().as_encoded_bytes());
        }
        key.number(data.len()).bytes(&built.as_nanos().to_le_bytes());
        Some(key.end().into())
    }

    /// All that is asked for besides what files say.
    fn options(&self) -> Key {
        let mut key = KeyOf::stage("options");
        key.text(&self.trees.recipe());
        for (name, value) in self.defines {
            key.text(name).text(value);
        }
        key.end()
    }

    /// What is there of the last compilation.
    pub(super) fn last(&self) -> Option<Last> {
        let bytes = self.trees.cache.record(&self.key()?)?;
        let (hash, bytes) = bytes.split_first_chunk::<32>()?;
        let last = || stage::decode::<Last>(bytes);
        last().filter(|_| blake3::hash(bytes) == blake3::Hash::from(*hash))
    }

    /// Keeps what was compiled, unless a file changed meanwhile.
    pub(super) fn keep(
        &self,
        (reads, stages): (&Reads, &Stages),
        pack: [[u8; 32]; 2],
        silent: bool,
        before: Option<&Last>,
    ) {
        let cache = self.trees.cache;
        let (Some(_), Some(key)) = (cache.root(), self.key()) else { return };
        let Some(files) = reads.contents(self.root) else { return };
        let (results, parts) = stages.results();
        let parts = match parts {
            Some(parts) => stage::encode(&parts).and_then(|bytes| {
                let name = blake3::hash(&bytes);
                cache.store_record(&name, &bytes).then_some(name.into())
            }),
            None => before.and_then(|last| last.parts),
        };
        let last = Last { files, options: self.options(), pack, silent, results, parts };
        if let Some(bytes) = stage::encode(&last) {
            let hash = blake3::hash(&bytes);
            cache.store_record(&key, &[hash.as_bytes(), bytes.as_slice()].concat());
        }
    }
}

impl Last {
    /// Files that it read.
    pub(super) fn files(&self) -> impl ExactSizeIterator<Item = &PathBuf> {
        self.files.iter().map(|(path, _)| path)
    }

    /// Its pack, whole and verified.
    pub(super) fn pack(&self, output: &Path) -> Option<Arc<Pack>> {
        let pack = mapped::map(output).ok()?;
        pack.verify_hashes().ok()?;
        ([pack.render_id(), pack.recipe_id()] == self.pack).then(|| Arc::new(pack))
    }

    /// Whether compiling would read and be asked for the same.
    pub(super) fn is_of(&self, job: &Job<'_>, reads: &Reads) -> bool {
        let paths: Vec<PathBuf> = self.files().cloned().collect();
        reads.look_at(&paths, job.root);
        let same = |(path, content): &(PathBuf, Content)| reads.content(path, job.root) == *content;
        self.options == job.options() && self.files.iter().all(same)
    }

    /// Its results, with those of its `pack` if that is there.
    pub(super) fn stages(&self, pack: Option<Arc<Pack>>, cache: &Cache) -> Stages {
        let (name, cache) = (self.parts, cache.clone());
        let parts = move || {
            let name = blake3::Hash::from(name?);
            let bytes = cache.record(&name).filter(|bytes| blake3::hash(bytes) == name)?;
            stage::decode(&bytes)
        };
        Stages::after(self.results.clone(), pack).with_parts(parts)
    }

    /// Whether its pack was made by this recipe.
    pub(super) fn has_recipe(&self, recipe_id: [u8; 32]) -> bool {
        self.pack[1] == recipe_id
    }
}
