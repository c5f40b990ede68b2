//! The walk that is written by hand for the CPU, and the kernels that render several pixels at a time, find what the
//! generated scalar kernel finds, bit for bit, and trace as many rays: with everything that a ray can meet.

use compiler::bvh::{Layout, Preset};
use pack::Pack;
use pack::abi::{Instance, Material, material_flag};
use rayon::prelude::*;
use runtime::CpuWay;
use tests::features::{CASES, Case, compiled, named};
use tests::{picture, scene};

/// What differs between the ways to render on a CPU, in a line.
fn difference(name: &str, bytes: &[u8]) -> Option<String> {
    let ways = [(true, 16), (true, 8), (true, 1), (false, 16), (false, 1)];
    let outcomes = ways.map(|(by_hand, lanes)| {
        let pack = Pack::from_bytes(bytes.to_vec()).expect("what was written can be read");
        picture::cpu(pack, |job| job.way = CpuWay { by_hand, lanes })
    });
    let bits = |outcome: &runtime::Outcome| -> Vec<[u64; 3]> {
        outcome.film().means().iter().map(|rgb| rgb.map(f64::to_bits)).collect()
    };
    let plain = &outcomes[4];
    ways.iter().zip(&outcomes).find_map(|(way, outcome)| {
        let differ = bits(outcome).iter().zip(&bits(plain)).filter(|(a, b)| a != b).count();
        let counters = [outcome, plain].map(|outcome| outcome.film().counters);
        let same = differ == 0 && counters[0] == counters[1];
        (!same).then(|| format!("{name}, {way:?}: {differ} pixels differ, {counters:?}"))
    })
}

fn has_wide_nodes(case: &Case) -> bool {
    !compiled(case).lowered.wide_nodes.is_empty()
}

#[test]
fn all_ways_give_the_same_bits_for_every_feature() {
    let cases: Vec<&Case> = CASES.iter().collect();
    let trees = cases.iter().filter(|case| has_wide_nodes(case)).count();
    assert!(trees > CASES.len() / 2, "{trees} cases have a tree");
    let check = |case: &&Case| difference(case.name, &scene::bytes(&compiled(case)));
    let found: Vec<String> = cases.par_iter().filter_map(check).collect();
    assert!(found.is_empty(), "{}", found.join("\n"));
}

/// What the walk leaves to generated functions is in the cases: cut-outs, motion, spheres, shadow rays that go on.
#[test]
fn the_cases_have_what_is_rare_in_a_tree() {
    for feature in [
        "alpha clipping",
        "partial coverage",
        "motion",
        "spheres",
        "triangles",
        "see-through sheets",
    ] {
        let has = |case: &&Case| {
            let pack = Pack::from_bytes(scene::bytes(&compiled(case))).expect("readable");
            pack::features::names(pack.features()).contains(&feature)
        };
        let n = CASES.iter().filter(|case| has_wide_nodes(case)).filter(has).count();
        assert!(n > 1, "{n} cases with {feature}");
    }
}

/// More sheets one behind the other than a walk keeps, some of them in the same place, some on spheres.
#[test]
fn a_shadow_ray_through_many_sheets_meets_them_in_order() {
    let text = "rts 1
light lamp: sphere { center = (0.3, 6, 0.2)m, radius = 40cm, strength = 300 }
material pane: principled { color = linear(0.9, 0.95, 1), transmission = 1, roughness = 0 }
material floor: diffuse { color = linear(0.5) }
instance ground { shape = rectangle(size: (6, 6)m), material = floor }
instance sheet[i in 0..20] { shape = rectangle(size: (4, 4)m), material = pane, at = (0, 1.5 + 0.1 * floor(i / 2), 0)m }
instance bubble[i in 0..4] { shape = sphere(radius: 30cm), material = pane, at = (0.3 * i, 1 + 0.5 * i, 0)m }
camera eye: perspective { from = (0, 0.8, 4)m, to = (0, 0.2, 0)m, fov.vertical = 40deg }
film tiny { size = (32, 32)px }
render main: path { samples = 16, depth = 6 }
";
    let bytes = scene::bytes(&scene::compile(text));
    assert_eq!(difference("many sheets", &bytes), None);
    let pack = Pack::from_bytes(bytes).expect("readable");
    let lit = picture::cpu(pack, |_| {}).film().means().iter().filter(|rgb| rgb[1] > 0.0).count();
    assert!(lit > 300, "{lit} pixels have light");
}

