//! STL files, text or binary, become a [`MeshFile`].
//!
//! The format has triangles alone: corners at one place become one vertex, the normals of facets are left aside, as
//! corners and their order say the same, and `build` of all files of polygons makes smooth ones. A text may hold
//! several solids; each is a part. Axes and units are those of OBJ.

use super::budget::Loan;
use super::build::{self, Faces, Source};
use super::check::position_bits;
use super::error::{ErrorKind, ImportError};
use super::file::{Limits, Reader, read_file};
use super::foreign::{Format, foreign};
use super::frame::Frame;
use super::geometry::{CORNER_BYTES, Face, Geometry, PartName, Run, State, VALUE_BYTES};
use super::lines::{Lines, MAX_LINE, numbers_of, split_word, text};
use super::mesh::{MeshFile, NO_CORNER};
use super::report::ImportReport;
use super::studio::Studio;
use files::ShowPath as _;
use lang::scene::Axis;
use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::path::Path;

/// Bytes of a binary file before its triangles: a comment and their number.
const HEADER: usize = 84;
/// Bytes of a triangle: its normal, three corners, and two bytes that no two programs understand alike.
const TRIANGLE: usize = 50;
/// Bytes that a triangle takes: its corners, and its vertices with the entries by which they are found.
const TRIANGLE_BYTES: u64 = 3 * (CORNER_BYTES + VALUE_BYTES + 40);
/// Bytes beside its letters of a name and of the entry by which it is found.
const NAME_BYTES: u64 = 280;

/// Reads an STL file whose unit is `metres_per_unit` and whose `up` axis is to become +Y.
pub fn load_stl(
    path: &Path,
    metres_per_unit: f64,
    up: Axis,
    limits: &Limits,
) -> Result<MeshFile, ImportError> {
    let (bytes, _loan) = read_file(path, limits)?;
    read_stl(&bytes, path, metres_per_unit, up, limits)
}

/// The same for a file whose bytes are in memory; `path` names it in messages.
pub fn read_stl(
    bytes: &[u8],
    path: &Path,
    metres_per_unit: f64,
    up: Axis,
    limits: &Limits,
) -> Result<MeshFile, ImportError> {
    let mut reader = Reader::new(limits);
    reader.remember(path, bytes);
    let file = path.shown().to_string();
    let mut solids = Solids::new(limits);
    let faces = if let Some(triangles) = triangles_of(bytes) {
        solids.binary(triangles, &file)?;
        Faces::ByNumber
    } else {
        solids.text(bytes, &file)?;
        Faces::ByLine
    };
    let mut report = ImportReport::default();
    if let Some(line) = solids.first_latin {
        let message = "names are not UTF-8 and were read as Latin-1; this is the first";
        report.warn(format!("{file}:{line}"), message);
    }
    let source = Source {
        file: &file,
        faces,
        frame: Frame { metres_per_unit, up },
        names: &solids.names,
        material_ids: &[],
        limits,
    };
    let parts = build::parts(solids.geometry, solids.loan, &source, &mut report)?;
    report.files = reader.finish();
    Ok(MeshFile {
        parts,
        materials: Vec::new(),
        images: Vec::new(),
        studio: Studio::default(),
        report,
    })
}

/// The triangles of a binary file; `None` for one that is text, or nothing of the kind.
///
/// The number of triangles decides, as the comments of many binary files begin with `solid`.
fn triangles_of(bytes: &[u8]) -> Option<&[[u8; TRIANGLE]]> {
    let (header, rest) = bytes.split_at_checked(HEADER)?;
    let n = u32::from_le_bytes(*header.last_chunk()?) as usize;
    let (triangles, left) = rest.as_chunks();
    let exact = triangles.len() == n && left.is_empty();
    // Some programs write more behind the last triangle; a text of that length has no such number in its header.
    let is_text =
        bytes.trim_ascii_start().get(..5).is_some_and(|word| word.eq_ignore_ascii_case(b"solid"));
    if exact || !is_text { triangles.get(..n) } else { None }
}

type Failure = (ErrorKind, String);

fn format_error<T>(message: impl Into<String>) -> Result<T, Failure> {
    Err((ErrorKind::Format, message.into()))
}

struct Solids<'l> {
    limits: &'l Limits,
    geometry: Geometry,
    loan: Loan,
    vertices: BTreeMap<[u32; 3], u32>,
    names: Vec<PartName>,
    name_ids: BTreeMap<String, u32>,
    /// Of the solid at hand.
    name: u32,
    first_latin: Option<u64>,
}

impl<'l> Solids<'l> {
    fn new(limits: &'l Limits) -> Self {
        Self {
            limits,
            geometry: Geometry::default(),
            loan: limits.memory.nothing(),
            vertices: BTreeMap::new(),
            names: vec![PartName::default()],
            name_ids: BTreeMap::from([(String::new(), 0)]),
            name: 0,
            first_latin: None,
        }
    }

    fn binary(&mut self, triangles: &[[u8; TRIANGLE]], file: &str) -> Result<(), ImportError> {
        for (number, triangle) in (0_u32..).zip(triangles) {
            let (floats, _) = triangle.as_chunks();
            let mut corners = [[0.0; 3]; 3];
            for (value, bytes) in corners.as_flattened_mut().iter_mut().zip(&floats[3..]) {
                *value = f32::from_le_bytes(*bytes);
            }
            self.triangle(corners, number).map_err(|(kind, message)| {
                ImportError::new(kind, format!("{file}: face {number}"), message)
            })?;
        }
        Ok(())
    }

