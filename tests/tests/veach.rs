//! Veach's plates: four sizes of light mirrored in four roughnesses of plate.
//!
//! In every cell the three estimators agree, and the balance heuristic keeps the bound of Veach 1997,
//! Theorem 9.2, for one sample of each technique: its variance is at most that of the better one
//! plus half the squared mean. (Where one technique is nearly free of noise no factor can hold: the
//! other one's samples are noise by comparison.) Over all cells it beats both by far in the worst
//! relative error. Every pixel looks at the same point, so the spread of pixels is the variance.
//! The theorem is about independent samples, so they are. Fixed seeds.

use tests::console;
use tests::picture::{self, Estimate, channel};
use tests::scene;

/// Radii in metres of a light four metres away; strengths make all equally bright.
const RADII: [f64; 4] = [0.03, 0.1, 0.3, 0.9];
/// Radii of the ball that blurs the mirror direction.
const FUZZ: [f64; 4] = [0.01, 0.05, 0.2, 0.6];

/// Paths of a cell: 32 x 32 pixels of 64 samples.
const PATHS: f64 = 65_536.0;

/// A plate in the plane y = 0, seen under 45 degrees, and a light where the mirror looks.
fn cell(radius: f64, fuzz: f64) -> String {
    let strength = 0.01 / (radius * radius);
    format!(
        "rts 1
material plate: metal {{ color = linear(1), fuzz = {fuzz} }}
instance table {{ shape = rectangle(size: (50, 50)m), material = plate }}
light lamp: sphere {{ center = (2.8, 2.83, 0.02)m, radius = {radius}m, strength = {strength} }}
camera eye: perspective {{
  from = (-3, 3, 0)m
  to = (0, 0, 0)m
  fov.vertical = 0.001deg
}}
film f {{ size = (32, 32)px }}
render main: path {{ camera = eye, film = f, samples = 64, depth = 2, seed = 5, sampler = pcg }}
"
    )
}

#[test]
fn the_balance_heuristic_keeps_its_bound_in_every_cell() {
    let mut failures = Vec::new();
    let mut worst = [0.0_f64; 3];
    for radius in RADII {
        for fuzz in FUZZ {
            let text = cell(radius, fuzz);
            let [both, light, bsdf] = [0, 1, 2].map(|estimator| {
                let outcome = picture::cpu(scene::pack(&text), |job| job.estimator = estimator);
                Estimate::of(&channel(outcome.film(), 1))
            });
            let line = format!(
                "radius {radius:<5} fuzz {fuzz:<5} both {:.3e} +- {:.1e}, light +- {:.1e}, bsdf +- {:.1e}",
                both.mean, both.error, light.error, bsdf.error,
            );
            console::line(&line);
            assert!(both.mean > 0.0, "the mirror looks at the light: {line}");
            let z = |a: &Estimate, b: &Estimate| (a.mean - b.mean) / a.error.hypot(b.error);
            // A technique that has found the light in too few pixels has no error bar to speak of.
            let agree = [&light, &bsdf]
                .into_iter()
                .all(|other| other.error > 0.1 * other.mean || z(&both, other).abs() < 4.5);
            for (worst, estimate) in worst.iter_mut().zip([&both, &light, &bsdf]) {
                *worst = worst.max(estimate.error / both.mean);
            }
            let better = light.error.min(bsdf.error);
            // Variance of one sample is the squared error of the mean times the samples in it; the
            // spread of 1,024 pixels knows it to within 5 % (one standard error is 4.4 %).
            let spread = both.error * both.error * PATHS;
            let bound = better * better * PATHS + 0.5 * both.mean * both.mean;
            let efficient = spread <= 1.1 * bound;
            if !agree || !efficient {
                failures.push(line);
            }
        }
    }
    assert!(failures.is_empty(), "\n{}", failures.join("\n"));
    let [both, light, bsdf] = worst;
    console::line(&format!(
        "worst relative error: both {both:.1e}, light {light:.1e}, bsdf {bsdf:.1e}"
    ));
    assert!(4.0 * both < light.min(bsdf), "{worst:?}");
}
