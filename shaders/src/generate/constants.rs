//! `scene/constants.wgsl`: tags, flags and limits, taken from `pack::abi`.

use crate::FeatureSet;
use pack::abi::{
    CHILD_DOOR, CHILD_INNER, CHILD_OUT, CHILD_SPHERES, ChildRef, LIGHT_LEAF, LightKind, MOVES,
    MaterialKind, NONE, SamplerKind, SkyKind, TRI_SMOOTH, TextureFormat, Wrap, material_flag,
};
use std::fmt::Write as _;

/// The module for this scene.
pub(crate) fn text(features: &FeatureSet) -> String {
    let one_more = |child: ChildRef| child.encode().expect("small references have a word");
    let first_of_one = one_more(ChildRef::Triangles { first: 0, count: 1 });
    let count_unit = one_more(ChildRef::Triangles { first: 0, count: 2 }) - first_of_one;
    let rows = [
        ("NONE", NONE),
        ("STACK_SIZE", features.stack_size.max(1)),
        ("CHILD_INNER", CHILD_INNER),
        ("CHILD_INDEX", CHILD_INNER - 1),
        ("CHILD_SPHERES", CHILD_SPHERES),
        ("CHILD_DOOR", CHILD_DOOR),
        ("CHILD_DOOR_INDEX", !CHILD_DOOR & (CHILD_SPHERES - 1) & ((1 << 26) - 1)),
        ("CHILD_OUT", CHILD_OUT),
        ("CHILD_FIRST", count_unit - 1),
        ("CHILD_COUNT_SHIFT", count_unit.trailing_zeros()),
        ("MATERIAL_DIFFUSE", MaterialKind::Diffuse as u32),
        ("MATERIAL_METAL", MaterialKind::Metal as u32),
        ("MATERIAL_DIELECTRIC", MaterialKind::Dielectric as u32),
        ("MATERIAL_EMISSIVE", MaterialKind::Emissive as u32),
        ("MATERIAL_PRINCIPLED", MaterialKind::Principled as u32),
        ("MATERIAL_STONE", MaterialKind::Stone as u32),
        ("MATERIAL_WOOD", MaterialKind::Wood as u32),
        ("MATERIAL_FABRIC", MaterialKind::Fabric as u32),
        ("MATERIAL_CONDUCTOR", MaterialKind::Conductor as u32),
        ("MATERIAL_ROUGH_DIELECTRIC", MaterialKind::RoughDielectric as u32),
        ("MATERIAL_CLEARCOAT", MaterialKind::Clearcoat as u32),
        ("MATERIAL_PETAL", MaterialKind::Petal as u32),
        ("MATERIAL_LEAF", MaterialKind::Leaf as u32),
        ("MATERIAL_WATER", MaterialKind::Water as u32),
        ("FLAG_EMIT_BOTH_SIDES", material_flag::EMIT_BOTH_SIDES),
        ("FLAG_ALPHA_CLIP", material_flag::ALPHA_CLIP),
        ("FLAG_TANGENT", material_flag::TANGENT),
        ("FLAG_OBJECT", material_flag::OBJECT),
        ("FLAG_INTERIOR", material_flag::INTERIOR),
        ("FLAG_THROUGH", material_flag::THROUGH),
        ("TRI_SMOOTH", TRI_SMOOTH),
        ("FLAG_EMIT_TINT", material_flag::EMIT_TINT),
        ("LIGHT_LEAF", LIGHT_LEAF),
        ("LIGHT_LEAF_INDEX", LIGHT_LEAF - 1),
        ("MOVES", MOVES),
        ("LIGHT_SPHERE", LightKind::Sphere as u32),
        ("LIGHT_RECTANGLE", LightKind::Rectangle as u32),
        ("LIGHT_TRIANGLE", LightKind::Triangle as u32),
        ("LIGHT_SKY", LightKind::Sky as u32),
        ("SKY_CONSTANT", SkyKind::Constant as u32),
        ("SKY_GRADIENT", SkyKind::Gradient as u32),
        ("SAMPLER_SOBOL", SamplerKind::Sobol as u32),
        ("SAMPLER_PCG", SamplerKind::Pcg as u32),
        ("SKY_IMAGE", SkyKind::Image as u32),
        ("TEXTURE_RGBA8_SRGB", TextureFormat::Rgba8Srgb as u32),
        ("TEXTURE_RGBA8_LINEAR", TextureFormat::Rgba8Linear as u32),
        ("TEXTURE_RGBA16_FLOAT", TextureFormat::Rgba16Float as u32),
        ("WRAP_REPEAT", Wrap::Repeat as u32),
        ("WRAP_CLAMP", Wrap::Clamp as u32),
        ("WRAP_MIRROR", Wrap::Mirror as u32),
    ];
    let mut text =
        String::from("// Generated: tags of the records, and the limits of this scene.\n\n");
    for (name, value) in rows {
        let _ = writeln!(text, "const {name}: u32 = {value:#x}u;");
    }
    text
}
