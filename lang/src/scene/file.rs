//! Files that a scene uses: meshes and images.

use super::common::Name;
use crate::schema::words;
use crate::source::Span;
use crate::texture::Placement;

/// A mesh file.
#[derive(Clone, Debug, PartialEq)]
pub struct Asset {
    /// Declared name.
    pub name: Name,
    /// Path relative to the directory of the `.rts` file that declares it, as written.
    pub path: String,
    /// The path literal.
    pub path_span: Span,
    /// Which importer reads it.
    pub format: AssetFormat,
}

/// What a mesh file needs to be told.
#[derive(Clone, Debug, PartialEq)]
pub enum AssetFormat {
    /// Wavefront OBJ.
    Obj(FileFrame),
    /// Polygon file format (Stanford), text or binary.
    Ply(FileFrame),
    /// Stereolithography, text or binary.
    Stl(FileFrame),
    /// glTF 2.0, text or binary: metres and +Y up by its specification.
    Gltf(GltfChoice),
}

/// What of a glTF file is wanted that has several.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct GltfChoice {
    /// Seconds from the beginning of animations; without one everything stands as it is stored.
    pub time: Option<f64>,
    /// The animation that is played; without a name all of them, which must not move the same.
    pub animation: Option<String>,
    /// The variant of materials.
    pub variant: Option<String>,
}

/// What formats do not say that have neither unit nor directions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FileFrame {
    /// Metres per unit of the file.
    pub metres_per_unit: f64,
    /// Up axis of the file.
    pub up: Axis,
}

/// A signed coordinate axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axis {
    /// +x.
    PlusX,
    /// −x.
    MinusX,
    /// +y.
    PlusY,
    /// −y.
    MinusY,
    /// +z.
    PlusZ,
    /// −z.
    MinusZ,
}

/// An image file used by materials.
#[derive(Clone, Debug, PartialEq)]
pub struct Texture {
    /// Declared name.
    pub name: Name,
    /// Path relative to the declaring `.rts` file, as written.
    pub path: String,
    /// The path literal.
    pub path_span: Span,
    /// How its numbers are to be read.
    pub space: ColorSpace,
    /// Outside 0..1 along u and v.
    pub wrap: [Wrap; 2],
    /// Where the image lies.
    pub placement: Placement,
    /// It is an image of a mesh file, as the compiler adds them; a scene declares none.
    pub of_mesh: Option<MeshImage>,
}

/// An image of a mesh file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MeshImage {
    /// Index into `Scene::assets`.
    pub asset: usize,
    /// Index into the images of the file.
    pub image: usize,
}

/// A material or a camera of a mesh file, of which a declaration takes all that it does not say itself.
#[derive(Clone, Debug, PartialEq)]
pub struct FileBase {
    /// Index into `Scene::assets`.
    pub asset: usize,
    /// Its name in the file, and where the declaration says it.
    pub name: Name,
    /// Fields that the declaration says, each with its place.
    pub said: Vec<(&'static str, Span)>,
}

impl FileBase {
    /// Where the declaration says this field, if it does.
    #[must_use]
    pub fn says(&self, field: &str) -> Option<Span> {
        self.said.iter().find(|(known, _)| *known == field).map(|(_, span)| *span)
    }
}

words! {
    /// Encoding of an image's colour channels; alpha is always linear.
    pub enum ColorSpace {
        /// sRGB transfer curve.
        Srgb = "srgb" "colours with the sRGB curve: photographs and painted textures",
        /// Linear colour.
        Linear = "linear" "colours without a curve: HDR images",
        /// Linear numbers that are not colours: roughness, normals.
        Data = "data" "numbers that are not colours: roughness, masks",
    }
}

words! {
    /// What lies outside 0..1 of a texture.
    pub enum Wrap {
        /// The image repeats.
        Repeat = "repeat" "the image repeats",
        /// The edge texel goes on.
        Clamp = "clamp" "the edge continues",
        /// The image repeats mirrored.
        Mirror = "mirror" "the image repeats mirrored",
    }
}
