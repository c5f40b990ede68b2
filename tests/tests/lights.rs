//! Many lights and tinted ones: closed forms, and estimators that agree.

use std::fmt::Write as _;
use std::path::Path;

use compiler::lower::Visibility;
use pack::abi::{LIGHT_LEAF, Light, LightNode};
use pack::{Checked, Pack};
use tests::console;
use tests::picture::{self, Estimate, channel};
use tests::scene;

fn pack_in(dir: &Path, text: &str) -> Pack<Checked> {
    Pack::from_bytes(scene::bytes(&scene::compile_in(dir, text))).expect("valid")
}

/// The mean over pixels is `expected`, and known well enough to say so.
fn check(name: &str, pack: Pack<Checked>, samples: u32, expected: f64) {
    let outcome = picture::cpu(pack, |job| {
        job.samples = runtime::SampleRange { start: 0, end: samples };
    });
    let found = Estimate::of(&channel(outcome.film(), 1));
    let z = found.z(expected);
    console::line(&format!(
        "{name:<36} expected {expected:.6} found {:.6} +- {:.6}",
        found.mean, found.error
    ));
    let near = (found.mean - expected).abs() <= 4.0 * found.error + 2e-6 * expected;
    assert!(near && found.error <= 0.003 * expected, "{name}: z = {z:.2}, {found:?}");
}

/// A white floor of which every pixel sees the same point, under `things`.
fn floor(things: &str) -> String {
    format!(
        "rts 1
{things}
material white: diffuse {{ color = linear(1) }}
instance floor {{ shape = rectangle(size: (200, 200)m), material = white }}
camera eye: perspective {{
  from = (-3, 0.5, 0)m
  to = (0, 0, 0)m
  up = (0.1, 0.2, 1)
  fov.vertical = 0.001deg
}}
film f {{ size = (16, 16)px }}
render main: path {{ camera = eye, film = f, samples = 16, depth = 2, seed = 11 }}
"
    )
}

/// A square of side 2 at height 1 that faces down, cut into `2 n^2` triangles.
fn square(n: usize) -> String {
    let mut obj = String::new();
    let at = |k: usize| 2.0 * k as f64 / n as f64 - 1.0;
    for i in 0..=n {
        for j in 0..=n {
            let _ = writeln!(obj, "v {} 1 {}", at(i), at(j));
        }
    }
    let id = |i: usize, j: usize| i * (n + 1) + j + 1;
    for i in 0..n {
        for j in 0..n {
            let (a, b, c, d) = (id(i, j), id(i + 1, j), id(i + 1, j + 1), id(i, j + 1));
            let _ = writeln!(obj, "f {a} {b} {c}\nf {a} {c} {d}");
        }
    }
    obj
}

/// Form factor of a 2x2 square at height 1 over its centre.
const SQUARE: f64 = 0.554_126_424;

#[test]
fn a_hundred_thousand_equal_lights_give_the_light_of_one() {
    let dir = tempfile::tempdir().expect("dir");
    std::fs::write(dir.path().join("square.obj"), square(224)).expect("writable");
    let text = floor(
        "asset square = obj(\"square.obj\", unit: m, up: +y)
material lamp: emissive { color = linear(1), sides = front }
instance panel { shape = square, material = lamp }",
    );
    let pack = pack_in(dir.path(), &text);
    assert_eq!(pack.records::<Light>().len(), 100_352);
    assert_eq!(pack.records::<LightNode>().len(), 200_703);
    check("100,352 triangles in a square", pack, 512, SQUARE);
}

#[test]
fn one_light_among_many_black_or_faint_ones_is_found() {
    let dir = tempfile::tempdir().expect("dir");
    std::fs::write(dir.path().join("square.obj"), square(224)).expect("writable");
    for (name, strength) in [("black", "0"), ("faint", "1e-9")] {
        let text = floor(&format!(
            "asset square = obj(\"square.obj\", unit: m, up: +y)
material lamp: emissive {{ color = linear(1), sides = front }}
material ember: emissive {{ color = linear(1), strength = {strength}, sides = front }}
instance embers {{ shape = square, material = ember, at = (0, 7, 0)m }}
instance panel {{ shape = rectangle(size: (2, 2)m), material = lamp, rotate = (180, 0, 0)deg, at = (0, 1, 0)m }}"
        ));
        let pack = pack_in(dir.path(), &text);
        check(&format!("one light among 100,352 {name} ones"), pack, 512, SQUARE);
    }
}

