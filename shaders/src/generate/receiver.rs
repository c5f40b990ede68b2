//! `scene/receiver.wgsl`: what the choice of a light knows of the surface that is lit.

use super::wgsl::imports;
use crate::FeatureSet;
use pack::abi::MaterialKind;
use std::fmt::Write as _;

/// The receiver of a vertex, where a tree of lights asks for it.
pub(crate) fn text(features: &FeatureSet) -> String {
    let mut text =
        String::from("// Generated: what choosing a light knows of the surface that is lit.\n\n");
    text += &imports(["bsdf/scatter.wgsl"]);
    let (kind, none, at) = if features.light_tree {
        let at = "vec4f(scatter.ns, f32((RECEIVER_OPAQUE >> min(scatter.kind, 31u)) & 1u))";
        ("vec4f", "vec4f(0.0)", at)
    } else {
        ("u32", "0u", "0u")
    };
    let _ = write!(
        text,
        "\nalias Receiver = {kind};\n\
         \n// Bit 1 << kind: no light comes through a surface of this material.\n\
         const RECEIVER_OPAQUE: u32 = {:#x}u;\n\
         \n// No surface.\n\
         fn receiver_none() -> Receiver {{\n    return {none};\n}}\n\
         \n// The shading normal in xyz, 0 in a medium; w is 1 where no light comes through the surface.\n\
         fn receiver_at(scatter: Scatter) -> Receiver {{\n    return {at};\n}}\n",
        opaque(),
    );
    text
}

/// The kinds that transmit nothing, as a mask.
fn opaque() -> u32 {
    let bit = |kind: &MaterialKind| 1_u32 << (*kind as u32);
    MaterialKind::ALL.iter().filter(|kind| !kind.traits().transmits).map(bit).sum()
}
