//! Checks header and section table, before anything looks inside a section.
//!
//! Turns the bytes of a file into the list of its sections, or into the first broken rule, in a
//! fixed order: length and magic, header fields, table, each entry against the place where the one
//! before it ended, padding, completeness. Afterwards every section lies inside the file, aligned,
//! without holes, and holds a whole number of elements. It does not know what records mean.

use crate::error::PackError;
use crate::fault::{HeaderFault, SectionFault};
use crate::features;
use crate::header::{
    ENDIAN_TAG, ENTRY_LEN, Entry, FLAG_MUST_UNDERSTAND, FORMAT_MAJOR, FORMAT_MINOR, HEADER_LEN,
    Header, MAGIC, MAX_SECTIONS, align_up, layout_id, render_id,
};
use crate::kind::{Kind, SECTIONS};

/// A header and a table whose every range is proven.
#[derive(Clone, Debug)]
pub(crate) struct Table {
    pub(crate) header: Header,
    pub(crate) entries: Vec<Entry>,
}

impl Table {
    /// Where the section's bytes are, if it is there.
    pub(crate) fn range(&self, kind: Kind) -> Option<std::ops::Range<usize>> {
        self.entries.iter().find(|entry| entry.kind == kind.0).map(entry_range)
    }
}

/// The bytes of a checked entry.
pub(crate) fn entry_range(entry: &Entry) -> std::ops::Range<usize> {
    // `check` has proven that both ends lie inside a file that is in memory.
    let at = |value: u64| usize::try_from(value).expect("a checked section lies inside memory");
    at(entry.offset)..at(entry.offset + entry.length)
}

/// Judges the first bytes of a file (128, or the whole file when it is shorter).
pub(crate) fn check_header(head: &[u8], file_len: u64) -> Result<Header, PackError> {
    if !head.starts_with(&MAGIC) {
        return Err(foreign(head));
    }
    let Some(head) = head.get(..HEADER_LEN) else {
        return Err(HeaderFault::Short { len: file_len }.into());
    };
    let header: Header = bytemuck::pod_read_unaligned(head);
    let fault = header_fault(&header, file_len);
    fault.map_or(Ok(header), |fault| Err(fault.into()))
}

/// The length that a header says, of which everything else is judged; `head` as in [`check_header`].
pub(crate) fn header_says(head: &[u8]) -> Result<u64, PackError> {
    // A header that is too short has no length to say; `check_header` tells what it is instead.
    let whole = head.get(..HEADER_LEN).map(bytemuck::pod_read_unaligned::<Header>);
    let len = whole.map_or(head.len() as u64, |header| header.file_len);
    check_header(head, len).map(|header| header.file_len)
}

