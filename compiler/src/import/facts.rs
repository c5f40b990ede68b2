//! What a scene asks of a mesh file or an image before it needs triangles or texels.
//!
//! Small, and kept from one compilation to the next, so that a file is read again only when it changed, or when
//! something new is made of its triangles or texels. Contents are named by what was read, not by the file: another
//! material in a file is no other mesh.

use lang::scene::Parts;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::image::{Environment, Image, Pixels};
use super::material::ImportedMaterial;
use super::mesh::{self, Attribute, MeshFile, Part};
use super::report::ImportReport;
use super::studio::Studio;

/// Of a mesh file.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct MeshFacts {
    /// Of its parts, in the same order.
    pub parts: Vec<PartFacts>,
    /// Its materials.
    pub materials: Vec<ImportedMaterial>,
    /// Of its images, in the same order.
    pub images: Vec<ImageFacts>,
    /// Its lights and cameras.
    pub studio: Studio,
    /// What was noticed when it was read.
    pub report: ImportReport,
}

/// Of a part.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct PartFacts {
    /// See [`Part::name`].
    pub name: String,
    /// See [`Part::aliases`].
    pub aliases: Vec<String>,
    /// See [`Part::material`].
    pub material: Option<u32>,
    /// Whether it has texture coordinates.
    pub has_uvs: bool,
    /// Whether its vertices have colours.
    pub has_colors: bool,
    /// How many triangles it has.
    pub n_triangles: usize,
    /// Lowest and highest coordinates of its vertices, metres; the wrong way round where it has none.
    pub bounds: [[f32; 3]; 2],
    /// BLAKE3 of its geometry.
    pub content: [u8; 32],
}

/// Of an image.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ImageFacts {
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// See [`Image::has_alpha`].
    pub has_alpha: bool,
    /// See [`Image::is_radiance`].
    pub is_radiance: bool,
    /// BLAKE3 of what it shows, whatever its file looks like.
    pub content: [u8; 32],
}

/// Of an image of the sky.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct EnvironmentFacts {
    /// Of its texels.
    pub image: ImageFacts,
    /// See [`Environment::scale`].
    pub scale: f64,
}

impl MeshFacts {
    /// Of a file.
    #[must_use]
    pub fn of(file: &MeshFile) -> Self {
        Self {
            parts: file.parts.par_iter().map(PartFacts::of).collect(),
            materials: file.materials.clone(),
            images: file.images.par_iter().map(|image| ImageFacts::of(&image.image)).collect(),
            studio: file.studio.clone(),
            report: file.report.clone(),
        }
    }

    /// As [`MeshFile::find_parts`].
    #[must_use]
    pub fn find_parts(&self, name: &str) -> Vec<usize> {
        mesh::find(&self.parts, |part| (&part.name, &part.aliases), name)
    }

    /// The parts that a shape shows.
    #[must_use]
    pub fn chosen(&self, parts: &Parts) -> Vec<usize> {
        match parts {
            Parts::All => (0..self.parts.len()).collect(),
            Parts::Named(name) => self.find_parts(name),
            Parts::Listed(list) => list.clone(),
        }
    }

    /// As [`MeshFile::part_names`].
    #[must_use]
    pub fn part_names(&self) -> Vec<&str> {
        mesh::names(self.parts.iter().map(|part| (&part.name, &part.aliases)))
    }
}

impl PartFacts {
    fn of(part: &Part) -> Self {
        let mut bounds = [[f32::INFINITY; 3], [f32::NEG_INFINITY; 3]];
        for p in &part.positions {
            for k in 0..3 {
                (bounds[0][k], bounds[1][k]) = (bounds[0][k].min(p[k]), bounds[1][k].max(p[k]));
            }
        }
        Self {
            name: part.name.clone(),
            aliases: part.aliases.clone(),
            material: part.material,
            has_uvs: part.uvs != Attribute::Absent,
            has_colors: !part.colors.is_empty(),
            n_triangles: part.triangles.len(),
            bounds,
            content: geometry(part),
        }
    }
}

fn geometry(part: &Part) -> [u8; 32] {
    let mut hasher = blake3::Hasher::new();
    let mut list = |bytes: &[u8]| {
        hasher.update(&(bytes.len() as u64).to_le_bytes()).update(bytes);
    };
    list(bytemuck::cast_slice(&part.positions));
    list(bytemuck::cast_slice(&part.triangles));
    attribute(&part.normals, &mut list);
    attribute(&part.uvs, &mut list);
    if !part.colors.is_empty() {
        list(bytemuck::cast_slice(&part.colors));
    }
    *hasher.finalize().as_bytes()
}

fn attribute<T: bytemuck::NoUninit>(attribute: &Attribute<T>, list: &mut impl FnMut(&[u8])) {
    match attribute {
        Attribute::Absent => list(&[0]),
        Attribute::PerVertex(values) => {
            list(&[1]);
            list(bytemuck::cast_slice(values));
        }
        Attribute::Indexed { values, corners } => {
            list(&[2]);
            list(bytemuck::cast_slice(values));
            list(bytemuck::cast_slice(corners));
        }
    }
}

impl ImageFacts {
    /// Of an image.
    #[must_use]
    pub fn of(image: &Image) -> Self {
        let Image { width, height, has_alpha, is_radiance, .. } = *image;
        let mut hasher = blake3::Hasher::new();
        hasher.update(&width.to_le_bytes());
        hasher.update(match &image.data {
            Pixels::Rgba8(bytes) => bytes,
            Pixels::Rgba16F(bits) => bytemuck::cast_slice(bits),
        });
        Self { width, height, has_alpha, is_radiance, content: *hasher.finalize().as_bytes() }
    }
}

impl EnvironmentFacts {
    /// Of an image of the sky.
    #[must_use]
    pub fn of(environment: &Environment) -> Self {
        Self { image: ImageFacts::of(&environment.image), scale: environment.scale }
    }
}
