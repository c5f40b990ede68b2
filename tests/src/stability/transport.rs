//! Long paths, dark scenes, large images, odd cameras, late samples, runs that are cut short.

use std::collections::BTreeSet;
use std::path::Path;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Duration;

use pack::abi::{Camera, MaterialKind, SamplerKind, material_flag};
use runtime::convergence::{Measure, Point};
use runtime::kernel::f32::ROULETTE_SURVIVAL;
use runtime::{
    Control, Counters, DeviceChoice, Event, Job, Precision, Rect, SampleRange, Scene, Stop, render,
};

use super::tools::{
    WHITE_SKY, count, diagnose, endless, estimates, films_of, first_error, open, sized, view,
};
use super::{Case, Row};
use crate::kernel::Bench;
use crate::picture::{self, Estimate, channel};
use crate::scene;
use crate::statistics::{Counts, Mean, index};

/// The cases of this file.
pub const CASES: &[Case] = &[
    Case {
        id: "X46",
        input: "closed white room, albedo .999",
        must: "1 / (1 - rho), 4 se; finite variance",
        measure: room,
    },
    Case {
        id: "X47",
        input: "path of 2e4 bounces between mirrors of .9999",
        must: "throughput right to 1e-3; roulette ends paths",
        measure: mirrors,
    },
    Case {
        id: "X48",
        input: "light seen only through glass",
        must: "mean right by hits, with weight 1; 4 se",
        measure: caustic,
    },
    Case { id: "X49", input: "a black scene", must: "exactly 0 everywhere", measure: black },
    Case {
        id: "X50",
        input: "image of 1x1, 1 sample; of 16384x16384; 2^20 samples; more than 2^32 in all",
        must: "no overflow, 64-bit counters, exact (whole images: --heavy)",
        measure: sizes,
    },
    Case {
        id: "X51",
        input: "shutter and aperture 0; field of view 1e-3 and 179.9 degrees",
        must: "finite rays, unit directions, 1e-6",
        measure: cameras,
    },
    Case {
        id: "X52",
        input: "sample numbers 2^24 and 2^32 - 1, dimension 1e4",
        must: "uniform (chi-square, alpha 1e-3), no repetition",
        measure: late_samples,
    },
    Case {
        id: "X53",
        input: "time limit, interruption or failure in the middle of a batch",
        must: "complete batches are kept, the end is told, exact",
        measure: cut_short,
    },
];

/// A ball of albedo `rho` around the camera whose wall glows with 1.
fn ball(rho: f64) -> compiler::pipeline::Compiled {
    let text = format!(
        "rts 1
material wall: diffuse {{ color = linear({rho}) }}
material lamp: emissive {{ color = linear(1) }}
instance room {{ shape = sphere(radius: 1m), material = wall }}
instance spark {{ shape = sphere(radius: 1mm), material = lamp, at = (0, 5, 0)m }}
{}",
        view([0.2, 0.1, 0.0], [0.0, -1.0, 0.1], 1024)
            .replace("seed = 11", "seed = 11, sampler = pcg")
    );
    let mut compiled = scene::compile(&text);
    // The language keeps scattering and emission apart in simple materials; the record does not.
    glow(&mut compiled, MaterialKind::Diffuse);
    compiled.lowered.render.max_depth = 65_535;
    compiled
}

fn glow(compiled: &mut compiler::pipeline::Compiled, kind: MaterialKind) {
    for material in &mut compiled.lowered.materials {
        if material.kind == kind as u32 {
            material.emission = [1.0; 3];
            material.flags |= material_flag::EMIT_BOTH_SIDES;
        }
    }
}

fn room() -> Vec<Row> {
    let bytes = scene::bytes(&ball(0.999));
    let [few, many] = [16, 64].map(|n| films_of(&bytes, sized(10, n)));
    let truth = 1.0 / (1.0 - f64::from(0.999_f32));
    let spread = |film: &runtime::Film| {
        let mut mean = Mean::default();
        for x in channel(film, 1) {
            mean.add(x);
        }
        mean.deviation()
    };
    let ratio = [0, 1].map(|i| spread(&few[i]) / spread(&many[i]));
    vec![
        Row::mean("radiance", truth, 1e-4, estimates(&many)),
        // Each of the two is known to 7 %.
        Row::near("noise of 16 samples over that of 64", 2.0, 0.6, ratio),
    ]
}

