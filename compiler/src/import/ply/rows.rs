//! Rows of a PLY file become flat arrays: each number finite, each index one of a vertex.

use std::fmt;
use std::io::ErrorKind::UnexpectedEof;

use serde::Deserialize;
use serde::de::{DeserializeSeed, Deserializer, IgnoredAny, MapAccess, SeqAccess, Visitor};

use super::super::budget::Loan;
use super::super::colors::linear;
use super::super::error::{ErrorKind, ImportError};
use super::super::file::Limits;
use super::super::geometry::{
    COLOR_BYTES, CORNER_BYTES, Face, Geometry, MAX_CORNERS, Run, State, VALUE_BYTES,
};
use super::super::mesh::NO_CORNER;
use super::header::{Element, Failure, Header, Slot, Vertex};

/// What rows become.
pub(super) struct Rows {
    pub(super) geometry: Geometry,
    /// Faces of one or two corners.
    pub(super) n_not_polygons: u64,
    n_vertices: u32,
    has_normals: bool,
    has_uvs: bool,
    /// See [`Header::color_scale`]; `None` without colours.
    color_scale: Option<f32>,
    /// See [`Header::alpha_scale`]; `None`: colours have no alpha.
    alpha_scale: Option<f32>,
    loan: Loan,
    /// Number of the row at hand.
    row: u64,
    /// Why reading stopped, unless it is what `serde_ply` says.
    failure: Option<Failure>,
    /// Corners and their UVs of the face at hand.
    corners: Vec<u32>,
    corner_uvs: Vec<f32>,
}

impl Rows {
    /// Reads the rows of all elements; the loan is what they take, and what they will take as parts.
    pub(super) fn read(
        header: &Header<'_>,
        file: &str,
        limits: &Limits,
    ) -> Result<(Self, Loan), ImportError> {
        let (has_normals, has_uvs) = (header.has(&Vertex::NORMAL), header.has(&Vertex::UV));
        let color_scale = header.has(&Vertex::COLOR).then_some(header.color_scale);
        let alpha_scale = header.has(&[Vertex::ALPHA]).then_some(header.alpha_scale);
        let n_kinds = 1 + u64::from(has_normals) + u64::from(has_uvs);
        let bytes = n_kinds * VALUE_BYTES + u64::from(color_scale.is_some()) * COLOR_BYTES;
        let mut rows = Self {
            geometry: Geometry::default(),
            n_not_polygons: 0,
            n_vertices: header.n_vertices,
            has_normals,
            has_uvs,
            color_scale,
            alpha_scale,
            loan: limits.memory.take(u64::from(header.n_vertices) * bytes, file)?,
            row: 0,
            failure: None,
            corners: Vec::new(),
            corner_uvs: Vec::new(),
        };
        let mut reader =
            header.reader().map_err(|(kind, message)| ImportError::new(kind, file, message))?;
        for element in &header.elements {
            let read = (&mut reader).next_value_seed(Table { rows: &mut rows, element });
            read.map_err(|error| rows.failed(&error.0, element, file))?;
        }
        let loan = std::mem::take(&mut rows.loan);
        Ok((rows, loan))
    }

    fn failed(&mut self, error: &std::io::Error, element: &Element, file: &str) -> ImportError {
        let place = format!("{file}: {} {}", element.name, self.row);
        let (kind, message) = self.failure.take().unwrap_or_else(|| {
            let message = match error.kind() {
                UnexpectedEof => {
                    format!("the file ends here; it should have {} rows", element.count)
                }
                _ => error.to_string().chars().filter(|c| !c.is_control()).take(200).collect(),
            };
            (ErrorKind::Format, message)
        });
        ImportError::new(kind, place, message)
    }

