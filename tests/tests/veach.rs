//! Veach's plates: four sizes of light mirrored in four roughnesses of plate.
//!
//! In every cell the balance heuristic has at most twice the variance of the better of its two
//! techniques, and all three agree. Every pixel looks at the same point, so the spread of pixels is
//! the variance. Fixed seeds.

use tests::console;
use tests::picture::{self, Estimate, channel};
use tests::scene;

/// Radii in metres of a light four metres away; strengths make all equally bright.
const RADII: [f64; 4] = [0.03, 0.1, 0.3, 0.9];
/// Radii of the ball that blurs the mirror direction.
const FUZZ: [f64; 4] = [0.01, 0.05, 0.2, 0.6];

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
render main: path {{ camera = eye, film = f, samples = 64, depth = 2, seed = 5 }}
"
    )
}

#[test]
fn the_balance_heuristic_is_never_much_worse_than_the_better_technique() {
    let mut failures = Vec::new();
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
            let better = light.error.min(bsdf.error);
            let efficient = both.error * both.error <= 2.0 * better * better + 1e-18;
            if !agree || !efficient {
                failures.push(line);
            }
        }
    }
    assert!(failures.is_empty(), "\n{}", failures.join("\n"));
}
