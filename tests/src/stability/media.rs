//! Media from nothing to opaque, and waves far out.

use pack::abi::{Material, MaterialKind};

use super::tools::{WHITE_SKY, endless, estimates, films, films_of, means, sized, view};
use super::{Case, Row};
use crate::kernel::{Bench, Lobe};
use crate::picture::Estimate;
use crate::statistics::Mean;
use crate::statistics::stream::Stream;

/// The cases of this file.
pub const CASES: &[Case] = &[
    Case {
        id: "X33",
        input: "extinction 0",
        must: "a slab is the identity, exact",
        measure: nothing,
    },
    Case { id: "X34", input: "extinction 1e-6, 1e-3", must: "exp(-tau) to 1e-6", measure: thin },
    Case {
        id: "X35",
        input: "extinction 1e6",
        must: "no NaN; reflectance of half a space, 4 se",
        measure: dense,
    },
    Case {
        id: "X36",
        input: "scattering (0.1, 1, 10) and (1, 1e3, 1e6), no absorption",
        must: "reflected and transmitted light add up to 1 in each channel, 4 se",
        measure: channels,
    },
    Case {
        id: "X37",
        input: "thickness 1e-7 and 1e3 (0 is refused)",
        must: "the identity to 1e-6; reflectance of half a space, 4 se",
        measure: thickness,
    },
    Case {
        id: "X38",
        input: "g = 0, ±1e-6, ±0.5, ±0.999, ±1",
        must: "mean cosine g (4 se), directions unit (1e-6); ±1 straight",
        measure: phases,
    },
    Case {
        id: "X39",
        input: "fog of optical depth 1e-8 and 100 to the sky",
        must: "the sky, 1e-6; fog in its own light is 1, 4 se",
        measure: fogs,
    },
    Case {
        id: "X40",
        input: "absorption times distance 1e-8, 90, 1e4",
        must: "exp(-tau), no infinity, not negative, exact",
        measure: beer,
    },
    Case {
        id: "X41",
        input: "waves at coordinates of 1e5, frequency 1e3",
        must: "normals unit, 1e-6; reflected rays above the surface, exact",
        measure: waves,
    },
];

/// A slab in front of a white sky, seen along its normal.
fn slab(medium: &str, thickness: &str, depth: u32) -> String {
    format!(
        "{WHITE_SKY}medium x: homogeneous {{ {medium} }}
material m: dielectric {{ ior = 1, interior = x }}
instance slab {{ shape = box(size: (400, 400, {thickness})m), material = m }}\n{}",
        view([0.0, 0.0, 1500.0], [0.0; 3], depth).replace("up = (0.1, 0.2, 1)", "up = (0, 1, 0)")
    )
}

/// As [`slab`], near, and no wider than it must be for what is thin.
fn near(medium: &str, thickness: &str, depth: u32) -> String {
    slab(medium, thickness, depth).replace("(400, 400,", "(4, 4,").replace("1.5e3)m", "5e0)m")
}

fn nothing() -> Vec<Row> {
    let found = means(&near("sigma_a = 0/m", "0.5", 64), 8, 16);
    vec![Row::near("radiance through it", 1.0, 0.0, found.map(|e| e.mean))]
}

fn thin() -> Vec<Row> {
    let row = |sigma: f64| {
        let found = means(&near(&format!("sigma_a = {sigma:e}/m"), "1", 64), 8, 16);
        Row::near(format!("{sigma:e}/m over 1 m"), (-sigma).exp(), 1e-6, found.map(|e| e.mean))
    };
    vec![row(1e-6), row(1e-3)]
}

/// Chandrasekhar's 1 - H(1) sqrt(1 - a) for albedo 0.9.
const HALF_SPACE: f64 = 0.414_947;

fn dense() -> Vec<Row> {
    let mut rows = Vec::new();
    for sigma in [1e3, 1e4, 1e6] {
        let medium = format!("sigma_a = {:e}/m, sigma_s = {:e}/m", 0.1 * sigma, 0.9 * sigma);
        let films = films(&near(&medium, "0.5", 1024), 16, 512);
        let found = estimates(&films);
        rows.push(Row::mean(format!("{sigma:e}/m, albedo 0.9"), HALF_SPACE, 1e-4, found));
        let bad = [0, 1].map(|i| films[i].counters.bad);
        rows.push(Row::never(format!("{sigma:e}/m: samples that are not finite"), 131_072, bad));
    }
    rows
}

fn channels() -> Vec<Row> {
    let mut rows = Vec::new();
    for (name, sigma, thickness) in [
        ("(0.1, 1, 10)/m over 1 m", "(0.1, 1, 10)", "1"),
        ("(1, 1e3, 1e6)/m over 10 um", "(1, 1000, 1000000)", "1e-5"),
    ] {
        let text = near(&format!("sigma_s = {sigma}/m"), thickness, 1024);
        let films = films_of(&endless(&text), sized(8, 64));
        for (k, colour) in ["red", "green", "blue"].into_iter().enumerate() {
            let found = [0, 1].map(|i| Estimate::of(&crate::picture::channel(&films[i], k)));
            rows.push(Row::mean(format!("{name}, {colour}"), 1.0, 2e-5, found));
        }
    }
    rows
}

fn thickness() -> Vec<Row> {
    let thin = |thickness: &str, expected: f64| {
        let found = means(&near("sigma_a = 1/m", thickness, 64), 8, 16);
        Row::near(format!("{thickness} m of 1/m"), expected, 1e-6, found.map(|e| e.mean))
    };
    let text = slab("mean_free_path = 1m, albedo = linear(0.9)", "1000", 1024);
    vec![
        thin("1e-4", (-1e-4_f64).exp()),
        thin("1e-5", (-1e-5_f64).exp()),
        thin("1e-7", 1.0),
        Row::mean("1e3 free paths, albedo 0.9", HALF_SPACE, 1e-4, means(&text, 16, 512)),
    ]
}

