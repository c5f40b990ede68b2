//! The checked scene: plain data in SI units, ready to be lowered.
//!
//! Everything a `.rts` text says has been resolved when a `Scene` exists: names are indices, `like`
//! chains and indexed instances are expanded, expressions are numbers, units are metres, radians,
//! seconds and kelvins, colours are linear Rec. 709. It does not know files, meshes or the pack:
//! whether an asset can be read and has the named part is the compiler's business, and each item
//! carries the `Span` that such a later complaint must point at.
//!
//! Lists are sorted by name, so that the order of declarations in the text does not matter.

mod common;
mod file;
mod instance;
mod lens;
mod light;
mod links;
mod motion;
mod view;

pub use common::{Name, Rgb};
pub use file::{
    Asset, AssetFormat, Axis, ColorSpace, FileBase, FileFrame, GltfChoice, MeshImage, Texture, Wrap,
};
pub use instance::Instance;
pub(crate) use lens::across_other;
pub use lens::{FieldOfView, Lens, LensSpec, Opening};
pub use light::{Beam, Directional, Light, Profile, Tint};
pub use links::LightLinks;
pub use motion::{CameraKey, Keyed, Motion, MotionKey, at_time, bends};
pub use view::{
    Camera, CameraOfFile, Film, Filter, Fit, Layer, MIN_UP_SINE, Projection, Render, Sampler, Side,
    ToneMap,
};

pub use crate::material::{
    Color, Inside, Material, MaterialModel, MaterialOfFile, NormalMap, Pattern, Principled, Scalar,
    TextureProjection,
};
pub use crate::medium::{Medium, MediumModel};
pub use crate::shape::{EditOf, MeshEdit, Parts, Shape, fourth};
pub use crate::sky::{Sky, SkyModel, SunSky};
pub use crate::texture::{Placement, TextureExpression, TexturePattern};

/// A whole checked scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// Mesh files, sorted by name.
    pub assets: Vec<Asset>,
    /// Images, sorted by name.
    pub textures: Vec<Texture>,
    /// What materials compute from textures, in their order.
    pub expressions: Vec<TextureExpression<usize>>,
    /// Materials, sorted by name.
    pub materials: Vec<Material>,
    /// Media of materials and of the atmosphere, sorted by name.
    pub media: Vec<Medium>,
    /// Things in the world, fully expanded (`beams[0]`, `beams[1]`, …), sorted by name, index order.
    pub instances: Vec<Instance>,
    /// Sphere lights declared with `light`, sorted by name.
    pub lights: Vec<Light>,
    /// Lights at infinity, sorted by name.
    pub directional: Vec<Directional>,
    /// What is seen where nothing is; `None` is black.
    pub sky: Option<Sky>,
    /// The camera that `render` names.
    pub camera: Camera,
    /// The film that `render` names.
    pub film: Film,
    /// The one `render` declaration.
    pub render: Render,
}

impl Scene {
    /// What lights light that do not light everything, in the order of instances, lights and directional lights.
    pub fn light_links(&self) -> impl Iterator<Item = &LightLinks> {
        let things = self.instances.iter().map(|instance| &instance.links);
        let lights = self.lights.iter().map(|light| &light.links);
        let far = self.directional.iter().map(|light| &light.links);
        things.chain(lights).chain(far).filter_map(Option::as_ref)
    }
}
