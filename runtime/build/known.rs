//! Every declaration that the linker can emit, with the scenes for which it emits it.
//!
//! The linker is run over families of feature sets; in each family one group of features takes all
//! its values. A declaration that always reads the same is known for every scene; one that varies
//! within a family is known only for scenes with the same features of that group.

use crate::pieces::pieces;
use pack::abi::{LightKind, MaterialKind, SkyKind, TextureFormat};
use pack::features as bit;
use shaders::{FeatureSet, Windows};
use std::collections::{BTreeMap, BTreeSet};
use std::error::Error;
use std::fmt::Write as _;

/// A family: the feature bits that vary, and every member with its bits.
struct Family {
    mask: u32,
    members: Vec<(u32, FeatureSet)>,
}

/// Texts of a declaration, each with the (family, bits) in which it occurs.
type Texts = BTreeMap<String, BTreeSet<(usize, u32)>>;

/// Rust source of `KNOWN: &[Known]`, sorted by text.
pub(crate) fn table() -> Result<String, Box<dyn Error>> {
    let families = [materials(), geometry(), views(), formats()];
    let mut declarations: BTreeMap<String, Texts> = BTreeMap::new();
    for (f, family) in families.iter().enumerate() {
        for (bits, features) in &family.members {
            for (name, text) in declarations_of(features)? {
                declarations.entry(name).or_default().entry(text).or_default().insert((f, *bits));
            }
        }
    }
    let mut rows: BTreeSet<(String, String)> = readers()?;
    for (name, texts) in &declarations {
        if name.ends_with("_word") {
            continue;
        }
        rows.extend(rows_of(name, texts, &families)?);
    }
    let mut source = String::from("static KNOWN: &[Known] = &[\n");
    for (text, condition) in rows {
        writeln!(source, "    Known {{ text: {text:?}, condition: {condition} }},")?;
    }
    source.push_str("];\n");
    Ok(source)
}

/// The rows of one declaration.
fn rows_of(
    name: &str,
    texts: &Texts,
    families: &[Family],
) -> Result<Vec<(String, String)>, Box<dyn Error>> {
    let any = |text: &String| (text.clone(), "Condition::Any".to_owned());
    if texts.len() == 1 {
        return Ok(texts.keys().map(any).collect());
    }
    let varies = |f: &usize| {
        texts.values().filter(|places| places.iter().any(|place| place.0 == *f)).count() > 1
    };
    let varying: Vec<usize> = (0..families.len()).filter(varies).collect();
    let &[family] = varying.as_slice() else {
        let masks: Vec<u32> = varying.iter().map(|f| families[*f].mask).collect();
        return Err(format!("`{name}` depends on several groups of features: {masks:#x?}").into());
    };
    let mask = families[family].mask;
    let mut rows = Vec::new();
    for (text, places) in texts {
        for (_, bits) in places.iter().filter(|place| place.0 == family) {
            let condition = format!("Condition::Features {{ mask: {mask:#x}, bits: {bits:#x} }}");
            rows.push((text.clone(), condition));
        }
    }
    Ok(rows)
}

/// Name and text of every declaration of a kernel.
fn declarations_of(features: &FeatureSet) -> Result<Vec<(String, String)>, Box<dyn Error>> {
    let linked = shaders::link(features)?;
    let pieces = pieces(&linked.text).map_err(|line| format!("line {line} is not plain text"))?;
    pieces
        .into_iter()
        .map(|(_, text)| {
            Ok((name_of(text).ok_or("a declaration without a name")?, text.to_owned()))
        })
        .collect()
}

/// The word after `fn`, `struct`, `const`, `alias` or `var<…>`.
fn name_of(text: &str) -> Option<String> {
    let code =
        text.lines().find(|line| !line.starts_with("//") && !line.starts_with("@compute"))?;
    let keyword = ["fn ", "struct ", "const ", "alias ", "var<"];
    let start = keyword.iter().filter_map(|k| code.find(k).map(|i| i + k.len())).min()?;
    let rest = &code[start..];
    let rest = if code[..start].ends_with("var<") { rest.split_once("> ")?.1 } else { rest };
    let end = rest.find(|c: char| c != '_' && !c.is_ascii_alphanumeric()).unwrap_or(rest.len());
    (end > 0).then(|| rest[..end].to_owned())
}

/// Every subset of `all`.
fn subsets<T: Copy + Ord>(all: &[T]) -> Vec<BTreeSet<T>> {
    (0..1_u32 << all.len())
        .map(|bits| {
            all.iter().enumerate().filter(|(i, _)| bits >> i & 1 == 1).map(|(_, t)| *t).collect()
        })
        .collect()
}

fn materials() -> Family {
    let of = |kind: &MaterialKind| match kind {
        MaterialKind::Diffuse => bit::MATERIAL_DIFFUSE,
        MaterialKind::Metal => bit::MATERIAL_METAL,
        MaterialKind::Dielectric => bit::MATERIAL_DIELECTRIC,
        MaterialKind::Emissive => bit::MATERIAL_EMISSIVE,
        MaterialKind::Principled => bit::MATERIAL_PRINCIPLED,
    };
    let mask = MaterialKind::ALL.iter().map(of).sum();
    let member = |materials: BTreeSet<MaterialKind>| {
        (materials.iter().map(of).sum(), FeatureSet { materials, ..FeatureSet::full() })
    };
    Family { mask, members: subsets(&MaterialKind::ALL).into_iter().map(member).collect() }
}