#[test]
fn a_tint_over_all_directions_is_a_factor() {
    let dir = tempfile::tempdir().expect("dir");
    // Half angle with sine 0.1, overhead: the form factor is 0.01.
    let sun = "light sun: sphere { center = (0, 4, 0)m, radius = 40cm, tint.color = linear(1, 0.65, 0.22), tint.angle = ";
    let with = |angle: &str| pack_in(dir.path(), &floor(&format!("{sun}{angle} }}")));
    check("tinted all over", with("180deg"), 256, 0.0065);
    // The sun itself has a radius of 5.7 degrees.
    check("tinted within 18 degrees", with("18deg"), 256, 0.0065);
    check(
        "tinted in 3 degrees",
        with("3deg"),
        1024,
        0.01 - 0.35 * 3_f64.to_radians().sin().powi(2),
    );
}

#[test]
fn the_camera_sees_the_tint_within_its_angle_only() {
    let dir = tempfile::tempdir().expect("dir");
    let look = |x: f64| {
        let text = format!(
            "rts 1
light sun: sphere {{ direction = (0, 0, -1), distance = 10m, angular_radius = 20deg, strength = 2, tint.color = linear(1, 0.5, 0.25), tint.angle = 10deg }}
camera eye: perspective {{ from = (0, 0, 0)m, to = ({}, 0, -1)m, fov.vertical = 0.1deg }}
film f {{ size = (4, 4)px }}
render main: path {{ camera = eye, film = f, samples = 4, seed = 11 }}
",
            x.to_radians().tan()
        );
        let outcome = picture::cpu(pack_in(dir.path(), &text), |_| {});
        channel(outcome.film(), 1)
    };
    assert!(look(0.0).iter().chain(&look(9.5)).all(|value| (value - 1.0).abs() < 1e-6));
    assert!(look(10.5).iter().chain(&look(19.0)).all(|value| (value - 2.0).abs() < 1e-6));
    assert!(look(20.5).iter().all(|value| *value == 0.0));
}

