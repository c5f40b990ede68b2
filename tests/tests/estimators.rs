//! All estimators of one picture agree: light samples only, BSDF samples only, both with the balance
//! and with the power heuristic, each with and without Russian roulette, with Sobol's and with
//! independent samples, in `f32` and, once each, in `f64`.
//!
//! Image means over independent seeds; all pairs within four standard errors of their difference.

use pack::Pack;
use pack::abi::SamplerKind;
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
render main: path { camera = eye, film = f, samples = 16, depth = 64, seed = 1 }
";

/// A floor under petals and panes: light comes to it straight through one or two of them, and scattered.
const SHEETS: &str = "rts 1
material white: diffuse { color = linear(0.7) }
material sakura: petal { color = linear(0.9, 0.8, 0.7), sigma_s = 2/mm, thickness = 0.2mm..0.4mm }
material pane: principled { color = linear(0.9, 0.95, 0.9), roughness = 0, transmission = 0.8 }
material cover: principled { color = linear(0.9), roughness = 0, transmission = 1, coat.weight = 0.5, coat.roughness = 0.3 }
material lamp: emissive { color = linear(1, 0.9, 0.8), strength = 3 }
instance floor { shape = rectangle(size: (4, 4)m), material = white }
instance a { shape = rectangle(size: (2, 2)m), material = sakura, at = (-0.9, 1, 0)m, rotate = (10, 0, 0)deg }
instance b { shape = rectangle(size: (2, 2)m), material = pane, at = (0.9, 1.2, 0)m, rotate = (0, 0, 15)deg }
instance c { shape = rectangle(size: (3, 1)m), material = cover, at = (0, 1.8, 0.4)m, rotate = (170, 0, 0)deg }
instance panel { shape = rectangle(size: (2, 2)m), material = lamp, at = (0, 3.9, 0)m, rotate = (180, 0, 0)deg }
instance glow { shape = sphere(radius: 40cm), material = lamp, at = (1.4, 2.6, 0.3)m }
sky dim: gradient { sun.direction = (0.3, 0.8, 0.2), disc.color = linear(3) }
camera eye: perspective { from = (0, 1.6, 5)m, to = (0, 0.6, 0)m, fov.vertical = 45deg }
film f { size = (24, 24)px }
render main: path { camera = eye, film = f, samples = 16, depth = 64, seed = 1 }
";

/// The same in a room of smoke, with a box of milk whose surface is not there and a filled glass ball.
const SMOKE: &str = "rts 1
medium smoke: homogeneous { sigma_a = (0.01, 0.02, 0.04)/m, sigma_s = (0.1, 0.15, 0.3)/m, g = 0.5, sky_distance = 5m }
medium milk: homogeneous { sigma_s = (2, 1, 0.5)/m, sigma_a = 0.1/m, g = -0.2 }
medium ink: homogeneous { sigma_a = (0.5, 0.1, 2)/m }
material white: diffuse { color = linear(0.7) }
material paint: principled { color = linear(0.2, 0.4, 0.7), roughness = 0.5 }
material cloudy: dielectric { ior = 1, interior = milk, priority = 1 }
material glass: dielectric { ior = 1.5, interior = ink, priority = 2 }
material lamp: emissive { color = linear(1, 0.9, 0.8), strength = 3 }
instance floor { shape = rectangle(size: (4, 4)m), material = white }
instance back {
  shape = rectangle(size: (4, 4)m)
  material = paint
  rotate = (90, 0, 0)deg
  at = (0, 2, -2)m
}
instance panel { shape = rectangle(size: (2, 2)m), material = lamp, at = (0, 3.9, 0)m }
instance cloud { shape = box(size: (1.4, 1, 1.4)m), material = cloudy, at = (-0.8, 0.8, 0)m }
instance ball { shape = sphere(radius: 50cm), material = glass, at = (-0.4, 0.9, 0.6)m }
instance glow { shape = sphere(radius: 40cm), material = lamp, at = (1.2, 0.4, 0.3)m }
sky dim: constant { color = linear(0.2) }
camera eye: perspective { from = (0, 1.6, 5)m, to = (0, 1.4, 0)m, fov.vertical = 45deg }
film f { size = (24, 24)px }
render main: path { camera = eye, film = f, atmosphere = smoke, samples = 64, depth = 64, seed = 1 }
";

/// Longest path there.
const SMOKE_DEPTH: u32 = 64;
/// The same for [`SHEETS`].
const SHEETS_DEPTH: u32 = 64;

