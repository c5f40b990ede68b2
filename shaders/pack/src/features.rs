//! Feature bits of the header: which kinds of things a pack holds.
//!
//! Turns the contents into 64 bits. The bits are derived, never chosen: writer and reader compute
//! them with the same function, so a pack cannot claim what it does not hold. A reader refuses
//! bits that it does not know.

use crate::abi::{
    CameraKind, FilterKind, LightKind, MaterialKind, NONE, Object, SamplerKind, SkyKind,
    TextureFormat, UNLIMITED_DEPTH, material_flag,
};
use crate::contents::Contents;

/// Declares the features that are no kind of a record: their bits and names.
macro_rules! features {
    ($($(#[$row:meta])* $name:ident = $bit:literal $title:literal,)*) => {
        $($(#[$row])* pub const $name: u64 = 1 << $bit;)*

        /// Bits and names.
        const OTHERS: &[(u32, &str)] = &[$(($bit, $title)),*];
    };
}

features! {
    /// Has triangles.
    TRIANGLES = 0 "triangles",
    /// Has spheres.
    SPHERES = 1 "spheres",
    /// Has a material with alpha clipping.
    ALPHA_CLIP = 15 "alpha clipping",
    /// The camera has a lens with a radius.
    LENS = 16 "lens",
    /// Has a material that depends on the tangent.
    TANGENTS = 17 "tangents",
    /// Has a material that depends on the object.
    OBJECTS = 18 "objects",
    /// And it has no inside: a thin sheet.
    SHEETS = 19 "see-through sheets",
    /// Paths may have any length.
    UNLIMITED = 22 "unlimited depth",
    /// Has a material with a normal map.
    NORMAL_MAPS = 21 "normal maps",
    /// Its nodes are wide.
    WIDE_NODES = 23 "wide nodes",
    /// Has an atmosphere, or things with an inside.
    MEDIA = 24 "media",
    /// Has a medium that scatters.
    SCATTERING = 25 "scattering media",
    /// Has fog.
    FOG = 26 "fog",
    /// Has a material behind which shadow rays go on.
    THROUGH = 27 "see-through materials",
    /// Has a principled material with a specular factor or colour.
    PRINCIPLED_SPECULAR = 28 "principled specular",
    /// Has a principled material with a coat.
    PRINCIPLED_COAT = 29 "principled coat",
    /// Has a principled material that lets light through.
    PRINCIPLED_TRANSMISSION = 30 "principled transmission",
    /// Has a principled material with sheen.
    PRINCIPLED_SHEEN = 51 "principled sheen",
    /// Has a principled material that is brushed.
    PRINCIPLED_ANISOTROPY = 20 "principled anisotropy",
    /// Something moves while the shutter is open. Ways of several pieces and cameras with keys have no bits of their
    /// own: sections say that they are there.
    MOTION = 31 "motion",
    /// The opening of the lens has corners.
    BLADES = 36 "aperture blades",
    /// Has a tree of lights.
    LIGHT_TREE = 54 "light tree",
    /// Has a tinted light.
    TINT = 55 "tinted lights",
    /// Has instances of meshes.
    INSTANCES = 56 "instances",
    /// Has more than one light.
    LIGHT_CHOICE = 57 "several lights",
    /// Has a light that shines into a cone.
    SPOT = 60 "spot lights",
    /// Has a material of partial coverage.
    ALPHA_BLEND = 62 "partial coverage",
    /// Has a light with a profile.
    PROFILE = 49 "light profiles",
    /// Has a material that the camera does not see.
    UNSEEN = 63 "lights that the camera does not see",
}

/// Has a sphere among its lights.
pub const LIGHT_SPHERE: u64 = LightKind::Sphere.feature();
/// Has a rectangle among its lights.
pub const LIGHT_RECTANGLE: u64 = LightKind::Rectangle.feature();
/// Has a triangle among its lights.
pub const LIGHT_TRIANGLE: u64 = LightKind::Triangle.feature();
/// Has a texture in 8-bit sRGB.
pub const TEXTURE_RGBA8_SRGB: u64 = TextureFormat::Rgba8Srgb.feature();
/// Has a texture in linear 8-bit.
pub const TEXTURE_RGBA8_LINEAR: u64 = TextureFormat::Rgba8Linear.feature();
/// Has a texture in half floats.
pub const TEXTURE_RGBA16_FLOAT: u64 = TextureFormat::Rgba16Float.feature();
/// Has a texture that is computed.
pub const TEXTURE_EXPRESSION: u64 = TextureFormat::Expression.feature();
/// Has a principled material.
pub const MATERIAL_PRINCIPLED: u64 = MaterialKind::Principled.feature();
/// Independent random numbers, instead of Sobol's.
pub const SAMPLER_PCG: u64 = SamplerKind::Pcg.feature();
/// Cameras that are not perspective.
pub const CAMERAS: u64 = CameraKind::Orthographic.feature() | CameraKind::Panoramic.feature();
/// Pixel filters other than a box of one pixel.
pub const FILTERS: u64 = FilterKind::Box.feature()
    | FilterKind::Tent.feature()
    | FilterKind::Gaussian.feature()
    | FilterKind::BlackmanHarris.feature();

/// The name of every bit, empty for those that are free. Two features with the same bit do not compile.
const TABLE: [&str; 64] = {
    let mut table = [""; 64];
    claim(&mut table, OTHERS);
    claim(&mut table, LightKind::FEATURES);
    claim(&mut table, SkyKind::FEATURES);
    claim(&mut table, TextureFormat::FEATURES);
    claim(&mut table, SamplerKind::FEATURES);
    claim(&mut table, CameraKind::FEATURES);
    claim(&mut table, FilterKind::FEATURES);
    claim(&mut table, MaterialKind::FEATURES);
    table
};

const fn claim(table: &mut [&'static str; 64], rows: &[(u32, &'static str)]) {
    let mut i = 0;
    while i < rows.len() {
        let (bit, name) = rows[i];
        assert!(table[bit as usize].is_empty(), "two features have the same bit");
        table[bit as usize] = name;
        i += 1;
    }
}

/// All bits that this reader knows.
pub const KNOWN: u64 = {
    let (mut known, mut bit) = (0, 0);
    while bit < TABLE.len() {
        if !TABLE[bit].is_empty() {
            known |= 1 << bit;
        }
        bit += 1;
    }
    known
};

/// Every bit with its name, in bit order.
pub const NAMES: [(u64, &str); KNOWN.count_ones() as usize] = {
    let mut names = [(0, ""); KNOWN.count_ones() as usize];
    let (mut n, mut bit) = (0, 0);
    while bit < TABLE.len() {
        if !TABLE[bit].is_empty() {
            names[n] = (1 << bit, TABLE[bit]);
            n += 1;
        }
        bit += 1;
    }
    names
};

/// Names of the bits that are set, in bit order; unknown bits are left out.
#[must_use]
pub fn names(features: u64) -> Vec<&'static str> {
    NAMES.iter().filter(|(bit, _)| features & bit != 0).map(|(_, name)| *name).collect()
}

/// The bits of these contents; unknown tags, which the checks refuse, set none.
pub(crate) fn of(contents: &Contents<'_>) -> u64 {
    let mut bits = 0;
    let mut set = |bit: u64, present: bool| bits |= if present { bit } else { 0 };
    set(TRIANGLES, !contents.triangles.is_empty());
    set(SPHERES, !contents.spheres.is_empty());
    set(LENS, contents.camera.lens_radius > 0.0);
    set(BLADES, contents.camera.lens_radius > 0.0 && contents.camera.blades > 0);
    set(CameraKind::from_tag(contents.camera.kind).map_or(0, CameraKind::feature), true);
    set(SamplerKind::from_tag(contents.render.sampler).map_or(0, SamplerKind::feature), true);
    set(FilterKind::from_tag(contents.render.filter).map_or(0, FilterKind::feature), true);
    set(UNLIMITED, contents.render.max_depth == UNLIMITED_DEPTH);
    set(LIGHT_CHOICE, contents.lights.len() > 1);
    set(LIGHT_TREE, !contents.light_nodes.is_empty());
    set(INSTANCES, !contents.instances.is_empty());
    set(WIDE_NODES, !contents.wide_nodes.is_empty());
    let moves = contents.objects.iter().any(Object::moves);
    set(MOTION, moves || !contents.camera_keys.is_empty());
    for light in contents.lights {
        set(LightKind::from_tag(light.kind).map_or(0, LightKind::feature), true);
        set(UNSEEN, light.is_unseen());
    }
    if let Some(sky) = contents.sky {
        set(SkyKind::from_tag(sky.kind).map_or(0, SkyKind::feature), true);
        set(UNSEEN, sky.unseen != 0);
    }
    for texture in contents.textures {
        set(TextureFormat::from_tag(texture.format).map_or(0, TextureFormat::feature), true);
    }
    for material in contents.materials {
        set(MaterialKind::from_tag(material.kind).map_or(0, MaterialKind::feature), true);
        set(TINT, material.flags & material_flag::EMIT_TINT != 0);
        set(SPOT, material.flags & material_flag::EMIT_SPOT != 0);
        set(UNSEEN, material.flags & material_flag::UNSEEN != 0);
        set(PROFILE, material.flags & material_flag::EMIT_PROFILE != 0);
        set(ALPHA_CLIP, material.flags & material_flag::ALPHA_CLIP != 0);
        set(ALPHA_BLEND, material.is_partial());
        set(TANGENTS, material.flags & material_flag::TANGENT != 0);
        set(OBJECTS, material.flags & material_flag::OBJECT != 0);
        set(NORMAL_MAPS, material.normal_texture != NONE);
        set(MEDIA, material.flags & material_flag::INTERIOR != 0);
        set(THROUGH, material.flags & material_flag::THROUGH != 0);
        set(SHEETS, material.is_sheet());
        set(PRINCIPLED_SPECULAR, material.has_specular());
        set(PRINCIPLED_COAT, material.has_coat());
        set(PRINCIPLED_TRANSMISSION, material.has_transmission());
        set(PRINCIPLED_SHEEN, material.has_sheen());
        set(PRINCIPLED_ANISOTROPY, material.is_brushed());
    }
    set(MEDIA, contents.render.air != NONE);
    set(FOG, contents.render.fog != NONE);
    for medium in contents.media {
        set(SCATTERING, medium.sigma_s.iter().any(|sigma| *sigma > 0.0));
    }
    bits
}
