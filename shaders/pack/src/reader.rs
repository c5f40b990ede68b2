//! Opens packs. The only way to a record leads through [`Pack::check`].
//!
//! Turns bytes into slices of records, in place. It keeps the invariant that a `Pack<Checked>` has
//! passed every rule but the hashes: indices lie inside their tables, the tree is a tree, numbers
//! are finite. It does not know what a device does with the records.

use std::io::Read;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::path::Path;

use crate::abi::{Camera, RenderSettings, Sky};
use crate::check;
use crate::contents::Contents;
use crate::error::PackError;
use crate::header::{Entry, section_hash_unless};
use crate::kind::{Kind, PackRecord};
use crate::manifest::Manifest;
use crate::map::{Bytes, Witness};
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

    /// Checks every rule but the hashes, at about the speed of memory.
    pub fn check(self) -> Result<Pack<Checked>, PackError> {
        let table = table::check(self.bytes.as_slice())?;
        let pack = Pack { bytes: self.bytes, state: Checked { table } };
        check::contents(&pack.contents()?, pack.features())?;
        let entries = pack.state.table.entries.iter();
        pack.bytes.are_hashed(entries.map(|entry| (entry_range(entry), entry.hash)));
        Ok(pack)
    }
}

impl Pack<Checked> {
    /// Reads a file into memory and checks it. Nothing that becomes of the file matters afterwards.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, PackError> {
        Self::of(Bytes::read(path.as_ref())?)
    }

    /// Reads a pack of at most `most` bytes into memory, from anything that gives bytes, to its end; and checks it.
    pub fn receive(from: impl Read, most: u64) -> Result<Self, PackError> {
        Self::of(Bytes::receive(from, most)?)
    }

    /// Maps a file and checks it: pages are loaded when they are first touched.
    ///
    /// # Safety
    ///
    /// Nobody writes to the file or shortens it before the pack and its witnesses are dropped: what is borrowed from
    /// the pack would change. What replaces the file under its name, as our own writer does, is no harm.
    ///
    /// A caller cannot forbid that to other processes. It must be content with what is left when they do it all the
    /// same: the crate reads nothing from the mapping but plain numbers, for which every pattern of bits is a value,
    /// and indexes only what it has measured itself; bytes that are gone become zeros and not SIGBUS; and
    /// [`Self::witness`] tells. So it asks the witness before anything that was read counts, and ends if it fails.
    #[expect(unsafe_code, reason = "mapping a file cannot be safe, see above")]
    pub unsafe fn map(path: impl AsRef<Path>) -> Result<Self, PackError> {
        // SAFETY: the caller's promise is the same.
        let bytes = unsafe { Bytes::map(path.as_ref()) }?;
        let witness = bytes.witness();
        // A file that is being written to breaks some rule, but that is not what is wrong with it.
        let altered = || witness.as_ref().and_then(|witness| witness.look().err());
        match catch_unwind(AssertUnwindSafe(|| Self::of(bytes))) {
            Ok(checked) => checked.map_err(|error| altered().unwrap_or(error)),
            // Rules rely on what was checked before them.
            Err(panic) => Err(altered().unwrap_or_else(|| resume_unwind(panic))),
        }
    }

    fn of(bytes: Bytes) -> Result<Self, PackError> {
        Pack { bytes, state: Unchecked(()) }.check()
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
        // It was UTF-8 when it was checked, and is unless a mapped file was written to.
        std::str::from_utf8(bytes).unwrap_or_default()
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

    /// Who knows whether the file of a mapped pack has changed; `None` of a pack in memory.
    #[must_use]
    pub fn witness(&self) -> Option<Witness> {
        self.bytes.witness()
    }

    /// Reads every byte and compares it with the stored hashes: finds damage that the rules allow,
    /// such as a flipped bit in a colour.
    pub fn verify_hashes(&self) -> Result<(), PackError> {
        self.verify_hashes_unless(&|| false).map(|_| ())
    }

    /// As [`Self::verify_hashes`], but gives up soon after `given_up` says so. Whether all was verified.
    pub fn verify_hashes_unless(
        &self,
        given_up: &(dyn Fn() -> bool + Sync),
    ) -> Result<bool, PackError> {
        for section in self.sections() {
            match section_hash_unless(section.bytes, given_up) {
                None => return Ok(false),
                Some(hash) if hash == section.hash => {}
                Some(_) => {
                    // Other bytes than those that were opened are not the same as damaged ones.
                    self.witness().map_or(Ok(()), |witness| witness.look())?;
                    return Err(PackError::Hash { kind: section.kind });
                }
            }
        }
        Ok(true)
    }

    /// The last word on a mapped file, after everything was read from it and before that counts: fails if it may have
    /// been written to since it was opened. Of a pack in memory nothing can be wrong.
    pub fn settle(&self) -> Result<(), PackError> {
        let Some(witness) = self.witness() else { return Ok(()) };
        witness.look_closely()?;
        if witness.is_in_doubt() {
            self.verify_hashes()?;
            witness.look()?;
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
