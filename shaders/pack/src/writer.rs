//! Writes packs: sections in canonical order, aligned, without holes, never in place.
//!
//! Turns slices of records into the bytes of a file. It keeps two invariants: the same sections
//! give the same bytes, and nothing is written that the reader would refuse. It does not know where
//! the records come from.

use std::borrow::Cow;
use std::io::{self, Write};
use std::path::Path;

use rayon::prelude::*;

use crate::abi::RenderSettings;

use crate::contents::Contents;
use crate::error::PackError;
use crate::fault::SectionFault;
use crate::header::{
    ENDIAN_TAG, ENTRY_BYTES, ENTRY_LEN, Entry, FLAG_MUST_UNDERSTAND, FORMAT_MAJOR, FORMAT_MINOR,
    HEADER_BYTES, HEADER_LEN, Header, MAGIC, align_up, layout_id, render_id, section_hash,
};
use crate::kind::{Kind, PackRecord, SectionSpec};
use crate::manifest::Manifest;
use crate::map::Witness;
use crate::reader::Section;
use crate::{check, features};

/// Collects sections by reference; nothing is copied before it goes to the file.
#[derive(Debug, Default)]
pub struct PackWriter<'a> {
    sections: Vec<(Kind, Payload<'a>)>,
    /// Hashes of sections that are known.
    hashes: Vec<(Kind, [u8; 16])>,
    /// Of mapped packs that bytes are taken from.
    sources: Vec<Witness>,
    recipe_id: [u8; 32],
}

/// Bytes whose start suits their records.
#[derive(Debug)]
enum Payload<'a> {
    Bytes(Cow<'a, [u8]>),
    Words(Vec<[u32; 4]>),
}

impl Payload<'_> {
    fn as_slice(&self) -> &[u8] {
        match self {
            Self::Bytes(bytes) => bytes,
            Self::Words(words) => bytemuck::cast_slice(words),
        }
    }
}

impl<'a> PackWriter<'a> {
    /// A pack without sections.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds the section of these records; no records, no section.
    pub fn records<R: PackRecord>(&mut self, records: &'a [R]) -> &mut Self {
        self.push(R::KIND, Payload::Bytes(Cow::Borrowed(bytemuck::cast_slice(records))))
    }

    /// Adds the section of a single record: settings, camera, sky.
    pub fn record<R: PackRecord>(&mut self, record: &'a R) -> &mut Self {
        self.records(std::slice::from_ref(record))
    }

    /// Adds the texels of all textures; none, no section.
    pub fn texels(&mut self, words: &'a [[u32; 4]]) -> &mut Self {
        self.push(Kind::TEXEL, Payload::Bytes(Cow::Borrowed(bytemuck::cast_slice(words))))
    }

    /// Adds the linear value of each sRGB byte; needed exactly when a texture is `Rgba8Srgb`.
    pub fn srgb_table(&mut self, values: &'a [f32; 256]) -> &mut Self {
        self.push(Kind::SRGBLUT, Payload::Bytes(Cow::Borrowed(bytemuck::cast_slice(values))))
    }

    /// Adds the table by which the sky is sampled; none, no section.
    pub fn sky_table(&mut self, words: &'a [[f32; 4]]) -> &mut Self {
        self.push(Kind::SKYTABLE, Payload::Bytes(Cow::Borrowed(bytemuck::cast_slice(words))))
    }

    /// Adds the tables of directional albedo that materials read; none, no section.
    pub fn albedo(&mut self, words: &'a [[f32; 4]]) -> &mut Self {
        self.push(Kind::ALBEDO, Payload::Bytes(Cow::Borrowed(bytemuck::cast_slice(words))))
    }

    /// Adds the linked WGSL text.
    pub fn kernel(&mut self, wgsl: &'a str) -> &mut Self {
        self.bytes(Kind::KERNEL, wgsl.as_bytes())
    }

