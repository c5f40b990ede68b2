//! All estimators of one picture agree: light samples only, BSDF samples only, both with the
//! balance heuristic, each with and without Russian roulette, in `f32` and in `f64`.
//!
//! Image means over independent seeds; all pairs within four standard errors of their difference.

use pack::Pack;
use runtime::Precision;
use tests::console;
use tests::picture::{self, Estimate};
use tests::scene;

/// A room with every kind of light and of scattering that all three estimators can see: lights are
/// large, so that finding them by chance takes no forever.
const ROOM: &str = "rts 1
material white: diffuse { color = linear(0.7) }
material brass: metal { color = linear(0.8, 0.6, 0.3), fuzz = 0.4 }
material paint: principled { color = linear(0.2, 0.4, 0.7), roughness = 0.5 }
material lamp: emissive { color = linear(1, 0.9, 0.8), strength = 3 }
instance floor { shape = rectangle(size: (4, 4)m), material = white }
instance back {
  shape = rectangle(size: (4, 4)m)
  material = paint
  rotate = (90, 0, 0)deg
  at = (0, 2, -2)m
}
instance ceiling { shape = rectangle(size: (4, 4)m), material = white, at = (0, 4, 0)m }
instance panel { shape = rectangle(size: (1.6, 1.6)m), material = lamp, at = (0, 3.9, 0)m }
instance ball { shape = sphere(radius: 70cm), material = brass, at = (-0.8, 0.7, 0)m }
instance glow { shape = sphere(radius: 40cm), material = lamp, at = (1.2, 0.4, 0.3)m }
sky dim: constant { color = linear(0.2) }
camera eye: perspective { from = (0, 1.6, 5)m, to = (0, 1.4, 0)m, fov.vertical = 45deg }
film f { size = (24, 24)px }
render main: path { camera = eye, film = f, samples = 64, depth = 64, seed = 1 }
";

const SEEDS: u32 = 8;

#[test]
fn all_estimators_agree() {
    let mut found: Vec<(String, Estimate)> = Vec::new();
    // Independent seeds for each estimator: equal ones would hide differences.
    let mut first_seed = 1000;
    for (roulette, depth) in [("roulette", None), ("no roulette", Some(64))] {
        let mut compiled = scene::compile(ROOM);
        if let Some(depth) = depth {
            compiled.lowered.render.roulette_depth = depth;
        }
        let bytes = scene::bytes(&compiled);
        for (name, estimator) in [("both", 0), ("light samples", 1), ("bsdf samples", 2)] {
            for precision in [Precision::F32, Precision::F64] {
                if precision == Precision::F64 && depth.is_some() {
                    continue;
                }
                let means: Vec<f64> = (0..SEEDS)
                    .map(|seed| {
                        let pack = Pack::from_bytes(bytes.clone()).expect("valid");
                        let outcome = picture::cpu(pack, |job| {
                            job.estimator = estimator;
                            job.precision = precision;
                            job.seed = first_seed + seed;
                        });
                        Estimate::of(&picture::channel(outcome.film(), 1)).mean
                    })
                    .collect();
                first_seed += 1000;
                let label = format!("{name}, {roulette}, {}", precision.name());
                let estimate = Estimate::of(&means);
                console::line(&format!(
                    "{label:<36} {:.5} +- {:.5}",
                    estimate.mean, estimate.error
                ));
                found.push((label, estimate));
            }
        }
    }
    for (i, (a_name, a)) in found.iter().enumerate() {
        for (b_name, b) in &found[..i] {
            let z = (a.mean - b.mean) / a.error.hypot(b.error);
            assert!(z.abs() < 4.0, "{a_name} and {b_name}: z = {z:.2}");
        }
    }
}