twins! {
    /// Mean cosine of scattered directions, and the largest error of their length.
    fn phase(g: f64, n: u32) -> (Estimate, f64) {
        let bench = Bench::new();
        let mut kernel = open(&bench);
        let axis = DVec3::new(0.36, -0.48, 0.8);
        let mut stream = Stream::new(163, 0);
        let (mut mean, mut length) = (Mean::default(), 0.0_f64);
        for _ in 0..n {
            let u = stream.pair24();
            let wi = wide(kernel.hg_sample(v3(axis), real(g), V2::new(u.x as Real, u.y as Real)));
            mean.add(wi.dot(axis));
            length = length.max((wi.length() - 1.0).abs());
        }
        (Estimate { mean: mean.value(), error: mean.error() }, if length.is_nan() { f64::INFINITY } else { length })
    }
}

fn phases() -> Vec<Row> {
    let mut rows = Vec::new();
    let mut lengths = [0.0_f64; 2];
    for g in [0.0, 1e-6, -1e-6, 0.5, -0.5, 0.999, -0.999, 1.0, -1.0] {
        let [(a, la), (b, lb)] = both!(phase(g, 200_000));
        lengths = [lengths[0].max(la), lengths[1].max(lb)];
        rows.push(Row::mean(format!("mean cosine, g = {g}"), g, 2e-7, [a, b]));
    }
    rows.push(Row::below("1 - length of a direction", 1e-6, lengths));
    rows
}

fn fogs() -> Vec<Row> {
    let fog = |density: &str, colour: &str| {
        format!(
            "{WHITE_SKY}medium mist: fog {{ density = {density}/m, color = linear({colour}), sky_distance = 100m }}
material clay: diffuse {{ color = linear(0.5) }}
instance ball {{ shape = sphere(radius: 1m), material = clay, at = (0, 0, 9)m }}
{}",
            view([0.0, 0.0, 5.0], [0.0; 3], 4).replace("depth = 4", "depth = 4, atmosphere = mist")
        )
    };
    let value = |text: &str| means(text, 8, 16).map(|e| e.mean);
    let milk = format!(
        "{WHITE_SKY}medium x: homogeneous {{ mean_free_path = 0.02m, albedo = linear(1) }}
material m: dielectric {{ ior = 1, interior = x }}
instance ball {{ shape = sphere(radius: 0.5m), material = m }}\n{}",
        view([0.0, 0.3, 5.0], [0.0; 3], 1024)
    );
    vec![
        Row::near("depth 1e-8: the sky", 1.0, 1e-6, value(&fog("1e-10", "0.2"))),
        Row::near("depth 100: the fog", 0.2, 1e-6, value(&fog("1", "0.2"))),
        Row::near("in its own light", 1.0, 1e-6, value(&fog("0.01", "1"))),
        Row::mean(
            "a white ball that scatters, 50 free paths wide",
            1.0,
            2e-5,
            estimates(&films_of(&endless(&milk), sized(8, 8))),
        ),
    ]
}

twins! {
    /// What is left after `tau`.
    fn left(tau: f64) -> f64 {
        let bench = Bench::new();
        let mut kernel = open(&bench);
        f64::from(kernel.beer_transmittance(V3::splat(real(tau))).x)
    }
}

fn beer() -> Vec<Row> {
    let row = |tau: f64, tolerance: f64| {
        let found = both!(left(tau));
        let row = Row::near(format!("tau = {tau:e}"), (-tau).exp(), tolerance, found);
        let holds = row.holds && found.iter().all(|x| *x >= 0.0);
        Row { holds, ..row }
    };
    vec![row(1e-8, 1e-7), row(1.0, 1e-7), row(90.0, 1e-38), row(1e4, 0.0), row(1e30, 0.0)]
}

twins! {
    /// Largest error of a normal's length, and reflections that are not above the surface.
    fn far_waves(n: u32) -> (f64, u64) {
        let water = Material { pattern_scale: 1000.0, bump_height: 20.0, ..Material::default() };
        let bench = Bench::new().materials(&[water]);
        let mut kernel = open(&bench);
        let mut stream = Stream::new(167, 0);
        let (mut worst, mut under) = (0.0_f64, 0);
        for _ in 0..n {
            let place = stream.direction() * 1e5;
            let lobe = Lobe { ior: 1.333, normal: DVec3::Y, place, ..Lobe::new(MaterialKind::Water) };
            let d = stream.direction();
            let wo = v3(DVec3::new(d.x, d.y.abs().max(1e-4), d.z).normalize());
            let normal = kernel.water_normal(scatter(&lobe), wo);
            let off = (wide(normal).length() - 1.0).abs();
            worst = worst.max(if off.is_nan() { f64::INFINITY } else { off });
            // Always the reflection: u = 0.
            let out = kernel.water_sample(scatter(&lobe), wo, 0.0);
            let up = wide(out.wi).y;
            under += u64::from(out.weight.x > 0.0 && (up.is_nan() || up <= 0.0));
        }
        (worst, under)
    }
}

fn waves() -> Vec<Row> {
    let [(a, ua), (b, ub)] = both!(far_waves(200_000));
    vec![
        Row::below("1 - length of a normal", 1e-6, [a, b]),
        Row::never("reflections under the surface", 200_000, [ua, ub]),
    ]
}
