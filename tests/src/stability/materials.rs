//! Materials at the ends of their parameters.

use std::f64::consts::FRAC_PI_2;
use std::path::Path;

use super::tools::{WHITE_SKY, diagnose, films, first_error, means, shot, view};
use super::{Case, Row};
use crate::kernel::{Bench, Lobe};
use crate::picture::{Estimate, channel};
use crate::statistics::stream::Stream;
use crate::statistics::{Counts, grid};

/// The cases of this file.
pub const CASES: &[Case] = &[
    Case {
        id: "X21",
        input: "refractive index 1, 1 + 1e-6, 1.0001",
        must: "the object is invisible: image and background differ by less than 1e-4",
        measure: invisible,
    },
    Case {
        id: "X22",
        input: "refractive index 10, from outside and from within",
        must: "mean reflectances .64017 and .99640, 1e-4",
        measure: mean_fresnel,
    },
    Case {
        id: "X23",
        input: "critical angle ± 1e-6 rad",
        must: "F continuous, directions unit, 1e-5",
        measure: critical,
    },
    Case {
        id: "X24",
        input: "roughness 0, 1e-4, 1e-3",
        must: "the mirror's image, no NaN; 4 se",
        measure: nearly_smooth,
    },
    Case {
        id: "X25",
        input: "roughness 1, seen along the normal",
        must: "E = 1 - ln 2 = .306853, 1e-3",
        measure: roughest,
    },
    Case {
        id: "X26",
        input: "fuzz 0, 1e-4, 0.999, 1, 1.001, 3",
        must: "chi-square of the lobe (alpha 1e-3), energy in closed form (4 se)",
        measure: fuzz,
    },
    Case {
        id: "X27",
        input: "albedo 0, 1, 1.0000001, 2",
        must: "0 exactly; furnace 1; clamped with a warning, exact",
        measure: albedo,
    },
];

fn invisible() -> Vec<Row> {
    // A wall of light behind the ball and darkness behind the camera: what is reflected is missing.
    let scene = |ball: &str| {
        format!(
            "material lamp: emissive {{ color = linear(1) }}
instance wall {{ shape = rectangle(size: (24, 24)m), material = lamp, rotate = (90, 0, 0)deg, at = (0, 0, -4)m }}
{ball}{}",
            shot([0.0, 0.4, 6.0], [0.0; 3], 22.0, 64)
        )
    };
    let glass = |ior: &str| {
        scene(&format!(
            "material m: dielectric {{ ior = {ior} }}\ninstance ball {{ shape = sphere(radius: 1m), material = m }}\n"
        ))
    };
    let back = films(&scene(""), 32, 256);
    let mut rows = Vec::new();
    for ior in ["1", "1.000001", "1.0001"] {
        let front = films(&glass(ior), 32, 256);
        let off = [0, 1].map(|i| {
            let [a, b] = [&back[i], &front[i]].map(|film| Estimate::of(&channel(film, 1)).mean);
            (b / a - 1.0).abs()
        });
        rows.push(Row::below(
            format!("index {ior}: relative difference of the image's mean"),
            1e-4,
            off,
        ));
    }
    rows
}

twins! {
    /// Mean reflectance of an interface for diffuse light.
    fn mean_reflectance(index: f64, front: bool) -> f64 {
        let bench = Bench::new();
        let mut kernel = open(&bench);
        let (eta, minus_1) = if front { (index, index - 1.0) } else { (1.0 / index, (1.0 - index) / index) };
        let n = 100_000;
        let at = |i: u32| (f64::from(i) + 0.5) / f64::from(n);
        let mut sum = 0.0;
        for i in 0..n {
            sum += 2.0 * at(i) * f64::from(kernel.fresnel_dielectric(at(i) as Real, eta as Real, minus_1 as Real));
        }
        sum / f64::from(n)
    }
}

fn mean_fresnel() -> Vec<Row> {
    vec![
        Row::near("from outside", 0.64017, 1e-4, both!(mean_reflectance(10.0, true))),
        Row::near("from within", 0.99640, 1e-4, both!(mean_reflectance(10.0, false))),
    ]
}

twins! {
    /// Largest error of F and of the length of the refracted direction at the critical angle and 1e-6 beside it.
    fn critical_errors() -> [f64; 2] {
        let bench = Bench::new();
        let mut kernel = open(&bench);
        let (mut worst, mut length) = (0.0_f64, 0.0_f64);
        for index in [1.0001, 1.33, 1.5, 2.4, 10.0_f64] {
            let minus_1 = (1.0 - index) / index;
            let angle = (1.0 + minus_1).asin();
            for step in [-1e-6, 0.0, 1e-6] {
                let (sin, c) = (angle + step).sin_cos();
                let eta = 1.0 + minus_1;
                let f = f64::from(kernel.fresnel_dielectric(c as Real, eta as Real, minus_1 as Real));
                worst = worst.max((f - fresnel(c, eta)).abs());
                let wo = V3::new(sin as Real, 0.0, c as Real);
                let wi = kernel.dielectric_refract(V3::Z, wo, eta as Real, minus_1 as Real);
                length = length.max((wide(wi).length() - 1.0).abs());
            }
        }
        [worst, length]
    }
}