    fn vertex(&mut self, values: &[f64; Vertex::N]) -> Result<(), Failure> {
        let single = |number: Vertex| {
            #[expect(clippy::cast_possible_truncation, reason = "rounding is what it is for")]
            let rounded = values[number.0] as f32;
            if rounded.is_finite() {
                return Ok(rounded);
            }
            Err((ErrorKind::Number, format!("`{}` is not a finite number", values[number.0])))
        };
        let [x, y, z] = Vertex::POSITION.map(single);
        self.geometry.positions.push([x?, y?, z?]);
        if self.has_normals {
            let [x, y, z] = Vertex::NORMAL.map(single);
            self.geometry.normals.push([x?, y?, z?]);
        }
        if let Some(scale) = self.color_scale {
            let [r, g, b] = Vertex::COLOR.map(single);
            let value = |x: f32| if scale > 0.0 { linear(x / scale) } else { x.clamp(0.0, 1.0) };
            let [r, g, b] = [r?, g?, b?].map(value);
            let alpha = match self.alpha_scale {
                Some(scale) if scale > 0.0 => single(Vertex::ALPHA)? / scale,
                Some(_) => single(Vertex::ALPHA)?,
                None => 1.0,
            };
            self.geometry.colors.push([r, g, b, alpha.clamp(0.0, 1.0)]);
        }
        if self.has_uvs {
            let [u, v] = Vertex::UV.map(single);
            self.geometry.uvs.push([u?, v?]);
        }
        Ok(())
    }

    /// Takes the corners at hand as a face.
    fn face(&mut self) -> Result<(), Failure> {
        let corners = std::mem::take(&mut self.corners);
        let corner_uvs = std::mem::take(&mut self.corner_uvs);
        let done = self.add_face(&corners, &corner_uvs);
        (self.corners, self.corner_uvs) = (corners, corner_uvs); // their memory is used again
        done
    }

    fn add_face(&mut self, corners: &[u32], corner_uvs: &[f32]) -> Result<(), Failure> {
        if corners.len() < 3 {
            self.n_not_polygons += 1;
            return Ok(());
        }
        let has_own = match corner_uvs.len() {
            0 => false,
            n if n == 2 * corners.len() => true,
            n => {
                let message = format!("{n} numbers of `texcoord` for {} corners", corners.len());
                return Err((ErrorKind::Format, message));
            }
        };
        self.charge(corners.len() as u64 * (CORNER_BYTES + if has_own { VALUE_BYTES } else { 0 }))?;
        let geometry = &mut self.geometry;
        let first_uv = u32::try_from(geometry.uvs.len()).unwrap_or(NO_CORNER);
        if has_own {
            geometry.uvs.extend(corner_uvs.as_chunks::<2>().0);
        }
        if geometry.uvs.len() >= NO_CORNER as usize {
            return Err((ErrorKind::Limit, "more than 2^32 texture coordinates".to_owned()));
        }
        for (number, vertex) in (0..).zip(corners) {
            let uv = if has_own { first_uv + number } else { *vertex };
            let optional = |there: bool, index: u32| if there { index } else { NO_CORNER };
            geometry.corners.push([
                *vertex,
                optional(has_own || self.has_uvs, uv),
                optional(self.has_normals, *vertex),
            ]);
        }
        let n_corners = u32::try_from(corners.len()).unwrap_or(u32::MAX); // at most MAX_CORNERS
        let at = u32::try_from(self.row).unwrap_or(u32::MAX);
        geometry.faces.push(Face { n_corners, at });
        let state = State {
            name: 0,
            material: None,
            has_uv: has_own || self.has_uvs,
            has_normal: self.has_normals,
            smoothing: None,
        };
        match geometry.runs.last_mut() {
            Some(run) if run.state == state => run.n_faces += 1,
            _ => geometry.runs.push(Run { state, n_faces: 1 }),
        }
        Ok(())
    }

    /// Asks for memory before it is taken.
    fn charge(&mut self, bytes: u64) -> Result<(), Failure> {
        self.loan.charge(bytes, "").map_err(|error| (error.kind, error.message))
    }

    /// The result of a check, as `serde` passes it on.
    fn checked<T, E: serde::de::Error>(&mut self, result: Result<T, Failure>) -> Result<T, E> {
        result.map_err(|failure| {
            self.failure = Some(failure);
            E::custom("see there")
        })
    }
}

