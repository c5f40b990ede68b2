//! OBJ text becomes flat arrays in one pass, each line checked as it is read.
//!
//! Numbers are finite, indices are resolved and lie within what has been defined above them, faces have at least
//! three corners. Consecutive faces for which the same names, material, smoothing group and kinds of indices hold
//! are one [`Run`]. What a keyword means for the mesh, units and axes are not known here.

use super::super::budget::Loan;
use super::super::colors::linear;
use super::super::error::{ErrorKind, ImportError, excerpt};
use super::super::file::Limits;
use super::super::geometry::{
    COLOR_BYTES, CORNER_BYTES, Face, Geometry, MAX_CORNERS, PartName, Run, State, VALUE_BYTES,
};
use super::super::lines::{Lines, MAX_LINE, numbers_of, split_word, text, uncommented, words};
use super::super::mesh::NO_CORNER;
use std::collections::BTreeMap;

/// Bytes of a run, in a list that doubles.
const RUN_BYTES: u64 = 80;
/// Bytes beside its letters of a name and of the entry by which it is found.
const NAME_BYTES: u64 = 200;

/// What an OBJ file says.
#[derive(Debug, Default)]
pub(super) struct Obj {
    pub(super) geometry: Geometry,
    /// Names that runs refer to.
    pub(super) names: Vec<PartName>,
    /// Materials that runs refer to, with the line of their first `usemtl`.
    pub(super) materials: Vec<(String, u64)>,
    /// Material libraries with their lines.
    pub(super) libraries: Vec<(String, u64)>,
    pub(super) oddities: Oddities,
}

/// What the user is warned about; of each kind how often it was met, and the line of the first.
#[derive(Debug, Default)]
pub(super) struct Oddities {
    /// By keyword: lines that were skipped.
    pub(super) skipped: BTreeMap<String, (u64, u64)>,
    /// Vertices with a colour where others have none; no colour is used.
    pub(super) colored: (u64, u64),
    /// Names that are not UTF-8 and were read as Latin-1.
    pub(super) latin: (u64, u64),
    /// Faces with indices of UVs and of normals of which the file has none above them; these indices are left out.
    pub(super) dangling: [(u64, u64); 2],
}

/// Parses the text of `file`; the loan is what the result takes, and what it will take as parts.
pub(super) fn parse(text: &[u8], file: &str, limits: &Limits) -> Result<(Obj, Loan), ImportError> {
    let mut parser = Parser::new(limits);
    let mut lines = Lines::new(text);
    while let Some((number, line)) = lines.next() {
        let outcome = if line.len() > MAX_LINE {
            format_error(format!("this line is longer than {MAX_LINE} bytes; no OBJ line is"))
        } else {
            parser.line(number, line)
        };
        outcome.map_err(|(kind, message)| {
            ImportError::new(kind, format!("{file}:{number}"), message)
        })?;
    }
    let mut out = parser.out;
    settle_colors(&mut out);
    Ok((out, parser.loan))
}

/// Colours as linear factors, if all vertices have some. They have the sRGB curve, and go to 1, or to 255 where one is
/// larger.
fn settle_colors(obj: &mut Obj) {
    let colors = &mut obj.geometry.colors;
    if colors.len() != obj.geometry.positions.len() {
        obj.oddities.colored.0 += colors.len() as u64;
        colors.clear();
        return;
    }
    let most = colors.as_flattened().iter().fold(1.0_f32, |most, x| most.max(*x));
    let scale = if most > 1.0 { 1.0 / 255.0 } else { 1.0 };
    for color in colors {
        let [r, g, b, alpha] = *color;
        let [r, g, b] = [r, g, b].map(|x| linear(x * scale));
        *color = [r, g, b, alpha];
    }
}

struct Parser {
    /// Number of the line at hand.
    line: u64,
    max_faces: u64,
    /// What was taken, and what is not asked for yet.
    loan: Loan,
    name: PartName,
    state: State,
    name_ids: BTreeMap<PartName, u32>,
    material_ids: BTreeMap<String, u32>,
    out: Obj,
}

type Checked<T = ()> = Result<T, (ErrorKind, String)>;

