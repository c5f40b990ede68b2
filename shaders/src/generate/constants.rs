//! `scene/constants.wgsl`: tags, flags and limits, taken from `pack::abi`.

use super::wgsl::tag;
use crate::FeatureSet;
use pack::abi::{
    CHILD_INNER, CHILD_INSTANCE, CHILD_OUT, CHILD_SPHERES, CameraKind, ChildRef, FilterKind,
    LIGHT_LEAF, LightKind, MOVES, MaterialKind, NONE, SamplerKind, SkyKind, TRI_SMOOTH,
    TextureFormat, TextureOpKind, Wrap, material_flag,
};
use std::fmt::Write as _;

/// The module for this scene.
pub(crate) fn text(features: &FeatureSet) -> String {
    let one_more = |child: ChildRef| child.encode().expect("small references have a word");
    let first_of_one = one_more(ChildRef::Triangles { first: 0, count: 1 });
    let count_unit = one_more(ChildRef::Triangles { first: 0, count: 2 }) - first_of_one;
    let named = |name: &str, value: u32| (name.to_owned(), value);
    let mut rows = vec![
        named("NONE", NONE),
        named("STACK_SIZE", features.stack_size.max(1)),
        named("CHILD_INNER", CHILD_INNER),
        named("CHILD_INDEX", CHILD_INNER - 1),
        named("CHILD_SPHERES", CHILD_SPHERES),
        named("CHILD_INSTANCE", CHILD_INSTANCE),
        named("CHILD_INSTANCE_INDEX", !CHILD_INSTANCE & (CHILD_SPHERES - 1) & ((1 << 26) - 1)),
        named("CHILD_OUT", CHILD_OUT),
        named("CHILD_FIRST", count_unit - 1),
        named("CHILD_COUNT_SHIFT", count_unit.trailing_zeros()),
    ];
    rows.extend(MaterialKind::DECLARED.map(|kind| (tag("MATERIAL", &kind.stem()), kind as u32)));
    rows.extend([
        named("FLAG_EMIT_BOTH_SIDES", material_flag::EMIT_BOTH_SIDES),
        named("FLAG_ALPHA_CLIP", material_flag::ALPHA_CLIP),
        named("FLAG_TANGENT", material_flag::TANGENT),
        named("FLAG_OBJECT", material_flag::OBJECT),
        named("FLAG_PROJECT", material_flag::PROJECT),
        named("FLAG_PROJECT_X", material_flag::PROJECT_X),
        named("FLAG_PROJECT_Y", material_flag::PROJECT_Y),
        named("FLAG_PROJECT_Z", material_flag::PROJECT_Z),
        named("FLAG_PROJECT_BOX", material_flag::PROJECT_BOX),
        named("FLAG_PROJECT_SOLID", material_flag::PROJECT_SOLID),
        named("FLAG_INTERIOR", material_flag::INTERIOR),
        named("FLAG_THROUGH", material_flag::THROUGH),
        named("TRI_SMOOTH", TRI_SMOOTH),
        named("FLAG_EMIT_TINT", material_flag::EMIT_TINT),
        named("FLAG_EMIT_SPOT", material_flag::EMIT_SPOT),
        named("FLAG_EMIT_PROFILE", material_flag::EMIT_PROFILE),
        named("FLAG_UNSEEN", material_flag::UNSEEN),
        named("FLAG_ALPHA_BLEND", material_flag::ALPHA_BLEND),
        named("LIGHT_LEAF", LIGHT_LEAF),
        named("LIGHT_LEAF_INDEX", LIGHT_LEAF - 1),
        named("MOVES", MOVES),
    ]);
    rows.extend(LightKind::DECLARED.map(|kind| (tag("LIGHT", &kind.stem()), kind as u32)));
    rows.extend(SkyKind::DECLARED.map(|kind| (tag("SKY", &kind.stem()), kind as u32)));
    rows.extend(SamplerKind::DECLARED.map(|kind| (tag("SAMPLER", &kind.stem()), kind as u32)));
    rows.extend(CameraKind::DECLARED.map(|kind| (tag("CAMERA", &kind.stem()), kind as u32)));
    rows.extend(FilterKind::DECLARED.map(|kind| (tag("FILTER", &kind.stem()), kind as u32)));
    rows.extend(TextureFormat::DECLARED.map(|kind| (tag("TEXTURE", &kind.stem()), kind as u32)));
    rows.extend(TextureOpKind::DECLARED.map(|kind| (tag("TEXTURE_OP", &kind.stem()), kind as u32)));
    rows.extend(Wrap::DECLARED.map(|rule| (tag("WRAP", &rule.stem()), rule as u32)));
    let mut text =
        String::from("// Generated: tags of the records, and the limits of this scene.\n\n");
    for (name, value) in rows {
        let _ = writeln!(text, "const {name}: u32 = {value:#x}u;");
    }
    text
}