/// All rows of an element.
struct Table<'t> {
    rows: &'t mut Rows,
    element: &'t Element,
}

impl<'de> DeserializeSeed<'de> for Table<'_> {
    type Value = ();

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<(), D::Error> {
        deserializer.deserialize_seq(self)
    }
}

impl<'de> Visitor<'de> for Table<'_> {
    type Value = ();

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("rows")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<(), A::Error> {
        let Self { rows, element } = self;
        rows.row = 0;
        while seq.next_element_seed(Row { rows, element })?.is_some() {
            rows.row += 1;
        }
        Ok(())
    }
}

/// One row.
struct Row<'t> {
    rows: &'t mut Rows,
    element: &'t Element,
}

impl<'de> DeserializeSeed<'de> for Row<'_> {
    type Value = ();

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<(), D::Error> {
        deserializer.deserialize_map(self)
    }
}

impl<'de> Visitor<'de> for Row<'_> {
    type Value = ();

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("a row")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<(), A::Error> {
        let Self { rows, element } = self;
        let mut vertex = [0.0; Vertex::N];
        rows.corners.clear();
        rows.corner_uvs.clear();
        for slot in &element.slots {
            map.next_key::<IgnoredAny>()?;
            match slot {
                Slot::Vertex(number) => vertex[number.0] = map.next_value::<f64>()?,
                Slot::Corners => map.next_value_seed(Corners(rows))?,
                Slot::CornerUvs => map.next_value_seed(CornerUvs(rows))?,
                Slot::Other => {
                    map.next_value::<IgnoredAny>()?;
                }
            }
        }
        let done = match element.name.as_str() {
            "vertex" => rows.vertex(&vertex),
            "face" => rows.face(),
            _ => Ok(()),
        };
        rows.checked(done)
    }
}

/// The corners of a face.
struct Corners<'t>(&'t mut Rows);

impl<'de> DeserializeSeed<'de> for Corners<'_> {
    type Value = ();

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<(), D::Error> {
        deserializer.deserialize_seq(self)
    }
}

impl<'de> Visitor<'de> for Corners<'_> {
    type Value = ();

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("a list of vertices")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<(), A::Error> {
        let rows = self.0;
        while let Some(Index(index)) = seq.next_element()? {
            let n = rows.n_vertices;
            let checked = match u32::try_from(index).ok().filter(|index| *index < n) {
                None => {
                    Err((ErrorKind::Index, format!("vertex {index}, but there are {n} vertices")))
                }
                Some(_) if rows.corners.len() >= MAX_CORNERS => {
                    Err((ErrorKind::Limit, format!("a face has at most {MAX_CORNERS} corners")))
                }
                Some(index) => Ok(index),
            };
            let index = rows.checked(checked)?;
            rows.corners.push(index);
        }
        Ok(())
    }
}

/// u and v of the corners of a face.
struct CornerUvs<'t>(&'t mut Rows);

impl<'de> DeserializeSeed<'de> for CornerUvs<'_> {
    type Value = ();

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<(), D::Error> {
        deserializer.deserialize_seq(self)
    }
}

impl<'de> Visitor<'de> for CornerUvs<'_> {
    type Value = ();

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("a list of texture coordinates")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<(), A::Error> {
        let rows = self.0;
        while let Some(number) = seq.next_element::<f32>()? {
            let checked = match number {
                _ if rows.corner_uvs.len() >= 2 * MAX_CORNERS => {
                    Err((ErrorKind::Limit, format!("a face has at most {MAX_CORNERS} corners")))
                }
                number if number.is_finite() => Ok(number),
                number => Err((ErrorKind::Number, format!("`{number}` is not a finite number"))),
            };
            let number = rows.checked(checked)?;
            rows.corner_uvs.push(number);
        }
        Ok(())
    }
}

/// A whole number, whatever its type in the file.
#[derive(Deserialize)]
#[serde(transparent)]
struct Index(i64);
