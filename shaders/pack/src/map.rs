//! The bytes of a file in memory, mapped or read: with `bus`, the only unsafe code of this crate.
//!
//! Turns a path into aligned bytes. Magic and length are judged on the first 128 bytes, before
//! anything is mapped or allocated. A mapped file has a [`Witness`] that tells when it is no longer what was opened.
//! It does not know sections.

use std::fs::{File, Metadata};
use std::io::{Read, Seek, SeekFrom};
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};
use std::time::{Duration, SystemTime};

use memmap2::Mmap;

use crate::bus::Guarded;
use crate::error::{Alteration, PackError};
use crate::header::HEADER_LEN;
use crate::table;

/// Alignment that every record and every word of a pack is happy with.
const WORD: usize = 16;

/// Bytes that start at a multiple of 16.
#[derive(Debug)]
pub(crate) enum Bytes {
    /// A private mapping; pages are aligned.
    Mapped(Arc<Mapping>),
    /// Words of 16 bytes, and how many of their bytes count.
    Words(Vec<u128>, usize),
    /// A vector that the allocator happened to align.
    Aligned(Vec<u8>),
}

impl Bytes {
    /// The bytes; the start is a multiple of 16.
    pub(crate) fn as_slice(&self) -> &[u8] {
        match self {
            Self::Mapped(mapping) => &mapping.map,
            Self::Words(words, len) => &bytemuck::cast_slice(words)[..*len],
            Self::Aligned(bytes) => bytes,
        }
    }

    /// Gives the memory of pages that were read back to the system; who reads them again gets them from the file.
    pub(crate) fn release(&self) {
        #[cfg(unix)]
        if let Self::Mapped(mapping) = self {
            #[expect(
                unsafe_code,
                reason = "the advice may change bytes of mappings that are not those of a file"
            )]
            // SAFETY: the mapping is one of a file and was never written to, so whatever page is dropped has the
            // same bytes when it comes back: those of the file, which nobody writes to while it is mapped, or the
            // zeros that took their place.
            let advised =
                unsafe { mapping.map.unchecked_advise(memmap2::UncheckedAdvice::DontNeed) };
            // A system that does not take the advice keeps the pages, which harms nobody.
            let _ = advised;
        }
    }

    /// Takes the vector as it is, or copies it when it is not aligned.
    pub(crate) fn from_vec(bytes: Vec<u8>) -> Self {
        if bytes.as_ptr().addr().is_multiple_of(WORD) {
            return Self::Aligned(bytes);
        }
        let mut words = vec![0u128; bytes.len().div_ceil(WORD)];
        bytemuck::cast_slice_mut(&mut words)[..bytes.len()].copy_from_slice(&bytes);
        Self::Words(words, bytes.len())
    }

    /// Reads a file whose first bytes look like a pack of this format.
    pub(crate) fn read(path: &Path) -> Result<Self, PackError> {
        let (mut file, data) = open(path)?;
        read(&mut file, data.len()).map_err(io("read", path))
    }

    /// Reads a pack of at most `most` bytes from anything that gives bytes, to its end.
    pub(crate) fn receive(mut from: impl Read, most: u64) -> Result<Self, PackError> {
        let name = Path::new("-");
        let mut bytes = Vec::new();
        from.by_ref().take(HEADER_LEN as u64).read_to_end(&mut bytes).map_err(io("read", name))?;
        let len = table::header_says(&bytes)?;
        if len > most {
            return Err(PackError::TooLarge { len, most });
        }
        // One byte more shows that something follows. Memory is taken as the bytes come, not as they are announced.
        let rest = len.saturating_sub(bytes.len() as u64).saturating_add(1);
        from.take(rest).read_to_end(&mut bytes).map_err(io("read", name))?;
        table::check_header(&bytes[..HEADER_LEN], bytes.len() as u64)?;
        Ok(Self::from_vec(bytes))
    }

    /// Maps a file whose first bytes look like a pack of this format.
    ///
    /// # Safety
    ///
    /// See [`crate::Pack::map`].
    #[expect(unsafe_code, reason = "mapping a file cannot be safe")]
    pub(crate) unsafe fn map(path: &Path) -> Result<Self, PackError> {
        let (file, data) = open(path)?;
        // SAFETY: the caller sees to it that nobody writes to the file. The length is taken from this handle.
        let map = unsafe { Mmap::map(&file) }.map_err(io("map", path))?;
        // SAFETY: this is the whole of the mapping, of which only slices of plain bytes are given away, each borrowed
        // from the `Mapping`, where the guard is dropped before the map.
        let guard = unsafe { Guarded::new(&map) }.map_err(io("map", path))?;
        // A file that was cut off since it was opened is found by its length.
        let stamp = Stamp::of(&data);
        let (written, hashes) = (Mutex::new(stamp.written), OnceLock::new());
        let path = path.to_owned();
        Ok(Self::Mapped(Arc::new(Mapping { guard, map, file, path, stamp, written, hashes })))
    }

    /// Where hashed bytes lie, and their hashes: then a witness can tell whether a file that was written to has the
    /// bytes that it had.
    pub(crate) fn are_hashed(&self, hashes: impl Iterator<Item = (Range<usize>, [u8; 16])>) {
        if let Self::Mapped(mapping) = self {
            mapping.hashes.get_or_init(|| hashes.collect());
        }
    }

    /// Who knows whether the file has changed; memory does not change.
    pub(crate) fn witness(&self) -> Option<Witness> {
        match self {
            Self::Mapped(mapping) => Some(Witness(Arc::clone(mapping))),
            Self::Words(..) | Self::Aligned(_) => None,
        }
    }
}