/// A mesh that is stored once and looks otherwise in some of its places: plain, cut out, and letting light through.
#[test]
fn what_an_instance_is_made_of_counts_and_not_its_mesh() {
    let folder = tempfile::tempdir().expect("a temporary directory can be made");
    std::fs::write(folder.path().join("globe.obj"), globe()).expect("it can be written");
    let text = "rts 1
sky day: constant { color = linear(0.3) }
light lamp: sphere { center = (0.3, 6, 0.2)m, radius = 40cm, strength = 300 }
material plain: diffuse { color = linear(0.5) }
material pane: principled { color = linear(0.9, 0.95, 1), transmission = 1, roughness = 0 }
material lace: principled { color = linear(0.4, 0.7, 0.3), alpha = checker(8, 8), alpha.clip = 50% }
asset globe = obj(\"globe.obj\", unit: m, up: +y)
instance ground { shape = rectangle(size: (9, 9)m), material = plain }
instance a[i in 0..4] { shape = globe, material = plain, at = (i - 1.5, 0.5, -1)m, scale = 0.5 }
instance b[i in 0..4] { shape = globe, material = lace, at = (i - 1.5, 0.5, 1)m, scale = 0.5 }
instance c[i in 0..4] { shape = globe, material = pane, at = (i - 1.5, 1.5, 0)m, scale = 0.5 }
camera eye: perspective { from = (0, 2, 5)m, to = (0, 0.6, 0)m, fov.vertical = 50deg }
film tiny { size = (48, 32)px }
render main: path { samples = 16, depth = 6 }
";
    let bytes = scene::bytes(&scene::compile_in(folder.path(), text));
    assert_eq!(difference("instances of three materials", &bytes), None);
    let pack = Pack::from_bytes(bytes).expect("readable");
    let instances: &[Instance] = pack.records();
    let materials: &[Material] = pack.records();
    for flag in [material_flag::ALPHA_CLIP, material_flag::THROUGH] {
        let has =
            |i: &Instance| materials.get(i.material as usize).is_some_and(|m| m.flags & flag != 0);
        assert!(instances.iter().filter(|i| has(i)).count() > 1, "{flag}");
    }
}

/// A sphere of triangles with texture coordinates, as OBJ.
fn globe() -> String {
    let (columns, rows) = (24_u16, 12_u16);
    let corner = |row: u16, column: u16| {
        let (u, v) = (f32::from(column) / f32::from(columns), f32::from(row) / f32::from(rows));
        let (sin, cos) = (std::f32::consts::TAU * u).sin_cos();
        let (r, y) = (std::f32::consts::PI * v).sin_cos();
        format!("v {} {y} {}\nvt {u} {v}\n", r * cos, r * sin)
    };
    let square = |row: u16, column: u16| {
        let a = 1 + row * (columns + 1) + column;
        let (b, c, d) = (a + 1, a + columns + 1, a + columns + 2);
        format!("f {a}/{a} {b}/{b} {d}/{d}\nf {a}/{a} {d}/{d} {c}/{c}\n")
    };
    let corners = (0..=rows).flat_map(|row| (0..=columns).map(move |column| corner(row, column)));
    let squares = (0..rows).flat_map(|row| (0..columns).map(move |column| square(row, column)));
    corners.chain(squares).collect()
}

/// A scene with a binary tree has no other walk.
#[test]
fn binary_nodes_are_walked_by_the_kernel() {
    let text = "rts 1
sky day: constant { color = linear(1) }
material m: diffuse { color = linear(0.5) }
instance s { shape = box(size: (1, 1, 1)m), material = m }
instance t { shape = sphere(radius: 40cm), material = m, at = (1, 0.4, 0.3)m }
camera eye: perspective { from = (0, 1.5, 5)m, to = (0, 0.8, 0)m, fov.vertical = 40deg }
film tiny { size = (32, 32)px }
render main: path { camera = eye, film = tiny, samples = 16, depth = 6, seed = 1 }
";
    let build = |layout| scene::compile_built("".as_ref(), text, Preset::Default, layout);
    let films = Layout::ALL.map(|layout| {
        let bytes = scene::bytes(&build(layout));
        assert_eq!(difference(layout.name(), &bytes), None);
        let pack = Pack::from_bytes(bytes).expect("readable");
        picture::cpu(pack, |_| {}).film().means()
    });
    assert!(films[0] == films[1]);
    assert!(has_wide_nodes(named("all")));
}
