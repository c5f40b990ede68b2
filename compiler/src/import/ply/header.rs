//! The header of a PLY file: what its rows hold, checked against the bytes that are there.

use super::super::error::{ErrorKind, excerpt};
use super::super::file::Limits;
use super::super::lines::text;
use serde_ply::{ElementDef, PlyFormat, PlyReader, PropertyType, ScalarType};
use std::collections::BTreeSet;
use std::io::{BufRead, Cursor, Read as _};

/// Longest header, bytes: thousands of properties and comments.
const MAX_HEADER: usize = 1 << 20;

/// Which rule of the format is broken, and how.
pub(super) type Failure = (ErrorKind, String);

/// A header, and what comes after it.
pub(super) struct Header<'a> {
    text: String,
    payload: &'a [u8],
    is_text: bool,
    pub(super) elements: Vec<Element>,
    pub(super) n_vertices: u32,
    pub(super) n_faces: u64,
    /// What the numbers of colours are divided by; 0: they are linear.
    pub(super) color_scale: f32,
    /// What their alpha is divided by; 0: it is a share.
    pub(super) alpha_scale: f32,
    /// Images that comments name.
    pub(super) images: Vec<String>,
}

/// Rows of one kind.
pub(super) struct Element {
    pub(super) name: String,
    pub(super) count: u64,
    /// What each value of a row is.
    pub(super) slots: Vec<Slot>,
}

/// What a value of a row is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Slot {
    /// A number of a vertex.
    Vertex(Vertex),
    /// Indices of the corners of a face.
    Corners,
    /// u and v of each corner of a face.
    CornerUvs,
    /// Nothing that is used.
    Other,
}

/// Numbers of a vertex, by their place in a row of [`Vertex::N`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Vertex(pub(super) usize);

impl Vertex {
    pub(super) const N: usize = 12;
    pub(super) const POSITION: [Self; 3] = [Self(0), Self(1), Self(2)];
    pub(super) const NORMAL: [Self; 3] = [Self(3), Self(4), Self(5)];
    pub(super) const UV: [Self; 2] = [Self(6), Self(7)];
    pub(super) const COLOR: [Self; 3] = [Self(8), Self(9), Self(10)];
    pub(super) const ALPHA: Self = Self(11);

    /// The names that are in use; those of UVs are `u v` of many, `s t` of Blender, and `MeshLab`'s.
    fn named(name: &str) -> Option<Self> {
        const NAMES: [&[&str]; Vertex::N] = [
            &["x"],
            &["y"],
            &["z"],
            &["nx"],
            &["ny"],
            &["nz"],
            &["u", "s", "texture_u", "texture_s"],
            &["v", "t", "texture_v", "texture_t"],
            &["red", "r", "diffuse_red"],
            &["green", "g", "diffuse_green"],
            &["blue", "b", "diffuse_blue"],
            &["alpha", "a", "diffuse_alpha"],
        ];
        NAMES.iter().position(|names| names.contains(&name)).map(Self)
    }
}

impl<'a> Header<'a> {
    /// Reads a header and compares what it claims with the bytes after it, and with the limits.
    pub(super) fn read(bytes: &'a [u8], limits: &Limits) -> Result<Self, Failure> {
        let (text, payload) = split(bytes)?;
        let reader = PlyReader::from_reader(Cursor::new(text.as_bytes()));
        let reader = reader.map_err(|error| format_error(&error.0.to_string()))?;
        let found = reader.header();
        let mut header = Self {
            is_text: found.format == PlyFormat::Ascii,
            payload,
            elements: Vec::with_capacity(found.elem_defs.len()),
            n_vertices: 0,
            n_faces: 0,
            color_scale: 0.0,
            alpha_scale: 0.0,
            images: found.comments.iter().filter_map(|comment| image_of(comment)).collect(),
            text: String::new(),
        };
        let mut names = BTreeSet::new();
        for element in &found.elem_defs {
            if !names.insert(&element.name) {
                let name = excerpt(element.name.as_bytes());
                return Err(format_error(&format!("`element {name}` stands twice in the header")));
            }
            header.add(element, limits)?;
        }
        drop(reader);
        header.text = text;
        Ok(header)
    }

    /// The rows, behind the header.
    pub(super) fn reader(&self) -> Result<PlyReader<impl BufRead>, Failure> {
        // The last number of a text need not have anything behind it.
        let end: &[u8] = if self.is_text { b"\n" } else { b"" };
        let all = self.text.as_bytes().chain(self.payload).chain(end);
        PlyReader::from_reader(all).map_err(|error| format_error(&error.0.to_string()))
    }

    /// Whether vertices have all of these numbers.
    pub(super) fn has(&self, numbers: &[Vertex]) -> bool {
        let of_vertices = self.elements.iter().filter(|element| element.name == "vertex");
        let slots: Vec<Slot> = of_vertices.flat_map(|element| element.slots.clone()).collect();
        numbers.iter().all(|number| slots.contains(&Slot::Vertex(*number)))
    }

    /// `8 vertex, 1 tristrips`.
    pub(super) fn contents(&self) -> String {
        const MOST: usize = 8; // kinds of rows; more fill no line
        let list = self.elements.iter().take(MOST);
        let list: Vec<String> = list
            .map(|element| format!("{} {}", element.count, excerpt(element.name.as_bytes())))
            .collect();
        if list.is_empty() { "nothing else".to_owned() } else { list.join(", ") }
    }