fn io<'a>(action: &'static str, path: &'a Path) -> impl FnOnce(std::io::Error) -> PackError + 'a {
    move |source| PackError::Io { action, path: path.to_owned(), source }
}

/// A regular file that begins as a pack, and what the system says of it. A pipe is not waited for.
fn open(path: &Path) -> Result<(File, Metadata), PackError> {
    let regular = |data: Metadata| {
        let is_file = data.is_file();
        is_file.then_some(data).ok_or_else(|| PackError::NotAFile { path: path.to_owned() })
    };
    // Devices may act when they are opened, so most are refused before. What slips in between is caught below.
    regular(std::fs::metadata(path).map_err(io("open", path))?)?;
    let mut options = File::options();
    options.read(true);
    #[cfg(unix)]
    {
        use std::os::unix::fs::OpenOptionsExt as _;
        options.custom_flags(libc::O_NONBLOCK);
    }
    #[cfg(windows)]
    {
        use std::os::windows::fs::OpenOptionsExt as _;
        // FILE_SHARE_READ and FILE_SHARE_DELETE: while it is open nobody writes to it, but it may be renamed.
        options.share_mode(1 | 4);
    }
    let mut file = options.open(path).map_err(io("open", path))?;
    // The size comes from the handle that is mapped, so no other file can slip in between.
    let data = regular(file.metadata().map_err(io("open", path))?)?;
    let mut head = Vec::with_capacity(HEADER_LEN);
    file.by_ref().take(HEADER_LEN as u64).read_to_end(&mut head).map_err(io("read", path))?;
    table::check_header(&head, data.len())?;
    Ok((file, data))
}

/// A mapped file. The order of the first two fields is the order in which they are dropped, and matters.
#[derive(Debug)]
pub(crate) struct Mapping {
    guard: Guarded,
    map: Mmap,
    file: File,
    path: PathBuf,
    stamp: Stamp,
    /// Time of the last write of which it is known that it left the bytes as they were opened.
    written: Mutex<Option<SystemTime>>,
    hashes: OnceLock<Vec<(Range<usize>, [u8; 16])>>,
}

impl Mapping {
    /// Whether everything that is hashed has its hash; false where nothing is known. On this thread alone: the
    /// threads of a pool may wait for the one that asks.
    fn has_its_bytes(&self) -> bool {
        let is_same = |(range, hash): &(Range<usize>, [u8; 16])| {
            blake3::hash(&self.map[range.clone()]).as_bytes().starts_with(hash)
        };
        self.hashes.get().is_some_and(|hashes| hashes.iter().all(is_same))
    }
}