    /// Adds a section from bytes; they are copied only when their start does not suit the records.
    pub fn bytes(&mut self, kind: Kind, bytes: &'a [u8]) -> &mut Self {
        let of_records = kind.spec().is_some_and(|spec| spec.elem_size > 1);
        let aligned = bytes.as_ptr().addr().is_multiple_of(align_of::<RenderSettings>());
        // A ragged length is refused later, by name; it must not be padded here.
        let payload = if of_records && !aligned && bytes.len().is_multiple_of(16) {
            Payload::Words(bytes.chunks_exact(16).map(bytemuck::pod_read_unaligned).collect())
        } else {
            Payload::Bytes(Cow::Borrowed(bytes))
        };
        self.push(kind, payload)
    }

    /// Adds a section of another pack as it is. Its hash is taken over: whoever calls this has verified it, or the
    /// file that comes of it is as damaged as the other.
    pub fn section(&mut self, section: Section<'a>) -> &mut Self {
        if section.kind.spec().is_some_and(|spec| spec.version == section.version) {
            self.hashes.push((section.kind, section.hash));
        }
        self.bytes(section.kind, section.bytes)
    }

    /// Says that what is written was made of the bytes of a mapped pack. If its file changes before everything is
    /// written, nothing is.
    pub fn taken_from(&mut self, source: Option<Witness>) -> &mut Self {
        self.sources.extend(source);
        self
    }

    /// Adds the manifest.
    pub fn manifest(&mut self, manifest: &Manifest) -> Result<&mut Self, PackError> {
        let bytes = manifest.encode()?;
        Ok(self.push(Kind::META, Payload::Bytes(Cow::Owned(bytes))))
    }

    /// Sets the name of the inputs; all zero when nobody does.
    pub fn recipe_id(&mut self, id: [u8; 32]) -> &mut Self {
        self.recipe_id = id;
        self
    }

    /// The whole file in memory.
    pub fn to_bytes(&self) -> Result<Vec<u8>, PackError> {
        let plan = self.plan()?;
        let len = plan.header.file_len;
        let mut bytes = Vec::with_capacity(usize::try_from(len).unwrap_or(0));
        plan.stream(&mut bytes).expect("writing to a vector cannot fail");
        Ok(bytes)
    }

    /// Writes the file under a temporary name beside `path`, then renames it: whoever has the old
    /// file mapped keeps the old bytes, and nobody ever sees half a pack. Returns the pack's `render_id`.
    pub fn write(&self, path: impl AsRef<Path>) -> Result<[u8; 32], PackError> {
        // Whatever fails because a source has changed is told as that.
        let altered = || self.sources.iter().find_map(|source| source.look().err());
        let plan = self.plan().map_err(|error| altered().unwrap_or(error))?;
        let written = files::write(path.as_ref(), |out| {
            let streamed = plan.stream(out);
            altered().map_or(streamed, |error| Err(io::Error::other(error.to_string())))
        });
        written.map_err(|error| altered().unwrap_or(error.into()))?;
        Ok(plan.header.render_id)
    }

    /// The `render_id` that the pack will have.
    pub fn render_id(&self) -> Result<[u8; 32], PackError> {
        Ok(self.plan()?.header.render_id)
    }

    fn push(&mut self, kind: Kind, payload: Payload<'a>) -> &mut Self {
        if !payload.as_slice().is_empty() {
            self.sections.push((kind, payload));
        }
        self
    }

    /// Sorts, checks, hashes and places the sections.
    fn plan(&self) -> Result<Plan<'_>, PackError> {
        let mut sections = Vec::with_capacity(self.sections.len());
        for (index, (kind, payload)) in (0..).zip(&self.sections) {
            let spec = kind.spec().ok_or_else(|| {
                let (major, minor) = (FORMAT_MAJOR, FORMAT_MINOR);
                fault(*kind, index, SectionFault::NotInFormat { major, minor })
            })?;
            sections.push((spec, payload.as_slice()));
        }
        let order = |spec: &SectionSpec| crate::SECTIONS.iter().position(|s| s.kind == spec.kind);
        sections.sort_by_key(|(spec, _)| order(spec));
        for (index, pair) in (1..).zip(sections.windows(2)) {
            if pair[0].0.kind == pair[1].0.kind {
                return Err(fault(pair[1].0.kind, index, SectionFault::Twice));
            }
        }
        for (index, (spec, bytes)) in (0..).zip(&sections) {
            check_size(index, spec, bytes)?;
        }
        let find = |kind| sections.iter().find(|(spec, _)| spec.kind == kind).map(|found| found.1);
        let contents = Contents::new(find)?;
        let features = features::of(&contents);
        check::contents(&contents, features)?;
        let known = |kind| self.hashes.iter().find(|known| known.0 == kind).map(|known| known.1);
        Ok(Plan::new(sections, known, features, self.recipe_id))
    }
}