    fn add(&mut self, element: &ElementDef, limits: &Limits) -> Result<(), Failure> {
        let shown = excerpt(element.name.as_bytes());
        let count = element.count as u64;
        let least =
            element.properties.iter().map(|property| self.least_bytes(&property.property_type));
        let least: u64 = least.sum();
        let room = self.payload.len() as u64 + u64::from(self.is_text); // the last needs no space behind it
        if count > 0 && (least == 0 || least.checked_mul(count).is_none_or(|bytes| bytes > room)) {
            let message =
                format!("it cannot hold the {count} rows of `{shown}` that its header claims");
            return Err(format_error(&message));
        }
        let slots = element.properties.iter();
        let slots: Vec<Slot> = slots
            .map(|property| slot(&element.name, &property.name, &property.property_type))
            .collect();
        match element.name.as_str() {
            "vertex" => {
                self.n_vertices =
                    u32::try_from(count).ok().filter(|n| *n < u32::MAX).ok_or_else(|| {
                        (ErrorKind::Limit, format!("{count} vertices; 2^32 are too many"))
                    })?;
                let scale = |number: Vertex| {
                    let mut properties = element.properties.iter();
                    let found =
                        properties.find(|property| Vertex::named(&property.name) == Some(number));
                    found.map_or(0.0, |property| color_scale(&property.property_type))
                };
                self.color_scale = scale(Vertex::COLOR[0]);
                self.alpha_scale = scale(Vertex::ALPHA);
                let has = |number: &Vertex| slots.contains(&Slot::Vertex(*number));
                if !Vertex::POSITION.iter().all(has) {
                    return Err(format_error("its vertices do not have `x`, `y` and `z`"));
                }
            }
            "face" if slots.contains(&Slot::Corners) => self.n_faces = count,
            _ => {}
        }
        if self.n_faces > limits.triangles {
            let max = limits.triangles;
            return Err((ErrorKind::Limit, format!("{count} faces, the limit is {max}")));
        }
        self.elements.push(Element { name: element.name.clone(), count, slots });
        Ok(())
    }

    /// Bytes that a value takes at least: in text a digit and a space.
    fn least_bytes(&self, kind: &PropertyType) -> u64 {
        if self.is_text {
            return 2;
        }
        match kind {
            PropertyType::Scalar(scalar) | PropertyType::List { count_type: scalar, .. } => {
                match scalar {
                    ScalarType::I8 | ScalarType::U8 => 1,
                    ScalarType::I16 | ScalarType::U16 => 2,
                    ScalarType::I32 | ScalarType::U32 | ScalarType::F32 => 4,
                    ScalarType::F64 => 8,
                }
            }
        }
    }
}

/// The largest number of a type of colour; 0 for floats, which are linear. Integers have the sRGB curve, alpha has none.
fn color_scale(kind: &PropertyType) -> f32 {
    match kind {
        PropertyType::Scalar(ScalarType::U16 | ScalarType::I16) => 65535.0,
        PropertyType::Scalar(
            ScalarType::U8 | ScalarType::I8 | ScalarType::U32 | ScalarType::I32,
        ) => 255.0,
        PropertyType::Scalar(ScalarType::F32 | ScalarType::F64) | PropertyType::List { .. } => 0.0,
    }
}

fn slot(element: &str, property: &str, kind: &PropertyType) -> Slot {
    match (element, kind, property) {
        ("vertex", PropertyType::Scalar(_), name) => {
            Vertex::named(name).map_or(Slot::Other, Slot::Vertex)
        }
        ("face", PropertyType::List { .. }, "vertex_indices" | "vertex_index") => Slot::Corners,
        ("face", PropertyType::List { .. }, "texcoord") => Slot::CornerUvs,
        _ => Slot::Other,
    }
}

/// The text of a header, its end included, and what comes after it.
fn split(bytes: &[u8]) -> Result<(String, &[u8]), Failure> {
    // Lines may end as on old Macs: then nothing else in the header does.
    let old = bytes.get(3) == Some(&b'\r') && bytes.get(4) != Some(&b'\n');
    let end_of_line = if old { b'\r' } else { b'\n' };
    let mut end = 0;
    for line in bytes.split_inclusive(|byte| *byte == end_of_line) {
        end += line.len();
        if end > MAX_HEADER {
            return Err(format_error(&format!("its header has no end within {MAX_HEADER} bytes")));
        }
        if line.trim_ascii() == b"end_header" && line.ends_with(&[end_of_line]) {
            let (header, payload) = bytes.split_at(end);
            let header = text(header).0;
            let header = if old { header.replace('\r', "\n") } else { header.into_owned() };
            return Ok((header, payload));
        }
    }
    Err(format_error("its header has no line `end_header`"))
}

/// The image that a comment of `MeshLab` names.
fn image_of(comment: &str) -> Option<String> {
    let name = comment.trim().strip_prefix("TextureFile")?.trim();
    (!name.is_empty()).then(|| excerpt(name.as_bytes()))
}

/// Text of a file may be in what `serde_ply` says.
fn format_error(message: &str) -> Failure {
    let message: String = message.chars().filter(|c| !c.is_control()).take(200).collect();
    (ErrorKind::Format, message)
}
