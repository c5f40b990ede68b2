//! Every declaration that the linker can emit, with the scenes for which it emits it.
//!
//! The linker is run over families of feature sets; in each family one group of features takes all
//! its values. A declaration that always reads the same is known for every scene; one that varies
//! within a family is known only for scenes with the same features of that group.

use crate::pieces::{name_of, pieces};
use pack::abi::{LightKind, MaterialKind, SamplerKind, SkyKind, TextureFormat};
use pack::features as bit;
use shaders::{FeatureSet, NodeLayout, Windows};
use std::collections::{BTreeMap, BTreeSet};
use std::error::Error;
use std::fmt::Write as _;

/// A family: the feature bits that vary, and every member with its bits.
struct Family {
    mask: u64,
    members: Vec<(u64, FeatureSet)>,
}

/// Feature bits are long numbers.
const GENERATED: &str = "#[allow(clippy::unreadable_literal, reason = \"generated\")]\n";

/// Index of the family of [`materials`].
const MATERIALS: usize = 0;
/// Index of the family of [`media`].
const MEDIA: usize = 1;

/// Texts of a declaration, each with the (family, bits) in which it occurs.
type Texts = BTreeMap<String, BTreeSet<(usize, u64)>>;

/// Rust source of `KNOWN: &[Known]`, sorted by text, and of `SWITCHES: &[Switch]`.
pub(crate) fn table() -> Result<String, Box<dyn Error>> {
    let families = [
        materials(),
        media(),
        geometry(),
        views(),
        formats(),
        asked(),
        normals(),
        samplers(),
        tints(),
        choices(),
        layers(),
        motion(),
        instances(),
        layouts(),
    ];
    let mut declarations: BTreeMap<String, Texts> = BTreeMap::new();
    for (f, family) in families.iter().enumerate() {
        for (bits, features) in &family.members {
            for (name, text) in declarations_of(features)? {
                declarations.entry(name).or_default().entry(text).or_default().insert((f, *bits));
            }
        }
    }
    let mut rows: BTreeSet<(String, String)> = readers()?;
    let mut switching = Vec::new();
    for (name, texts) in &declarations {
        if name.ends_with("_word") {
            continue;
        }
        rows.extend(rows_of(name, texts, &families)?);
        let varying = varying(texts, families.len());
        if varying.first() == Some(&MATERIALS) {
            switching.push(name.clone());
        }
    }
    let mut source = format!("{GENERATED}static KNOWN: &[Known] = &[\n");
    for (text, condition) in rows {
        writeln!(source, "    Known {{ text: {text:?}, condition: {condition} }},")?;
    }
    source.push_str("];\n");
    source += &switches(&switching)?;
    Ok(source)
}

/// The families in which a declaration has several texts.
fn varying(texts: &Texts, n_families: usize) -> Vec<usize> {
    let varies = |f: &usize| {
        texts.values().filter(|places| places.iter().any(|place| place.0 == *f)).count() > 1
    };
    (0..n_families).filter(varies).collect()
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
    let varying = varying(texts, families.len());
    // Where kinds of scattering differ, a point in a medium is one of them.
    let ([family] | [family @ MATERIALS, MEDIA]) = *varying.as_slice() else {
        let masks: Vec<u64> = varying.iter().map(|f| families[*f].mask).collect();
        return Err(format!("`{name}` depends on several groups of features: {masks:#x?}").into());
    };
    let mask = literal(families[family].mask);
    let mut rows = Vec::new();
    for (text, places) in texts {
        for (_, bits) in places.iter().filter(|place| place.0 == family) {
            let bits = literal(*bits);
            let condition = format!("Condition::Features {{ mask: {mask}, bits: {bits} }}");
            rows.push((text.clone(), condition));
        }
    }
    Ok(rows)
}

/// Hexadecimal Rust source, in groups of four digits.
fn literal(bits: u64) -> String {
    let digits = format!("{bits:x}");
    let first = digits.len() % 4;
    let (head, tail) = digits.split_at(first);
    let groups = tail.as_bytes().chunks(4).map(|group| String::from_utf8_lossy(group).into_owned());
    let all: Vec<String> =
        Some(head.to_owned()).filter(|head| !head.is_empty()).into_iter().chain(groups).collect();
    format!("0x{}", all.join("_"))
}

/// Name and text of every declaration of a kernel.
fn declarations_of(features: &FeatureSet) -> Result<Vec<(String, String)>, Box<dyn Error>> {
    let linked = shaders::link(features)?;
    let pieces = pieces(&linked.text).map_err(|line| format!("line {line} is not plain text"))?;
    pieces
        .into_iter()
        .map(|(_, text)| {
            Ok((name_of(text).ok_or("a declaration without a name")?.to_owned(), text.to_owned()))
        })
        .collect()
}

/// Every subset of `all`.
fn subsets<T: Copy + Ord>(all: &[T]) -> Vec<BTreeSet<T>> {
    (0..1_u32 << all.len())
        .map(|bits| {
            all.iter().enumerate().filter(|(i, _)| bits >> i & 1 == 1).map(|(_, t)| *t).collect()
        })
        .collect()
}

