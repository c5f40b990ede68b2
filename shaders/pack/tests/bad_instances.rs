//! Packs whose instances are broken, one rule a case, and sound ones.

mod common;

use common::sound::assert_sound;
use common::{Draft, Scene, inner, instance, node, put32, spheres, triangles};
use pack::abi::{Instance, MOVES, NONE, Node, OBJECT_OF_INSTANCE, TRI_SMOOTH};
use pack::bvh::stack_need;
use pack::{Kind, Pack, features};
use proptest::prelude::*;

#[test]
fn a_mesh_in_two_places_is_sound() {
    let scene = Scene::with_instances();
    let pack = Pack::from_bytes(scene.bytes()).unwrap();
    assert_eq!(pack.records::<Instance>(), scene.instances);
    assert!(pack.features() & features::INSTANCES != 0);
    assert_eq!(stack_need(&scene.nodes, &scene.instances, inner(0)), 6);
    assert_sound(&pack);
}

/// Bytes of instance `i` from its field at `byte`.
const fn field(i: usize, byte: usize) -> usize {
    112 * i + byte
}

const ROOT: usize = 12;
const MATERIAL: usize = 28;
const OBJECT: usize = 44;
const REACH: usize = 60;
const COL_Y: usize = 80;

type Change = (Kind, usize, u32, &'static str);

/// The word at this byte of the section, and what is said of it.
#[expect(clippy::too_many_lines, reason = "a table")]
fn cases() -> Vec<Change> {
    let instances = Kind::INSTANCE;
    let side = |i: usize, side: usize| 64 * i + side;
    let (left, right) = (12, 28);
    vec![
        (
            instances,
            field(0, 0),
            f32::NAN.to_bits(),
            "INSTANCE[0] at byte 0x0: row_x is NaN, expected a finite number",
        ),
        (
            instances,
            field(1, COL_Y + 4),
            (-0.26_f32).to_bits(),
            "INSTANCE[1] at byte 0x70: row_x and the other rows are not the inverse of the columns: off by 3.8461503e-2",
        ),
        (
            instances,
            field(0, REACH),
            0,
            "INSTANCE[0] at byte 0x3c: reach is 0, expected a finite number greater than 0",
        ),
        (
            instances,
            field(0, MATERIAL),
            99,
            "INSTANCE[0] at byte 0x1c: material is 99, but MATERIAL has 15 elements",
        ),
        (
            instances,
            field(0, OBJECT),
            2,
            "INSTANCE[0] at byte 0x2c: object is 2, but OBJECT has 2 elements",
        ),
        (
            instances,
            field(0, OBJECT),
            MOVES,
            "INSTANCE[0] at byte 0x2c: object is marked as moving, but object 0 is not",
        ),
        (
            instances,
            field(1, OBJECT),
            1,
            "INSTANCE[1] at byte 0x9c: object is marked as static, but object 1 moves",
        ),
        (
            instances,
            field(0, 76),
            1,
            "INSTANCE[0] at byte 0x4c: _pad0 is 0x1, unused fields must be zero",
        ),
        (
            instances,
            field(0, ROOT),
            NONE,
            "INSTANCE[0] at byte 0x0: root is none, an instance shows a node or triangles",
        ),
        (
            instances,
            field(0, ROOT),
            instance(1),
            "INSTANCE[0] at byte 0x0: root is instance 1, an instance shows a node or triangles",
        ),
        (
            instances,
            field(0, ROOT),
            spheres(0, 1),
            "INSTANCE[0] at byte 0x0: root is spheres 0..1, an instance shows a node or triangles",
        ),
        (
            instances,
            field(0, ROOT),
            inner(7),
            "INSTANCE[0] at byte 0x0: root is node 7, but NODE has 7 elements",
        ),
        (
            instances,
            field(0, ROOT),
            inner(0),
            "INSTANCE[0] at byte 0x0: root is node 0, which already has a parent",
        ),
        // Node 6 is a child of node 5, which the other instance shows.
        (
            instances,
            field(0, ROOT),
            inner(6),
            "NODE[5] at byte 0x140: right is node 6, which already has a parent",
        ),
        (
            Kind::NODE,
            side(3, right),
            instance(2),
            "NODE[3] at byte 0xc0: right is instance 2, but INSTANCE has 2 elements",
        ),
        (
            Kind::NODE,
            side(3, right),
            instance(1),
            "NODE[4] at byte 0x100: right is instance 1, which is in another leaf already",
        ),
        (
            Kind::NODE,
            side(6, right),
            instance(0),
            "NODE[6] at byte 0x180: right is instance 0, but the tree of an instance holds triangles",
        ),
        (
            Kind::NODE,
            side(6, left),
            spheres(0, 1),
            "NODE[6] at byte 0x180: left is spheres 0..1, but the tree of an instance holds triangles",
        ),
        (
            Kind::NODE,
            side(1, left),
            triangles(4, 1),
            "NODE[1] at byte 0x40: left is triangles 4..5, of which one belongs to an instance",
        ),
        (
            Kind::TRISHADE,
            48 * 5 + 44,
            TRI_SMOOTH,
            "NODE[6] at byte 0x180: left is triangles 5..7, of which one belongs to no instance, or is a light",
        ),
        (
            Kind::TRISHADE,
            48 * 7 + 40,
            1,
            "NODE[6] at byte 0x180: right is triangles 7..8, of which one belongs to no instance, or is a light",
        ),
        (
            Kind::TRIANGLE,
            48 * 4 + 12,
            MOVES,
            "TRIANGLE[4] at byte 0xcc: id0 is marked as moving, but object 2147483647 is not",
        ),
        (Kind::RENDER, 36, 5, "RENDER[0] at byte 0x0: stack_need is 5, but the tree needs 6"),
    ]
}

#[test]
fn broken_instances_are_refused() {
    let good = Scene::with_instances().bytes();
    let mut wrong = Vec::new();
    for (kind, at, word, expected) in cases() {
        let mut draft = Draft::new(&good);
        put32(draft.section(kind), at, word);
        let found = Pack::from_bytes(draft.seal()).unwrap_err().to_string();
        if found != expected {
            wrong.push(format!("expected: {expected}\nfound:    {found}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn an_instance_in_no_leaf_is_refused() {
    let mut scene = Scene::with_instances();
    scene.instances.push(scene.instances[0]);
    let found = scene.writer().to_bytes().unwrap_err().to_string();
    assert_eq!(found, "INSTANCE[2] at byte 0xe0: no leaf holds this primitive");
}

/// A chain of `n` inner nodes with a sphere each over an instance of a chain of `m` with a triangle each.
fn deep(n: u32, m: u32) -> Scene {
    let mut scene = Scene::with_instances();
    scene.lights.clear();
    scene.render.n_lights = 0;
    scene.instances.truncate(1);
    scene.instances[0].root = inner(n);
    let sphere = scene.spheres[0];
    let (triangle, shade) = (scene.triangles[7], scene.shades[7]);
    scene.spheres = vec![sphere; n as usize];
    scene.triangles = vec![triangle; m as usize + 1];
    scene.shades = vec![shade; m as usize + 1];
    for triangle in &mut scene.triangles {
        (triangle.id0, triangle.id1, triangle.id2) = (0, 1, 2);
    }
    let world =
        (0..n).map(|i| node(spheres(i, 1), if i + 1 == n { instance(0) } else { inner(i + 1) }));
    let mesh = (0..m).map(|i| {
        node(triangles(i, 1), if i + 1 == m { triangles(m, 1) } else { inner(n + i + 1) })
    });
    scene.nodes = world.chain(mesh).collect();
    scene.render.root = inner(0);
    scene.render.stack_need = n + 1 + m;
    scene
}

#[test]
fn the_way_out_counts_for_the_stack() {
    assert_sound(&Pack::from_bytes(deep(48, 47).bytes()).unwrap());
    let found = deep(48, 48).writer().to_bytes().unwrap_err().to_string();
    assert_eq!(
        found,
        "RENDER[0] at byte 0x0: the tree needs 97 stack entries, at most 96 are allowed"
    );
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    /// Whatever word of the sections about instances is changed: refused, or sound.
    #[test]
    fn changed_words_are_refused_or_harmless(
        section in 0..4_usize, at in 0..64_usize, word in prop_oneof![
            any::<u32>(), (0..9_u32).prop_map(inner), (0..3_u32).prop_map(instance),
            (0..9_u32, 1..3_u32).prop_map(|(first, count)| triangles(first, count)),
            Just(NONE), Just(OBJECT_OF_INSTANCE),
        ]
    ) {
        let kind = [Kind::INSTANCE, Kind::NODE, Kind::TRISHADE, Kind::RENDER][section];
        let mut draft = Draft::new(&Scene::with_instances().bytes());
        let bytes = draft.section(kind);
        let at = 4 * (at % (bytes.len() / 4));
        put32(bytes, at, word);
        if let Ok(pack) = Pack::from_bytes(draft.seal()) {
            assert_sound(&pack);
        }
    }
}

/// Sizes that offsets above rely on.
#[test]
fn records_have_the_sizes_that_offsets_say() {
    assert_eq!((size_of::<Instance>(), size_of::<Node>()), (112, 64));
}
