//! Feature bits of the header: which kinds of things a pack holds.
//!
//! Turns the contents into 64 bits. The bits are derived, never chosen: writer and reader compute
//! them with the same function, so a pack cannot claim what it does not hold. A reader refuses
//! bits that it does not know.

use crate::abi::{
    LightKind, MaterialKind, NONE, Object, SamplerKind, SkyKind, TextureFormat, material_flag,
};
use crate::contents::Contents;

/// Has triangles.
pub const TRIANGLES: u64 = 1 << 0;
/// Has spheres.
pub const SPHERES: u64 = 1 << 1;
/// Has a sphere among its lights.
pub const LIGHT_SPHERE: u64 = 1 << 2;
/// Has a rectangle among its lights.
pub const LIGHT_RECTANGLE: u64 = 1 << 3;
/// Has a triangle among its lights.
pub const LIGHT_TRIANGLE: u64 = 1 << 4;
/// Has a constant sky.
pub const SKY_CONSTANT: u64 = 1 << 5;
/// Has a gradient sky.
pub const SKY_GRADIENT: u64 = 1 << 6;
/// Has a texture in 8-bit sRGB.
pub const TEXTURE_RGBA8_SRGB: u64 = 1 << 7;
/// Has a texture in linear 8-bit.
pub const TEXTURE_RGBA8_LINEAR: u64 = 1 << 8;
/// Has a texture in half floats.
pub const TEXTURE_RGBA16_FLOAT: u64 = 1 << 9;
/// Has a diffuse material.
pub const MATERIAL_DIFFUSE: u64 = material(MaterialKind::Diffuse);
/// Has a metal material.
pub const MATERIAL_METAL: u64 = material(MaterialKind::Metal);
/// Has a dielectric material.
pub const MATERIAL_DIELECTRIC: u64 = material(MaterialKind::Dielectric);
/// Has an emissive material.
pub const MATERIAL_EMISSIVE: u64 = material(MaterialKind::Emissive);
/// Has a principled material.
pub const MATERIAL_PRINCIPLED: u64 = material(MaterialKind::Principled);
/// Has a petal material.
pub const MATERIAL_PETAL: u64 = 1 << (32 + 11);
/// Has a leaf material.
pub const MATERIAL_LEAF: u64 = 1 << (32 + 12);
/// Has a material with alpha clipping.
pub const ALPHA_CLIP: u64 = 1 << 15;
/// The camera has a lens with a radius.
pub const LENS: u64 = 1 << 16;
/// Has a material that depends on the tangent.
pub const TANGENTS: u64 = 1 << 17;
/// Has a material that depends on the object.
pub const OBJECTS: u64 = 1 << 18;
/// Has a material with a normal map.
pub const NORMAL_MAPS: u64 = 1 << 21;
/// Its nodes are wide.
pub const WIDE_NODES: u64 = 1 << 23;
/// Something moves while the shutter is open.
pub const MOTION: u64 = 1 << 31;
/// Has a principled material with a specular factor or colour.
pub const PRINCIPLED_SPECULAR: u64 = 1 << 28;
/// Has a principled material with a coat.
pub const PRINCIPLED_COAT: u64 = 1 << 29;
/// Has a principled material that lets light through.
pub const PRINCIPLED_TRANSMISSION: u64 = 1 << 30;

/// Independent random numbers, instead of Sobol's.
pub const SAMPLER_PCG: u64 = 1 << 48;
/// Has an image sky.
pub const SKY_IMAGE: u64 = 1 << 52;
/// Has the sky among its lights.
pub const LIGHT_SKY: u64 = 1 << 53;
/// Has a tree of lights.
pub const LIGHT_TREE: u64 = 1 << 54;
/// Has more than one light.
pub const LIGHT_CHOICE: u64 = 1 << 57;
/// Has instances of meshes.
pub const INSTANCES: u64 = 1 << 56;
/// Has a tinted light.
pub const TINT: u64 = 1 << 55;

/// Has a stone material.
pub const MATERIAL_STONE: u64 = material(MaterialKind::Stone);
/// Has a wood material.
pub const MATERIAL_WOOD: u64 = material(MaterialKind::Wood);
/// Has a fabric material.
pub const MATERIAL_FABRIC: u64 = material(MaterialKind::Fabric);

/// The bit of a kind of material: its tag from bit 10 for the first five, from bit 32 for the others.
#[must_use]
pub const fn material(kind: MaterialKind) -> u64 {
    let tag = kind as u32;
    if tag < 5 { 1 << (10 + tag) } else { 1 << (32 + tag) }
}

/// Has a conductor material.
pub const MATERIAL_CONDUCTOR: u64 = 1 << 37;
/// Has a rough dielectric material.
pub const MATERIAL_ROUGH_DIELECTRIC: u64 = 1 << 38;
/// Has a clearcoat material.
pub const MATERIAL_CLEARCOAT: u64 = 1 << 39;

/// Has an atmosphere, or things with an inside.
pub const MEDIA: u64 = 1 << 24;
/// Has a medium that scatters.
pub const SCATTERING: u64 = 1 << 25;
/// Has fog.
pub const FOG: u64 = 1 << 26;
/// Has a material behind which shadow rays go on.
pub const THROUGH: u64 = 1 << 27;
/// And it has no inside: a thin sheet.
pub const SHEETS: u64 = 1 << 19;

/// Has a water material.
pub const MATERIAL_WATER: u64 = 1 << 45;

