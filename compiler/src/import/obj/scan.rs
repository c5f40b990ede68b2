//! Checks OBJ text line by line and hands `tobj` only lines that it reads right.
//!
//! `tobj` says no line numbers, joins no continued lines, skips what it does not know, and fills a
//! missing normal with the one before. So this scanner comes first, as the `BufRead` that `tobj`
//! reads from: each logical line is checked here (numbers finite, indices within what has been
//! defined so far, at least three corners), then passed on. Object, group, material and smoothing
//! state become a [`Tag`]; where the tag of a face differs from the one before, the scanner emits
//! `o <tag index>`, so that each of `tobj`'s models is uniform and says what it is.

use super::super::budget::Loan;
use super::super::error::{ErrorKind, ImportError, excerpt};
use super::super::file::Limits;
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::io::{BufRead, Read};

/// Longest logical line; no honest line is longer, and `tobj` holds one as a `String`.
const MAX_LINE: usize = 1 << 20;
/// Most corners of one polygon; bounds the work of cutting it into triangles.
const MAX_CORNERS: usize = 4096;
/// How much cleaned text is prepared at a time.
const CHUNK: usize = 1 << 16;
/// Bytes that a position, UV or normal takes: in `tobj`'s list, which doubles as it grows.
const VALUE_BYTES: u64 = 24;
/// Bytes that a corner of a face takes at most: `tobj`'s face, its index lists and map, copies of the three values
/// in its model and here, and the lists of triangles, all of which may have doubled.
const CORNER_BYTES: u64 = 160;
/// Bytes of a model of `tobj` and of its tag.
const MODEL_BYTES: u64 = 600;
/// Bytes beside its letters of a name and of the entry by which it is found.
const NAME_BYTES: u64 = 200;
/// The budget is asked for so many bytes at once.
const CHARGE: u64 = 1 << 20;

/// State that all faces of one of `tobj`'s models share.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Tag {
    /// Index into `Scanned::names`.
    pub(super) name: u32,
    /// Index into `Scanned::materials`.
    pub(super) material: Option<u32>,
    /// Faces have UV indices.
    pub(super) has_uv: bool,
    /// Faces have normal indices.
    pub(super) has_normal: bool,
    /// `s`: `None` where the file does not say, 0 for off.
    pub(super) smoothing: Option<u32>,
}

/// Names in force at a face.
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct PartName {
    /// Of the last `o`.
    pub(super) object: String,
    /// Of the last `g`, as written.
    pub(super) groups: String,
}

/// What the scanner learned beside the text it passed on.
#[derive(Debug, Default)]
pub(super) struct Scanned {
    /// One for each of `tobj`'s models, in order, with the number of faces before it.
    pub(super) tags: Vec<(Tag, u64)>,
    /// Names that tags refer to.
    pub(super) names: Vec<PartName>,
    /// Materials that tags refer to, with the line of their first `usemtl`.
    pub(super) materials: Vec<(String, u64)>,
    /// Material libraries with their lines.
    pub(super) libraries: Vec<(String, u64)>,
    /// Keywords that were skipped: how often, and the line of the first.
    pub(super) skipped: BTreeMap<String, (u64, u64)>,
    /// Vertices with a colour, which is not used, and the line of the first.
    pub(super) colored: (u64, u64),
    /// Names that are not UTF-8 and were read as Latin-1, and the line of the first.
    pub(super) latin: (u64, u64),
    /// Faces with indices of UVs and of normals of which the file has none above them, and the line of the
    /// first: these indices are left out.
    pub(super) dangling: [(u64, u64); 2],
    /// Faces so far.
    pub(super) n_faces: u64,
}

/// The checking reader.
pub(super) struct Scanner<'a> {
    file: &'a str,
    rest: &'a [u8],
    line: u64,
    /// Lines read by the logical line at hand, beyond its first.
    continued: u64,
    joined: Vec<u8>,
    ready: Vec<u8>,
    n_read: usize,
    /// Counts of `v`, `vt`, `vn` so far.
    defined: [u64; 3],
    max_faces: u64,
    /// What all of this takes, and what of it is not asked for yet.
    loan: Loan,
    due: u64,
    name: PartName,
    state: Tag,
    name_ids: BTreeMap<PartName, u32>,
    material_ids: BTreeMap<String, u32>,
    pub(super) out: Scanned,
    pub(super) error: Option<ImportError>,
}