fn fault(kind: Kind, index: u32, fault: SectionFault) -> PackError {
    PackError::Section { kind, index, fault }
}

fn check_size(index: u32, spec: &SectionSpec, bytes: &[u8]) -> Result<(), PackError> {
    let length = bytes.len() as u64;
    let size = u64::from(spec.elem_size);
    let count = length / size;
    if !length.is_multiple_of(size) {
        let size = spec.elem_size;
        return Err(fault(spec.kind, index, SectionFault::Length { found: length, count, size }));
    }
    if !(spec.min_count..=spec.max_count).contains(&count) {
        let (min, max) = (spec.min_count, spec.max_count);
        return Err(fault(spec.kind, index, SectionFault::Count { found: count, min, max }));
    }
    Ok(())
}

/// Padding between two sections is shorter than a page.
const ZEROS: [u8; 4096] = [0; 4096];

/// A file that only needs to be written down.
struct Plan<'a> {
    header: Header,
    entries: Vec<Entry>,
    payloads: Vec<&'a [u8]>,
}

impl<'a> Plan<'a> {
    fn new(
        sections: Vec<(&'static SectionSpec, &'a [u8])>,
        known: impl Fn(Kind) -> Option<[u8; 16]> + Sync,
        features: u64,
        recipe_id: [u8; 32],
    ) -> Self {
        let hash = |(spec, bytes): &(&SectionSpec, &[u8])| {
            known(spec.kind).unwrap_or_else(|| section_hash(bytes))
        };
        let hashes: Vec<[u8; 16]> = sections.par_iter().map(hash).collect();
        let mut end = (HEADER_LEN + sections.len() * ENTRY_LEN) as u64;
        let mut entries = Vec::with_capacity(sections.len());
        for ((spec, bytes), hash) in sections.iter().zip(hashes) {
            let offset = align_up(end).expect("sections in memory are far below 2^64 bytes");
            let length = bytes.len() as u64;
            end = offset + length;
            entries.push(Entry {
                kind: spec.kind.0,
                version: spec.version,
                flags: if spec.must_understand { FLAG_MUST_UNDERSTAND } else { 0 },
                offset,
                length,
                elem_size: spec.elem_size,
                zero: 0,
                elem_count: length / u64::from(spec.elem_size),
                hash,
            });
        }
        let section_count = u32::try_from(entries.len()).expect("there are few kinds");
        let header = Header {
            magic: MAGIC,
            major: FORMAT_MAJOR,
            minor: FORMAT_MINOR,
            endian: ENDIAN_TAG,
            header_len: HEADER_BYTES,
            entry_len: ENTRY_BYTES,
            table_off: HEADER_LEN as u64,
            section_count,
            features,
            file_len: end,
            layout_id: layout_id(),
            zero: [0; 2],
            render_id: render_id(features, &entries),
            recipe_id,
        };
        Self { header, entries, payloads: sections.into_iter().map(|(_, bytes)| bytes).collect() }
    }

    fn stream(&self, out: &mut dyn Write) -> io::Result<()> {
        out.write_all(bytemuck::bytes_of(&self.header))?;
        out.write_all(bytemuck::cast_slice(&self.entries))?;
        let mut end = (HEADER_LEN + self.entries.len() * ENTRY_LEN) as u64;
        for (entry, bytes) in self.entries.iter().zip(&self.payloads) {
            let gap = usize::try_from(entry.offset - end).expect("a gap is shorter than a page");
            out.write_all(&ZEROS[..gap])?;
            out.write_all(bytes)?;
            end = entry.offset + entry.length;
        }
        Ok(())
    }
}
