//! Every declaration that the linker can emit, with the scenes for which it emits it.
//!
//! The linker is run over families of feature sets; in each family one group of features takes all
//! its values. A declaration that always reads the same is known for every scene; one that varies
//! within a family is known only for scenes with the same features of that group.

use crate::emitted::{Emitted, Group, Texts, declarations_of};
use crate::families::{self, Family, GEOMETRY, MATERIALS, MEDIA};
use pack::abi::MaterialKind;
use pack::features as bit;
use shaders::{FeatureSet, Windows};
use std::collections::{BTreeMap, BTreeSet};
use std::error::Error;
use std::fmt::Write as _;

/// Feature bits are long numbers.
const GENERATED: &str = "#[allow(clippy::unreadable_literal, reason = \"generated\")]\n";

/// Rust source of `KNOWN: &[Known]`, sorted by text, and of `SWITCHES: &[Switch]`.
pub(crate) fn table() -> Result<String, Box<dyn Error>> {
    let families = families::all();
    let mut emitted = Emitted::default();
    for (f, family) in families.iter().enumerate() {
        // Members that differ only in bits follow each other.
        for alike in family.members.chunk_by(|a, b| a.1 == b.1) {
            emitted.add(f, alike)?;
        }
    }
    let mut rows: BTreeSet<(String, String)> = readers()?;
    let mut switching = Vec::new();
    for (name, texts) in emitted.by_name() {
        if name.ends_with("_word") {
            continue;
        }
        rows.extend(rows_of(name, &texts, &families)?);
        let varying = varying(&texts, families.len());
        if varying.first() == Some(&MATERIALS) {
            switching.push(name.to_owned());
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
fn varying(texts: &Texts<'_>, n_families: usize) -> Vec<usize> {
    let varies = |f: &usize| {
        texts.values().filter(|groups| groups.iter().any(|group| group.family == *f)).count() > 1
    };
    (0..n_families).filter(varies).collect()
}

/// The rows of one declaration.
fn rows_of(
    name: &str,
    texts: &Texts<'_>,
    families: &[Family],
) -> Result<Vec<(String, String)>, Box<dyn Error>> {
    let any = |text: &&str| ((*text).to_owned(), "Condition::Any".to_owned());
    if texts.len() == 1 {
        return Ok(texts.keys().map(any).collect());
    }
    let varying = varying(texts, families.len());
    // Where kinds of scattering differ, a point in a medium is one of them.
    let ([family] | [family @ MATERIALS, MEDIA]) = *varying.as_slice() else {
        let masks: Vec<u64> = varying.iter().map(|f| families[*f].mask).collect();
        return Err(format!("`{name}` depends on several groups of features: {masks:#x?}").into());
    };
    let of_family = |groups: &Vec<&Group>| {
        let own = groups.iter().filter(|group| group.family == family);
        own.flat_map(|group| group.bits.iter().copied()).collect::<Vec<u64>>()
    };
    let whole = families[family].mask;
    // Its members are all combinations that there can be, and far too many to list for each text.
    let mask =
        if family == GEOMETRY { decisive(whole, texts.values().map(of_family)) } else { whole };
    let mut rows = Vec::new();
    for (text, groups) in texts {
        let all: BTreeSet<u64> = of_family(groups).into_iter().map(|bits| bits & mask).collect();
        let mask = literal(mask);
        rows.extend(all.into_iter().map(|bits| {
            let bits = literal(bits);
            ((*text).to_owned(), format!("Condition::Features {{ mask: {mask}, bits: {bits} }}"))
        }));
    }
    Ok(rows)
}

/// The bits of `mask` that tell texts apart; `texts` has, for each text, the bits of the members that have it. A family
/// has many members, and most declarations depend on few of its features.
fn decisive(mask: u64, texts: impl Iterator<Item = Vec<u64>>) -> u64 {
    let mut found: BTreeMap<u64, BTreeSet<usize>> = BTreeMap::new();
    for (text, members) in texts.enumerate() {
        for bits in members {
            found.entry(bits).or_default().insert(text);
        }
    }
    let mut decisive = mask;
    for bit in (0..64).map(|shift| 1_u64 << shift).filter(|bit| mask & bit != 0) {
        let same = |(bits, texts): (&u64, &BTreeSet<usize>)| {
            found.get(&(bits ^ bit)).is_none_or(|others| others == texts)
        };
        if found.iter().all(same) {
            decisive &= !bit;
            let kept = std::mem::take(&mut found);
            found.extend(kept.into_iter().map(|(bits, texts)| (bits & !bit, texts)));
        }
    }
    decisive
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
            let of = |kind: &MaterialKind| {
                line.contains(&format!("case MATERIAL_{}:", kind.stem().to_ascii_uppercase()))
            };
            let kind = MaterialKind::ALL.into_iter().find(of);
            let kind = kind.ok_or_else(|| format!("`{name}` has a case of no kind: {line}"))?;
            cases.push(format!("({}, {line:?})", literal(kind.feature())));
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

/// The functions `node_word` and so on, for every number of windows that a device can bind.
fn readers() -> Result<BTreeSet<(String, String)>, Box<dyn Error>> {
    let full = FeatureSet::full();
    let triangles = FeatureSet { spheres: false, textures: BTreeSet::new(), ..full.clone() };
    let triangles =
        FeatureSet { lights: BTreeSet::new(), alpha_clip: false, alpha_blend: false, ..triangles };
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
