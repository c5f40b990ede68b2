//! The tree of lights, broken in every way that the kernel must not meet.

#![expect(clippy::unwrap_used, reason = "helpers of tests are tests")]

mod common;

use common::{Draft, Scene, put32};
use pack::abi::{LIGHT_LEAF, Light, LightKind, LightNode};
use pack::{Kind, Pack, features};

#[test]
fn a_tree_over_the_lights_is_accepted() {
    let scene = Scene::with_light_tree();
    let pack = Pack::from_bytes(scene.bytes()).unwrap();
    assert_eq!(pack.records::<LightNode>(), scene.light_nodes);
    let of_lights = features::LIGHT_TREE | features::TINT;
    assert_eq!(pack.features() & of_lights, of_lights);
}

fn check(kind: Kind, at: usize, value: u32, expected: &str) {
    let mut draft = Draft::new(&Scene::with_light_tree().bytes());
    put32(draft.section(kind), at, value);
    let found = Pack::from_bytes(draft.seal()).unwrap_err().to_string();
    assert_eq!(found, expected, "{kind} {at:#x}");
}

#[test]
fn every_light_has_one_leaf_at_the_end_of_its_trail() {
    let (node, light) = (Kind::LIGHTNODE, Kind::LIGHT);
    let order = "leads to nodes in another order than first child, second child";
    check(node, 0x28, 1, &format!("LIGHTNOD[1] at byte 0x58: child {order}"));
    check(node, 0x28, 99, &format!("LIGHTNOD[4] at byte 0xe8: child {order}"));
    check(node, 0x28, LIGHT_LEAF | 1, &format!("LIGHTNOD[1] at byte 0x58: child {order}"));
    check(node, 0x88, 3, &format!("LIGHTNOD[3] at byte 0xb8: child {order}"));
    let leaf = |light: u32| {
        format!("is a leaf with light {light}, which is no surface or has a leaf already")
    };
    check(node, 0xe8, LIGHT_LEAF | 1, &format!("LIGHTNOD[4] at byte 0xe8: child {}", leaf(1)));
    check(node, 0xe8, LIGHT_LEAF | 3, &format!("LIGHTNOD[4] at byte 0xe8: child {}", leaf(3)));
    check(node, 0xe8, LIGHT_LEAF | 9, &format!("LIGHTNOD[4] at byte 0xe8: child {}", leaf(9)));
    check(light, 0xbc, 1, "LIGHT[2] at byte 0xbc: trail is 0x1, but the way to its leaf is 0x3");
    check(
        node,
        0x1c,
        0,
        "LIGHTNOD[0] at byte 0x1c: power is 0, expected a finite number greater than 0",
    );
    check(
        node,
        0xc,
        0,
        "LIGHTNOD[0] at byte 0xc: radius2 is 0, expected a finite number greater than 0",
    );
    check(node, 0x14, 0, "LIGHTNOD[0] at byte 0x10: axis has length 0, expected 1");
}

#[test]
fn lights_without_a_leaf_and_trees_deeper_than_a_trail_are_refused() {
    let mut scene = Scene::with_light_tree();
    scene.light_nodes.truncate(3);
    scene.light_nodes[2].child = LIGHT_LEAF;
    let error = scene.writer().to_bytes().unwrap_err().to_string();
    assert_eq!(
        error,
        "LIGHT[2] at byte 0xbc: trail leads nowhere: no leaf of the light tree holds this light"
    );
    // A chain: each node has a leaf first, then the next node.
    let mut scene = Scene::with_light_tree();
    let (inner, leaf) = (scene.light_nodes[0], scene.light_nodes[1]);
    let n_links = 33;
    let link = |k: u32| [LightNode { child: 2 * k + 2, ..inner }, leaf];
    scene.light_nodes = (0..n_links).flat_map(link).chain([leaf]).collect();
    scene.lights = (0..=n_links)
        .map(|k| {
            let trail = if k < 32 { (1 << k) - 1 } else { u32::MAX };
            let share = 1.0 / 64.0;
            let cdf = if k == n_links { 1.0 } else { share };
            pack::abi::Light { trail, cdf, pmf: share, ..scene.lights[0] }
        })
        .collect();
    for (k, node) in scene.light_nodes.iter_mut().filter(|n| n.child & LIGHT_LEAF != 0).enumerate()
    {
        node.child = LIGHT_LEAF | u32::try_from(k).unwrap();
    }
    scene.render.n_lights = n_links + 1;
    scene.sky.as_mut().unwrap().light = pack::abi::NONE;
    scene.sky_table.clear();
    let error = scene.writer().to_bytes().unwrap_err().to_string();
    assert_eq!(error, "LIGHTNOD[64] at byte 0xc28: child leads deeper than 32 levels");
}

/// A directional light, then the three lights of the example.
fn with_directional() -> Scene {
    let mut scene = Scene::full();
    let sun = Light {
        kind: LightKind::Directional as u32,
        origin: [0.0, 1.0, 0.0],
        edge1: [2.0; 3],
        edge2: [1e-5, 0.0, 0.0],
        pmf: 0.25,
        cdf: 0.25,
        ..Light::default()
    };
    for light in &mut scene.lights {
        light.pmf *= 0.75;
        light.cdf = (0.25 + 0.75 * light.cdf).min(1.0);
    }
    scene.lights.insert(0, sun);
    for index in scene.shades.iter_mut().map(|shade| &mut shade.light) {
        *index = if *index == pack::abi::NONE { *index } else { *index + 1 };
    }
    for index in scene.spheres.iter_mut().map(|sphere| &mut sphere.light) {
        *index = if *index == pack::abi::NONE { *index } else { *index + 1 };
    }
    scene.render.n_lights = 4;
    scene
}

#[test]
fn directional_lights_come_first_and_have_a_solid_angle() {
    let scene = with_directional();
    let pack = Pack::from_bytes(scene.bytes()).unwrap();
    assert_ne!(pack.features() & LightKind::Directional.feature(), 0);
    let check = |at: usize, value: f32, expected: &str| {
        let mut draft = Draft::new(&scene.bytes());
        put32(draft.section(Kind::LIGHT), at, value.to_bits());
        assert_eq!(Pack::from_bytes(draft.seal()).unwrap_err().to_string(), expected);
    };
    let above = "expected a finite number greater than 0";
    check(0x20, 0.0, &format!("LIGHT[0] at byte 0x20: edge2 is 0, {above}"));
    check(0x20, 1.5, "LIGHT[0] at byte 0x20: edge2 is 1.5, expected 0 to 1");
    check(0x4, 2.0, "LIGHT[0] at byte 0x0: origin has length 2, expected 1");
    check(0x14, -1.0, "LIGHT[0] at byte 0x10: edge1 is -1, expected a finite number, 0 or more");
    // The first is a sphere, the second directional.
    let mut late = Draft::new(&scene.bytes());
    let lights = late.section(Kind::LIGHT);
    put32(lights, 0x0c, LightKind::Sphere as u32);
    put32(lights, 0x4c, LightKind::Directional as u32);
    put32(lights, 0x44, 1.0_f32.to_bits());
    put32(lights, 0x60, 1e-3_f32.to_bits());
    assert_eq!(
        Pack::from_bytes(late.seal()).unwrap_err().to_string(),
        "LIGHT[1] at byte 0x4c: kind is directional, but the light before it is not"
    );
}