type Checked = Result<(), (ErrorKind, String)>;

fn format_error(message: impl Into<String>) -> Checked {
    Err((ErrorKind::Format, message.into()))
}

impl<'a> Scanner<'a> {
    pub(super) fn new(file: &'a str, bytes: &'a [u8], limits: &Limits) -> Self {
        let rest = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
        let name_ids = BTreeMap::from([(PartName::default(), 0)]);
        let state =
            Tag { name: 0, material: None, has_uv: false, has_normal: false, smoothing: None };
        Self {
            file,
            rest,
            line: 0,
            continued: 0,
            joined: Vec::new(),
            ready: Vec::new(),
            n_read: 0,
            defined: [0; 3],
            max_faces: limits.triangles,
            loan: limits.memory.nothing(),
            due: 0,
            name: PartName::default(),
            state,
            name_ids,
            material_ids: BTreeMap::new(),
            out: Scanned { names: vec![PartName::default()], ..Scanned::default() },
            error: None,
        }
    }

    /// `file:line` of the line at hand.
    pub(super) fn place(&self) -> String {
        format!("{}:{}", self.file, self.line)
    }

    /// Prepares the next piece of cleaned text; stops at the end and at the first error.
    fn refill(&mut self) {
        self.ready.clear();
        self.n_read = 0;
        while self.error.is_none() && !self.rest.is_empty() && self.ready.len() < CHUNK {
            let outcome = self.next_line();
            if let Err((kind, message)) = outcome {
                self.error = Some(ImportError::new(kind, self.place(), message));
                self.ready.clear();
            }
        }
    }

    fn next_line(&mut self) -> Checked {
        self.line += 1 + std::mem::take(&mut self.continued);
        let mut line = self.physical_line();
        let mut joined = std::mem::take(&mut self.joined);
        if line.ends_with(b"\\") {
            joined.clear();
            while let Some(start) = line.strip_suffix(b"\\") {
                joined.extend_from_slice(start);
                joined.push(b' ');
                if joined.len() > MAX_LINE || self.rest.is_empty() {
                    line = b"";
                    break;
                }
                self.continued += 1;
                line = self.physical_line();
            }
            joined.extend_from_slice(line);
            line = joined.trim_ascii();
        }
        let outcome = if line.len() > MAX_LINE {
            format_error(format!("this line is longer than {MAX_LINE} bytes; no OBJ line is"))
        } else {
            self.check_line(line)
        };
        self.joined = joined;
        outcome
    }

