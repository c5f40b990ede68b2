//! Trees on disk, named by what they were built from.
//!
//! Turns fragments into trees, from a file when this very tree was built before. A file holds the
//! *shape* of a tree (child references, the order of primitives, where triangles were split), never
//! boxes: those are recomputed from the fragments, so that no file, however damaged or forged, can make a ray miss. A file
//! that fails any check is rebuilt and reported as a warning. With or without the cache the result
//! has the same bytes; only the time differs.
//!
//! The name is BLAKE3 over builder, parameters, file layout, all boxes, and all corners where triangles
//! may be split. Files are written under a
//! temporary name and renamed, so readers see all or nothing.

mod dir;
mod entry;

use files::ShowPath as _;
use std::io::{self, Read as _};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use thiserror::Error;

use crate::bvh::{self, BvhError, Input, Preset, Tree};

pub use entry::EntryFault;

/// Trees of fewer primitives are not kept: each would be a file of its own, to save a fraction of a millisecond.
pub const MIN_PRIMITIVES: usize = 256;
/// Default limit of all files together, bytes.
const CAP: u64 = 4 << 30;
/// Bytes of a record: thousands of file names, or a hundred thousand emitters and triangles of filled things.
const MAX_RECORD: u64 = 64 << 20;

/// Where trees are kept, if anywhere.
#[derive(Clone, Debug)]
pub struct Cache {
    root: Option<PathBuf>,
    cap: u64,
}

/// A tree and where it came from.
#[derive(Clone, Debug)]
pub struct Cached {
    /// The tree.
    pub tree: Tree,
    /// Where it came from.
    pub source: Source,
    /// What went wrong without harm.
    pub warning: Option<CacheWarning>,
}

/// Where a tree came from, and its time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Source {
    /// Built now and too small to keep, or there is no cache.
    Built {
        /// What building took.
        took: Duration,
    },
    /// Built now and stored.
    Stored {
        /// What building took.
        took: Duration,
    },
    /// Read from the cache.
    Loaded {
        /// What building took when it was stored, less what reading took now.
        saved: Duration,
    },
}

/// Something about the cache that does not stop the work.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
pub enum CacheWarning {
    /// A file failed a check; the tree was built again.
    #[error("cache entry {path} is damaged ({fault}); the tree was rebuilt")]
    Damaged {
        /// The file, relative to the cache directory.
        path: String,
        /// What was wrong.
        fault: EntryFault,
    },
    /// A file could not be written, so the next run will build again.
    #[error("cannot write to the cache {root}: {reason}; continuing without")]
    Unwritable {
        /// The cache directory.
        root: String,
        /// What the system said.
        reason: String,
    },
}

/// A failed request about the cache as a whole.
#[derive(Debug, Error)]
pub enum CacheError {
    /// The directory cannot be read or changed.
    #[error("cannot access the cache {path}")]
    Io {
        /// The directory or file.
        path: String,
        /// What the system said.
        #[source]
        source: io::Error,
    },
}

/// What the cache holds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct CacheStats {
    /// Number of trees.
    pub entries: u64,
    /// Their size together, bytes.
    pub bytes: u64,
}

impl Cache {
    /// No cache: everything is built.
    #[must_use]
    pub fn disabled() -> Self {
        Self { root: None, cap: CAP }
    }

    /// A cache in a directory, which need not exist yet.
    #[must_use]
    pub fn at(root: impl Into<PathBuf>) -> Self {
        Self { root: Some(root.into()), cap: CAP }
    }

    /// The user's cache: `$RTC_CACHE_DIR`, else `$XDG_CACHE_HOME/rtc`, else the place that the
    /// system has for it. Disabled when there is none.
    #[must_use]
    pub fn from_env() -> Self {
        let system = if cfg!(windows) {
            dir::System::Windows
        } else if cfg!(target_os = "macos") {
            dir::System::MacOs
        } else {
            dir::System::Unix
        };
        Self { root: dir::locate(system, |name| std::env::var_os(name)), cap: CAP }
    }

    /// The same cache with another limit of all files together, bytes.
    #[must_use]
    pub fn with_cap(self, cap: u64) -> Self {
        Self { cap, ..self }
    }

    /// The directory, if there is a cache.
    #[must_use]
    pub fn root(&self) -> Option<&Path> {
        self.root.as_deref()
    }

