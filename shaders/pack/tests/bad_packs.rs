//! One hand-made bad pack a rule, each with its exact error text.
//!
//! Every case starts from the same valid pack and breaks one thing; hashes, lengths and ids are
//! put right again, so that only the rule in question can fire. Cases of a single wrong word are
//! data: `bad_packs.txt`; those of WIDENODE, MOTION, CAMKEY, LIGHTLNK and VTXCOLOR start from the same pack with these sections. A last test reads the error enums and fails when a rule has no case here.

#![expect(clippy::unwrap_used, reason = "helpers of tests are tests")]

mod common;

use common::{Draft, Scene, fix_render_id, get32, get64, index64, inner, put, put32, put64};
use common::{spheres, triangles};
use pack::abi::{NONE, Node};
use pack::{Kind, Pack, PackError};

/// A mutation and the error it must give.
type Case = (Mutation, &'static str);

/// A change to loose parts.
type Change = fn(&mut Draft);

/// What a case changes.
enum Mutation {
    /// The file as it is.
    Raw(fn(&mut Vec<u8>)),
    /// Header and table; `render_id` is put right afterwards.
    Table(fn(&mut Vec<u8>)),
    /// Loose parts; everything is put right afterwards.
    Parts(Change),
    /// A 32-bit word of a section: section, byte offset, value.
    Word(Kind, usize, u32),
}

use Mutation::{Parts, Raw, Table, Word};

fn error(mutation: &Mutation) -> PackError {
    let scene = match mutation {
        Word(Kind::WIDENODE, ..) => Scene::wide(),
        Word(Kind::MOTION | Kind::CAMERAKEY, ..) => Scene::with_keys(),
        Word(Kind::LIGHTLINK, ..) => Scene::full().and_links(),
        Word(Kind::VERTEXCOLOR, ..) => Scene::full().and_vertex_colors(),
        _ => Scene::full(),
    };
    let mut bytes = scene.bytes();
    match mutation {
        Raw(change) => change(&mut bytes),
        Table(change) => {
            change(&mut bytes);
            fix_render_id(&mut bytes);
        }
        Parts(change) => {
            let mut draft = Draft::new(&bytes);
            change(&mut draft);
            bytes = draft.seal();
        }
        Word(kind, at, value) => bytes = with_word(&bytes, *kind, *at, *value),
    }
    Pack::from_bytes(bytes).expect_err("this pack must be refused")
}

fn with_word(pack: &[u8], kind: Kind, at: usize, value: u32) -> Vec<u8> {
    let mut draft = Draft::new(pack);
    put32(draft.section(kind), at, value);
    draft.seal()
}

fn check(cases: &[Case]) {
    for (index, (mutation, expected)) in cases.iter().enumerate() {
        assert_eq!(error(mutation).to_string(), *expected, "case {index}");
    }
}

/// First byte of entry `index` in the table.
const fn entry(index: usize) -> usize {
    128 + 64 * index
}

// Rows of the full pack's table.
const SKY: usize = 2;
const NODE: usize = 3;
const META: usize = 15;

/// What the table or the header has wrong.
fn header_cases() -> Vec<Case> {
    vec![
        (Raw(Vec::clear), "not a render pack: the first bytes are none, the file is empty"),
        (
            Raw(|b| b.truncate(127)),
            "header: the file ends after 127 bytes, a pack has at least 128",
        ),
        (
            Raw(|b| b.splice(4..6, *b"\n").for_each(drop)),
            "header: the first bytes were altered, perhaps by a transfer in text mode",
        ),
        (Raw(|b| b[12..16].reverse()), "header: byte order tag is 0x04030201, expected 0x01020304"),
        (
            Raw(|b| b[8] = 9),
            "header: format 9, this program reads format 2: compile the scene again: \
             rtc X -o X.pack",
        ),
        (
            Raw(|b| b[54] = 4),
            "header: unknown features 0x0004000000000000: the pack needs a newer program",
        ),
        (Raw(|b| put32(b, 16, 129)), "header: header_len is 129, expected 128"),
        (Raw(|b| put32(b, 20, 65)), "header: entry_len is 65, expected 64"),
        (Raw(|b| put64(b, 24, 1 << 40)), "header: table_off is 1099511627776, expected 128"),
        (Raw(|b| b[56] = 1), "header: reserved field 0 is 1, expected 0"),
        (Raw(|b| b[63] = 1), "header: reserved field 1 is 16777216, expected 0"),
        (
            Raw(|b| put64(b, 40, 1000)),
            "header: the header says 1000 bytes, the file has 65595: bytes follow the pack",
        ),
        (
            Raw(|b| b.truncate(8192)),
            "header: the header says 65595 bytes, the file has 8192: truncated",
        ),
        (Raw(|b| put32(b, 32, 0)), "header: 0 sections, expected 1 to 256"),
        (Raw(|b| put32(b, 32, u32::MAX)), "header: 4294967295 sections, expected 1 to 256"),
        (
            Raw(|b| {
                b.truncate(200);
                put64(b, 40, 200);
            }),
            "header: the section table needs 1152 bytes, the file has 200",
        ),
        (
            Table(|b| {
                b.push(0);
                let len = b.len() as u64;
                put64(b, 40, len);
            }),
            "header: the last section ends at byte 0x1003b, the file at byte 0x1003c",
        ),
        (Raw(|b| b[64] ^= 1), "header: render_id does not match the section table"),
        (Raw(|b| b[entry(NODE) + 48] ^= 1), "header: render_id does not match the section table"),
        (
            Table(|b| b[48] ^= 1),
            "header: features are 0x0200ffe0ff3fffde, but the contents have 0x0200ffe0ff3fffdf",
        ),
        (
            Parts(|d| put64(&mut d.header, 48, 0)),
            "header: features are 0x0000000000000000, but the contents have 0x0200ffe0ff3fffdf",
        ),
    ]
}

#[test]
fn header_rules() {
    check(&header_cases());
}

/// The one text that depends on the records, and so cannot be written down here.
#[test]
fn another_record_layout_is_refused() {
    let mut bytes = Scene::full().bytes();
    let here = pack::layout_id();
    put32(&mut bytes, 36, here ^ 1);
    let text = Pack::from_bytes(bytes).unwrap_err().to_string();
    let expected = format!(
        "header: record layout {:#010x}, this program has {here:#010x}: compile the scene again: \
         rtc X -o X.pack",
        here ^ 1
    );
    assert_eq!(text, expected);
}

/// What a section is called, and of what it says to be made.
fn name_cases() -> Vec<Case> {
    vec![
        (
            Table(|b| put(b, entry(SKY), *b"FOG     ")),
            "section FOG (entry 2): unknown mandatory section: the pack needs a \
             newer program",
        ),
        (
            Table(|b| put(b, entry(META), *b"MELA    ")),
            "section MELA (entry 15): unknown section in format 2.0",
        ),
        (
            Table(|b| b[entry(META)] = 0xff),
            "section 0x20202020415445ff (entry 15): the name is not ASCII",
        ),
        (
            Parts(|d| d.sections.swap(0, 1)),
            "section RENDER (entry 1): out of order: it must come before CAMERA",
        ),
        (
            Parts(|d| {
                let again = d.sections[1].clone();
                d.sections.insert(2, again);
            }),
            "section CAMERA (entry 2): the section is duplicated",
        ),
        (
            Table(|b| put32(b, entry(NODE) + 8, 2)),
            "section NODE (entry 3): version 2, this program reads version 1: compile the scene \
             again: rtc X -o X.pack",
        ),
        (
            Table(|b| put32(b, entry(NODE) + 12, 3)),
            "section NODE (entry 3): flags are 0x3, expected 0x1",
        ),
        (
            Table(|b| put32(b, entry(META) + 12, 1)),
            "section META (entry 15): flags are 0x1, expected 0x0",
        ),
        (
            Table(|b| b[entry(NODE) + 36] = 1),
            "section NODE (entry 3): the reserved field is 0x1, expected 0",
        ),
        (
            Table(|b| put32(b, entry(NODE) + 32, 32)),
            "section NODE (entry 3): element size is 32 bytes, expected 64",
        ),
    ]
}

/// How long a section is, and where.
fn range_cases() -> Vec<Case> {
    vec![
        (
            Parts(|d| d.section(Kind::SKY).clear()),
            "section SKY (entry 2): 0 elements, expected 1 to 1",
        ),
        (
            Parts(|d| d.section(Kind::RENDER).extend([0; 112])),
            "section RENDER (entry 0): 2 elements, expected 1 to 1",
        ),
        (
            Parts(|d| d.section(Kind::SRGBLUT).truncate(16)),
            "section SRGBLUT (entry 13): 1 elements, expected 64 to 64",
        ),
        (
            Parts(|d| d.section(Kind::KERNEL).resize((4 << 20) + 1, b' ')),
            "section KERNEL (entry 14): 4194305 elements, expected 1 to 4194304",
        ),
        (
            Parts(|d| d.section(Kind::META).resize((16 << 20) + 1, 0)),
            "section META (entry 15): 16777217 elements, expected 1 to 16777216",
        ),
        (
            Table(|b| put64(b, entry(NODE) + 40, 1 << 62)),
            "section NODE (entry 3): 4611686018427387904 elements, expected 1 to 268435456",
        ),
        (
            Table(|b| put64(b, entry(NODE) + 24, 191)),
            "section NODE (entry 3): length is 191 bytes, but 3 elements of 64 bytes make 192",
        ),
        (
            Table(|b| put64(b, entry(NODE) + 16, 0x4001)),
            "section NODE (entry 3): offset is 0x4001, expected 0x4000",
        ),
        (
            Table(|b| put64(b, entry(NODE) + 16, 0x3000)),
            "section NODE (entry 3): offset is 0x3000, expected 0x4000",
        ),
        (
            Table(|b| {
                put64(b, entry(NODE) + 24, 64 << 20);
                put64(b, entry(NODE) + 40, 1 << 20);
            }),
            "section NODE (entry 3): 67108864 bytes at 0x4000 reach beyond the end of the file at \
             0x1003b",
        ),
        (Table(|b| b[1152] = 7), "byte 0x480: padding must be zero, found 0x07"),
        (Table(|b| b[0xdfff] = 255), "byte 0xdfff: padding must be zero, found 0xff"),
    ]
}

#[test]
fn section_rules() {
    check(&name_cases());
    check(&range_cases());
}

/// Sections that a newer minor format may have must still add up.
#[test]
fn unknown_sections_are_skipped_only_when_they_add_up() {
    let unknown: [(Change, &str); 4] = [
        (
            |d| put32(d.entry(Kind(*b"FANCY   ")), 12, 2),
            "section FANCY (entry 3): flags are 0x2, expected 0x0",
        ),
        (
            |d| d.section(Kind(*b"FANCY   ")).clear(),
            "section FANCY (entry 3): 0 elements, expected 1 to 18446744073709551615",
        ),
        (
            |d| d.add(3, Kind(*b"FANCY   "), 0, b"again"),
            "section FANCY (entry 4): the section is duplicated",
        ),
        (
            |d| put32(d.entry(Kind(*b"FANCY   ")), 12, 1),
            "section FANCY (entry 3): unknown mandatory section: the pack needs a \
             newer program",
        ),
    ];
    for (change, expected) in unknown {
        let mut draft = Draft::new(&Scene::full().bytes());
        draft.header[10] = 1;
        draft.add(3, Kind(*b"FANCY   "), 0, b"x");
        change(&mut draft);
        assert_eq!(Pack::from_bytes(draft.seal()).unwrap_err().to_string(), expected);
    }
    // 2^62 elements of 4 bytes wrap to length 0.
    let mut draft = Draft::new(&Scene::full().bytes());
    draft.header[10] = 1;
    draft.add(3, Kind(*b"FANCY   "), 0, b"x");
    let mut bytes = draft.seal();
    put32(&mut bytes, entry(3) + 32, 4);
    put64(&mut bytes, entry(3) + 40, 1 << 62);
    put64(&mut bytes, entry(3) + 24, 0);
    assert_eq!(
        Pack::from_bytes(bytes).unwrap_err().to_string(),
        "section FANCY (entry 3): length is 0 bytes, but 4611686018427387904 elements of 4 bytes \
         make 18446744073709551616"
    );
}

/// What several sections together have wrong.
fn relation_cases() -> Vec<Case> {
    vec![
        (
            // Words of zeros are constants.
            Parts(|d| {
                d.section(Kind::TEXEL).extend([0; 6 * 48]);
                put32(d.section(Kind::TEXTURE), 0x60, 9);
            }),
            "TEXEL[30] at byte 0x1e0: kind is one value too many on the stack, which holds 6",
        ),
        (
            Parts(|d| {
                d.section(Kind::TEXEL).extend([0; 62 * 48]);
                put32(d.section(Kind::TEXTURE), 0x60, 65);
            }),
            "TEXTURE[3] at byte 0x60: width is 65, expected 1 to 64",
        ),
        (
            Parts(|d| {
                d.section(Kind::TEXEL).extend([0; 3 * 48]);
                put32(d.section(Kind::TEXTURE), 0x64, 2);
            }),
            "TEXTURE[3] at byte 0x64: height is 2, expected 1 to 1",
        ),
        (Parts(|d| d.remove(Kind::RENDER)), "section RENDER is missing"),
        (Parts(|d| d.remove(Kind::CAMERA)), "section CAMERA is missing"),
        (Parts(|d| d.remove(Kind::KERNEL)), "section KERNEL is missing"),
        (Parts(|d| d.remove(Kind::SRGBLUT)), "section SRGBLUT is missing, a texture is Rgba8Srgb"),
        (Word(Kind::TEXTURE, 8, 1), "section SRGBLUT must be absent, no texture is Rgba8Srgb"),
        (
            Parts(|d| {
                d.remove(Kind::TEXTURE);
                d.remove(Kind::SRGBLUT);
            }),
            "section TEXEL must be absent, there are no textures",
        ),
        (
            Parts(|d| d.section(Kind::TRISHADE).truncate(144)),
            "the number of TRISHADE elements is 3, but the number of TRIANGLE elements is 4",
        ),
        (
            Word(Kind::TEXEL, 0x60, 14),
            "the number of VTXCOLOR elements is 0, but the number of TRIANGLE elements is 4",
        ),
        (
            Parts(|d| {
                d.add(6, Kind::VERTEXCOLOR, 1, &[0; 64]);
                put32(d.entry(Kind::VERTEXCOLOR), 32, 16);
            }),
            "section VTXCOLOR must be absent, no texture reads it",
        ),
        (
            Parts(|d| {
                let nodes = d.section(Kind::NODE).clone();
                d.add(4, Kind::WIDENODE, 1, &nodes);
                put32(d.entry(Kind::WIDENODE), 32, 64);
            }),
            "section NODE must be absent, the nodes are wide",
        ),
        (Word(Kind::RENDER, 72, 4), "RENDER.n_lights is 4, but the number of LIGHT elements is 3"),
        (Parts(|d| d.section(Kind::KERNEL)[3] = 0xff), "KERNEL: not UTF-8 at byte 0x3"),
    ]
}

#[test]
fn relation_rules() {
    check(&relation_cases());
}

/// The file `bad_packs.txt`: one wrong word a case.
fn word_cases() -> Vec<Case> {
    let lines = include_str!("bad_packs.txt").lines();
    let mut lines = lines.filter(|line| !line.is_empty() && !line.starts_with('#'));
    let mut cases = Vec::new();
    while let (Some(change), Some(text)) = (lines.next(), lines.next()) {
        let (place, value) = change.split_once(": ").unwrap();
        let (kind, byte) = place.split_once(" 0x").unwrap();
        let kind = pack::SECTIONS.iter().find(|spec| spec.kind.name() == kind).unwrap().kind;
        let byte = usize::from_str_radix(byte, 16).unwrap();
        let text = text.strip_prefix("    ").unwrap();
        cases.push((Word(kind, byte, word(value)), text));
    }
    assert!(lines.next().is_none() && cases.len() > 90, "{} cases", cases.len());
    cases
}

/// A word as the case file writes it.
fn word(text: &str) -> u32 {
    let (kind, value) = text.split_once(' ').unwrap_or((text, ""));
    let pair = || value.split_once('+').map(|(a, b)| (a.parse().unwrap(), b.parse().unwrap()));
    match kind {
        "u32" => value.strip_prefix("0x").map_or_else(
            || value.parse().unwrap(),
            |digits| u32::from_str_radix(digits, 16).unwrap(),
        ),
        "f32" => value.parse::<f32>().unwrap().to_bits(),
        "node" => inner(value.parse().unwrap()),
        "triangles" => pair().map(|(first, count)| triangles(first, count)).unwrap(),
        "spheres" => pair().map(|(first, count)| spheres(first, count)).unwrap(),
        "none" => NONE,
        _ => panic!("unknown type {kind}"),
    }
}

#[test]
fn word_rules() {
    check(&word_cases());
}

/// Trees that take more than one wrong word.
fn tree_cases() -> Vec<Case> {
    vec![
        (
            Parts(|d| {
                let nodes = d.section(Kind::NODE);
                nodes.extend([0; 64]);
                put32(nodes, 64 + 28, triangles(2, 1));
                put32(nodes, 128 + 28, spheres(1, 1));
                put32(nodes, 192 + 12, triangles(3, 1));
                put32(nodes, 192 + 28, spheres(2, 1));
            }),
            "NODE[3] at byte 0xc0: no parent refers to this node",
        ),
        (
            Parts(deep_tree),
            "RENDER[0] at byte 0x0: the tree needs 97 stack entries, at most 96 are allowed",
        ),
    ]
}

/// A chain of 97 inner nodes, each with a sphere to its left, over the four triangles.
fn deep_tree(draft: &mut Draft) {
    let sphere = draft.section(Kind::SPHERE)[..32].to_vec();
    *draft.section(Kind::SPHERE) = sphere.repeat(97);
    let nodes: Vec<Node> = (0..97)
        .map(|index| {
            let right = if index == 96 { triangles(0, 4) } else { inner(index + 1) };
            common::node(spheres(index, 1), right)
        })
        .collect();
    *draft.section(Kind::NODE) = bytemuck::cast_slice(&nodes).to_vec();
    put32(draft.section(Kind::RENDER), 36, 97);
}

#[test]
fn tree_rules() {
    check(&tree_cases());
}

/// A tree at the limit is accepted: one entry less than the case above.
#[test]
fn the_deepest_tree_is_accepted() {
    let mut draft = Draft::new(&Scene::full().bytes());
    deep_tree(&mut draft);
    let nodes = draft.section(Kind::NODE);
    nodes.truncate(96 * 64);
    put32(nodes, 95 * 64 + 28, triangles(0, 4));
    draft.section(Kind::SPHERE).truncate(96 * 32);
    put32(draft.section(Kind::RENDER), 36, 96);
    assert_eq!(Pack::from_bytes(draft.seal()).unwrap().render().stack_need, 96);
}

/// A grid may end up to a step above the box that the parent has.
#[test]
fn a_wide_box_may_reach_one_step_out() {
    let bytes = with_word(&Scene::wide().bytes(), Kind::WIDENODE, 0x70, 0x8080_8081);
    assert_eq!(Pack::from_bytes(bytes).unwrap().render().stack_need, 5);
}

#[test]
fn damage_that_the_rules_allow_is_found_by_the_hashes() {
    for kind in [Kind::TRIANGLE, Kind::META] {
        let mut bytes = Scene::full().bytes();
        let draft = Draft::new(&bytes);
        let at = index64(&draft.sections[draft.find(kind)].0, 16);
        bytes[at] ^= 1;
        let pack = Pack::from_bytes(bytes).unwrap();
        assert_eq!(
            pack.verify_hashes().unwrap_err().to_string(),
            format!("section {kind}: the bytes do not match their hash, the file is damaged")
        );
    }
}

/// Rules of lights and skies, which have tests of their own.
const LIGHTS: [&str; 10] = [
    "Rising",
    "Edge",
    "NotFirst",
    "NotOfSky",
    "NotASky",
    "LightOrder",
    "LightDepth",
    "LightLeaf",
    "Trail",
    "LightLost",
];

/// Rules of instances, likewise.
const INSTANCES: [&str; 6] =
    ["NotInverse", "NoSuchInstance", "SharedInstance", "MeshRoot", "InMesh", "Frame"];

/// Reads the enums: a rule without a bad pack is a rule that nobody has seen fail.
#[test]
fn every_rule_has_a_bad_pack() {
    let cases =
        [header_cases(), name_cases(), range_cases(), relation_cases(), word_cases(), tree_cases()];
    let seen: Vec<String> =
        cases.iter().flatten().map(|(mutation, _)| format!("{:?}", error(mutation))).collect();
    // Shown by tests of their own, here and in `files.rs`, `round_trip.rs`, `bad_skies.rs`, `bad_lights.rs`,
    // `bad_instances.rs` and `changes.rs`.
    let files = ["Io", "File", "NotAFile", "SceneSource", "Manifest", "Hash", "Layout"];
    let changes = ["TooLarge", "Altered", "Length", "Written", "Lost"];
    let elsewhere = [files.as_slice(), &changes, &LIGHTS, &INSTANCES].concat();
    let mut rules = 0;
    let texts = concat!(
        include_str!("../src/error.rs"),
        include_str!("../src/fault/header.rs"),
        include_str!("../src/fault/section.rs"),
        include_str!("../src/fault/element.rs"),
        include_str!("../src/fault/bvh.rs"),
    );
    for line in texts.lines() {
        // Variants are the lines indented by four that begin with a capital letter.
        let Some(rest) = line.strip_prefix("    ") else { continue };
        if !rest.starts_with(|first: char| first.is_ascii_uppercase()) {
            continue;
        }
        let name: String = rest.chars().take_while(char::is_ascii_alphanumeric).collect();
        rules += 1;
        let found = seen.iter().any(|debug| {
            debug.split(|c: char| !c.is_ascii_alphanumeric()).any(|word| word == name)
        });
        assert!(found || elsewhere.contains(&name.as_str()), "no bad pack for {name}");
    }
    assert!(rules > 60, "only {rules} rules found");
}

/// A helper of these tests, tested: offsets and counts are read as they are written.
#[test]
fn the_draft_reads_what_it_writes() {
    let mut bytes = vec![0; 16];
    put64(&mut bytes, 0, u64::MAX - 1);
    put32(&mut bytes, 8, 7);
    assert_eq!((get64(&bytes, 0), get32(&bytes, 8)), (u64::MAX - 1, 7));
}
