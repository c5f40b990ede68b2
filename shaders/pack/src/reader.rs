//! Opens packs. The only way to a record leads through [`Pack::check`].
//!
//! Turns bytes into slices of records, in place. It keeps the invariant that a `Pack<Checked>` has
//! passed every rule but the hashes: indices lie inside their tables, the tree is a tree, numbers
//! are finite. It does not know what a device does with the records.

use std::path::Path;

use crate::abi::{Camera, RenderSettings, Sky};
use crate::check;
use crate::contents::Contents;
use crate::error::PackError;
use crate::header::{Entry, section_hash};
use crate::kind::{Kind, PackRecord};
use crate::manifest::Manifest;
use crate::map::{Bytes, MapMode};
use crate::table::{self, Table, entry_range};

/// State of a pack that nobody has looked at: it has no accessors.
#[derive(Debug)]
pub struct Unchecked(());

/// State of a pack that has passed every rule.
#[derive(Debug)]
pub struct Checked {
    table: Table,
}

/// A render pack in memory.
#[derive(Debug)]
pub struct Pack<State = Checked> {
    bytes: Bytes,
    state: State,
}

/// One section of a checked pack.
#[derive(Clone, Copy, Debug)]
pub struct Section<'a> {
    /// Its name.
    pub kind: Kind,
    /// Version of its elements.
    pub version: u32,
    /// Elements.
    pub count: u64,
    /// Bytes of one element.
    pub elem_size: u32,
    /// All of its bytes.
    pub bytes: &'a [u8],
    /// First 128 bits of the BLAKE3 hash of `bytes`, as stored; see [`Pack::verify_hashes`].
    pub hash: [u8; 16],
}

impl Pack<Unchecked> {
    /// Takes the bytes of a pack without looking at them.
    #[must_use]
    pub fn unchecked(bytes: Vec<u8>) -> Self {
        Self { bytes: Bytes::from_vec(bytes), state: Unchecked(()) }
    }

    /// Opens a file of which only the header has been looked at.
    pub fn open_unchecked(path: &Path, mode: MapMode) -> Result<Self, PackError> {
        Ok(Self { bytes: Bytes::open(path, mode)?, state: Unchecked(()) })
    }

    /// Checks every rule but the hashes, at about the speed of memory.
    pub fn check(self) -> Result<Pack<Checked>, PackError> {
        let table = table::check(self.bytes.as_slice())?;
        let pack = Pack { bytes: self.bytes, state: Checked { table } };
        check::contents(&pack.contents()?, pack.features())?;
        Ok(pack)
    }
}

impl Pack<Checked> {
    /// Opens and checks a file.
    pub fn open(path: impl AsRef<Path>, mode: MapMode) -> Result<Self, PackError> {
        Pack::open_unchecked(path.as_ref(), mode)?.check()
    }

    /// Checks bytes that are in memory.
    pub fn from_bytes(bytes: Vec<u8>) -> Result<Self, PackError> {
        Pack::unchecked(bytes).check()
    }

    /// The records of this type, in place; empty when the section is absent.
    #[must_use]
    pub fn records<R: PackRecord>(&self) -> &[R] {
        self.section_bytes(R::KIND).map_or(&[], bytemuck::cast_slice)
    }

    /// Settings of the picture.
    #[must_use]
    pub fn render(&self) -> &RenderSettings {
        self.records().first().expect("a checked pack has one RENDER record")
    }

    /// The camera.
    #[must_use]
    pub fn camera(&self) -> &Camera {
        self.records().first().expect("a checked pack has one CAMERA record")
    }

    /// The sky; `None` is black.
    #[must_use]
    pub fn sky(&self) -> Option<&Sky> {
        self.records().first()
    }

    /// Texels of all textures as 16-byte words; empty without textures.
    #[must_use]
    pub fn texels(&self) -> &[[u32; 4]] {
        self.section_bytes(Kind::TEXEL).map_or(&[], bytemuck::cast_slice)
    }

    /// Linear value of each sRGB byte; `None` when no texture is sRGB.
    #[must_use]
    pub fn srgb_table(&self) -> Option<&[f32; 256]> {
        let bytes = self.section_bytes(Kind::SRGBLUT)?;
        let values: &[f32] = bytemuck::cast_slice(bytes);
        Some(values.try_into().expect("a checked pack has 256 values in SRGBLUT"))
    }

    /// The linked WGSL text. It is UTF-8; whether it is a good shader is for the runtime to judge.
    #[must_use]
    pub fn kernel(&self) -> &str {
        let bytes = self.section_bytes(Kind::KERNEL).unwrap_or_default();
        std::str::from_utf8(bytes).expect("a checked pack has UTF-8 in KERNEL")
    }

    /// The manifest, decoded now; the empty one when there is none. An error here does not make the
    /// pack unfit to render.
    pub fn manifest(&self) -> Result<Manifest, PackError> {
        self.section_bytes(Kind::META).map_or_else(|| Ok(Manifest::default()), Manifest::decode)
    }

    /// The bytes of a section, whatever it holds.
    #[must_use]
    pub fn section_bytes(&self, kind: Kind) -> Option<&[u8]> {
        Some(&self.bytes.as_slice()[self.state.table.range(kind)?])
    }

    /// Every section in file order, those of a later minor format included.
    pub fn sections(&self) -> impl Iterator<Item = Section<'_>> {
        self.state.table.entries.iter().map(|entry| self.section(entry))
    }

    /// Name of what is rendered: equal for packs that give equal pictures, whatever their manifest.
    #[must_use]
    pub fn render_id(&self) -> [u8; 32] {
        self.state.table.header.render_id
    }

    /// Name of the inputs, as the writer gave it: answers whether a pack is up to date.
    #[must_use]
    pub fn recipe_id(&self) -> [u8; 32] {
        self.state.table.header.recipe_id
    }

    /// Bits of [`crate::features`].
    #[must_use]
    pub fn features(&self) -> u64 {
        self.state.table.header.features
    }

    /// Bytes of the whole file.
    #[must_use]
    pub fn file_len(&self) -> u64 {
        self.state.table.header.file_len
    }

    /// Gives the memory of what was read of a mapped pack back to the system: for who has taken what they need and is
    /// about to need room. Everything can still be read, from the file again.
    pub fn release_pages(&self) {
        self.bytes.release();
    }

    /// Reads every byte and compares it with the stored hashes: finds damage that the rules allow,
    /// such as a flipped bit in a colour.
    pub fn verify_hashes(&self) -> Result<(), PackError> {
        for section in self.sections() {
            if section_hash(section.bytes) != section.hash {
                return Err(PackError::Hash { kind: section.kind });
            }
        }
        Ok(())
    }

    fn section<'a>(&'a self, entry: &Entry) -> Section<'a> {
        Section {
            kind: Kind(entry.kind),
            version: entry.version,
            count: entry.elem_count,
            elem_size: entry.elem_size,
            bytes: &self.bytes.as_slice()[entry_range(entry)],
            hash: entry.hash,
        }
    }

    fn contents(&self) -> Result<Contents<'_>, PackError> {
        Contents::new(|kind| self.section_bytes(kind))
    }
}
