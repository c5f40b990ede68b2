//! Declarations of the table → a kernel with other features than the pack's, to find out what they cost.
//!
//! The table holds every declaration that the linker emits, with the features for which it does. Features
//! select one text for each name; what the entry point reaches of them is the kernel, as the linker would
//! write it, in another order. So this crate links kernels without knowing how they are generated.

use super::pieces::{name_of, pieces};
use super::{KNOWN, Known, SWITCHES, stack_size, windows};
use crate::setup::Setup;
use pack::features as bit;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::OnceLock;

/// The kernel that renders every pack, and whose translation is the CPU kernel.
pub(crate) static FULL: &str = include_str!(concat!(env!("OUT_DIR"), "/full.wgsl"));

/// The entry point of pictures.
pub(crate) const RENDER: &str = "render";
/// That of AOVs.
pub(crate) const AOV: &str = "aov";

/// What a kernel is wanted to do.
#[expect(clippy::struct_excessive_bools, reason = "each is something that has no feature bit")]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Wanted {
    /// Bits of `pack::features`.
    pub(crate) features: u64,
    /// Whether triangles interpolate normals, which has no bit.
    pub(crate) smooth: bool,
    /// Whether things turn, or have ways of several pieces; likewise.
    pub(crate) keys: bool,
    /// Whether the camera moves; likewise.
    pub(crate) camera_keys: bool,
    /// Whether some light does not light everything; likewise.
    pub(crate) links: bool,
    /// Whether textures are projected; likewise.
    pub(crate) projection: bool,
}

impl Wanted {
    /// What the pack's own kernel does.
    pub(crate) fn of(setup: &Setup<'_>) -> Self {
        let has = |function| setup.kernel().contains(function);
        Self {
            features: setup.features(),
            smooth: has("fn triangle_surface("),
            keys: has("fn pose_at("),
            camera_keys: has("fn keys_camera("),
            links: has("load_frame_link_at()"),
            projection: has("fn projection_apply("),
        }
    }

    /// With texture coordinates, which surfaces have where some texture may ask for them.
    pub(crate) fn with_uv(self) -> Self {
        const FORMATS: u64 =
            bit::TEXTURE_RGBA8_SRGB | bit::TEXTURE_RGBA8_LINEAR | bit::TEXTURE_RGBA16_FLOAT;
        let format = if self.features & FORMATS == 0 { bit::TEXTURE_RGBA8_SRGB } else { 0 };
        Self { features: self.features | format, ..self }
    }

    /// With one more feature, and what that one cannot be without.
    pub(crate) fn with(self, more: u64) -> Self {
        let texture = self.with_uv().features;
        let needs = match more {
            bit::SCATTERING => bit::MEDIA,
            bit::SHEETS => bit::THROUGH,
            bit::BLADES => bit::LENS,
            bit::LIGHT_TREE => bit::LIGHT_CHOICE,
            bit::LIGHT_SPHERE => bit::SPHERES,
            bit::LIGHT_RECTANGLE | bit::LIGHT_TRIANGLE | bit::INSTANCES => bit::TRIANGLES,
            bit::ALPHA_CLIP => texture,
            bit::NORMAL_MAPS => texture | bit::TANGENTS,
            bit::PRINCIPLED_SPECULAR | bit::PRINCIPLED_COAT | bit::PRINCIPLED_TRANSMISSION => {
                bit::MATERIAL_PRINCIPLED
            }
            _ => 0,
        };
        Self { features: self.features | more | needs, ..self }
    }
}

/// The kernel for the scene of `setup` that can do what is wanted, from its entry point on; `None` where there is no
/// such kernel, or where the pack's own is not known.
pub(crate) fn relink(setup: &Setup<'_>, wanted: Wanted, entry: &'static str) -> Option<String> {
    let own: BTreeMap<&str, &str> = declarations(setup.kernel())?;
    let mut sections = windows(setup);
    // Sections that the pack lacks have one window.
    for binding in 3..=7 {
        if !sections.iter().any(|(number, _)| *number == binding) {
            sections.push((binding, 1));
        }
    }
    let choice = Choice { own: &own, sections: &sections, wanted };
    let mut found: BTreeMap<&str, String> = BTreeMap::new();
    let mut open = vec![entry];
    while let Some(name) = open.pop() {
        if found.contains_key(name) {
            continue;
        }
        let text = choice.text(name)?;
        open.extend(names_in(&text));
        found.insert(name, text);
    }
    Some(found.into_values().map(|text| text + "\n\n").collect())
}

