//! Lights that are tiny, touched, bright, faint or many.

use std::fmt::Write as _;
use std::path::Path;

use glam::DVec3;
use pack::abi::Light;

use super::tools::{estimates, films_of, means, sized, view};
use super::{Case, Row};
use crate::kernel::Bench;
use crate::picture::Estimate;
use crate::scene;
use crate::statistics::Mean;
use crate::statistics::stream::Stream;

/// The cases of this file.
pub const CASES: &[Case] = &[
    Case {
        id: "X42",
        input: "sun of half angle 1e-4, 1e-6 rad",
        must: "E = pi L sin^2, 1e-5",
        measure: suns,
    },
    Case {
        id: "X43",
        input: "point on the light's sphere, 1e-7 inside, 1e-7 outside",
        must: "the mean is continuous, 4 se",
        measure: touching,
    },
    Case {
        id: "X44",
        input: "radiance 1e9, 1e15, 1e-20, 2^60, 2^-60",
        must: "the image scales: bit for bit for powers of two; nothing infinite",
        measure: brightness,
    },
    Case {
        id: "X45",
        input: "1 light among 1e5 black ones; 1e5 equal lights",
        must: "mean right (4 se); probabilities add up to 1, 1e-6",
        measure: many,
    },
];

const WHITE_FLOOR: &str = "material white: diffuse { color = linear(1) }
instance floor { shape = rectangle(size: (4, 4)m), material = white }
";

fn suns() -> Vec<Row> {
    let row = |t: f64| {
        let sine = t.sin();
        let text = format!(
            "{WHITE_FLOOR}light sun: sphere {{ center = (0, 1000, 0)m, radius = {:e}m, strength = {:e} }}\n{}",
            sine * 1000.0,
            1.0 / (sine * sine),
            view([-3.0, 0.5, 0.0], [0.0; 3], 2)
        );
        Row::mean(format!("{t:e} rad: E / (pi L sin^2)"), 1.0, 1e-5, means(&text, 16, 256))
    };
    vec![row(1e-4), row(1e-6)]
}

twins! {
    /// Mean over both techniques, balanced, of what a white plane at distance `d` from the centre of a sphere of
    /// radius 1 and radiance 1 sends back; its normal points to the centre.
    fn lit(d: f64, n: u32) -> Estimate {
        let bench = Bench::new().lights(&[Light { origin: [0.0, d as f32, 0.0], edge1: [1.0, 0.0, 0.0], ..Light::default() }]);
        let mut kernel = open(&bench);
        let light = kernel.load_light(0);
        let sphere = k::Sphere { center: light.origin, radius: light.edge1.x, ..k::Sphere::ZERO };
        let mut stream = Stream::new(173, 0);
        let pi = std::f64::consts::PI;
        let pdf = f64::from(kernel.sphere_light_pdf(light, V3::ZERO));
        let mut mean = Mean::default();
        for _ in 0..n {
            let mut value = 0.0;
            let u = stream.pair24();
            let to = kernel.sphere_light_sample(light, V3::ZERO, V2::new(u.x as Real, u.y as Real));
            let cos = f64::from(to.wi.y);
            if to.pdf > 0.0 && cos > 0.0 {
                value += cos / pi / (f64::from(to.pdf) + cos / pi);
            }
            let u = stream.pair24();
            let wi = kernel.diffuse_direction(V3::Y, V2::new(u.x as Real, u.y as Real));
            let hit = kernel.sphere_intersect(sphere, V3::ZERO, wi, false);
            if hit.x > 0.0 || hit.y > 0.0 {
                let density = f64::from(wi.y) / pi;
                value += density / (density + pdf);
            }
            mean.add(value);
        }
        Estimate { mean: mean.value(), error: mean.error() }
    }
}

fn touching() -> Vec<Row> {
    let row = |name: &str, d: f64| {
        // (R / d)^2 outside, 1 inside.
        let truth = f64::min(1.0, (1.0 / d).powi(2));
        Row::mean(name, truth, 1e-6, both!(lit(d, 200_000)))
    };
    vec![
        row("1e-7 inside", 1.0 - 1e-7),
        row("on the sphere", 1.0),
        row("1e-7 outside", 1.0 + 1e-7),
        row("1e-4 outside", 1.0 + 1e-4),
        row("1e-2 outside", 1.01),
    ]
}