fn mirrors() -> Vec<Row> {
    let text = format!(
        "rts 1
material glass: metal {{ color = linear(0.9999), fuzz = 0 }}
material lamp: emissive {{ color = linear(1) }}
instance a {{ shape = rectangle(size: (4, 4)m), material = glass, rotate = (90, 0, 0)deg, at = (0, 0, -1)m }}
instance b {{ shape = rectangle(size: (4, 4)m), material = glass, rotate = (90, 0, 0)deg, at = (0, 0, 1)m }}
instance spark {{ shape = sphere(radius: 1mm), material = lamp, at = (0, 5, 0)m }}
{}",
        view([0.0; 3], [0.0, 0.0, -1.0], 1024)
    );
    let mut compiled = scene::compile(&text);
    glow(&mut compiled, MaterialKind::Metal);
    compiled.lowered.render.max_depth = 65_535;
    let roulette = films_of(&scene::bytes(&compiled), sized(16, 4));
    let n = 20_000_u32;
    compiled.lowered.render.max_depth = n;
    compiled.lowered.render.roulette_depth = n;
    let whole = films_of(&scene::bytes(&compiled), sized(2, 2));
    let rho = f64::from(0.9999_f32);
    let truth = [0, 1].map(|i| {
        let bounces = f64::from(whole[i].counters.depth);
        (1.0 - rho.powf(bounces)) / (1.0 - rho)
    });
    let means = estimates(&whole);
    let off = [0, 1].map(|i| (means[i].mean / truth[i] - 1.0).abs());
    let depth = whole.each_ref().map(|film| f64::from(film.counters.depth));
    // No path ends before its throughput asks for less than certainty, that of the first bounce taken out; from there on
    // each bounce is survived with the reflectance. The longest that a pack allows is 65535.
    let paths = roulette[0].total_samples() as f64;
    let certain = 1.0 - f64::from(ROULETTE_SURVIVAL).ln() / rho.ln();
    let chance = (1.0 - rho.powf(65_535.0 - certain)) / (1.0 - rho);
    let length = certain + chance;
    let lengths = roulette.each_ref().map(|film| {
        let mean = film.counters.rays as f64 / paths;
        Estimate { mean, error: chance / paths.sqrt() }
    });
    vec![
        Row::near("bounces without roulette", f64::from(n), 0.0, depth),
        Row::below("relative error of radiance without roulette", 1e-3, off),
        Row::mean("mean length of a path with roulette", length, 0.0, lengths),
        Row::mean("radiance with roulette", 1.0 / (1.0 - rho), 1e-3, estimates(&roulette)),
    ]
}

fn caustic() -> Vec<Row> {
    let text = format!(
        "material white: diffuse {{ color = linear(1) }}
material glass: dielectric {{ ior = 1.5 }}
material lamp: emissive {{ color = linear(1) }}
instance shell {{ shape = sphere(radius: 4m), material = lamp }}
instance block {{ shape = box(size: (2, 2, 2)m), material = glass }}
instance stone {{ shape = box(size: (1, 1, 1)m), material = white }}
{}",
        view([0.3, 0.4, 3.0], [0.0; 3], 1024)
    );
    vec![Row::mean(
        "radiance of white stone in glass in light of 1",
        1.0,
        1e-5,
        estimates(&films_of(&endless(&text), sized(16, 256))),
    )]
}

fn black() -> Vec<Row> {
    let text = format!(
        "material black: diffuse {{ color = linear(0) }}
material grey: diffuse {{ color = linear(0.5) }}
instance a {{ shape = sphere(radius: 1m), material = black }}
instance b {{ shape = box(size: (3, 1, 1)m), material = grey }}
light bulb: sphere {{ center = (0, 5, 0)m, radius = 50cm }}
{}",
        super::tools::shot([0.0, 1.0, 5.0], [0.0; 3], 40.0, 8)
    );
    // The language refuses a scene without light; one whose light is put out is black, too.
    let (_, said) = diagnose(
        Path::new(""),
        &text.replace("light bulb: sphere { center = (0, 5, 0)m, radius = 50cm }", ""),
    );
    let told = first_error(&said);
    let mut compiled = scene::compile(&format!("rts 1\n{text}"));
    for material in &mut compiled.lowered.materials {
        material.emission = [0.0; 3];
    }
    let films = films_of(&scene::bytes(&compiled), sized(32, 16));
    let lit = count(&films, |c| c.map(f64::to_bits) != [0; 3]);
    let bad = [0, 1].map(|i| films[i].counters.bad);
    vec![
        Row::fact("no light in the text", "an error that says so", &told, told.contains("black")),
        Row::never("pixels that are not 0", 1024, lit),
        Row::never("samples that are not finite", 16_384, bad),
        until_error(&scene::bytes(&compiled)),
    ]
}