fn format_error<T>(message: impl Into<String>) -> Checked<T> {
    Err((ErrorKind::Format, message.into()))
}

impl Parser {
    fn new(limits: &Limits) -> Self {
        let state =
            State { name: 0, material: None, has_uv: false, has_normal: false, smoothing: None };
        Self {
            line: 0,
            max_faces: limits.triangles,
            loan: limits.memory.nothing(),
            name: PartName::default(),
            state,
            name_ids: BTreeMap::from([(PartName::default(), 0)]),
            material_ids: BTreeMap::new(),
            out: Obj { names: vec![PartName::default()], ..Obj::default() },
        }
    }

    fn line(&mut self, number: u64, line: &[u8]) -> Checked {
        self.line = number;
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
        let [x, y, z, w, ..] = numbers;
        let mut position = [x, y, z];
        match n {
            3 => {}
            4 => {
                position = position.map(|x| x / w);
                if w == 0.0 || !position.iter().all(|x| x.is_finite()) {
                    let message = "the weight w makes this vertex infinite";
                    return Err((ErrorKind::Number, message.to_owned()));
                }
            }
            6 | 7 => {
                self.charge(COLOR_BYTES)?;
                let place = self.out.geometry.positions.len();
                // Those of all vertices, or none.
                if self.out.geometry.colors.len() == place {
                    self.out.geometry.colors.push([numbers[3], numbers[4], numbers[5], 1.0]);
                } else {
                    count(&mut self.out.oddities.colored, self.line);
                }
            }
            n => return format_error(format!("a vertex has 3 numbers (x y z), found {n}")),
        }
        self.charge(VALUE_BYTES)?;
        push(&mut self.out.geometry.positions, position)
    }

    fn uv(&mut self, rest: &[u8]) -> Checked {
        let mut numbers = [0.0; 3];
        match numbers_of(rest, &mut numbers)? {
            1..=3 => {}
            n => return format_error(format!("`vt` has 1 to 3 numbers (u v w), found {n}")),
        }
        self.charge(VALUE_BYTES)?;
        push(&mut self.out.geometry.uvs, [numbers[0], numbers[1]])
    }

    fn normal(&mut self, rest: &[u8]) -> Checked {
        let mut normal = [0.0; 3];
        match numbers_of(rest, &mut normal)? {
            3 => {}
            n => return format_error(format!("a normal has 3 numbers, found {n}")),
        }
        self.charge(VALUE_BYTES)?;
        push(&mut self.out.geometry.normals, normal)
    }

    /// Asks for memory before it is taken.
    fn charge(&mut self, bytes: u64) -> Checked {
        self.loan.charge(bytes, "").map_err(|error| (error.kind, error.message))
    }

    fn face(&mut self, rest: &[u8]) -> Checked {
        let first = self.out.geometry.corners.len();
        let mut has = [true; 3];
        for word in words(rest) {
            let (corner, found) = self.corner(word)?;
            let n_corners = self.out.geometry.corners.len() - first;
            if n_corners > 0 && found != has {
                return format_error(format!(
                    "corner {} `{}` has other indices than the corners before it; all corners of a \
                     face must have the form v, v/vt, v//vn or v/vt/vn alike",
                    n_corners + 1,
                    excerpt(word)
                ));
            }
            has = found;
            self.out.geometry.corners.push(corner);
        }
        let n_corners = self.out.geometry.corners.len() - first;
        if n_corners < 3 {
            return format_error(format!("a face has at least 3 corners, found {n_corners}"));
        }
        let Some(n_corners) = u32::try_from(n_corners).ok().filter(|_| n_corners <= MAX_CORNERS)
        else {
            let message = format!("a face has at most {MAX_CORNERS} corners, found {n_corners}");
            return Err((ErrorKind::Limit, message));
        };
        if self.out.geometry.faces.len() as u64 >= self.max_faces {
            return Err((ErrorKind::Limit, format!("more than {} faces", self.max_faces)));
        }
        self.charge(u64::from(n_corners) * CORNER_BYTES)?;
        let dangles = [
            has[1] && self.out.geometry.uvs.is_empty(),
            has[2] && self.out.geometry.normals.is_empty(),
        ];
        for (dangles, found) in dangles.into_iter().zip(&mut self.out.oddities.dangling) {
            if dangles {
                count(found, self.line);
            }
        }
        self.state.has_uv = has[1] && !dangles[0];
        self.state.has_normal = has[2] && !dangles[1];
        let line = u32::try_from(self.line).unwrap_or(u32::MAX);
        self.out.geometry.faces.push(Face { n_corners, at: line });
        self.continue_run()
    }