/// Pictures of each estimator: enough for the spread to be known to 13 %.
const SEEDS: u32 = 32;
/// Longest path, so long that it ends nothing; without roulette only the scene ends a path.
const DEPTH: u32 = 4096;

/// Values of the estimator switch.
const ESTIMATORS: [(&str, u32); 4] = [("balance", 0), ("power", 3), ("light", 1), ("bsdf", 2)];

/// One way to the picture.
struct Way {
    roulette: bool,
    sampler: SamplerKind,
    estimator: (&'static str, u32),
    precision: Precision,
}

impl Way {
    fn all() -> impl Iterator<Item = Self> {
        let rows = [true, false].into_iter().flat_map(|roulette| {
            SamplerKind::ALL.into_iter().map(move |sampler| (roulette, sampler))
        });
        rows.flat_map(|(roulette, sampler)| {
            ESTIMATORS.into_iter().flat_map(move |estimator| {
                // Double precision takes the same decisions: once for each estimator is enough.
                let twice = roulette && sampler == SamplerKind::Sobol;
                let precisions =
                    [Precision::F32, Precision::F64].into_iter().take(1 + usize::from(twice));
                precisions.map(move |precision| Self { roulette, sampler, estimator, precision })
            })
        })
    }

    fn label(&self) -> String {
        let roulette = if self.roulette { "roulette" } else { "no roulette" };
        let (name, precision) = (self.estimator.0, self.precision.name());
        format!("{name}, {roulette}, {:?}, {precision}", self.sampler)
    }

    /// Mean of the green channel over `SEEDS` pictures, the first one with seed `first_seed`.
    fn estimate(&self, (text, depth): (&str, u32), first_seed: u32) -> Estimate {
        let mut compiled = scene::compile(text);
        let render = &mut compiled.lowered.render;
        render.max_depth = depth;
        render.sampler = self.sampler as u32;
        if !self.roulette {
            render.roulette_depth = depth;
        }
        let bytes = scene::bytes(&compiled);
        let means: Vec<f64> = (0..SEEDS)
            .map(|seed| {
                let pack = Pack::from_bytes(bytes.clone()).expect("valid");
                let outcome = picture::cpu(pack, |job| {
                    job.estimator = self.estimator.1;
                    job.precision = self.precision;
                    job.seed = first_seed + seed;
                });
                Estimate::of(&picture::channel(outcome.film(), 1)).mean
            })
            .collect();
        Estimate::of(&means)
    }
}

#[test]
fn all_estimators_agree() {
    agree((ROOM, DEPTH), &ESTIMATORS.map(|row| row.1));
}

#[test]
fn all_estimators_agree_in_media() {
    agree((SMOKE, SMOKE_DEPTH), &[0, 1, 2]);
}

/// Suns that two of the ways find, over a sky, among lamps of a tree.
#[test]
fn all_estimators_agree_under_directional_lights() {
    let suns = "light sun: directional { direction = (0.3, 0.6, 1), angular_diameter = 30deg, strength = 5 }
light moon: directional { direction = (-0.5, 0.4, 1), angular_diameter = 50deg, strength = 0.7 }
sky dim";
    agree((&ROOM.replace("sky dim", suns), SHEETS_DEPTH), &ESTIMATORS.map(|row| row.1));
}

/// At the full depth, and where the longest path ends at the first thing behind a sheet.
#[test]
fn all_estimators_agree_behind_sheets() {
    for depth in [2, SHEETS_DEPTH] {
        agree((SHEETS, depth), &[0, 1, 2]);
    }
}

/// All ways to the picture that use one of these estimators.
fn agree(scene: (&str, u32), estimators: &[u32]) {
    let mut found: Vec<(String, Estimate)> = Vec::new();
    // Independent seeds for each way: equal ones would hide differences.
    let ways = Way::all().filter(|way| estimators.contains(&way.estimator.1));
    for (way, first_seed) in ways.zip((100_000..).step_by(1000)) {
        let (label, estimate) = (way.label(), way.estimate(scene, first_seed));
        console::line(&format!("{label:<36} {:.5} +- {:.5}", estimate.mean, estimate.error));
        found.push((label, estimate));
    }
    assert_eq!(found.len(), 5 * estimators.len());
    for (i, (a_name, a)) in found.iter().enumerate() {
        for (b_name, b) in &found[..i] {
            let z = (a.mean - b.mean) / a.error.hypot(b.error);
            assert!(z.abs() < 4.0, "{a_name} and {b_name}: z = {z:.2}");
        }
    }
}