fn brightness() -> Vec<Row> {
    let text = format!(
        "rts 1\n{WHITE_FLOOR}light bulb: sphere {{ center = (0, 1, 0)m, radius = 10cm }}\n{}",
        view([-3.0, 0.5, 0.0], [0.0; 3], 4)
    );
    // After the text: the language has no numbers above 1e15.
    let lit = |strength: f64| {
        let compiled = scene::compile_changed(Path::new(""), &text, |scene| {
            scene.lights[0].radiance = [strength; 3];
        });
        films_of(&scene::bytes(&compiled), sized(16, 32))
    };
    let base = lit(1.0);
    let mut rows = Vec::new();
    for power in [60, -60] {
        let factor = 2.0_f64.powi(power);
        let other = lit(factor);
        let differ = [0, 1].map(|i| {
            let pairs = base[i].sums.iter().zip(&other[i].sums);
            pairs.filter(|(a, b)| a.map(|x| (x * factor).to_bits()) != b.map(f64::to_bits)).count()
                as u64
        });
        rows.push(Row::never(
            format!("2^{power}: pixels that are not the image times that"),
            256,
            differ,
        ));
    }
    let mean = estimates(&base);
    for strength in [1e9, 1e15, 1e-20] {
        let other = estimates(&lit(strength));
        let off = [0, 1].map(|i| (other[i].mean / strength / mean[i].mean - 1.0).abs());
        rows.push(Row::below(format!("{strength:e}: relative difference of the mean"), 1e-6, off));
    }
    rows
}

/// `2 n^2` triangles that cover the square of side 2 around (0, 1, 0), seen from below.
fn tiles(n: usize) -> String {
    let mut obj = String::new();
    for i in 0..=n {
        for j in 0..=n {
            let at = |k: usize| 2.0 * k as f64 / n as f64 - 1.0;
            let _ = writeln!(obj, "v {} 1 {}", at(i), at(j));
        }
    }
    for i in 0..n {
        for j in 0..n {
            let a = i * (n + 1) + j + 1;
            let (b, c, d) = (a + 1, a + n + 1, a + n + 2);
            let _ = writeln!(obj, "f {a} {c} {d}\nf {a} {d} {b}");
        }
    }
    obj
}

fn many() -> Vec<Row> {
    let dir = tempfile::tempdir().expect("a temporary directory can be made");
    std::fs::write(dir.path().join("tiles.obj"), tiles(224)).expect("writable");
    let compile = |colour: &str, more: &str| {
        let text = format!(
            "rts 1
asset tiles = obj(\"tiles.obj\", unit: m, up: +y)
material lamp: emissive {{ color = linear({colour}) }}
instance ceiling {{ shape = tiles, material = lamp }}
{more}{WHITE_FLOOR}{}",
            view([-3.0, 0.5, 0.0], [0.0; 3], 2)
        );
        scene::compile_in(dir.path(), &text)
    };
    // A square of side 2 at height 1, parallel.
    let equal = compile("1", "");
    let lights = u32::try_from(equal.lowered.lights.len()).expect("fewer than 2^32");
    let bench = Bench::new().lights(&equal.lowered.lights).light_tree(&equal.lowered.light_nodes);
    let (mut single, mut double) = (bench.single(), bench.double());
    let p = DVec3::new(0.02, -0.3, 0.05);
    let (nobody, nowhere) = (single.receiver_none(), double.receiver_none());
    let one: f64 =
        (0..lights).map(|i| f64::from(single.dispatch_choose_pmf(i, p.as_vec3(), nobody))).sum();
    let two: f64 = (0..lights).map(|i| double.dispatch_choose_pmf(i, p, nowhere)).sum();
    let films_equal = films_of(&scene::bytes(&equal), sized(16, 64));
    let sun = "light sun: sphere { center = (0, 0.5, 0)m, radius = 5cm, strength = 100 }\n";
    let dark = films_of(&scene::bytes(&compile("0", sun)), sized(16, 64));
    vec![
        Row::fact("lights", "≥ 100000", &lights.to_string(), lights >= 100_000),
        Row::near("sum of probabilities", 1.0, 1e-6, [one, two]),
        Row::mean("radiance below 1e5 equal lights", 0.554_126_424, 1e-5, estimates(&films_equal)),
        Row::mean("radiance below 1 light and 1e5 black ones", 1.0, 1e-5, estimates(&dark)),
    ]
}
