//! Pictures of scenes with meshes that are stored once, and of the same scenes with triangles in the world.

use std::fmt::Write as _;

use compiler::bvh::Layout;
use compiler::lower::Instancing;
use compiler::pipeline::Compiled;
use pack::{Checked, Pack};
use tests::features::{CASES, Case, shared};
use tests::{console, picture, scene};

fn pack_of(compiled: &Compiled) -> Pack<Checked> {
    Pack::from_bytes(scene::bytes(compiled)).expect("what was written can be read")
}

fn both(case: &Case) -> [Compiled; 2] {
    [Instancing::Auto, Instancing::Never].map(|how| shared(case, how, Layout::default()))
}

fn with_instances() -> impl Iterator<Item = &'static Case> {
    CASES.iter().filter(|case| case.name.contains("instances") && !case.name.contains("mirrored"))
}

/// The same paths in both, but for those that rounding sends another way, and for those that meet partial coverage,
/// whose numbers come from the ids of corners: the means of most pixels agree to rounding, and those of all pixels
/// as estimates of the same picture do.
#[test]
fn instances_look_like_triangles_in_the_world() {
    for case in with_instances() {
        let [one, flat] = both(case);
        let (n, places) = (&one.lowered.counters, flat.lowered.counters.triangles);
        assert!(
            n.instances >= 4 && n.shown == places && n.triangles < places,
            "{}: {n:?}",
            case.name
        );
        assert!(flat.lowered.instances.is_empty());
        let chosen = |scene: &Compiled| {
            scene.lowered.lights.iter().map(|l| (l.kind, l.pmf.to_bits())).collect::<Vec<_>>()
        };
        assert_eq!(chosen(&one), chosen(&flat), "{}: lights are chosen alike", case.name);
        let [a, b] = [&one, &flat].map(|scene| {
            let outcome = picture::cpu(pack_of(scene), |job| {
                job.samples = runtime::SampleRange { start: 0, end: 64 };
            });
            assert_eq!(outcome.film().counters.bad, 0, "{}", case.name);
            picture::channel(outcome.film(), 1)
        });
        let close = |(a, b): &(&f64, &f64)| (*a - *b).abs() <= 1e-3 * (a.abs() + b.abs());
        let same = a.iter().zip(&b).filter(close).count() as f64 / a.len() as f64;
        let mean = |p: &[f64]| p.iter().sum::<f64>() / p.len() as f64;
        let off = mean(&a) / mean(&b) - 1.0;
        console::line(&format!(
            "{:<48} {:5.1} % of pixels the same, mean off by {off:+.5}",
            case.name,
            same * 100.0
        ));
        let least = if case.name.contains("partial coverage") { 0.4 } else { 0.5 };
        assert!(same > least && off.abs() < 5e-3, "{}", case.name);
    }
}

/// Wide nodes and binary ones lead to the same hits: the same bits.
#[test]
fn both_layouts_of_nodes_show_the_same_instances() {
    for case in with_instances() {
        let films = Layout::ALL.map(|layout| {
            let scene = shared(case, Instancing::Auto, layout);
            assert_eq!(scene.lowered.nodes.is_empty(), layout == Layout::Wide);
            picture::cpu(pack_of(&scene), |_| {}).film().clone()
        });
        // Where shadow rays go through things, any of several opaque hits may end them.
        assert_eq!(films[0].means(), films[1].means(), "{}", case.name);
    }
}

/// Where surfaces coincide, the first instance is seen, whatever the tree: the picture is that without the others.
#[test]
fn of_instances_in_one_place_the_first_is_seen() {
    let dir = tempfile::tempdir().expect("a temporary directory can be made");
    let mut mesh = String::from("s off\n");
    for j in 0..=16 {
        for i in 0..=16 {
            writeln!(mesh, "v {} {} {}", i - 8, (i * 7 + j * 5) % 4, 8 - j)
                .expect("strings take all");
        }
    }
    for j in 0..16 {
        for i in 0..16 {
            let a = j * 17 + i + 1;
            writeln!(mesh, "f {a} {} {}\nf {a} {} {}", a + 1, a + 18, a + 18, a + 17)
                .expect("strings take all");
        }
    }
    std::fs::write(dir.path().join("hills.obj"), mesh).expect("a mesh can be written");
    let text = |things: &str| {
        format!(
            "rts 1\nsky day: constant {{ color = linear(1) }}\nasset hills = obj(\"hills.obj\", unit: m, up: +y)
material red: diffuse {{ color = linear(0.8, 0.1, 0.1) }}\nmaterial blue: diffuse {{ color = linear(0.1, 0.1, 0.8) }}
{things}camera eye: perspective {{ from = (0, 20, 25)m, to = (0, 0, 0)m, fov.vertical = 40deg }}
film f {{ size = (32, 24)px }}\nrender main: path {{ camera = eye, film = f, samples = 4, depth = 4, seed = 3 }}\n"
        )
    };
    let place = |name: &str, material: &str, x: i32| {
        format!("instance {name} {{ shape = hills, material = {material}, at = ({x}, 0, 0)m }}\n")
    };
    // A third one elsewhere, behind, so that all have the same frame.
    let film = |things: &str, layout: Layout| {
        let how = (Instancing::Auto, layout);
        let compiled = scene::compile_shared(dir.path(), &text(things), how, |_| {});
        assert!(compiled.lowered.instances.len() > 2);
        picture::cpu(pack_of(&compiled), |_| {}).film().clone()
    };
    let others = place("c", "blue", 60) + &place("d", "red", -60);
    let red = film(&(place("a", "red", 0) + &others), Layout::Wide);
    for layout in Layout::ALL {
        let both = film(&(place("a", "red", 0) + &place("b", "blue", 0) + &others), layout);
        let same = red.means() == both.means();
        assert!(same, "{layout}: the second of two equal things is seen");
        let turned = film(&(place("a", "blue", 0) + &place("b", "red", 0) + &others), layout);
        assert_ne!(turned.means(), red.means());
    }
}
