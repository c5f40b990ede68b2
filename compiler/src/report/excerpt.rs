//! Places in a source text become short excerpts of it, in which they can be marked.
//!
//! The drawing library reads every text that it is given from the start. So it is given the lines
//! around the places only, however long the text is; of long lines what is around the places; and no
//! character that would steer a terminal. A diagnostic costs what its own lines cost.

use std::collections::BTreeMap;
use std::ops::Range;

use lang::source::{FileId, SourceSet, Span};

use super::text::{escape, is_unsafe};

/// Places that are farther apart than this many lines get excerpts of their own.
const GAP: u32 = 100;
/// A place that covers more lines than this is marked in its first line only.
const MOST_LINES: u32 = 50;
/// Longer lines, in bytes, are cut.
const LONG_LINE: usize = 500;
/// What stays of a long line before and after each end of a place, in bytes.
const AROUND: usize = 80;

/// A few lines of a source text.
pub(super) struct Excerpt {
    /// Number of the first line.
    pub(super) line: usize,
    /// The lines, as they are shown.
    pub(super) text: String,
    /// The places in it: which of those asked for, and where it lies in `text`.
    pub(super) places: Vec<(usize, Range<usize>)>,
    /// Columns in `text` are not those of the source.
    pub(super) shifted: bool,
}

impl Excerpt {
    /// Column of an offset in `text`, in characters from 1.
    pub(super) fn column(&self, offset: usize) -> usize {
        let before = self.text.get(..offset).unwrap_or("");
        before.chars().rev().take_while(|c| *c != '\n').count() + 1
    }
}

/// A place in lines: the end is not before the start.
#[derive(Clone, Copy)]
struct Extent {
    index: usize,
    span: Span,
    first: u32,
    last: u32,
}

/// Excerpts that show all places of one file; that of the first place comes first, the others in
/// the order of the text.
pub(super) fn excerpts(sources: &SourceSet, file: FileId, places: &[Span]) -> Vec<Excerpt> {
    let mut extents: Vec<Extent> =
        places.iter().enumerate().map(|(i, span)| extent(sources, file, i, *span)).collect();
    extents.sort_by_key(|extent| (extent.first, extent.span.start));
    let mut groups: Vec<Vec<Extent>> = Vec::new();
    let mut last = 0;
    for extent in extents {
        match groups.last_mut() {
            Some(group) if extent.first <= last + GAP => group.push(extent),
            _ => groups.push(vec![extent]),
        }
        last = last.max(extent.last);
    }
    groups.sort_by_key(|group| !group.iter().any(|extent| extent.index == 0));
    groups.iter().map(|group| excerpt(sources, file, group)).collect()
}

fn extent(sources: &SourceSet, file: FileId, index: usize, span: Span) -> Extent {
    let text = sources.text(file);
    let on_boundary = |offset: u32| {
        let mut at = (offset as usize).min(text.len());
        while !text.is_char_boundary(at) {
            at -= 1;
        }
        u32::try_from(at).unwrap_or(u32::MAX)
    };
    let start = on_boundary(span.start);
    let mut end = on_boundary(span.end).max(start);
    let first = sources.line_of(file, start);
    let mut last = sources.line_of(file, end);
    if last - first > MOST_LINES {
        last = first;
        end = sources.line_span(file, first).end.max(start);
    }
    Extent { index, span: Span { file, start, end }, first, last }
}

fn excerpt(sources: &SourceSet, file: FileId, extents: &[Extent]) -> Excerpt {
    let first = extents.iter().map(|extent| extent.first).min().unwrap_or(1);
    let last = extents.iter().map(|extent| extent.last).max().unwrap_or(1);
    let n_lines = sources.n_lines(file);
    // Behind the last line break there is no line to show: what lies there is marked in the one before.
    let first = first.min(n_lines).max(1);
    let mut points: Vec<u32> =
        extents.iter().flat_map(|extent| [extent.span.start, extent.span.end]).collect();
    points.sort_unstable();
    points.dedup();
    let mut found: BTreeMap<u32, usize> = BTreeMap::new();
    let (mut text, mut shifted) = (String::new(), false);
    let mut rest = points.as_slice();
    for line in first..=last.max(first) {
        let span = sources.line_span(file, line);
        let raw = sources.slice(span);
        let next = sources.line_span(file, line + 1).start;
        let is_here = |point: &u32| line == last || *point < next;
        let n_here = rest.iter().take_while(|point| is_here(point)).count();
        let (here, others) = rest.split_at(n_here);
        rest = others;
        let columns: Vec<usize> = here
            .iter()
            .map(|point| (point.saturating_sub(span.start) as usize).min(raw.len()))
            .collect();
        let (shown, mapped) = clean(raw, &columns);
        shifted |= !here.is_empty() && shown != raw;
        for (point, at) in here.iter().zip(mapped) {
            found.insert(*point, text.len() + at);
        }
        text += &shown;
        if line < n_lines || line == n_lines && sources.text(file).ends_with('\n') {
            text.push('\n');
        }
    }
    let at = |point: u32| found.get(&point).copied().unwrap_or(text.len());
    let places = extents.iter().map(|extent| {
        let (start, end) = (at(extent.span.start), at(extent.span.end));
        (extent.index, start..end.max(start))
    });
    let mut places: Vec<(usize, Range<usize>)> = places.collect();
    places.sort_by_key(|(index, _)| *index);
    Excerpt { line: first as usize, text, places, shifted }
}

/// A line as it is shown, and where `columns` (ascending offsets of characters) are in it.
fn clean(line: &str, columns: &[usize]) -> (String, Vec<usize>) {
    let keeps_tabs = |c: char| is_unsafe(c) && c != '\t';
    if line.len() <= LONG_LINE && !line.contains(keeps_tabs) {
        return (line.to_owned(), columns.to_vec());
    }
    let mut shown = String::new();
    let mut mapped = Vec::with_capacity(columns.len());
    let mut columns = columns.iter().peekable();
    let mut end = 0;
    for part in parts(line, columns.clone().copied()) {
        if part.start > end {
            shown.push('…');
        }
        end = part.end;
        let kept = line.get(part.clone()).unwrap_or("");
        for (at, c) in kept.char_indices() {
            while columns.next_if(|column| **column <= part.start + at).is_some() {
                mapped.push(shown.len());
            }
            if keeps_tabs(c) { shown += &escape(c.encode_utf8(&mut [0; 4])) } else { shown.push(c) }
        }
    }
    mapped.extend(columns.map(|_| shown.len()));
    if end < line.len() {
        shown.push('…');
    }
    (shown, mapped)
}

/// What is shown of a line: all of it, or what lies around its start and the columns.
fn parts(line: &str, columns: impl Iterator<Item = usize>) -> Vec<Range<usize>> {
    if line.len() <= LONG_LINE {
        return std::iter::once(0..line.len()).collect();
    }
    let boundary = |mut at: usize| {
        while !line.is_char_boundary(at) {
            at -= 1;
        }
        at
    };
    let mut parts: Vec<Range<usize>> = Vec::new();
    for column in std::iter::once(0).chain(columns) {
        let start = boundary(column.saturating_sub(AROUND));
        let end = boundary((column + AROUND).min(line.len()));
        match parts.last_mut() {
            Some(part) if start <= part.end => part.end = part.end.max(end),
            _ => parts.push(start..end),
        }
    }
    parts
}