/// The name of its tag in the kernel: `MATERIAL_DIFFUSE`.
fn tag_name(kind: MaterialKind) -> String {
    let mut name = "MATERIAL".to_owned();
    for c in format!("{kind:?}").chars() {
        if c.is_ascii_uppercase() {
            name.push('_');
        }
        name.push(c.to_ascii_uppercase());
    }
    name
}

/// Materials, and media that scatter: whatever has a case of its own where light is scattered.
fn materials_mask() -> u64 {
    MaterialKind::ALL.into_iter().map(bit::material).sum::<u64>() | bit::SCATTERING
}

/// No material, and each alone: these dispatch without a `switch`.
fn materials() -> Family {
    let clear = FeatureSet { scattering: false, ..FeatureSet::full() };
    let none = FeatureSet { materials: BTreeSet::new(), ..clear.clone() };
    let mut members = vec![(0, none)];
    members.extend(MaterialKind::ALL.into_iter().map(|kind| {
        (bit::material(kind), FeatureSet { materials: [kind].into(), ..clear.clone() })
    }));
    Family { mask: materials_mask(), members }
}

/// Media, fog, and what shadow rays go through.
fn media() -> Family {
    let mut members = Vec::new();
    for (media, scattering) in [(false, false), (true, false), (true, true)] {
        let behind = [(false, false), (true, false), (true, true)];
        let both = behind.map(|behind| [(false, behind), (true, behind)]);
        for (fog, (through, sheets)) in both.into_iter().flatten() {
            let rows = [
                (media, bit::MEDIA),
                (scattering, bit::SCATTERING),
                (fog, bit::FOG),
                (through, bit::THROUGH),
                (sheets, bit::SHEETS),
            ];
            let bits = rows.iter().filter(|row| row.0).map(|row| row.1).sum();
            let features =
                FeatureSet { media, scattering, fog, through, sheets, ..FeatureSet::full() };
            members.push((bits, features));
        }
    }
    Family { mask: bit::MEDIA | bit::SCATTERING | bit::FOG | bit::THROUGH | bit::SHEETS, members }
}

/// Rust source of `SWITCHES: &[Switch]`: the functions that switch over the kinds of materials. With
/// two kinds or more their text is the head, the cases of those kinds that have one, the foot; there are far too
/// many subsets to list their texts.
fn switches(switching: &[String]) -> Result<String, Box<dyn Error>> {
    let full = declarations_of(&FeatureSet::full())?;
    let mut source = format!("{GENERATED}static SWITCHES: &[Switch] = &[\n");
    for name in switching {
        let text = &full.iter().find(|(known, _)| known == name).ok_or("no such function")?.1;
        let at = |part: &str| text.find(part).ok_or(format!("`{name}` has no `{part}`"));
        let (first, last) = (at("        case ")?, at("        default:")?);
        let (head, foot) = (&text[..first], &text[last..]);
        let mut cases = Vec::new();
        for line in text[first..last].split_inclusive('\n') {
            if line.contains("case PHASE_KIND:") {
                cases.push(format!("({}, {line:?})", literal(bit::SCATTERING)));
                continue;
            }
            let of = |kind: &MaterialKind| line.contains(&format!("case {}:", tag_name(*kind)));
            let kind = MaterialKind::ALL.into_iter().find(of);
            let kind = kind.ok_or_else(|| format!("`{name}` has a case of no kind: {line}"))?;
            cases.push(format!("({}, {line:?})", literal(bit::material(kind))));
        }
        let cases = cases.join(", ");
        writeln!(
            source,
            "    Switch {{ name: {name:?}, head: {head:?}, cases: &[{cases}], foot: {foot:?} }},"
        )?;
    }
    source.push_str("];\n");
    Ok(source)
}

/// What materials ask of a surface point. Tangents depend on the shapes too.
fn asked() -> Family {
    let members = [(0, false), (bit::OBJECTS, true)].into_iter();
    let members = members
        .map(|(bits, objects)| (bits, FeatureSet { objects, ..FeatureSet::full() }))
        .collect();
    Family { mask: bit::OBJECTS, members }
}

/// Layers of principled surfaces.
fn layers() -> Family {
    let bits = [bit::PRINCIPLED_SPECULAR, bit::PRINCIPLED_COAT, bit::PRINCIPLED_TRANSMISSION];
    let member = |rows: BTreeSet<u64>| {
        let [principled_specular, principled_coat, principled_transmission] =
            bits.map(|bit| rows.contains(&bit));
        let full = FeatureSet::full();
        let features =
            FeatureSet { principled_specular, principled_coat, principled_transmission, ..full };
        (rows.iter().sum(), features)
    };
    Family { mask: bits.iter().sum(), members: subsets(&bits).into_iter().map(member).collect() }
}

