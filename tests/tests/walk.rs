//! The walk that is written by hand for the CPU finds what the generated one finds, bit for bit, and traces as
//! many rays: with everything that a ray can meet.

use compiler::bvh::{Layout, Preset};
use pack::Pack;
use rayon::prelude::*;
use tests::features::{CASES, Case, compiled, named};
use tests::{picture, scene};

/// What differs between the two walks, in a line.
fn difference(name: &str, bytes: &[u8]) -> Option<String> {
    let [hand, generated] = [true, false].map(|native| {
        let pack = Pack::from_bytes(bytes.to_vec()).expect("what was written can be read");
        picture::cpu(pack, |job| job.native_walk = native)
    });
    let bits = |outcome: &runtime::Outcome| -> Vec<[u64; 3]> {
        outcome.film().means().iter().map(|rgb| rgb.map(f64::to_bits)).collect()
    };
    let differ = bits(&hand).iter().zip(&bits(&generated)).filter(|(a, b)| a != b).count();
    let counters = [&hand, &generated].map(|outcome| outcome.film().counters);
    let same = differ == 0 && counters[0] == counters[1];
    (!same).then(|| format!("{name}: {differ} pixels differ, {counters:?}"))
}

fn has_wide_nodes(case: &Case) -> bool {
    !compiled(case).lowered.wide_nodes.is_empty()
}

#[test]
fn both_walks_give_the_same_bits_for_every_feature() {
    let cases: Vec<&Case> = CASES.iter().filter(|case| has_wide_nodes(case)).collect();
    assert!(cases.len() > CASES.len() / 2, "{} cases have a tree", cases.len());
    let check = |case: &&Case| difference(case.name, &scene::bytes(&compiled(case)));
    let found: Vec<String> = cases.par_iter().filter_map(check).collect();
    assert!(found.is_empty(), "{}", found.join("\n"));
}

/// What the walk leaves to generated functions is in the cases: cut-outs, motion, spheres, shadow rays that go on.
#[test]
fn the_cases_have_what_is_rare_in_a_tree() {
    for feature in ["alpha clipping", "motion", "spheres", "triangles", "see-through sheets"] {
        let has = |case: &&Case| {
            let pack = Pack::from_bytes(scene::bytes(&compiled(case))).expect("readable");
            pack::features::names(pack.features()).contains(&feature)
        };
        let n = CASES.iter().filter(|case| has_wide_nodes(case)).filter(has).count();
        assert!(n > 1, "{n} cases with {feature}");
    }
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