fn skies_and_lens() -> Vec<(u32, FeatureSet)> {
    let of = |sky: &SkyKind| match sky {
        SkyKind::Constant => bit::SKY_CONSTANT,
        SkyKind::Gradient => bit::SKY_GRADIENT,
    };
    let mut members = Vec::new();
    for lens in [false, true] {
        for skies in subsets(&[SkyKind::Constant, SkyKind::Gradient]) {
            let bits = skies.iter().map(of).sum::<u32>() | if lens { bit::LENS } else { 0 };
            members.push((bits, FeatureSet { lens, skies, ..FeatureSet::full() }));
        }
    }
    members
}

fn views() -> Family {
    let mask = bit::SKY_CONSTANT | bit::SKY_GRADIENT | bit::LENS;
    Family { mask, members: skies_and_lens() }
}

const FORMATS: [(TextureFormat, u32); 3] = [
    (TextureFormat::Rgba8Srgb, bit::TEXTURE_RGBA8_SRGB),
    (TextureFormat::Rgba8Linear, bit::TEXTURE_RGBA8_LINEAR),
    (TextureFormat::Rgba16Float, bit::TEXTURE_RGBA16_FLOAT),
];

fn formats() -> Family {
    let mask = FORMATS.iter().map(|row| row.1).sum();
    let mut members = Vec::new();
    for rows in subsets(&FORMATS.map(|row| row.1)) {
        // Whether there are textures at all belongs to the family of shapes.
        if !rows.is_empty() {
            let textures =
                FORMATS.iter().filter(|row| rows.contains(&row.1)).map(|row| row.0).collect();
            members.push((rows.iter().sum(), FeatureSet { textures, ..FeatureSet::full() }));
        }
    }
    Family { mask, members }
}

/// Shapes, lights, cut-outs, and whether there are textures at all. Any formats of textures stand
/// for all: their own family covers them.
fn geometry() -> Family {
    let lights = [LightKind::Sphere, LightKind::Rectangle, LightKind::Triangle];
    let of = |kind: &LightKind| match kind {
        LightKind::Sphere => bit::LIGHT_SPHERE,
        LightKind::Rectangle => bit::LIGHT_RECTANGLE,
        LightKind::Triangle => bit::LIGHT_TRIANGLE,
    };
    let format_bits: Vec<u32> =
        subsets(&FORMATS.map(|row| row.1)).iter().map(|rows| rows.iter().sum()).collect();
    let mut members = Vec::new();
    for (triangles, smooth_normals, spheres) in [
        (false, false, false),
        (false, false, true),
        (true, false, false),
        (true, true, false),
        (true, false, true),
        (true, true, true),
    ] {
        for (textures, alpha_clip) in [(false, false), (true, false), (true, true)] {
            for lights in subsets(&lights) {
                let mut bits = lights.iter().map(of).sum::<u32>();
                bits |= if triangles { bit::TRIANGLES } else { 0 };
                bits |= if spheres { bit::SPHERES } else { 0 };
                bits |= if alpha_clip { bit::ALPHA_CLIP } else { 0 };
                let possible = lights.iter().all(|kind| match kind {
                    LightKind::Sphere => spheres,
                    LightKind::Rectangle | LightKind::Triangle => triangles,
                });
                if !possible {
                    continue;
                }
                let full = FeatureSet::full();
                let formats = if textures { full.textures.clone() } else { BTreeSet::new() };
                let features = FeatureSet {
                    triangles,
                    smooth_normals,
                    spheres,
                    lights,
                    alpha_clip,
                    textures: formats,
                    ..full
                };
                for format in format_bits.iter().filter(|format| textures == (**format != 0)) {
                    members.push((bits | format, features.clone()));
                }
            }
        }
    }
    let mask = bit::TRIANGLES
        | bit::SPHERES
        | bit::LIGHT_SPHERE
        | bit::LIGHT_RECTANGLE
        | bit::LIGHT_TRIANGLE
        | bit::ALPHA_CLIP
        | FORMATS.iter().map(|row| row.1).sum::<u32>();
    Family { mask, members }
}

/// The functions `node_word` and so on, for every number of windows that a device can bind.
fn readers() -> Result<BTreeSet<(String, String)>, Box<dyn Error>> {
    let full = FeatureSet::full();
    let triangles = FeatureSet { spheres: false, textures: BTreeSet::new(), ..full.clone() };
    let triangles = FeatureSet { lights: BTreeSet::new(), alpha_clip: false, ..triangles };
    let spheres = FeatureSet { triangles: false, spheres: true, ..triangles.clone() };
    let textured = FeatureSet { textures: full.textures.clone(), ..spheres.clone() };
    let with = |base: &FeatureSet, windows: Windows| FeatureSet { windows, ..base.clone() };
    let one = Windows::default();
    let mut rows = BTreeSet::new();
    for n in 1..=4 {
        let members = [
            (3, "node_word", with(&spheres, Windows { node: n, ..one })),
            (4, "tri_word", with(&triangles, Windows { tri: n, ..one })),
            (5, "shade_word", with(&triangles, Windows { shade: n, ..one })),
            (6, "sphere_word", with(&spheres, Windows { sphere: n, ..one })),
            (7, "texel_word", with(&textured, Windows { texel: n, ..one })),
        ];
        for (binding, reader, features) in members {
            // More buffers than every device has: no pack holds such a kernel.
            if features.bindings().is_err() {
                continue;
            }
            for (name, text) in declarations_of(&features)? {
                if name == reader {
                    rows.insert((
                        text,
                        format!("Condition::Windows {{ binding: {binding}, n: {n} }}"),
                    ));
                } else if name == "heap_word" || name.contains("_words_") {
                    rows.insert((text, "Condition::Any".to_owned()));
                }
            }
        }
    }
    Ok(rows)
}