    /// Counts the face at hand to the last run, or to a new one if its state is another.
    fn continue_run(&mut self) -> Checked {
        match self.out.geometry.runs.last_mut() {
            Some(run) if run.state == self.state => run.n_faces += 1,
            _ => {
                self.charge(RUN_BYTES)?;
                self.out.geometry.runs.push(Run { state: self.state.clone(), n_faces: 1 });
            }
        }
        Ok(())
    }

    /// The indices of `v`, `v/vt`, `v//vn` or `v/vt/vn`, and which of the three are there. UVs and normals of which
    /// the file has none so far may have any index, and get `NO_CORNER`.
    fn corner(&self, corner: &[u8]) -> Checked<([u32; 3], [bool; 3])> {
        const KINDS: [&str; 3] = ["vertex", "UV", "normal"];
        let known = &self.out.geometry;
        let defined = [known.positions.len(), known.uvs.len(), known.normals.len()];
        let mut out = [NO_CORNER; 3];
        let mut has = [false; 3];
        for (which, digits) in corner.split(|byte| *byte == b'/').enumerate() {
            if which > 2 || (which == 0 && digits.is_empty()) {
                return format_error(format!("`{}` is not of the form v/vt/vn", excerpt(corner)));
            }
            if digits.is_empty() {
                continue;
            }
            let index = std::str::from_utf8(digits).ok().and_then(|s| s.parse::<i64>().ok());
            let Some(index) = index else {
                let (digits, corner) = (excerpt(digits), excerpt(corner));
                return format_error(format!("`{digits}` is not an index in `{corner}`"));
            };
            let (kind, n) = (KINDS[which], defined[which]);
            has[which] = true;
            match resolve(index, n) {
                Some(index) => out[which] = index,
                None if index == 0 => {
                    let message = format!("{kind} index 0; indices begin at 1");
                    return Err((ErrorKind::Index, message));
                }
                None if which > 0 && n == 0 => {}
                None => {
                    let message =
                        format!("{kind} index {index}, but only {n} are defined above this line");
                    return Err((ErrorKind::Index, message));
                }
            }
        }
        Ok((out, has))
    }

    /// A name as text.
    fn text(&mut self, bytes: &[u8]) -> String {
        let (text, is_latin) = text(bytes);
        if is_latin {
            count(&mut self.out.oddities.latin, self.line);
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
        if !plain || keyword.len() > MAX_KEYWORD || self.out.oddities.skipped.len() >= MAX_KINDS {
            // Nothing of it is shown: a scene may name any file of its reader.
            return format_error("this is no OBJ keyword; is this an OBJ file?".to_owned());
        }
        let key = excerpt(keyword);
        let line = self.line;
        self.out.oddities.skipped.entry(key).or_insert((0, line)).0 += 1;
        Ok(())
    }
}

/// The index into a list of `n` that `index` of a file means: from 1 upwards, or from -1 down from the end.
fn resolve(index: i64, n: usize) -> Option<u32> {
    let n = i64::try_from(n).ok()?;
    let from_start = if index > 0 { index - 1 } else { n + index };
    let is_there = index != 0 && (0..n).contains(&from_start);
    u32::try_from(from_start).ok().filter(|_| is_there)
}

/// Appends a value; all indices stay below `NO_CORNER`.
fn push<T>(values: &mut Vec<T>, value: T) -> Checked {
    values.push(value);
    if values.len() >= NO_CORNER as usize {
        return Err((ErrorKind::Limit, "more than 2^32 values of one kind".to_owned()));
    }
    Ok(())
}

/// Counts one more; `line` is kept of the first.
fn count(found: &mut (u64, u64), line: u64) {
    if found.0 == 0 {
        found.1 = line;
    }
    found.0 += 1;
}
