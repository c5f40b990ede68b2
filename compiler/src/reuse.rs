//! What a compilation read, and what the next one of the same process need not do again.
//!
//! Meshes, images and proven kernels are kept between compilations of one `--watch` and found by
//! path, size and time of their files; what was not asked for in a compilation is forgotten after it.
//! A single compilation keeps nothing: it uses this to count and to list the files it read. The
//! result never depends on what is kept here. Trees have a cache of their own, on disk.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::SystemTime;

use pack::manifest::KernelSize;

use crate::import::{Image, ImportError, MeshFile};

/// Size and time of a file; `None` while there is none. Polling these works on every file system.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stamp(Option<(u64, SystemTime)>);

impl Stamp {
    /// Of the file as it is now.
    #[must_use]
    pub fn of(path: &Path) -> Self {
        let data = std::fs::metadata(path).ok();
        Self(data.and_then(|data| Some((data.len(), data.modified().ok()?))))
    }
}

/// How much of something was there already.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Share {
    /// Taken over.
    pub reused: usize,
    /// Needed.
    pub all: usize,
}

/// What of the geometry and the textures was taken over from an earlier pack.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Geometry {
    /// Nothing: all files were read.
    #[default]
    Nothing,
    /// Textures, and all meshes but those that stand elsewhere: only their files were read.
    OfOthers,
    /// Everything: no file was read.
    All,
}

/// What a compilation took over and what it did anew.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Reused {
    /// Scene texts, read and checked each time.
    pub texts: usize,
    /// Mesh files.
    pub meshes: Share,
    /// Image files that textures name; those of mesh files belong to these.
    pub images: Share,
    /// What is made of files and is that of an earlier pack.
    pub geometry: Geometry,
    /// Trees.
    pub trees: Share,
    /// The proof of the kernel.
    pub kernel: Share,
}

/// See the module.
#[derive(Debug, Default)]
pub struct Reuse {
    keep: bool,
    state: Mutex<State>,
}

#[derive(Debug, Default)]
struct State {
    reads: BTreeMap<PathBuf, Stamp>,
    meshes: BTreeMap<String, Kept<MeshFile>>,
    images: BTreeMap<String, Kept<Image>>,
    kernels: BTreeMap<String, KernelSize>,
    counts: Reused,
}

#[derive(Debug)]
struct Kept<T> {
    value: Arc<T>,
    files: Vec<(PathBuf, Stamp)>,
    used: bool,
}

impl<T> Clone for Kept<T> {
    fn clone(&self) -> Self {
        Self { value: Arc::clone(&self.value), files: self.files.clone(), used: self.used }
    }
}

impl Reuse {
    /// For one compilation.
    #[must_use]
    pub fn once() -> Self {
        Self::default()
    }

    /// For compilations one after the other.
    #[must_use]
    pub fn keeping() -> Self {
        Self { keep: true, ..Self::default() }
    }