/// What tilts shading normals.
fn normals() -> Family {
    let members = [(0, false), (bit::NORMAL_MAPS, true)].into_iter();
    let members = members
        .map(|(bits, normal_maps)| (bits, FeatureSet { normal_maps, ..FeatureSet::full() }))
        .collect();
    Family { mask: bit::NORMAL_MAPS, members }
}

/// Whether anything moves.
fn motion() -> Family {
    let members = [(0, false), (bit::MOTION, true)].into_iter();
    let members =
        members.map(|(bits, motion)| (bits, FeatureSet { motion, ..FeatureSet::full() })).collect();
    Family { mask: bit::MOTION, members }
}

/// Whether meshes have instances.
fn instances() -> Family {
    let member = |instances| {
        let bits = if instances { bit::INSTANCES } else { 0 };
        (bits, FeatureSet { instances, ..FeatureSet::full() })
    };
    Family { mask: bit::INSTANCES, members: [false, true].map(member).into() }
}

/// How nodes are stored.
fn layouts() -> Family {
    let members = [(0, NodeLayout::Binary), (bit::WIDE_NODES, NodeLayout::Wide)];
    let member =
        |(bits, layout)| (bits, FeatureSet { layouts: [layout].into(), ..FeatureSet::full() });
    Family { mask: bit::WIDE_NODES, members: members.map(member).into() }
}

fn skies_and_lens() -> Vec<(u64, FeatureSet)> {
    let of = |sky: &SkyKind| match sky {
        SkyKind::Constant => bit::SKY_CONSTANT,
        SkyKind::Gradient => bit::SKY_GRADIENT,
        SkyKind::Image => bit::SKY_IMAGE,
    };
    let mut members = Vec::new();
    for lens in [false, true] {
        for skies in subsets(&SkyKind::ALL) {
            let bits = skies.iter().map(of).sum::<u64>() | if lens { bit::LENS } else { 0 };
            members.push((bits, FeatureSet { lens, skies, ..FeatureSet::full() }));
        }
    }
    members
}

/// Tinted lights.
fn tints() -> Family {
    let member =
        |tint| (if tint { bit::TINT } else { 0 }, FeatureSet { tint, ..FeatureSet::full() });
    Family { mask: bit::TINT, members: [false, true].map(member).into() }
}

/// Several lights, and the tree of lights.
fn choices() -> Family {
    let member = |(light_choice, light_tree)| {
        let choice = if light_choice { bit::LIGHT_CHOICE } else { 0 };
        let tree = if light_tree { bit::LIGHT_TREE } else { 0 };
        (choice | tree, FeatureSet { light_choice, light_tree, ..FeatureSet::full() })
    };
    let mask = bit::LIGHT_CHOICE | bit::LIGHT_TREE;
    Family { mask, members: [(false, false), (true, false), (true, true)].map(member).into() }
}

fn views() -> Family {
    let mask = bit::SKY_CONSTANT | bit::SKY_GRADIENT | bit::SKY_IMAGE | bit::LENS;
    Family { mask, members: skies_and_lens() }
}

const FORMATS: [(TextureFormat, u64); 3] = [
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

fn samplers() -> Family {
    let members = SamplerKind::ALL.map(|kind| {
        let bits = if kind == SamplerKind::Pcg { bit::SAMPLER_PCG } else { 0 };
        (bits, FeatureSet { samplers: [kind].into(), ..FeatureSet::full() })
    });
    Family { mask: bit::SAMPLER_PCG, members: members.into() }
}

/// Shapes, lights, cut-outs, and whether there are textures at all. Any formats of textures stand
/// for all: their own family covers them.
fn geometry() -> Family {
    let of = |kind: &LightKind| match kind {
        LightKind::Sphere => bit::LIGHT_SPHERE,
        LightKind::Rectangle => bit::LIGHT_RECTANGLE,
        LightKind::Triangle => bit::LIGHT_TRIANGLE,
        LightKind::Sky => bit::LIGHT_SKY,
    };
    let format_bits: Vec<u64> =
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
        for (textures, alpha_clip, tangents) in [
            (false, false, false),
            (true, false, false),
            (true, true, false),
            (false, false, true),
            (true, false, true),
            (true, true, true),
        ] {
            for lights in subsets(&LightKind::ALL) {
                let mut bits = lights.iter().map(of).sum::<u64>();
                bits |= if triangles { bit::TRIANGLES } else { 0 };
                bits |= if spheres { bit::SPHERES } else { 0 };
                bits |= if alpha_clip { bit::ALPHA_CLIP } else { 0 };
                bits |= if tangents { bit::TANGENTS } else { 0 };
                let possible = lights.iter().all(|kind| match kind {
                    LightKind::Sphere => spheres,
                    LightKind::Rectangle | LightKind::Triangle => triangles,
                    LightKind::Sky => triangles || spheres,
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
                    tangents,
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
        | bit::LIGHT_SKY
        | bit::ALPHA_CLIP
        | bit::TANGENTS
        | FORMATS.iter().map(|row| row.1).sum::<u64>();
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
