//! Triangles by part, object frame of the file: metres, +Y up, right-handed.

use super::error::ImportError;
use super::file::Limits;
use super::material::{ImportedImage, ImportedMaterial};
use super::report::ImportReport;
use super::studio::Studio;
use std::collections::BTreeSet;

/// A mesh file in memory.
#[derive(Clone, Debug)]
pub struct MeshFile {
    /// What it is made of; never empty. Several parts may share a name (one per material).
    pub parts: Vec<Part>,
    /// Materials that parts refer to.
    pub materials: Vec<ImportedMaterial>,
    /// Images that materials refer to.
    pub images: Vec<ImportedImage>,
    /// Lights and cameras, which are not used.
    pub studio: Studio,
    /// What was noticed on the way.
    pub report: ImportReport,
}

/// Corner index of `Attribute::Indexed` that stands for "none here"; then all three corners have it.
pub const NO_CORNER: u32 = u32::MAX;

/// Values at the corners of triangles.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Attribute<T> {
    /// The part has none. For normals: flat, the geometric normal is the shading normal.
    #[default]
    Absent,
    /// One a vertex: `Part::triangles` indexes this, too.
    PerVertex(Vec<T>),
    /// Own indices, one triple a triangle; each `< values.len()`, or all three `NO_CORNER`.
    Indexed {
        /// The values.
        values: Vec<T>,
        /// As long as `Part::triangles`.
        corners: Vec<[u32; 3]>,
    },
}

/// One piece of geometry with one material.
#[derive(Clone, Debug, Default)]
pub struct Part {
    /// OBJ: `object/group`, or what there is of it; glTF: names of the nodes from the root, joined
    /// by `/`. Empty for an OBJ without names.
    pub name: String,
    /// Other names that select this part: OBJ: the object and each group; glTF: every node on the
    /// way and the mesh. Sorted, without repeats.
    pub aliases: Vec<String>,
    /// Index into `MeshFile::materials`.
    pub material: Option<u32>,
    /// Metres; finite.
    pub positions: Vec<[f32; 3]>,
    /// Unit vectors.
    pub normals: Attribute<[f32; 3]>,
    /// v points up: v = 1 is the first row of an image. Finite.
    pub uvs: Attribute<[f32; 2]>,
    /// Counter-clockwise seen from outside, each index `< positions.len()`.
    pub triangles: Vec<[u32; 3]>,
    /// Linear colours of vertices and their alpha, 0 ..= 1; none, or as many as positions.
    pub colors: Vec<[f32; 4]>,
}

impl<T: Copy> Attribute<T> {
    /// The values at the corners of triangle `tri_idx`, whose vertices are `vertices`.
    #[must_use]
    pub fn at(&self, tri_idx: usize, vertices: [u32; 3]) -> Option<[T; 3]> {
        let (values, corners) = match self {
            Self::Absent => return None,
            Self::PerVertex(values) => (values, vertices),
            Self::Indexed { values, corners } => (values, *corners.get(tri_idx)?),
        };
        let value = |corner: u32| values.get(corner as usize).copied();
        Some([value(corners[0])?, value(corners[1])?, value(corners[2])?])
    }
}

impl Part {
    /// Corners of triangle `tri_idx`, metres.
    #[must_use]
    pub fn corners(&self, tri_idx: usize) -> [[f32; 3]; 3] {
        self.triangles[tri_idx].map(|vertex| self.positions[vertex as usize])
    }

    /// Shading normals of triangle `tri_idx`; `None`: flat.
    #[must_use]
    pub fn corner_normals(&self, tri_idx: usize) -> Option<[[f32; 3]; 3]> {
        self.normals.at(tri_idx, self.triangles[tri_idx])
    }

    /// Colours and alpha at the corners of triangle `tri_idx`; 1 where the part has none.
    #[must_use]
    pub fn corner_colors(&self, tri_idx: usize) -> [[f32; 4]; 3] {
        let color = |vertex: u32| self.colors.get(vertex as usize).copied().unwrap_or([1.0; 4]);
        self.triangles[tri_idx].map(color)
    }

    /// UVs of triangle `tri_idx`, if it has any.
    #[must_use]
    pub fn corner_uvs(&self, tri_idx: usize) -> Option<[[f32; 2]; 3]> {
        self.uvs.at(tri_idx, self.triangles[tri_idx])
    }
}

impl MeshFile {
    /// Indices of the parts that `name` selects, ascending; empty when there is none.
    ///
    /// Exact names go first. As names in a scene are identifiers, `left_wheel` also finds
    /// `Left wheel` and `left-wheel` where no exact name fits: case and everything that is not a
    /// letter or digit is ignored.
    #[must_use]
    pub fn find_parts(&self, name: &str) -> Vec<usize> {
        find(&self.parts, |part| (&part.name, &part.aliases), name)
    }

    /// Every name that selects something, sorted, for suggestions.
    #[must_use]
    pub fn part_names(&self) -> Vec<&str> {
        names(self.parts.iter().map(|part| (&part.name, &part.aliases)))
    }
}

/// Name and aliases of a part.
type Names<'a> = (&'a String, &'a Vec<String>);

/// See [`MeshFile::find_parts`].
pub(super) fn find<T>(parts: &[T], names: impl Fn(&T) -> Names<'_>, name: &str) -> Vec<usize> {
    let select = |same: &dyn Fn(&str) -> bool| -> Vec<usize> {
        let fits = |part: &usize| {
            let (own, aliases) = names(&parts[*part]);
            same(own) || aliases.iter().any(|alias| same(alias))
        };
        (0..parts.len()).filter(fits).collect()
    };
    let exact = select(&|own| own == name);
    if exact.is_empty() { select(&|own| letters(own).eq(letters(name))) } else { exact }
}

/// See [`MeshFile::part_names`].
pub(super) fn names<'a>(parts: impl Iterator<Item = Names<'a>>) -> Vec<&'a str> {
    let names = parts.flat_map(|(name, aliases)| {
        std::iter::once(name.as_str()).chain(aliases.iter().map(String::as_str))
    });
    names.filter(|name| !name.is_empty()).collect::<BTreeSet<_>>().into_iter().collect()
}

/// Letters and digits of a name in lower case.
fn letters(name: &str) -> impl Iterator<Item = char> {
    name.chars().filter(|c| c.is_alphanumeric()).flat_map(char::to_lowercase)
}

/// Takes what the parts of a mesh need until the pack is written: here, and once more in the pack.
pub(super) fn keep(parts: &[Part], place: &str, limits: &Limits) -> Result<(), ImportError> {
    fn attribute<T>(attribute: &Attribute<T>) -> usize {
        match attribute {
            Attribute::Absent => 0,
            Attribute::PerVertex(values) => size_of_val(values.as_slice()),
            Attribute::Indexed { values, corners } => {
                size_of_val(values.as_slice()) + size_of_val(corners.as_slice())
            }
        }
    }
    let part = |part: &Part| {
        size_of_val(part.positions.as_slice())
            + size_of_val(part.triangles.as_slice())
            + attribute(&part.normals)
            + attribute(&part.uvs)
            + size_of_val(part.colors.as_slice())
    };
    let bytes: usize = parts.iter().map(part).sum();
    limits.memory.take(2 * bytes as u64, place)?.keep();
    Ok(())
}