/// Reflectance from the amplitudes of both polarisations.
fn fresnel(c: f64, eta: f64) -> f64 {
    let cos2 = 1.0 - (1.0 - c * c) / (eta * eta);
    if cos2 <= 0.0 {
        return 1.0;
    }
    let t = cos2.sqrt();
    let (s, p) = ((c - eta * t) / (c + eta * t), (eta * c - t) / (eta * c + t));
    0.5 * (s * s + p * p)
}

fn critical() -> Vec<Row> {
    let [a, b] = both!(critical_errors());
    vec![
        Row::below("error of F", 1e-5, [a[0], b[0]]).known(
            "1 - F falls as the root of the distance to the critical angle; a cosine rounded to f32 is 6e-8 away, \
             which is 1e-3 to 1e-2 of F",
        ),
        Row::below("1 - length of the refracted direction", 1e-5, [a[1], b[1]]),
    ]
}

fn nearly_smooth() -> Vec<Row> {
    let scene = |material: &str| {
        format!(
            "sky day: gradient {{ base = 2, blend.high = 0.6, blend.low = 0.1 }}
material m: {material}
instance ball {{ shape = sphere(radius: 1m), material = m }}\n{}",
            shot([0.0, 0.3, 6.0], [0.0; 3], 14.0, 64)
        )
    };
    let mirrors = [
        (
            "conductor",
            "metal { color = linear(1), fuzz = 0 }",
            "conductor { color = linear(1), roughness = ",
        ),
        ("dielectric", "dielectric { ior = 1.5 }", "dielectric { ior = 1.5, roughness = "),
    ];
    let mut rows = Vec::new();
    let mut bad = [0, 0];
    for (name, smooth, rough) in mirrors {
        let mirror = films(&scene(smooth), 32, 64);
        for roughness in ["0", "0.0001", "0.001"] {
            let other = films(&scene(&format!("{rough}{roughness} }}")), 32, 64);
            for i in [0, 1] {
                bad[i] += other[i].counters.bad;
            }
            let z = blocks(&mirror, &other);
            rows.push(Row::below(
                format!("{name} {roughness}: largest distance of 16 blocks in se"),
                4.0,
                z,
            ));
        }
    }
    rows.push(Row::never("samples that are not finite", 6 * 65536, bad));
    rows
}

/// Largest distance of blocks of 8 x 8 pixels of two pictures of 32 x 32, by the spread of their differences.
fn blocks(a: &[runtime::Film; 2], b: &[runtime::Film; 2]) -> [f64; 2] {
    [0, 1].map(|i| {
        let [x, y] = [&a[i], &b[i]].map(|film| channel(film, 1));
        let block = |k: usize| {
            let at = |j: usize| (k / 4 * 8 + j / 8) * 32 + k % 4 * 8 + j % 8;
            let off: Vec<f64> = (0..64).map(|j| x[at(j)] - y[at(j)]).collect();
            let off = Estimate::of(&off);
            // What rounding leaves is no difference.
            if off.mean.abs() < 1e-6 { 0.0 } else { off.z(0.0).abs() }
        };
        (0..16).map(block).fold(0.0, f64::max)
    })
}

fn roughest() -> Vec<Row> {
    let text = format!(
        "{WHITE_SKY}material m: conductor {{ color = linear(1), roughness = 1, compensation = off }}
instance floor {{ shape = rectangle(size: (4, 4)m), material = m }}\n{}",
        view([0.0, 5.0, 0.0], [0.0; 3], 2)
    );
    let found = means(&text, 16, 4096);
    vec![Row::near("E", 1.0 - std::f64::consts::LN_2, 1e-3, found.map(|e| e.mean))]
}

twins! {
    /// Share of light that a white metal reflects.
    fn metal_energy(fuzz: f64, mu: f64, n: u32) -> Estimate {
        let lobe = Lobe::metal(fuzz as f32);
        let bench = lobe.bench();
        let mut kernel = open(&bench);
        let wo = v3(lobe.at_cosine(mu));
        let s = scatter(&lobe);
        let mut stream = Stream::new(137, 0);
        let mut kept = 0;
        for _ in 0..n {
            let u = stream.pair24();
            let out = kernel.metal_sample(s, wo, V2::new(u.x as Real, u.y as Real), stream.unit24() as Real);
            kept += u32::from(out.weight.x > 0.0);
        }
        let mean = f64::from(kept) / f64::from(n);
        Estimate { mean, error: (mean * (1.0 - mean) / f64::from(n)).sqrt() }
    }
}