    /// Takes the next line off the text, without the white space around it.
    fn physical_line(&mut self) -> &'a [u8] {
        let end = self.rest.iter().position(|byte| *byte == b'\n');
        let (line, rest) = match end {
            Some(end) => (&self.rest[..end], &self.rest[end + 1..]),
            None => (self.rest, &[][..]),
        };
        self.rest = rest;
        line.trim_ascii()
    }

    fn check_line(&mut self, line: &[u8]) -> Checked {
        let (keyword, rest) = split_word(line);
        match keyword {
            [] | [b'#', ..] => Ok(()),
            b"v" => self.vertex(uncommented(rest)),
            b"vt" => self.uv(uncommented(rest)),
            b"vn" => self.normal(uncommented(rest)),
            b"f" | b"fo" => self.face(uncommented(rest)),
            b"o" => {
                self.name.object = self.text(rest);
                self.name.groups.clear();
                self.rename()
            }
            b"g" => {
                self.name.groups = self.text(rest);
                self.rename()
            }
            b"usemtl" => self.use_material(rest),
            b"mtllib" => {
                let name = self.text(rest);
                self.charge(NAME_BYTES + 4 * name.len() as u64)?;
                self.out.libraries.push((name, self.line));
                Ok(())
            }
            b"s" => self.smoothing(uncommented(rest)),
            other => self.skip(other),
        }
    }

    fn vertex(&mut self, rest: &[u8]) -> Checked {
        let mut numbers = [0.0; 7];
        let n = numbers_of(rest, &mut numbers)?;
        if n == 4 {
            let w = numbers[3];
            if w == 0.0 || numbers[..3].iter().any(|x| !(x / w).is_finite()) {
                return Err((
                    ErrorKind::Number,
                    "the weight w makes this vertex infinite".to_owned(),
                ));
            }
        }
        match n {
            3 | 4 => self.pass(b"v", rest),
            6 | 7 => {
                count(&mut self.out.colored, self.line);
                self.pass(b"v", words_of(rest, 3));
            }
            n => return format_error(format!("a vertex has 3 numbers (x y z), found {n}")),
        }
        self.define(0)
    }

    fn uv(&mut self, rest: &[u8]) -> Checked {
        match numbers_of(rest, &mut [0.0; 3])? {
            1 => {
                let mut with_v = rest.to_vec();
                with_v.extend_from_slice(b" 0");
                self.pass(b"vt", &with_v);
            }
            2 | 3 => self.pass(b"vt", words_of(rest, 2)),
            n => return format_error(format!("`vt` has 1 to 3 numbers (u v w), found {n}")),
        }
        self.define(1)
    }

    fn normal(&mut self, rest: &[u8]) -> Checked {
        match numbers_of(rest, &mut [0.0; 3])? {
            3 => self.pass(b"vn", rest),
            n => return format_error(format!("a normal has 3 numbers, found {n}")),
        }
        self.define(2)
    }

    /// Takes memory before `tobj` does.
    fn charge(&mut self, bytes: u64) -> Checked {
        self.due += bytes;
        if self.due < CHARGE {
            return Ok(());
        }
        let due = std::mem::take(&mut self.due);
        self.loan.more(due, "").map_err(|error| (error.kind, error.message))
    }

    /// What reading took.
    pub(super) fn finish(self) -> (Scanned, Loan) {
        (self.out, self.loan)
    }

    fn define(&mut self, which: usize) -> Checked {
        self.charge(VALUE_BYTES)?;
        self.defined[which] += 1;
        if self.defined[which] >= u64::from(u32::MAX) {
            return Err((ErrorKind::Limit, "more than 2^32 values of one kind".to_owned()));
        }
        Ok(())
    }

    fn face(&mut self, rest: &[u8]) -> Checked {
        let mut n_corners = 0;
        let mut has = [true; 3];
        for corner in words(rest) {
            let found = self.corner(corner)?;
            if n_corners > 0 && found != has {
                return format_error(format!(
                    "corner {} `{}` has other indices than the corners before it; all corners of a \
                     face must have the form v, v/vt, v//vn or v/vt/vn alike",
                    n_corners + 1,
                    excerpt(corner)
                ));
            }
            has = found;
            n_corners += 1;
        }
        if n_corners < 3 {
            return format_error(format!("a face has at least 3 corners, found {n_corners}"));
        }
        if n_corners > MAX_CORNERS {
            let message = format!("a face has at most {MAX_CORNERS} corners, found {n_corners}");
            return Err((ErrorKind::Limit, message));
        }
        if self.out.n_faces >= self.max_faces {
            return Err((ErrorKind::Limit, format!("more than {} faces", self.max_faces)));
        }
        self.charge(n_corners as u64 * CORNER_BYTES)?;
        let dangles = [1, 2].map(|which| has[which] && self.defined[which] == 0);
        let has = [has[1] && !dangles[0], has[2] && !dangles[1]];
        let tag = Tag { has_uv: has[0], has_normal: has[1], ..self.state.clone() };
        if self.out.tags.last().is_none_or(|(last, _)| *last != tag) {
            let opening = format!("o {}\n", self.out.tags.len());
            self.ready.extend_from_slice(opening.as_bytes());
            self.out.tags.push((tag, self.out.n_faces));
            self.charge(MODEL_BYTES)?;
        }
        if dangles == [false; 2] {
            self.pass(b"f", rest);
        } else {
            for (dangles, found) in dangles.into_iter().zip(&mut self.out.dangling) {
                if dangles {
                    count(found, self.line);
                }
            }
            self.pass(b"f", &with_indices(rest, has));
        }
        self.out.n_faces += 1;
        Ok(())
    }

    /// Checks `v`, `v/vt`, `v//vn` or `v/vt/vn`; says which of the three are there. UVs and normals of which the
    /// file has none so far may have any index.
    fn corner(&self, corner: &[u8]) -> Result<[bool; 3], (ErrorKind, String)> {
        const KINDS: [&str; 3] = ["vertex", "UV", "normal"];
        let mut has = [false; 3];
        for (which, digits) in corner.split(|byte| *byte == b'/').enumerate() {
            if which > 2 || (which == 0 && digits.is_empty()) {
                let message = format!("`{}` is not of the form v/vt/vn", excerpt(corner));
                return Err((ErrorKind::Format, message));
            }
            if digits.is_empty() {
                continue;
            }
            let index = std::str::from_utf8(digits).ok().and_then(|s| s.parse::<i64>().ok());
            let Some(index) = index else {
                let message =
                    format!("`{}` is not an index in `{}`", excerpt(digits), excerpt(corner));
                return Err((ErrorKind::Format, message));
            };
            let n = self.defined[which];
            let dangles = which > 0 && n == 0;
            if index == 0 || (index.unsigned_abs() > n && !dangles) {
                let kind = KINDS[which];
                let message = if index == 0 {
                    format!("{kind} index 0; indices begin at 1")
                } else {
                    format!("{kind} index {index}, but only {n} are defined above this line")
                };
                return Err((ErrorKind::Index, message));
            }
            has[which] = true;
        }
        Ok(has)
    }

    /// A name as text.
    fn text(&mut self, bytes: &[u8]) -> String {
        let (text, is_latin) = text(bytes);
        if is_latin {
            count(&mut self.out.latin, self.line);
        }
        text.into_owned()
    }

    fn rename(&mut self) -> Checked {
        let next = u32::try_from(self.out.names.len())
            .map_err(|_| (ErrorKind::Limit, "more than 2^32 groups".to_owned()))?;
        self.state.name = if let Some(id) = self.name_ids.get(&self.name) {
            *id
        } else {
            let letters = self.name.object.len() + self.name.groups.len();
            self.charge(NAME_BYTES + 4 * letters as u64)?;
            self.name_ids.insert(self.name.clone(), next);
            self.out.names.push(self.name.clone());
            next
        };
        Ok(())
    }

    fn use_material(&mut self, rest: &[u8]) -> Checked {
        let name = self.text(rest);
        if name.is_empty() {
            self.state.material = None;
            return Ok(());
        }
        let next = u32::try_from(self.out.materials.len())
            .map_err(|_| (ErrorKind::Limit, "more than 2^32 materials".to_owned()))?;
        if !self.material_ids.contains_key(&name) {
            self.charge(NAME_BYTES + 4 * name.len() as u64)?;
        }
        let id = *self.material_ids.entry(name.clone()).or_insert(next);
        if id == next {
            self.out.materials.push((name, self.line));
        }
        self.state.material = Some(id);
        Ok(())
    }

    fn smoothing(&mut self, rest: &[u8]) -> Checked {
        let word = rest.trim_ascii();
        let group = std::str::from_utf8(word).ok().and_then(|s| s.parse::<u32>().ok());
        self.state.smoothing = match (word, group) {
            (b"off", _) => Some(0),
            (b"on", _) => Some(1),
            (_, Some(group)) => Some(group),
            _ => {
                let found = excerpt(word);
                return format_error(format!("`s` takes `off` or a group number, found `{found}`"));
            }
        };
        Ok(())
    }

    fn skip(&mut self, keyword: &[u8]) -> Checked {
        const MAX_KEYWORD: usize = 32; // longer ones exist in no dialect
        const MAX_KINDS: usize = 64; // a text with more unknown words is not an OBJ file
        let plain = keyword.iter().all(|c| c.is_ascii_alphanumeric() || matches!(c, b'_' | b'-'));
        if !plain || keyword.len() > MAX_KEYWORD || self.out.skipped.len() >= MAX_KINDS {
            // Nothing of it is shown: a scene may name any file of its reader.
            return format_error("this is no OBJ keyword; is this an OBJ file?".to_owned());
        }
        let key = excerpt(keyword);
        let line = self.line;
        self.out.skipped.entry(key).or_insert((0, line)).0 += 1;
        Ok(())
    }

    /// Hands a line on.
    fn pass(&mut self, keyword: &[u8], rest: &[u8]) {
        self.ready.extend_from_slice(keyword);
        self.ready.push(b' ');
        self.ready.extend_from_slice(rest);
        self.ready.push(b'\n');
    }
}