fn header_fault(header: &Header, file_len: u64) -> Option<HeaderFault> {
    if header.endian != ENDIAN_TAG {
        return Some(HeaderFault::Endian { found: header.endian });
    }
    if header.major != FORMAT_MAJOR {
        return Some(HeaderFault::Major { found: header.major, expected: FORMAT_MAJOR });
    }
    let bits = header.features & !features::KNOWN;
    if bits != 0 {
        return Some(HeaderFault::UnknownFeatures { bits });
    }
    if header.layout_id != layout_id() {
        return Some(HeaderFault::Layout { found: header.layout_id, expected: layout_id() });
    }
    let fixed: [(&'static str, u64, u64); 5] = [
        ("header_len", header.header_len.into(), HEADER_LEN as u64),
        ("entry_len", header.entry_len.into(), ENTRY_LEN as u64),
        ("table_off", header.table_off, HEADER_LEN as u64),
        ("reserved field 0", header.zero[0].into(), 0),
        ("reserved field 1", header.zero[1].into(), 0),
    ];
    for (field, found, expected) in fixed {
        if found != expected {
            return Some(HeaderFault::Fixed { field, found, expected });
        }
    }
    if header.file_len != file_len {
        return Some(HeaderFault::FileLen { said: header.file_len, actual: file_len });
    }
    let found = header.section_count;
    if !(1..=MAX_SECTIONS).contains(&found) {
        return Some(HeaderFault::SectionCount { found });
    }
    let needed = HEADER_LEN as u64 + u64::from(found) * ENTRY_LEN as u64;
    (needed > file_len).then_some(HeaderFault::Table { needed, actual: file_len })
}

/// What a file without the magic is.
fn foreign(head: &[u8]) -> PackError {
    let start = &head[..head.len().min(8)];
    let text = match std::str::from_utf8(head) {
        Ok(text) => text,
        // The cut after 128 bytes may split a character.
        Err(error) => std::str::from_utf8(&head[..error.valid_up_to()]).unwrap_or(""),
    };
    let is_text = text.len() + 4 > head.len();
    if is_text && text.trim_start_matches('\u{feff}').trim_start().starts_with("rts") {
        return PackError::SceneSource;
    }
    // Seven-bit transfers turn 0x89 into 0x09; text-mode ones change the line ends.
    if start.get(1..4) == Some(b"RTP") {
        return HeaderFault::Altered.into();
    }
    PackError::NotAPack { start: start.to_vec() }
}

/// Judges header and table of a whole pack.
pub(crate) fn check(bytes: &[u8]) -> Result<Table, PackError> {
    let file_len = bytes.len() as u64;
    let header = check_header(&bytes[..bytes.len().min(HEADER_LEN)], file_len)?;
    // `check_header` has proven that the table fits.
    let table_end = HEADER_LEN + header.section_count as usize * ENTRY_LEN;
    let entries: Vec<Entry> = bytes[HEADER_LEN..table_end]
        .chunks_exact(ENTRY_LEN)
        .map(bytemuck::pod_read_unaligned)
        .collect();

    let mut end = table_end as u64;
    for (index, entry) in (0u32..).zip(&entries) {
        let before = &entries[..index as usize];
        if let Some(fault) = entry_fault(entry, before, &header, end) {
            return Err(PackError::Section { kind: Kind(entry.kind), index, fault });
        }
        check_padding(bytes, end, entry.offset)?;
        end = entry.offset + entry.length;
    }
    if end != file_len {
        return Err(HeaderFault::End { end, actual: file_len }.into());
    }
    check_complete(&entries)?;
    if header.render_id != render_id(header.features, &entries) {
        return Err(HeaderFault::RenderId.into());
    }
    Ok(Table { header, entries })
}

/// Judges one entry. `end`: first byte after the section before it.
fn entry_fault(entry: &Entry, before: &[Entry], header: &Header, end: u64) -> Option<SectionFault> {
    let kind = Kind(entry.kind);
    let fault = match kind.spec() {
        Some(_) => known_entry_fault(entry, before),
        None => unknown_entry_fault(entry, before, header),
    };
    if fault.is_some() {
        return fault;
    }
    if entry.zero != 0 {
        return Some(SectionFault::Reserved { found: entry.zero });
    }
    let (found, count, size) = (entry.length, entry.elem_count, entry.elem_size);
    if count.checked_mul(size.into()) != Some(found) {
        return Some(SectionFault::Length { found, count, size });
    }
    let expected = align_up(end)?;
    if entry.offset != expected {
        return Some(SectionFault::Offset { found: entry.offset, expected });
    }
    // Compared with what remains, so that nothing can wrap.
    let file_len = header.file_len;
    if file_len.checked_sub(entry.offset).is_none_or(|remains| entry.length > remains) {
        let (offset, length) = (entry.offset, entry.length);
        return Some(SectionFault::Beyond { offset, length, file_len });
    }
    None
}

fn known_entry_fault(entry: &Entry, before: &[Entry]) -> Option<SectionFault> {
    let kind = Kind(entry.kind);
    let spec = kind.spec()?;
    let order = |kind: Kind| SECTIONS.iter().position(|spec| spec.kind == kind);
    for earlier in before.iter().map(|entry| Kind(entry.kind)) {
        if earlier == kind {
            return Some(SectionFault::Twice);
        }
        if order(earlier).is_some_and(|earlier| Some(earlier) > order(kind)) {
            return Some(SectionFault::Order { after: earlier });
        }
    }
    if entry.version != spec.version {
        return Some(SectionFault::Version { found: entry.version, expected: spec.version });
    }
    let expected = if spec.must_understand { FLAG_MUST_UNDERSTAND } else { 0 };
    if entry.flags != expected {
        return Some(SectionFault::Flags { found: entry.flags, expected });
    }
    if entry.elem_size != spec.elem_size {
        return Some(SectionFault::ElemSize { found: entry.elem_size, expected: spec.elem_size });
    }
    if !(spec.min_count..=spec.max_count).contains(&entry.elem_count) {
        let (min, max) = (spec.min_count, spec.max_count);
        return Some(SectionFault::Count { found: entry.elem_count, min, max });
    }
    None
}

/// A section of a newer minor format: skipped, but its bytes must still be accounted for.
fn unknown_entry_fault(entry: &Entry, before: &[Entry], header: &Header) -> Option<SectionFault> {
    if !entry.kind.iter().all(|byte| byte.is_ascii_graphic() || *byte == b' ') {
        return Some(SectionFault::Name);
    }
    if entry.flags & FLAG_MUST_UNDERSTAND != 0 {
        return Some(SectionFault::Unknown);
    }
    let is_newer = header.minor.saturating_sub(FORMAT_MINOR) > 0;
    if !is_newer {
        return Some(SectionFault::NotInFormat { major: header.major, minor: header.minor });
    }
    if entry.flags != 0 {
        return Some(SectionFault::Flags { found: entry.flags, expected: 0 });
    }
    if entry.elem_size == 0 || entry.elem_count == 0 {
        let found = entry.elem_count.min(entry.elem_size.into());
        return Some(SectionFault::Count { found, min: 1, max: u64::MAX });
    }
    before.iter().any(|earlier| earlier.kind == entry.kind).then_some(SectionFault::Twice)
}

/// Judges the gap `from..to`; both ends lie inside the file.
fn check_padding(bytes: &[u8], from: u64, to: u64) -> Result<(), PackError> {
    for offset in from..to {
        let found = usize::try_from(offset).ok().and_then(|at| bytes.get(at)).copied();
        if let Some(found @ 1..) = found {
            return Err(PackError::Padding { offset, found });
        }
    }
    Ok(())
}

fn check_complete(entries: &[Entry]) -> Result<(), PackError> {
    for spec in SECTIONS.iter().filter(|spec| spec.required) {
        if !entries.iter().any(|entry| entry.kind == spec.kind.0) {
            return Err(PackError::missing(spec.kind));
        }
    }
    Ok(())
}