/// Every bit with its name, in bit order.
pub const NAMES: [(u64, &str); 46] = [
    (TRIANGLES, "triangles"),
    (SPHERES, "spheres"),
    (LIGHT_SPHERE, "sphere lights"),
    (LIGHT_RECTANGLE, "rectangle lights"),
    (LIGHT_TRIANGLE, "triangle lights"),
    (SKY_CONSTANT, "constant sky"),
    (SKY_GRADIENT, "gradient sky"),
    (TEXTURE_RGBA8_SRGB, "sRGB textures"),
    (TEXTURE_RGBA8_LINEAR, "linear 8-bit textures"),
    (TEXTURE_RGBA16_FLOAT, "half-float textures"),
    (MATERIAL_DIFFUSE, "diffuse"),
    (MATERIAL_METAL, "metal"),
    (MATERIAL_DIELECTRIC, "dielectric"),
    (MATERIAL_EMISSIVE, "emissive"),
    (MATERIAL_PRINCIPLED, "principled"),
    (ALPHA_CLIP, "alpha clipping"),
    (LENS, "lens"),
    (TANGENTS, "tangents"),
    (OBJECTS, "objects"),
    (NORMAL_MAPS, "normal maps"),
    (WIDE_NODES, "wide nodes"),
    (MOTION, "motion"),
    (MATERIAL_STONE, "stone"),
    (MATERIAL_WOOD, "wood"),
    (MATERIAL_FABRIC, "fabric"),
    (SAMPLER_PCG, "independent samples"),
    (MATERIAL_CONDUCTOR, "conductor"),
    (MATERIAL_ROUGH_DIELECTRIC, "rough dielectric"),
    (MATERIAL_CLEARCOAT, "clearcoat"),
    (MATERIAL_PETAL, "petal"),
    (MATERIAL_LEAF, "leaf"),
    (MEDIA, "media"),
    (SCATTERING, "scattering media"),
    (FOG, "fog"),
    (THROUGH, "see-through materials"),
    (SHEETS, "see-through sheets"),
    (MATERIAL_WATER, "water"),
    (SKY_IMAGE, "image sky"),
    (LIGHT_SKY, "sky light"),
    (LIGHT_TREE, "light tree"),
    (TINT, "tinted lights"),
    (PRINCIPLED_SPECULAR, "principled specular"),
    (PRINCIPLED_COAT, "principled coat"),
    (PRINCIPLED_TRANSMISSION, "principled transmission"),
    (INSTANCES, "instances"),
    (LIGHT_CHOICE, "several lights"),
];

/// All bits that this reader knows.
pub const KNOWN: u64 = {
    let (mut known, mut i) = (0, 0);
    while i < NAMES.len() {
        known |= NAMES[i].0;
        i += 1;
    }
    known
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
    set(SAMPLER_PCG, contents.render.sampler == SamplerKind::Pcg as u32);
    set(LIGHT_CHOICE, contents.lights.len() > 1);
    set(LIGHT_TREE, !contents.light_nodes.is_empty());
    set(INSTANCES, !contents.instances.is_empty());
    set(WIDE_NODES, !contents.wide_nodes.is_empty());
    set(MOTION, contents.objects.iter().any(Object::moves));
    for light in contents.lights {
        set(LIGHT_SPHERE, light.kind == LightKind::Sphere as u32);
        set(LIGHT_RECTANGLE, light.kind == LightKind::Rectangle as u32);
        set(LIGHT_TRIANGLE, light.kind == LightKind::Triangle as u32);
        set(LIGHT_SKY, light.kind == LightKind::Sky as u32);
    }
    if let Some(sky) = contents.sky {
        set(SKY_CONSTANT, sky.kind == SkyKind::Constant as u32);
        set(SKY_GRADIENT, sky.kind == SkyKind::Gradient as u32);
        set(SKY_IMAGE, sky.kind == SkyKind::Image as u32);
    }
    for texture in contents.textures {
        set(TEXTURE_RGBA8_SRGB, texture.format == TextureFormat::Rgba8Srgb as u32);
        set(TEXTURE_RGBA8_LINEAR, texture.format == TextureFormat::Rgba8Linear as u32);
        set(TEXTURE_RGBA16_FLOAT, texture.format == TextureFormat::Rgba16Float as u32);
    }
    for material in contents.materials {
        for kind in MaterialKind::ALL {
            set(self::material(kind), material.kind == kind as u32);
        }
        set(TINT, material.flags & material_flag::EMIT_TINT != 0);
        set(ALPHA_CLIP, material.flags & material_flag::ALPHA_CLIP != 0);
        set(TANGENTS, material.flags & material_flag::TANGENT != 0);
        set(OBJECTS, material.flags & material_flag::OBJECT != 0);
        set(NORMAL_MAPS, material.normal_texture != NONE);
        set(MEDIA, material.flags & material_flag::INTERIOR != 0);
        set(THROUGH, material.flags & material_flag::THROUGH != 0);
        set(SHEETS, material.is_sheet());
        set(PRINCIPLED_SPECULAR, material.has_specular());
        set(PRINCIPLED_COAT, material.has_coat());
        set(PRINCIPLED_TRANSMISSION, material.has_transmission());
    }
    set(MEDIA, contents.render.air != NONE);
    set(FOG, contents.render.fog != NONE);
    for medium in contents.media {
        set(SCATTERING, medium.sigma_s.iter().any(|sigma| *sigma > 0.0));
    }
    bits
}