impl BufRead for Scanner<'_> {
    fn fill_buf(&mut self) -> std::io::Result<&[u8]> {
        if self.n_read >= self.ready.len() {
            self.refill();
        }
        Ok(&self.ready[self.n_read..])
    }

    fn consume(&mut self, n: usize) {
        self.n_read = self.ready.len().min(self.n_read + n);
    }
}

impl Read for Scanner<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> std::io::Result<usize> {
        let n = self.fill_buf()?.read(buffer)?;
        self.consume(n);
        Ok(n)
    }
}

/// Line of face `face_idx` (counted as the scanner counts), for messages about a face found later.
pub(super) fn line_of_face(bytes: &[u8], face_idx: u64) -> u64 {
    let mut faces = 0;
    let mut continues = false;
    for (line_idx, line) in bytes.split(|byte| *byte == b'\n').enumerate() {
        let line = line.trim_ascii();
        let starts = !continues && matches!(split_word(line).0, b"f" | b"fo");
        continues = line.ends_with(b"\\");
        if starts && faces == face_idx {
            return line_idx as u64 + 1;
        }
        faces += u64::from(starts);
    }
    0
}

pub(super) fn words(line: &[u8]) -> impl Iterator<Item = &[u8]> {
    line.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty())
}

pub(super) fn split_word(line: &[u8]) -> (&[u8], &[u8]) {
    let end = line.iter().position(u8::is_ascii_whitespace).unwrap_or(line.len());
    (&line[..end], line[end..].trim_ascii())
}

