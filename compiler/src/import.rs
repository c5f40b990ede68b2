//! Mesh files and images become plain arrays in memory: OBJ/MTL, PLY, STL, glTF/GLB, PNG, JPEG, WebP, KTX2, HDR, EXR.
//!
//! Every number that leaves this module has been checked: positions and UVs are finite, indices lie
//! inside their arrays, triangles have an area, images have the length that their size says. Bad
//! input is an [`ImportError`] that names file and line (text), row (PLY), triangle (STL) or accessor (glTF); odd but usable
//! input is counted in the [`ImportReport`]. Limits are checked before memory is taken.
//!
//! It does not know the scene, the pack or how materials are packed.

mod budget;
mod build;
mod check;
mod colors;
mod error;
mod facts;
mod file;
mod foreign;
mod frame;
mod geometry;
mod gltf;
mod guard;
mod image;
mod image_set;
mod lines;
mod material;
mod mesh;
mod normals;
mod obj;
mod ply;
mod polygon;
mod report;
mod stl;
mod studio;
mod topology;

pub use self::budget::Budget;
pub use self::error::{ErrorKind, ImportError};
pub use self::facts::{EnvironmentFacts, ImageFacts, MeshFacts, PartFacts};
pub use self::file::Limits;
pub use self::gltf::{load_gltf, read_gltf};
pub use self::image::{Environment, Image, Pixels, decode_image, load_environment, load_image};
pub use self::material::{ImportedImage, ImportedMaterial, MapUse};
pub use self::mesh::{Attribute, MeshFile, NO_CORNER, Part};
pub use self::obj::{load_obj, read_obj};
pub use self::ply::{load_ply, read_ply};
pub use self::report::{FileRead, Finding, ImportReport, Warning};
pub use self::stl::{load_stl, read_stl};
pub use self::studio::{FileCamera, FileLight, FileView, LightKind, Studio};
pub use self::topology::{Topology, topology};