    fn text(&mut self, bytes: &[u8], file: &str) -> Result<(), ImportError> {
        let mut corners = Vec::new();
        let mut lines = Lines::new(bytes);
        let mut is_open = false;
        let mut last = 0;
        while let Some((number, line)) = lines.next() {
            last = number;
            if !is_open && !line.is_empty() {
                is_open = split_word(line).0.eq_ignore_ascii_case(b"solid");
                if !is_open {
                    return Err(self::no_stl(bytes, file));
                }
            }
            self.line(number, line, &mut corners).map_err(|(kind, message)| {
                ImportError::new(kind, format!("{file}:{number}"), message)
            })?;
        }
        if !is_open {
            return Err(self::no_stl(bytes, file));
        }
        if !corners.is_empty() {
            let place = format!("{file}:{last}");
            let message = "the file ends inside of a facet";
            return Err(ImportError::new(ErrorKind::Format, place, message));
        }
        Ok(())
    }

    fn line(
        &mut self,
        number: u64,
        line: &[u8],
        corners: &mut Vec<[f32; 3]>,
    ) -> Result<(), Failure> {
        if line.len() > MAX_LINE {
            return format_error(format!(
                "this line is longer than {MAX_LINE} bytes; no STL line is"
            ));
        }
        let (keyword, rest) = split_word(line);
        match keyword.to_ascii_lowercase().as_slice() {
            b"vertex" => {
                let mut corner = [0.0; 3];
                match numbers_of(rest, &mut corner)? {
                    3 => {}
                    n => return format_error(format!("a vertex has 3 numbers (x y z), found {n}")),
                }
                if corners.len() == 3 {
                    return format_error("a facet has 3 vertices, this is the fourth");
                }
                corners.push(corner);
                Ok(())
            }
            b"endloop" => {
                let Ok(triangle) = <[[f32; 3]; 3]>::try_from(corners.as_slice()) else {
                    return format_error(format!(
                        "a facet has 3 vertices, found {}",
                        corners.len()
                    ));
                };
                corners.clear();
                self.triangle(triangle, u32::try_from(number).unwrap_or(u32::MAX))
            }
            b"solid" => self.solid(rest, number),
            b"" | b"facet" | b"outer" | b"endfacet" | b"endsolid" | b"color" => Ok(()),
            // Nothing of it is shown: a scene may name any file of its reader.
            _ => format_error("this is no STL keyword; is this an STL file?"),
        }
    }

    fn solid(&mut self, name: &[u8], number: u64) -> Result<(), Failure> {
        let (name, is_latin) = text(name);
        if is_latin {
            self.first_latin.get_or_insert(number);
        }
        self.name = if let Some(known) = self.name_ids.get(name.as_ref()) {
            *known
        } else {
            self.charge(NAME_BYTES + 2 * name.len() as u64)?;
            let next = u32::try_from(self.names.len())
                .map_err(|_| (ErrorKind::Limit, "more than 2^32 solids".to_owned()))?;
            self.name_ids.insert(name.to_string(), next);
            self.names.push(PartName { object: name.into_owned(), groups: String::new() });
            next
        };
        Ok(())
    }

    fn triangle(&mut self, corners: [[f32; 3]; 3], at: u32) -> Result<(), Failure> {
        if let Some(x) = corners.as_flattened().iter().find(|x| !x.is_finite()) {
            return Err((ErrorKind::Number, format!("`{x}` is not a finite number")));
        }
        if self.geometry.faces.len() as u64 >= self.limits.triangles {
            return Err((
                ErrorKind::Limit,
                format!("more than {} triangles", self.limits.triangles),
            ));
        }
        self.charge(TRIANGLE_BYTES)?;
        for corner in corners {
            let vertex = self.vertex(corner)?;
            self.geometry.corners.push([vertex, NO_CORNER, NO_CORNER]);
        }
        self.geometry.faces.push(Face { n_corners: 3, at });
        let state = State {
            name: self.name,
            material: None,
            has_uv: false,
            has_normal: false,
            smoothing: None,
        };
        match self.geometry.runs.last_mut() {
            Some(run) if run.state == state => run.n_faces += 1,
            _ => self.geometry.runs.push(Run { state, n_faces: 1 }),
        }
        Ok(())
    }

    /// The vertex at a place.
    fn vertex(&mut self, place: [f32; 3]) -> Result<u32, Failure> {
        match self.vertices.entry(position_bits(place)) {
            Entry::Occupied(known) => Ok(*known.get()),
            Entry::Vacant(free) => {
                let next = u32::try_from(self.geometry.positions.len()).ok();
                let next = next.filter(|next| *next < NO_CORNER);
                let next =
                    next.ok_or_else(|| (ErrorKind::Limit, "more than 2^32 vertices".to_owned()))?;
                self.geometry.positions.push(place);
                Ok(*free.insert(next))
            }
        }
    }

    /// Asks for memory before it is taken.
    fn charge(&mut self, bytes: u64) -> Result<(), Failure> {
        self.loan.charge(bytes, "").map_err(|error| (error.kind, error.message))
    }
}

/// Says what a file is that is neither.
fn no_stl(bytes: &[u8], file: &str) -> ImportError {
    let message = match (foreign(bytes, Format::Stl), bytes.get(80..HEADER)) {
        (Some(what), _) => format!("this is not an STL file but {what}"),
        (None, Some([a, b, c, d])) => {
            let n = u32::from_le_bytes([*a, *b, *c, *d]);
            let most = (bytes.len() - HEADER) / TRIANGLE;
            format!(
                "this is no STL file, or one that is cut off: a text begins with `solid`, and \
                 as a binary file it claims {n} triangles and has room for {most}"
            )
        }
        // Nothing of it is shown: a scene may name any file of its reader.
        (None, _) => "this is no STL file: it does not begin with `solid`".to_owned(),
    };
    ImportError::new(ErrorKind::Format, file, message)
}