#[test]
fn estimators_agree_about_tints_and_trees() {
    let dir = tempfile::tempdir().expect("dir");
    std::fs::write(dir.path().join("square.obj"), square(6)).expect("writable");
    let text = "rts 1
asset square = obj(\"square.obj\", unit: m, up: +y)
sky s: gradient { sun.direction = (0.5, 0.4, 0.3), disc.power = 60, strength = 2 }
light sun: sphere { center = (-2, 3, 2)m, radius = 90cm, strength = 4, tint.color = linear(1, 0.2, 0.1), tint.angle = 12deg }
material white: diffuse { color = linear(0.7) }
material brass: metal { color = linear(0.8, 0.6, 0.3), fuzz = 0.4 }
material paint: principled { color = linear(0.2, 0.4, 0.7), roughness = 0.5 }
material lamp: emissive { color = linear(1, 0.9, 0.8), strength = 3, sides = front }
instance floor { shape = rectangle(size: (6, 6)m), material = white }
instance panel { shape = square, material = lamp, at = (0, 1.5, -1)m }
instance block { shape = box(size: (1, 1, 1)m), material = paint, at = (1.3, 0.5, -0.6)m }
instance ball { shape = sphere(radius: 70cm), material = brass, at = (-0.8, 0.7, 0)m }
camera eye: perspective { from = (0, 1.6, 5)m, to = (0, 0.8, 0)m, fov.vertical = 40deg }
film f { size = (24, 24)px }
render main: path { camera = eye, film = f, samples = 96, depth = 16, seed = 1 }
";
    let bytes = scene::bytes(&scene::compile_in(dir.path(), text));
    let pack = Pack::from_bytes(bytes.clone()).expect("valid");
    assert!(!pack.records::<LightNode>().is_empty());
    let mut found: Vec<(&str, Estimate)> = Vec::new();
    for (first, name, estimator) in
        [(1000, "both", 0), (2000, "light samples", 1), (3000, "bsdf samples", 2)]
    {
        let means: Vec<f64> = (0..16)
            .map(|seed| {
                let pack = Pack::from_bytes(bytes.clone()).expect("valid");
                let outcome = picture::cpu(pack, |job| {
                    job.estimator = estimator;
                    job.seed = first + seed;
                });
                Estimate::of(&channel(outcome.film(), 1)).mean
            })
            .collect();
        let estimate = Estimate::of(&means);
        console::line(&format!("{name:<14} {:.5} +- {:.5}", estimate.mean, estimate.error));
        found.push((name, estimate));
    }
    for (k, (a_name, a)) in found.iter().enumerate() {
        for (b_name, b) in &found[..k] {
            let z = (a.mean - b.mean) / a.error.hypot(b.error);
            assert!(z.abs() < 4.0, "{a_name} and {b_name}: z = {z:.2}");
        }
    }
}

/// What a tree takes each light for, over its share of the power: the lamp in the open first, then three lamps
/// in a room of `walls` around (3, 1, 0). The camera is at `from`.
fn counted(walls: &str, from: &str, visibility: Visibility) -> Vec<f32> {
    let dir = tempfile::tempdir().expect("dir");
    let text = format!(
        "rts 1
light a: sphere {{ center = (0, 4, 0)m, radius = 10cm, color = linear(4) }}
light b: sphere {{ center = (3.4, 1, 0)m, radius = 10cm, color = linear(40) }}
light c: sphere {{ center = (2.6, 1.2, 0.3)m, radius = 10cm, color = linear(40) }}
light d: sphere {{ center = (3, 0.6, -0.3)m, radius = 10cm, color = linear(40) }}
material grey: diffuse {{ color = linear(0.5) }}
material glass: dielectric {{ ior = 1.5 }}
material paper: leaf {{ color = linear(0.5) }}
instance floor {{ shape = rectangle(size: (20, 20)m), material = grey }}
{walls}
camera eye: perspective {{ from = {from}m, to = (3, 1, 0)m, fov.vertical = 40deg }}
film f {{ size = (16, 16)px }}
render main: path {{ camera = eye, film = f, samples = 16, depth = 6 }}
"
    );
    let lowered = scene::compile_lit(dir.path(), &text, visibility).lowered;
    let share = |(index, light): (u32, &Light)| {
        let leaf = |node: &&LightNode| node.child == LIGHT_LEAF | index;
        let node = lowered.light_nodes.iter().find(leaf).expect("every light has a leaf");
        node.power / light.pmf
    };
    (0..).zip(&lowered.lights).map(share).collect()
}

/// All shares are powers of two, which are exact.
fn bits(shares: &[f32]) -> Vec<u32> {
    shares.iter().map(|share| share.to_bits()).collect()
}

#[test]
fn lights_that_no_path_finds_count_less() {
    let crate_of = |material: &str| {
        format!(
            "instance crate {{ shape = box(size: (2, 2, 2)m), material = {material}, at = (3, 1.001, 0)m }}"
        )
    };
    let lid = "instance lid { shape = rectangle(size: (2, 2)m), material = grey, at = (3, 2, 0)m }";
    let (outside, inside) = ("(0, 2, 6)", "(2.2, 1.6, 0.7)");
    let (seen, hidden) = (1.0_f32.to_bits(), (1.0_f32 / 128.0).to_bits());
    for (name, walls, from, expected) in [
        ("closed crate", crate_of("grey"), outside, [seen, hidden, hidden, hidden]),
        ("glass crate", crate_of("glass"), outside, [seen; 4]),
        ("paper crate", crate_of("paper"), outside, [seen; 4]),
        ("lid alone", lid.to_owned(), outside, [seen; 4]),
        // What is outside has too little power to matter.
        ("camera in the crate", crate_of("grey"), inside, [seen; 4]),
    ] {
        assert_eq!(bits(&counted(&walls, from, Visibility::Auto)), expected, "{name}");
        assert_eq!(bits(&counted(&walls, from, Visibility::Never)), [seen; 4], "{name}");
    }
}

#[test]
fn hidden_lights_are_the_same_with_any_number_of_threads() {
    let walls =
        "instance crate { shape = box(size: (2, 2, 2)m), material = grey, at = (3, 1.001, 0)m }";
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(|| bits(&counted(walls, "(0, 2, 6)", Visibility::Auto)))
    };
    assert_eq!(with(1), with(3));
}

/// A floor under a faint lamp, with strong ones in a crate beside it, is as bright as without these.
#[test]
fn lights_in_a_closed_crate_change_no_picture() {
    let dir = tempfile::tempdir().expect("dir");
    std::fs::write(dir.path().join("square.obj"), square(2)).expect("writable");
    // The lamp overhead gives `SQUARE`, one behind the camera's back, in a crate, nothing.
    let text = floor(
        "asset square = obj(\"square.obj\", unit: m, up: +y)
material lamp: emissive { color = linear(1), sides = front }
material glare: emissive { color = linear(100), sides = front }
material wall: diffuse { color = linear(0.5) }
instance panel { shape = square, material = lamp }
instance shut { shape = square, material = glare, at = (0, 1, 20)m }
instance crate { shape = box(size: (4, 4, 4)m), material = wall, at = (0, 2.01, 20)m }",
    );
    let compiled = scene::compile_in(dir.path(), &text);
    let nodes = &compiled.lowered.light_nodes;
    assert!(nodes[0].power < 0.02, "{}", nodes[0].power);
    let pack = Pack::from_bytes(scene::bytes(&compiled)).expect("valid");
    check("a crate with strong lamps", pack, 512, SQUARE);
}