    fn lock(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// A compilation begins; what the last one did not ask for is forgotten.
    pub fn begin(&self) {
        let mut state = self.lock();
        state.reads.clear();
        state.counts = Reused::default();
        state.meshes.retain(|_, kept| std::mem::take(&mut kept.used));
        state.images.retain(|_, kept| std::mem::take(&mut kept.used));
    }

    /// Nothing is forgotten after this compilation: it had no need to ask.
    pub(crate) fn keep_all(&self) {
        let mut state = self.lock();
        state.meshes.values_mut().for_each(|kept| kept.used = true);
        state.images.values_mut().for_each(|kept| kept.used = true);
    }

    /// A file is about to be read, whether it is there or not.
    pub fn read(&self, path: &Path) {
        let stamp = Stamp::of(path);
        self.lock().reads.entry(path.to_owned()).or_insert(stamp);
    }

    /// Every file that was asked for since `begin`, as it was then.
    #[must_use]
    pub fn reads(&self) -> BTreeMap<PathBuf, Stamp> {
        self.lock().reads.clone()
    }

    /// What was counted since `begin`.
    pub(crate) fn counts(&self) -> Reused {
        self.lock().counts
    }

    /// The mesh file that `load` gives; `format`: how it is read.
    pub(crate) fn mesh(
        &self,
        path: &Path,
        format: &str,
        load: impl FnOnce() -> Result<MeshFile, ImportError>,
    ) -> Result<Arc<MeshFile>, ImportError> {
        self.read(path);
        let key = format!("{} {format}", path.display());
        let found = self.lock().meshes.get(&key).cloned();
        let found = found.filter(|kept| is_current(&kept.files));
        let reused = found.is_some();
        let kept = if let Some(kept) = found {
            kept
        } else {
            let value = Arc::new(load()?);
            let files = value.report.files.iter().map(|file| file.path.as_path());
            Kept { files: self.stamps(files.chain([path])), value, used: true }
        };
        let mut state = self.lock();
        state.counts.meshes.count(reused);
        state.note(&kept.files);
        if self.keep {
            state.meshes.insert(key, Kept { used: true, ..kept.clone() });
        }
        Ok(kept.value)
    }

    /// The image that `load` gives.
    pub(crate) fn image(
        &self,
        path: &Path,
        load: impl FnOnce() -> Result<Image, ImportError>,
    ) -> Result<Arc<Image>, ImportError> {
        self.read(path);
        let key = path.display().to_string();
        let found = self.lock().images.get(&key).cloned();
        let found = found.filter(|kept| is_current(&kept.files));
        let reused = found.is_some();
        let kept = if let Some(kept) = found {
            kept
        } else {
            let files = self.stamps([path]);
            Kept { files, value: Arc::new(load()?), used: true }
        };
        let mut state = self.lock();
        state.counts.images.count(reused);
        if self.keep {
            state.images.insert(key, Kept { used: true, ..kept.clone() });
        }
        Ok(kept.value)
    }

    /// How large this kernel is, if it was proven before; `prove` proves and measures it otherwise.
    pub(crate) fn kernel<E>(
        &self,
        text: &str,
        prove: impl FnOnce() -> Result<KernelSize, E>,
    ) -> Result<KernelSize, E> {
        let known = self.lock().kernels.get(text).copied();
        let size = known.map_or_else(prove, Ok)?;
        let mut state = self.lock();
        state.counts.kernel.count(known.is_some());
        if self.keep && known.is_none() {
            state.kernels.insert(text.to_owned(), size);
        }
        Ok(size)
    }

    /// This kernel was proven by the same program, and is that large.
    pub(crate) fn know_kernel(&self, text: &str, size: KernelSize) {
        self.lock().kernels.insert(text.to_owned(), size);
    }

    /// Stamps of files, those taken before they were read where there are any.
    fn stamps<'a>(&self, paths: impl IntoIterator<Item = &'a Path>) -> Vec<(PathBuf, Stamp)> {
        let state = self.lock();
        let before = |path: &Path| state.reads.get(path).copied();
        let stamp = |path: &Path| before(path).unwrap_or_else(|| Stamp::of(path));
        paths.into_iter().map(|path| (path.to_owned(), stamp(path))).collect()
    }
}

impl State {
    fn note(&mut self, files: &[(PathBuf, Stamp)]) {
        for (path, stamp) in files {
            self.reads.entry(path.clone()).or_insert(*stamp);
        }
    }
}

impl Share {
    fn count(&mut self, reused: bool) {
        self.all += 1;
        self.reused += usize::from(reused);
    }
}

fn is_current(files: &[(PathBuf, Stamp)]) -> bool {
    files.iter().all(|(path, stamp)| Stamp::of(path) == *stamp)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::import::Pixels;

    fn image(width: u32) -> Image {
        let data = Pixels::Rgba8(vec![0; 4 * width as usize]);
        Image { width, height: 1, data, has_alpha: false, clamped: 0, is_radiance: false }
    }

    #[test]
    fn an_image_is_read_again_when_its_file_changes() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.png");
        std::fs::write(&path, "1").unwrap();
        let reuse = Reuse::keeping();
        let width = |width| {
            reuse.begin();
            let found = reuse.image(&path, || Ok(image(width))).unwrap().width;
            (found, reuse.counts().images)
        };
        assert_eq!(width(1), (1, Share { reused: 0, all: 1 }));
        assert_eq!(width(2), (1, Share { reused: 1, all: 1 }));
        std::fs::write(&path, "22").unwrap();
        assert_eq!(width(3), (3, Share { reused: 0, all: 1 }));
        assert_eq!(reuse.reads().keys().collect::<Vec<_>>(), [&path]);
        // A compilation that does not ask for it lets it go.
        reuse.begin();
        assert_eq!(width(4), (4, Share { reused: 0, all: 1 }));
    }

    #[test]
    fn a_single_compilation_keeps_nothing() {
        let reuse = Reuse::once();
        let path = Path::new("there is no such file");
        reuse.image(path, || Ok(image(1))).unwrap();
        reuse.kernel("text", || Ok::<_, ()>(KernelSize::default())).unwrap();
        assert_eq!(reuse.image(path, || Ok(image(2))).unwrap().width, 2);
        assert_eq!(reuse.kernel("text", || Err("again")), Err("again"));
        assert_eq!(reuse.reads()[path], Stamp::of(path));
    }

    #[test]
    fn a_kernel_is_proven_once_and_a_bad_one_each_time() {
        let reuse = Reuse::keeping();
        assert_eq!(reuse.kernel("bad", || Err("no")), Err("no"));
        assert_eq!(reuse.kernel("bad", || Err("no")), Err("no"));
        let size = KernelSize { lines: 3, words: 70 };
        assert_eq!(reuse.kernel("good", || Ok::<_, &str>(size)), Ok(size));
        assert_eq!(reuse.kernel("good", || Err("asked again")), Ok(size));
        assert_eq!(reuse.counts().kernel, Share { reused: 1, all: 2 });
    }
}
