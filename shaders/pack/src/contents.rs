//! A pack's sections as typed slices.
//!
//! Turns byte slices, found by section name, into slices of records. Writer and reader both look
//! through this view, so both check and derive the same things. It judges nothing.

use crate::abi::{
    Camera, CameraKey, Instance, Light, LightLink, LightNode, Material, Medium, MotionPiece, Node,
    Object, RenderSettings, Sky, Sphere, Texture, TriShade, Triangle, VertexColors, WideNode,
};
use crate::error::PackError;
use crate::kind::{Kind, PackRecord};

/// Typed view of the sections; absent sections are empty.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Contents<'a> {
    pub(crate) render: &'a RenderSettings,
    pub(crate) camera: &'a Camera,
    pub(crate) sky: Option<&'a Sky>,
    pub(crate) nodes: &'a [Node],
    pub(crate) wide_nodes: &'a [WideNode],
    pub(crate) triangles: &'a [Triangle],
    pub(crate) shades: &'a [TriShade],
    pub(crate) vertex_colors: &'a [VertexColors],
    pub(crate) spheres: &'a [Sphere],
    pub(crate) materials: &'a [Material],
    pub(crate) objects: &'a [Object],
    pub(crate) instances: &'a [Instance],
    pub(crate) media: &'a [Medium],
    pub(crate) lights: &'a [Light],
    pub(crate) light_nodes: &'a [LightNode],
    pub(crate) textures: &'a [Texture],
    pub(crate) texels: &'a [[u32; 4]],
    pub(crate) srgb: &'a [f32],
    pub(crate) sky_table: &'a [f32],
    pub(crate) albedo: &'a [f32],
    pub(crate) links: &'a [LightLink],
    pub(crate) motion: &'a [MotionPiece],
    pub(crate) camera_keys: &'a [CameraKey],
    pub(crate) kernel: &'a [u8],
}

impl<'a> Contents<'a> {
    /// The view. `find` returns the bytes of a section, whole elements, aligned to 4 bytes.
    pub(crate) fn new(find: impl Fn(Kind) -> Option<&'a [u8]>) -> Result<Self, PackError> {
        fn records<'a, R: PackRecord>(find: &impl Fn(Kind) -> Option<&'a [u8]>) -> &'a [R] {
            find(R::KIND).map_or(&[], bytemuck::cast_slice)
        }
        let first = PackError::missing;
        Ok(Self {
            render: records(&find).first().ok_or_else(|| first(Kind::RENDER))?,
            camera: records(&find).first().ok_or_else(|| first(Kind::CAMERA))?,
            sky: records(&find).first(),
            nodes: records(&find),
            wide_nodes: records(&find),
            triangles: records(&find),
            shades: records(&find),
            vertex_colors: records(&find),
            spheres: records(&find),
            materials: records(&find),
            objects: records(&find),
            instances: records(&find),
            media: records(&find),
            lights: records(&find),
            light_nodes: records(&find),
            textures: records(&find),
            texels: find(Kind::TEXEL).map_or(&[], bytemuck::cast_slice),
            srgb: find(Kind::SRGBLUT).map_or(&[], bytemuck::cast_slice),
            sky_table: find(Kind::SKYTABLE).map_or(&[], bytemuck::cast_slice),
            albedo: find(Kind::ALBEDO).map_or(&[], bytemuck::cast_slice),
            links: records(&find),
            motion: records(&find),
            camera_keys: records(&find),
            kernel: find(Kind::KERNEL).ok_or_else(|| first(Kind::KERNEL))?,
        })
    }

    /// Elements of a section, as index relations count them.
    #[inline]
    pub(crate) fn count(&self, kind: Kind) -> usize {
        match kind {
            Kind::NODE => self.nodes.len(),
            Kind::WIDENODE => self.wide_nodes.len(),
            Kind::TRIANGLE => self.triangles.len(),
            Kind::TRISHADE => self.shades.len(),
            Kind::SPHERE => self.spheres.len(),
            Kind::MATERIAL => self.materials.len(),
            Kind::OBJECT => self.objects.len(),
            Kind::INSTANCE => self.instances.len(),
            Kind::MEDIUM => self.media.len(),
            Kind::LIGHT => self.lights.len(),
            Kind::TEXTURE => self.textures.len(),
            Kind::TEXEL => self.texels.len(),
            Kind::MOTION => self.motion.len(),
            _ => 0,
        }
    }
}
