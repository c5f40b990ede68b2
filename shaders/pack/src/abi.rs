//! The records that `rtc` writes and the kernel reads, field by field.
//!
//! Turns: nothing; it is the shared vocabulary of compiler, shaders and runtime. Every record is a
//! multiple of 16 bytes, little-endian, and reaches the kernel as `array<vec4<u32>>` words which
//! generated loaders decode. `shaders` writes the WGSL struct of the same name from the field table, and
//! `shaders::layout` proves that it has these fields at these offsets.
//!
//! It does not know naga, wgpu, files or the language.

mod albedo;
mod aov;
mod camera;
mod field;
mod film;
mod frame;
mod geometry;
mod instance;
mod light;
mod light_node;
mod link;
mod material;
mod medium;
mod motion;
mod object;
mod render;
mod sky;
mod tag;
mod texture;
mod texture_op;
mod vertex_colors;

pub use albedo::{AlbedoTable, albedo_tables, albedo_words};
pub use aov::AovSample;
pub use camera::{Camera, CameraKind};
pub use field::{AbiRecord, Field, FieldType, Record};
pub use film::FilmPixel;
pub use frame::Frame;
pub use geometry::{
    CHILD_INNER, CHILD_INSTANCE, CHILD_OUT, CHILD_SPHERES, ChildRef, EMPTY_BOX, MAX_DEPTH,
    MAX_LEAF, MOVES, Node, Sphere, TRI_SMOOTH, TriShade, Triangle, WIDTH, WideNode,
};
pub use instance::{Instance, OBJECT_OF_INSTANCE};
pub use light::{Light, LightKind, LightSurface};
pub use light_node::{LIGHT_LEAF, LightNode, MAX_LIGHT_DEPTH};
pub use link::LightLink;
pub use material::{Lobes, Material, MaterialKind, Number, Traits, material_flag};
pub use medium::Medium;
pub use motion::{CameraKey, MotionPiece};
pub use object::Object;
pub use render::{
    FilterKind, RenderSettings, SamplerKind, ToneMap, UNLIMITED_DEPTH, f64_bits, f64_from_bits,
};
pub use sky::{Sky, SkyKind, sky_table_values};
pub use texture::{Texture, TextureFormat, Wrap};
pub use texture_op::{MAX_TEXTURE_OPS, MAX_TEXTURE_STACK, TextureOp, TextureOpKind};
pub use vertex_colors::VertexColors;

/// "No such element" wherever an index is optional: texture ids, light ids.
pub const NONE: u32 = u32::MAX;

/// Samples in one canonical batch: `f32` sums cover sample indices `[16k, 16k + 16)`, and batches
/// are added in `f64` in ascending order. Fixed, so that tile size, thread count and device do not
/// change the image.
pub const BATCH: u32 = 16;

/// Most entries that a traversal stack may need. The compiler splits at the median below
/// [`MAX_DEPTH`]: 47 for a mesh's tree, 48 for the tree of the scene above it, and one for the way out of
/// an instance.
pub const MAX_STACK: u32 = 96;

/// Every record that the kernel knows, in the order in which tables are printed.
#[must_use]
pub fn records() -> Vec<Record> {
    vec![
        Record::of::<Frame>(),
        Record::of::<Camera>(),
        Record::of::<Sky>(),
        Record::of::<Node>(),
        Record::of::<WideNode>(),
        Record::of::<Triangle>(),
        Record::of::<TriShade>(),
        Record::of::<VertexColors>(),
        Record::of::<Sphere>(),
        Record::of::<Object>(),
        Record::of::<LightLink>(),
        Record::of::<MotionPiece>(),
        Record::of::<CameraKey>(),
        Record::of::<Instance>(),
        Record::of::<Material>(),
        Record::of::<Medium>(),
        Record::of::<Light>(),
        Record::of::<LightNode>(),
        Record::of::<Texture>(),
        Record::of::<TextureOp>(),
        Record::of::<FilmPixel>(),
        Record::of::<AovSample>(),
    ]
}