/// Tells whether the file of a mapped pack is still as it was opened. It keeps the mapping alive.
#[derive(Clone, Debug)]
pub struct Witness(Arc<Mapping>);

impl Witness {
    /// Fails when the file was written to or cut off, or cannot be read any more. One call of the system; but where
    /// only its time is another one, the hashes decide whether it was written to, and from then on that time counts.
    pub fn look(&self) -> Result<(), PackError> {
        let (mapping, altered) = (&*self.0, |how| Err(PackError::Altered { how }));
        let mut written = mapping.written.lock().unwrap_or_else(PoisonError::into_inner);
        let Ok(data) = mapping.file.metadata() else { return altered(Alteration::Lost) };
        let (now, then) = (Stamp::of(&data), mapping.stamp);
        if now.len != then.len {
            return altered(Alteration::Length { now: now.len, then: then.len });
        }
        if mapping.guard.is_lost() {
            return altered(Alteration::Lost);
        }
        if now.written != *written {
            if !mapping.has_its_bytes() {
                return altered(Alteration::Written);
            }
            // A write since then moves the time once more.
            *written = now.written;
        }
        Ok(())
    }

    /// As [`Self::look`]; a network file system asks its server for it, as it does whenever a file is opened.
    pub fn look_closely(&self) -> Result<(), PackError> {
        drop(open(&self.0.path));
        self.look()
    }

    /// Whether the file may have been written to without its time telling: that was set by somebody, or was so short
    /// a time ago that its clock or a late write of a page need not have moved it. Then only the hashes can tell.
    #[must_use]
    pub fn is_in_doubt(&self) -> bool {
        let now = self.0.file.metadata().map(|data| Stamp::of(&data));
        self.0.stamp.fresh || now.is_ok_and(|now| now.changed != self.0.stamp.changed)
    }

    /// Whether both are of the same mapping.
    #[must_use]
    pub fn is(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

/// Systems write a page that a process has mapped and altered within this time, and set the file's time then.
const LATE: Duration = Duration::from_mins(1);

/// What the system says of a file.
#[derive(Clone, Copy, Debug)]
struct Stamp {
    len: u64,
    /// Time of the last write.
    written: Option<SystemTime>,
    /// Time of the last change of anything, names and permissions included, in seconds and nanoseconds.
    changed: (i64, i64),
    /// It was written to shortly before, or in the future.
    fresh: bool,
}

impl Stamp {
    fn of(data: &Metadata) -> Self {
        let written = data.modified().ok();
        #[cfg(unix)]
        let changed = {
            use std::os::unix::fs::MetadataExt as _;
            (data.ctime(), data.ctime_nsec())
        };
        #[cfg(not(unix))]
        let changed = (0, 0);
        let age = written.and_then(|written| SystemTime::now().duration_since(written).ok());
        Self { len: data.len(), written, changed, fresh: age.is_none_or(|age| age < LATE) }
    }
}

/// Reads `len` bytes from the start of the file into words.
fn read(file: &mut File, len: u64) -> std::io::Result<Bytes> {
    let len = usize::try_from(len).map_err(|_| std::io::ErrorKind::OutOfMemory)?;
    let mut words: Vec<u128> = Vec::new();
    words.try_reserve_exact(len.div_ceil(WORD)).map_err(|_| std::io::ErrorKind::OutOfMemory)?;
    words.resize(len.div_ceil(WORD), 0);
    file.seek(SeekFrom::Start(0))?;
    file.read_exact(&mut bytemuck::cast_slice_mut(&mut words)[..len])?;
    Ok(Bytes::Words(words, len))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_kind_of_bytes_is_aligned() {
        for len in [0, 1, 15, 16, 17, 4097] {
            let vec: Vec<u8> = (0..=255).cycle().take(len).collect();
            let bytes = Bytes::from_vec(vec.clone());
            assert_eq!(bytes.as_slice(), vec);
            assert!(len == 0 || bytes.as_slice().as_ptr().addr().is_multiple_of(WORD));
        }
        let words = Bytes::Words(vec![u128::MAX; 2], 17);
        assert_eq!(words.as_slice(), [255; 17]);
    }
}