/// The first `n` words of a line that has at least as many.
fn words_of(line: &[u8], n: usize) -> &[u8] {
    let mut end = 0;
    for _ in 0..n {
        let rest = &line[end..];
        let start = rest.iter().position(|b| !b.is_ascii_whitespace()).unwrap_or(rest.len());
        let word = &rest[start..];
        end += start + word.iter().position(u8::is_ascii_whitespace).unwrap_or(word.len());
    }
    &line[..end]
}

pub(super) fn uncommented(line: &[u8]) -> &[u8] {
    let end = line.iter().position(|byte| *byte == b'#').unwrap_or(line.len());
    line[..end].trim_ascii()
}

/// Parses every word as a finite number into `out`; returns how many there are, at most one too many.
pub(super) fn numbers_of(line: &[u8], out: &mut [f32]) -> Result<usize, (ErrorKind, String)> {
    let mut n = 0;
    for word in words(line) {
        let number = std::str::from_utf8(word).ok().and_then(|s| s.parse::<f32>().ok());
        let Some(number) = number else {
            return Err((ErrorKind::Format, format!("`{}` is not a number", excerpt(word))));
        };
        if !number.is_finite() {
            let message = format!("`{}` is not a finite number", excerpt(word));
            return Err((ErrorKind::Number, message));
        }
        let Some(slot) = out.get_mut(n) else {
            return Ok(words(line).count());
        };
        *slot = number;
        n += 1;
    }
    Ok(n)
}

/// Bytes of a name as text, and whether they are not UTF-8: then they are read as Latin-1, which old exporters
/// wrote in western countries, and in which all bytes are characters.
pub(super) fn text(bytes: &[u8]) -> (Cow<'_, str>, bool) {
    match std::str::from_utf8(bytes) {
        Ok(text) => (Cow::Borrowed(text), false),
        Err(_) => (bytes.iter().copied().map(char::from).collect(), true),
    }
}

/// Counts one more; `line` is kept of the first.
fn count(found: &mut (u64, u64), line: u64) {
    if found.0 == 0 {
        found.1 = line;
    }
    found.0 += 1;
}

/// Corners with no other indices than that of the vertex and those that they have: of a UV, of a normal.
fn with_indices(corners: &[u8], has: [bool; 2]) -> Vec<u8> {
    let mut out = Vec::with_capacity(corners.len());
    for corner in words(corners) {
        let mut parts = corner.split(|byte| *byte == b'/');
        out.extend_from_slice(parts.next().unwrap_or_default());
        let [uv, normal] = [0, 1].map(|_| parts.next().unwrap_or_default());
        match has {
            [false, false] => {}
            [true, false] => out.extend_from_slice(&[b"/", uv].concat()),
            [_, true] => {
                let uv = if has[0] { uv } else { b"" };
                out.extend_from_slice(&[b"/", uv, b"/", normal].concat());
            }
        }
        out.push(b' ');
    }
    out
}