/// A goal of 1 % in a picture whose error is 0 over 0.
fn until_error(black: &[u8]) -> Row {
    let found = [Precision::F32, Precision::F64].map(|precision| {
        let outcome = picture::cpu(open(black), |job| {
            sized(32, 1 << 18)(job);
            job.precision = precision;
            job.measure = Some(Measure { goal: "0.01".parse().ok(), ..Measure::default() });
        });
        let points = outcome.convergence.map_or(Vec::new(), |curve| curve.points);
        let numbers = |point: &Point| {
            let noise = point.noise;
            [noise.mean, noise.mse, noise.rel, noise.rel_lo, noise.rel_hi, noise.p95, noise.top]
        };
        let exact = points.iter().flat_map(numbers).all(|x| x.to_bits() == 0);
        // Goals begin at 64 samples, and hold at two points in a row.
        let soon = points.last().is_some_and(|point| point.spp < 10_000);
        let text = format!(
            "{:?}, {}, {}",
            outcome.stop,
            if soon { "at once" } else { "late" },
            if exact { "0" } else { "not 0" }
        );
        (text, outcome.stop == Stop::ErrorReached && soon && exact)
    });
    let [(single, a), (double, b)] = found;
    let what = "`--until-error 0.01` ends, its numbers are";
    let expected = "ErrorReached, at once, 0";
    Row { double, ..Row::fact(what, expected, &single, a && b) }
}

fn sizes() -> Vec<Row> {
    let text = format!("{WHITE_SKY}{}", view([0.0, 0.0, 5.0], [0.0; 3], 2));
    let bytes = scene::bytes(&scene::compile(&format!("rts 1\n{text}")));
    let one = films_of(&bytes, sized(1, 1));
    let large = films_of(&bytes, |job: &mut Job| {
        job.resize([16_384, 16_384]);
        job.crop = Rect { x: 16_382, y: 16_382, w: 2, h: 2 };
        job.samples = SampleRange { start: 0, end: 4 };
    });
    let late = films_of(&bytes, |job: &mut Job| {
        job.resize([2, 2]);
        job.samples = SampleRange { start: u32::MAX - 5, end: u32::MAX };
    });
    let mut counters = Counters { rays: u64::from(u32::MAX), ..Counters::default() };
    counters.add(&counters.clone());
    let mean = |films: &[runtime::Film; 2]| [0, 1].map(|i| films[i].mean(0)[1]);
    vec![
        Row::near("1x1, 1 sample", 1.0, 0.0, mean(&one)),
        Row::near("last pixels of 16384x16384", 1.0, 0.0, mean(&large)),
        Row::near("the last 5 of 2^32 samples", 1.0, 0.0, mean(&late)),
        Row::fact(
            "rays of two runs of 2^32 - 1",
            "8589934590",
            &counters.rays.to_string(),
            counters.rays == 8_589_934_590,
        ),
    ]
}

twins! {
    /// Rays that are not finite or not unit to 1e-6.
    fn bad_rays(fov: f64) -> u64 {
        let tan = (0.5 * fov.to_radians()).tan() as f32;
        let camera = Camera {
            origin: [0.3, -0.2, 0.1],
            lens_radius: 0.0,
            right: [0.8, 0.0, -0.6],
            half_height: tan,
            up: [0.0, 1.0, 0.0],
            focus_distance: 2.5,
            forward: [-0.6, 0.0, -0.8],
            half_width: tan,
            ..Camera::default()
        };
        let bench = Bench::new().camera(camera, [64, 64]);
        let mut kernel = open(&bench);
        let mut bad = 0;
        for i in 0..=64_u32 {
            for j in 0..=64_u32 {
                let key = kernel.sample_key(glam::UVec2::new(i, j), 0, 1);
                let ray = kernel.dispatch_camera(key, V2::new(i as Real, j as Real));
                let length = wide(ray.dir).length();
                let fine = (length - 1.0).abs() < 1e-6 && wide(ray.origin).is_finite();
                bad += u64::from(!fine);
            }
        }
        bad
    }
}

