//! `scene/receiver.wgsl`: what direct light knows of the surface that is lit. `scene/links.wgsl`: which lights light it.

use super::wgsl::imports;
use crate::FeatureSet;
use pack::abi::MaterialKind;
use std::fmt::Write as _;

/// The shading normal, for the tree of lights.
const FACING: &str = "vec4f(scatter.ns, f32((RECEIVER_OPAQUE >> min(scatter.kind, 31u)) & 1u))";

/// The receiver of a vertex, where a tree of lights or light linking asks for it.
pub(crate) fn text(features: &FeatureSet) -> String {
    let mut text =
        String::from("// Generated: what direct light knows of the surface that is lit.\n\n");
    text += &imports(["bsdf/scatter.wgsl", "scene/links.wgsl"]);
    let links = "links_received(object, scatter.material)";
    // Its declaration, no receiver, one at a vertex, and its two parts.
    let (kind, none, at, facing, sets) = match (features.light_tree, features.links) {
        (false, false) => ("alias Receiver = u32;", "0u", "0u".to_owned(), "vec4f(0.0)", "0u"),
        (true, false) => {
            ("alias Receiver = vec4f;", "vec4f(0.0)", FACING.to_owned(), "receiver", "0u")
        }
        (false, true) => (
            "struct Receiver {\n    // Bit k: the lights of set k light it.\n    links: u32,\n}",
            "Receiver(LINKS_ALL)",
            format!("Receiver({links})"),
            "vec4f(0.0)",
            "receiver.links",
        ),
        (true, true) => (
            "struct Receiver {\n    // See `receiver_facing`.\n    facing: vec4f,\n    \
             // Bit k: the lights of set k light it.\n    links: u32,\n}",
            "Receiver(vec4f(0.0), LINKS_ALL)",
            format!("Receiver({FACING}, {links})"),
            "receiver.facing",
            "receiver.links",
        ),
    };
    let _ = write!(
        text,
        "\n{kind}\n\
         \n// Bit 1 << kind: no light comes through a surface of this material.\n\
         const RECEIVER_OPAQUE: u32 = {:#x}u;\n\
         \n// No surface: every light lights it.\n\
         fn receiver_none() -> Receiver {{\n    return {none};\n}}\n\
         \n// A point of `object`, or of a medium where that is `NONE`.\n\
         fn receiver_at(scatter: Scatter, object: u32) -> Receiver {{\n    return {at};\n}}\n\
         \n// The shading normal in xyz, 0 in a medium; w is 1 where no light comes through the surface.\n\
         fn receiver_facing(receiver: Receiver) -> vec4f {{\n    return {facing};\n}}\n\
         \n// As `LightLink::receives`.\n\
         fn receiver_links(receiver: Receiver) -> u32 {{\n    return {sets};\n}}\n",
        opaque(),
    );
    text
}

/// Light linking. The full kernel asks whether there is any.
pub(crate) fn links(features: &FeatureSet) -> String {
    let mut text = String::from("// Generated: which lights of this scene light which things.\n\n");
    text += &imports(["scene/constants.wgsl", "scene/records.wgsl"]);
    let (received, joined) = if features.links {
        (
            "    if (load_frame_link_at() == NONE) {\n        return LINKS_ALL;\n    }\n    \
             if (object == NONE) {\n        return load_medium_receives(medium);\n    }\n    \
             return load_light_link_receives(load_frame_n_lights() + object);\n",
            "    if (load_frame_link_at() == NONE) {\n        return true;\n    }\n    \
             let own = load_light_link_own_set(i);\n    \
             return own == 0u || (own & sets) != 0u;\n",
        )
    } else {
        ("    return LINKS_ALL;\n", "    return true;\n")
    };
    let _ = write!(
        text,
        "\n// Every set of lights.\n\
         const LINKS_ALL: u32 = 0xffffffffu;\n\
         \n// As `LightLink::receives`: of an object, or of medium `medium` where that is `NONE`.\n\
         fn links_received(object: u32, medium: u32) -> u32 {{\n{received}}}\n\
         \n// Whether entry `i` of the table, a light or something that glows, lights what receives these sets.\n\
         fn links_joined(i: u32, sets: u32) -> bool {{\n{joined}}}\n\
         \n// The same of what is known by its object.\n\
         fn links_glow(object: u32, sets: u32) -> bool {{\n    \
         return links_joined(load_frame_n_lights() + object, sets);\n}}\n"
    );
    text
}

/// The kinds that transmit nothing, as a mask.
fn opaque() -> u32 {
    let bit = |kind: &MaterialKind| 1_u32 << (*kind as u32);
    MaterialKind::ALL.iter().filter(|kind| !kind.traits().transmits).map(bit).sum()
}