    /// The tree of the input, read or built.
    ///
    /// # Errors
    /// When no tree can be built; trouble with files is a warning.
    pub fn tree(&self, preset: Preset, input: Input<'_>) -> Result<Cached, BvhError> {
        let start = Instant::now();
        let root = self.root.as_deref().filter(|_| input.fragments.len() >= MIN_PRIMITIVES);
        let Some(root) = root else {
            let tree = bvh::build(preset, input)?;
            return Ok(Cached {
                tree,
                source: Source::Built { took: start.elapsed() },
                warning: None,
            });
        };
        let key = key(preset, &input);
        let relative = dir::entry_path(&key);
        let path = root.join(&relative);
        let mut warning = None;
        match entry::load(&path, &key, &input) {
            Ok((tree, took)) => {
                dir::touch(&path);
                let saved = took.saturating_sub(start.elapsed());
                return Ok(Cached { tree, source: Source::Loaded { saved }, warning });
            }
            Err(EntryFault::Absent) => {}
            Err(fault) => {
                let path = relative.to_string_lossy().replace('\\', "/");
                warning = Some(CacheWarning::Damaged { path, fault });
            }
        }
        let start = Instant::now();
        let tree = bvh::build(preset, input)?;
        let took = start.elapsed();
        let source = match dir::store(&path, &entry::encode(&tree, &key, took)) {
            Ok(()) => Source::Stored { took },
            Err(error) => {
                let (root, reason) = (root.shown().to_string(), error.to_string());
                warning = Some(CacheWarning::Unwritable { root, reason });
                Source::Built { took }
            }
        };
        Ok(Cached { tree, source, warning })
    }

    /// What `store_record` was given for this key; nothing if it is longer than any record.
    pub(crate) fn record(&self, key: &blake3::Hash) -> Option<Vec<u8>> {
        let path = self.root.as_ref()?.join(dir::record_path(key));
        let file = files::open_regular(&path).ok()?;
        let mut bytes = Vec::new();
        file.take(MAX_RECORD + 1).read_to_end(&mut bytes).ok()?;
        dir::touch(&path);
        (bytes.len() as u64 <= MAX_RECORD).then_some(bytes)
    }

    /// Keeps some bytes under a key; says whether it did. A cache that cannot be written harms nobody.
    pub(crate) fn store_record(&self, key: &blake3::Hash, bytes: &[u8]) -> bool {
        let Some(root) = &self.root else { return false };
        let fits = bytes.len() as u64 <= MAX_RECORD;
        fits && dir::store(&root.join(dir::record_path(key)), bytes).is_ok()
    }

    /// How much there is.
    pub fn stats(&self) -> Result<CacheStats, CacheError> {
        let files = self.files()?;
        let bytes = files.iter().map(|f| f.bytes).sum();
        let entries = files.iter().filter(|file| file.is_tree).count() as u64;
        Ok(CacheStats { entries, bytes })
    }

    /// Deletes every tree, and nothing else; returns what there was.
    pub fn clear(&self) -> Result<CacheStats, CacheError> {
        self.delete_oldest(None)
    }

    /// Deletes the trees that were not used for longest until the rest is within the limit; returns
    /// what was deleted.
    pub fn prune(&self) -> Result<CacheStats, CacheError> {
        self.delete_oldest(Some(self.cap))
    }

    /// Deletes the oldest files while more than `keep` bytes are left; all of them for `None`.
    fn delete_oldest(&self, keep: Option<u64>) -> Result<CacheStats, CacheError> {
        let mut files = self.files()?;
        files.sort_by(|a, b| (a.used, &a.path).cmp(&(b.used, &b.path)));
        let mut left: u64 = files.iter().map(|f| f.bytes).sum();
        let mut deleted = CacheStats::default();
        for file in files {
            if keep.is_some_and(|keep| left <= keep) {
                break;
            }
            dir::remove(&file.path).map_err(|e| io_error(&file.path, e))?;
            left -= file.bytes;
            deleted.entries += u64::from(file.is_tree);
            deleted.bytes += file.bytes;
        }
        Ok(deleted)
    }

    fn files(&self) -> Result<Vec<dir::File>, CacheError> {
        let Some(root) = &self.root else { return Ok(Vec::new()) };
        dir::files(root).map_err(|e| io_error(root, e))
    }
}

fn io_error(path: &Path, source: io::Error) -> CacheError {
    CacheError::Io { path: path.shown().to_string(), source }
}

/// The name of a tree: everything that its shape depends on.
fn key(preset: Preset, input: &Input<'_>) -> blake3::Hash {
    let fragments = &input.fragments;
    let mut hasher = blake3::Hasher::new();
    for part in [preset.recipe(), entry::LAYOUT] {
        hasher.update(&(part.len() as u64).to_le_bytes());
        hasher.update(part.as_bytes());
    }
    hasher.update(&(fragments.len() as u64).to_le_bytes());
    hasher.update(bytemuck::cast_slice(fragments));
    if preset.splits_triangles() {
        hasher.update(bytemuck::cast_slice(&input.corners));
    }
    hasher.finalize()
}