twins! {
    /// Chance of the metal's directions at `mu` if its density is right; 1 for a mirror that is one.
    fn metal_chance(fuzz: f64, mu: f64, n: u32) -> f64 {
        let lobe = Lobe::metal(fuzz as f32);
        let bench = lobe.bench();
        let (mut kernel, mut truth) = (open(&bench), bench.double());
        let wo = lobe.at_cosine(mu);
        let mirror = lobe.mirror(wo);
        let (s, d) = (scatter(&lobe), lobe.double());
        let mut stream = Stream::new(139, 0);
        let mut draw = |kernel: &mut k::Kernel<'_>| {
            let u = stream.pair24();
            let out = kernel.metal_sample(s, v3(wo), V2::new(u.x as Real, u.y as Real), stream.unit24() as Real);
            (out.weight.x > 0.0).then(|| wide(out.wi))
        };
        if fuzz < 1e-3 {
            let same = (0..n).all(|_| draw(&mut kernel).is_some_and(|wi| (wi - mirror).length() < 1e-6));
            return if same { 1.0 } else { 0.0 };
        }
        let reach = FRAC_PI_2;
        let shape = grid::Shape { reach, ring_scale: reach, ..grid::Shape::SPHERE };
        let cells = grid::Grid::new(mirror, lobe.normal, shape);
        let shares = cells.integrate_above(16, lobe.normal, |wi| truth.metal_eval(d, wo, wi).pdf);
        let lost = (1.0 - shares.iter().sum::<f64>()).max(0.0);
        let expected = shares.into_iter().chain([lost]).map(|x| x * f64::from(n)).collect();
        let mut counts = Counts::new(expected);
        for _ in 0..n {
            let cell = draw(&mut kernel).and_then(|wi| cells.cell(wi)).unwrap_or(cells.cells());
            counts.add(cell);
        }
        counts.p_value()
    }
}

fn fuzz() -> Vec<Row> {
    let mut rows = Vec::new();
    let mu = 0.5;
    for fuzz in [0.0, 1e-4, 0.999, 1.0] {
        let t = if fuzz < 1e-3 { 1.0 } else { f64::min(1.0, mu / fuzz) };
        let energy = 0.5 + 0.75 * t - 0.25 * t * t * t;
        let found = both!(metal_energy(fuzz, mu, 200_000));
        rows.push(Row::mean(format!("energy of fuzz {fuzz} at cosine 0.5"), energy, 1e-7, found));
        let chance = both!(metal_chance(fuzz, mu, 200_000));
        let [a, b] = chance.map(super::number);
        rows.push(Row {
            double: b,
            expected: "p > 1e-3".into(),
            ..Row::fact(
                format!("chi-square of fuzz {fuzz}"),
                "",
                &a,
                chance.iter().all(|p| *p > 1e-3),
            )
        });
    }
    for fuzz in ["1.001", "3"] {
        rows.push(refused(
            &format!("fuzz {fuzz}"),
            &format!("metal {{ color = linear(1), fuzz = {fuzz} }}"),
        ));
    }
    rows
}

/// A material that the language does not take.
fn refused(name: &str, material: &str) -> Row {
    let text = format!(
        "{WHITE_SKY}material m: {material}\ninstance b {{ shape = sphere(radius: 1m), material = m }}\n{}",
        view([0.0, 0.0, 5.0], [0.0; 3], 2)
    );
    let (compiled, said) = diagnose(Path::new(""), &text);
    let line = first_error(&said);
    Row::fact(name, "an error at the value", &line, compiled.is_none() && line.contains("error["))
}

fn albedo() -> Vec<Row> {
    let text = |rho: &str| {
        format!(
            "{WHITE_SKY}material m: diffuse {{ color = linear({rho}) }}
instance ball {{ shape = sphere(radius: 1m), material = m }}\n{}",
            view([0.3, 0.4, 6.0], [0.0; 3], 16)
        )
    };
    let [black, white] = ["0", "1"].map(|rho| means(&text(rho), 16, 64));
    let clamped = |rho: &str| {
        let row =
            refused(&format!("albedo {rho}"), &format!("diffuse {{ color = linear({rho}) }}"));
        let holds = !row.holds && row.single.contains("warning[");
        Row { expected: "clamped to 1, with a warning".into(), holds, ..row }.known(
            "it is refused with an error at the value: no scene is rendered otherwise than it is written",
        )
    };
    vec![
        Row::near("albedo 0", 0.0, 0.0, black.map(|e| e.mean)),
        Row::mean("albedo 1", 1.0, 2e-6, white),
        clamped("1.0000001"),
        clamped("2"),
    ]
}