fn cameras() -> Vec<Row> {
    let bad = |fov: f64| {
        Row::never(
            format!("bad rays at {fov} degrees, aperture 0, shutter 0"),
            4225,
            both!(bad_rays(fov)),
        )
    };
    let wide = view([0.0, 0.0, 5.0], [0.0; 3], 2).replace("0.001deg", "179.9deg");
    let (compiled, said) = diagnose(Path::new(""), &format!("{WHITE_SKY}{wide}"));
    let refused = compiled.is_none() && said.contains("error[");
    let line = first_error(&said);
    vec![
        bad(1e-3),
        bad(179.9),
        Row::fact("the language at 179.9 degrees", "an error: 179 is the most", &line, refused),
    ]
}

fn late_samples() -> Vec<Row> {
    let mut rows = Vec::new();
    let n = 1 << 16;
    for kind in [SamplerKind::Sobol, SamplerKind::Pcg] {
        let bench = Bench::new().sampler(kind);
        let mut kernel = bench.single();
        for (name, first, bounce) in [
            ("from 2^24", 1 << 24, 0),
            ("up to 2^32 - 1", u32::MAX - (n - 1), 0),
            ("from 2^24, dimension 1e4", 1 << 24, 10_000 / 32),
        ] {
            let mut counts = Counts::uniform(32 * 32, n as usize);
            let mut seen = BTreeSet::new();
            let key = kernel.sample_key(glam::UVec2::new(321, 16), 0, 7);
            for i in 0..n {
                let key = runtime::kernel::f32::SampleKey { sample: first + i, bounce, ..key };
                let p = kernel.sample_2d(key, runtime::kernel::f32::PURPOSE_DIRECTION);
                counts.add(index(p.x.into(), 32) * 32 + index(p.y.into(), 32));
                seen.insert((p.x.to_bits(), p.y.to_bits()));
            }
            let p = counts.p_value();
            let fresh = seen.len() == n as usize;
            let found = format!("p {}, {} pairs", super::number(p), seen.len());
            rows.push(Row::fact(
                format!("{kind:?} {name}"),
                "p > 1e-3, 65536 pairs",
                &found,
                p > 1e-3 && fresh,
            ));
        }
    }
    rows
}

fn cut_short() -> Vec<Row> {
    let text = format!(
        "rts 1\n{WHITE_SKY}material m: diffuse {{ color = linear(0.5) }}
instance ball {{ shape = sphere(radius: 1m), material = m }}\n{}",
        super::tools::shot([0.0, 1.0, 5.0], [0.0; 3], 40.0, 8)
    );
    let bytes = scene::bytes(&scene::compile(&text));
    let mut rows = Vec::new();
    for (name, wanted) in [
        ("time limit", Stop::TimeLimit),
        ("interruption", Stop::Cancelled),
        ("failure", Stop::Failed),
    ] {
        let scene = Scene::new(open(&bytes));
        let mut job = Job::of_scene(&scene);
        job.resize([128, 128]);
        job.samples = SampleRange { start: 0, end: 1 << 20 };
        let n_blocks = AtomicU64::new(0);
        let control = Control::new(move |event| {
            // Between two batches of sixteen blocks each.
            let breaks = wanted == Stop::Failed
                && matches!(event, Event::Block)
                && n_blocks.fetch_add(1, Ordering::Relaxed) == 23;
            assert!(!breaks, "this block breaks");
        });
        match wanted {
            Stop::TimeLimit => job.time_limit = Some(Duration::from_millis(60)),
            Stop::Cancelled => control.cancel(),
            _ => job.samples.end = 64,
        }
        let row = match render(&scene, &job, &DeviceChoice::Cpu, &control) {
            Err(error) => Row::fact(name, &format!("{wanted:?}"), &error.to_string(), false),
            Ok(outcome) => {
                let film = outcome.film();
                let told = outcome.stop == wanted && film.samples().0 < job.samples.end;
                let failed = wanted == Stop::Failed && outcome.failures.len() == 1;
                let even = film.is_even() || failed;
                let found = format!(
                    "{:?}, {}",
                    outcome.stop,
                    if even { "whole batches" } else { "uneven" }
                );
                Row::fact(name, &format!("{wanted:?}, whole batches"), &found, told && even)
            }
        };
        rows.push(row);
    }
    rows
}
