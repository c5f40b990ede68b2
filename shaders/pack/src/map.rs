//! The bytes of a file in memory, mapped or read: the only unsafe code of the project's packs.
//!
//! Turns a path into aligned bytes. Magic and length are judged on the first 128 bytes, before
//! anything is mapped or allocated. It does not know sections.

use std::fs::File;
use std::io::{Read, Seek, SeekFrom};
use std::path::Path;

use memmap2::Mmap;

use crate::error::PackError;
use crate::header::HEADER_LEN;
use crate::table;

/// How a pack gets into memory.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum MapMode {
    /// Mapped: pages are loaded when they are first touched. The file must not change meanwhile.
    #[default]
    Map,
    /// Read into memory: for network file systems and for files that somebody may write to.
    Read,
}

/// Alignment that every record and every word of a pack is happy with.
const WORD: usize = 16;

/// Bytes that start at a multiple of 16.
#[derive(Debug)]
pub(crate) enum Bytes {
    /// A private mapping; pages are aligned.
    Mapped(Mmap),
    /// Words of 16 bytes, and how many of their bytes count.
    Words(Vec<u128>, usize),
    /// A vector that the allocator happened to align.
    Aligned(Vec<u8>),
}

impl Bytes {
    /// The bytes; the start is a multiple of 16.
    pub(crate) fn as_slice(&self) -> &[u8] {
        match self {
            Self::Mapped(map) => map,
            Self::Words(words, len) => &bytemuck::cast_slice(words)[..*len],
            Self::Aligned(bytes) => bytes,
        }
    }

    /// Gives the memory of pages that were read back to the system; who reads them again gets them from the file.
    pub(crate) fn release(&self) {
        #[cfg(unix)]
        if let Self::Mapped(map) = self {
            #[expect(
                unsafe_code,
                reason = "the advice may change bytes of mappings that are not those of a file"
            )]
            // SAFETY: the mapping is one of a file and was never written to, so whatever page is dropped has the
            // same bytes when it comes back: those of the file, which nobody writes to while it is mapped.
            let advised = unsafe { map.unchecked_advise(memmap2::UncheckedAdvice::DontNeed) };
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

    /// Opens a file whose first bytes look like a pack of this format.
    pub(crate) fn open(path: &Path, mode: MapMode) -> Result<Self, PackError> {
        let io = |action| move |source| PackError::Io { action, path: path.to_owned(), source };
        let mut file = File::open(path).map_err(io("open"))?;
        // The size comes from the handle that is mapped, so no other file can slip in between.
        let metadata = file.metadata().map_err(io("open"))?;
        if !metadata.is_file() {
            return Err(PackError::NotAFile { path: path.to_owned() });
        }
        let mut head = Vec::with_capacity(HEADER_LEN);
        file.by_ref().take(HEADER_LEN as u64).read_to_end(&mut head).map_err(io("read"))?;
        table::check_header(&head, metadata.len())?;
        match mode {
            MapMode::Map => {
                #[expect(unsafe_code, reason = "the one mapping of the project")]
                // SAFETY: the caller of `Pack::open` chose `MapMode::Map`, whose documentation asks
                // that nobody writes to the file meanwhile; our own writer never does, it renames.
                let map = unsafe { map(&file) }.map_err(io("map"))?;
                Ok(Self::Mapped(map))
            }
            MapMode::Read => read(&mut file, metadata.len()).map_err(io("read")),
        }
    }
}

/// Maps a whole file, privately.
///
/// # Safety
///
/// Nobody may write to the file or shorten it while the mapping lives: the bytes behind `&[u8]`
/// would change, or touching them would raise SIGBUS.
#[expect(unsafe_code, reason = "mapping a file cannot be safe, see above")]
unsafe fn map(file: &File) -> std::io::Result<Mmap> {
    // SAFETY: the caller upholds the contract above. The mapping takes its length from this handle.
    unsafe { Mmap::map(file) }
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
