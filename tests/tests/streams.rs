//! Every use of random numbers has its own: a feature that draws numbers without being seen leaves the
//! picture as it is, bit for bit, with either sampler.

use compiler::pipeline::Compiled;
use pack::Pack;
use pack::abi::SamplerKind;
use runtime::Film;
use tests::{picture, scene};

/// A ball and a mirror on a floor below the sky, which has no sun and is no light. `more` are declarations,
/// `color` is that of all.
fn text(sampler: SamplerKind, color: f64, more: &str) -> String {
    let sampler = match sampler {
        SamplerKind::Sobol => "sobol",
        SamplerKind::Pcg => "pcg",
    };
    format!(
        "rts 1
sky day: gradient {{ }}
material clay: diffuse {{ color = linear({color}) }}
material steel: metal {{ color = linear({color}), fuzz = 0.2 }}
instance floor {{ shape = rectangle(size: (20, 20)m), material = clay }}
instance ball {{ shape = sphere(radius: 1m), material = clay, at = (-1, 1, 0)m }}
instance mirror {{ shape = sphere(radius: 80cm), material = steel, at = (1, 0.8, 0)m }}
{more}
camera eye: perspective {{ from = (0.5, 1.8, 5)m, to = (0, 0.9, 0)m, fov.vertical = 42deg }}
film small {{ size = (40, 30)px }}
render main: path {{ camera = eye, film = small, samples = 16, depth = 6, seed = 7, sampler = {sampler} }}
"
    )
}

fn film(compiled: &Compiled) -> Film {
    let pack = Pack::from_bytes(scene::bytes(compiled)).expect("what was written can be read");
    picture::cpu(pack, |_| {}).film().clone()
}

fn assert_same_picture(name: &str, a: &Film, b: &Film) {
    let bits =
        |film: &Film| -> Vec<_> { film.sums.iter().map(|rgb| rgb.map(f64::to_bits)).collect() };
    assert!(bits(a) == bits(b), "{name}: the pictures differ");
}

/// Rays through a lens of no size are those of a pinhole: the focus is at distance 1 of the kernel's units,
/// where the two ways to compute them round alike.
#[test]
fn a_lens_leaves_all_other_numbers_alone() {
    for sampler in SamplerKind::ALL {
        let mut compiled = scene::compile(&text(sampler, 0.6, ""));
        let without = film(&compiled);
        compiled.lowered.camera.lens_radius = 1e-30;
        compiled.lowered.camera.focus_distance = 1.0;
        assert_same_picture(&format!("{sampler:?}"), &without, &film(&compiled));
        // The lens is drawn for: a larger one is seen.
        compiled.lowered.camera.lens_radius = 0.01;
        assert_ne!(without.sums, film(&compiled).sums);
    }
}

/// White surfaces survive roulette with certainty; the numbers are drawn all the same.
#[test]
fn roulette_leaves_all_other_numbers_alone() {
    for sampler in SamplerKind::ALL {
        let with_roulette = |color, depth| {
            let mut compiled = scene::compile(&text(sampler, color, ""));
            compiled.lowered.render.roulette_depth = depth;
            film(&compiled)
        };
        let name = format!("{sampler:?}");
        assert_same_picture(&name, &with_roulette(1.0, 1), &with_roulette(1.0, 1024));
        // Grey ones do not.
        assert_ne!(with_roulette(0.6, 1).sums, with_roulette(0.6, 1024).sums);
    }
}

/// A lamp inside an opaque ball lights nothing, but every vertex chooses it and a point on it.
#[test]
fn a_light_leaves_all_other_numbers_alone() {
    let lamp = |at: &str| {
        format!(
            "light bulb: sphere {{ center = {at}, radius = 30cm, color = linear(1), strength = 20 }}"
        )
    };
    for sampler in SamplerKind::ALL {
        let film = |more: &str| film(&scene::compile(&text(sampler, 0.6, more)));
        let (without, hidden) = (film(""), film(&lamp("(-1, 1, 0)m")));
        assert!(hidden.counters.rays > without.counters.rays, "shadow rays are traced");
        assert_same_picture(&format!("{sampler:?}"), &without, &hidden);
        // In the open it is seen.
        assert_ne!(without.sums, film(&lamp("(-1, 3, 0)m")).sums);
    }
}

/// What the tests above rest on: other numbers make another picture.
#[test]
fn samplers_and_seeds_make_different_pictures() {
    let films: Vec<Film> = SamplerKind::ALL
        .into_iter()
        .flat_map(|sampler| [7, 8].map(|seed| (sampler, seed)))
        .map(|(sampler, seed)| {
            let mut compiled = scene::compile(&text(sampler, 0.6, ""));
            compiled.lowered.render.seed = seed;
            film(&compiled)
        })
        .collect();
    for (i, a) in films.iter().enumerate() {
        for b in &films[..i] {
            assert_ne!(a.sums, b.sums);
        }
    }
}