/// Whether two kernels have the same declarations.
pub(crate) fn is_same(a: &str, b: &str) -> bool {
    let all = |text| pieces(text).map(|all| all.into_iter().map(|(_, text)| text.to_owned()));
    let set = |text| all(text).map(Iterator::collect::<BTreeSet<String>>);
    set(a).is_ok_and(|a| set(b).is_ok_and(|b| a == b))
}

/// Name and text of each declaration.
fn declarations(kernel: &str) -> Option<BTreeMap<&str, &str>> {
    let pieces = pieces(kernel).ok()?;
    pieces.into_iter().map(|(_, text)| Some((name_of(text)?, text))).collect()
}

/// The rows of the table by name.
fn table() -> &'static BTreeMap<&'static str, Vec<&'static Known>> {
    static TABLE: OnceLock<BTreeMap<&str, Vec<&Known>>> = OnceLock::new();
    TABLE.get_or_init(|| {
        let mut table: BTreeMap<&str, Vec<&Known>> = BTreeMap::new();
        for known in KNOWN {
            table.entry(name_of(known.text).unwrap_or_default()).or_default().push(known);
        }
        table
    })
}

/// Names of declarations that a text uses, its own included.
fn names_in(text: &str) -> Vec<&'static str> {
    let code = text.lines().map(|line| line.split("//").next().unwrap_or_default());
    let words = code.flat_map(|line| line.split(|c: char| c != '_' && !c.is_ascii_alphanumeric()));
    let switches = |word: &str| SWITCHES.iter().find(|s| s.name == word).map(|s| s.name);
    let known = |word: &str| {
        let row = table().get_key_value(word).map(|(name, _)| *name);
        row.or_else(|| switches(word)).or((word == STACK).then_some(STACK))
    };
    words.filter_map(known).collect()
}

/// Its number is the pack's, so no table holds it.
const STACK: &str = "STACK_SIZE";

/// Words of the texts for triangles that interpolate normals, where there is another text for those that do not.
const SMOOTH: [&str; 4] = ["triangle_surface(", "SmoothStart", "smooth_start_", "smooth_probe_"];

/// Words of the texts for things that turn, where there is another text for those that do not.
const KEYED: [&str; 2] = ["pose_", "dispatch_triangle_dir(i, ray.dir"];
/// Words of the texts for cameras that move, likewise.
const EYE: [&str; 1] = ["keys_camera("];
/// Words of the texts for light linking, likewise.
const LINKED: [&str; 4] = ["struct Receiver", "Receiver(", "receiver.", "load_frame_link_at()"];
/// Words of the text for textures that are projected, likewise.
const PROJECTED: [&str; 2] = ["projection_apply(", "projection_at("];
/// Words of the text for either.
const TIME: [&str; 1] = ["load_frame_camera_key_at() == NONE"];

/// How one text is chosen for a name.
struct Choice<'a> {
    own: &'a BTreeMap<&'a str, &'a str>,
    sections: &'a [(u32, u64)],
    wanted: Wanted,
}

impl Choice<'_> {
    fn text(&self, name: &str) -> Option<String> {
        if name == STACK {
            // A kernel without geometry has no stack; one entry is the least.
            let own = self.own.get(STACK).filter(|text| stack_size(text).is_some());
            return Some((*own.unwrap_or(&"const STACK_SIZE: u32 = 0x1u;")).to_owned());
        }
        let Wanted { features, smooth, keys, camera_keys, links, projection } = self.wanted;
        let rows = table().get(name).into_iter().flatten();
        let fitting: BTreeSet<&str> = rows
            .filter(|known| known.condition.holds(features, self.sections))
            .map(|known| known.text)
            .collect();
        let kinds: [(&[&str], bool); 6] = [
            (&SMOOTH, smooth),
            (&KEYED, keys),
            (&EYE, camera_keys),
            (&TIME, keys || camera_keys),
            (&LINKED, links),
            (&PROJECTED, projection),
        ];
        // What has no bit tells texts apart that fit the same features.
        let chosen = match fitting.len() {
            0 => None,
            1 => fitting.first(),
            _ => {
                let is = |text: &&str, words: &[&str]| words.iter().any(|word| text.contains(word));
                let kind =
                    kinds.iter().find(|(words, _)| fitting.iter().any(|text| is(text, words)));
                kind.and_then(|(words, wanted)| {
                    fitting.iter().find(|text| is(text, words) == *wanted)
                })
            }
        };
        let switch = || SWITCHES.iter().find(|switch| switch.name == name);
        chosen.map(|text| (*text).to_owned()).or_else(|| Some(switch()?.text(features)))
    }
}
