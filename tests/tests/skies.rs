//! Skies: closed forms, agreeing estimators, and directions that are where they are said to be.

use std::f64::consts::{PI, TAU};
use std::path::Path;

use glam::DVec3;
use pack::{Checked, Pack};
use tests::console;
use tests::kernel::Bench;
use tests::picture::{self, Estimate, channel};
use tests::scene;
use tests::statistics::stream::Stream;

/// A lat-long image of 64 x 32 texels, grey.
fn save(dir: &Path, texel: impl Fn(usize, usize) -> f32 + Sync) {
    exr::prelude::write_rgb_file(dir.join("sky.exr"), 64, 32, |x, y| {
        let value = texel(x, y);
        (value, value, value)
    })
    .expect("an image can be written");
}

fn pack_in(dir: &Path, text: &str) -> Pack<Checked> {
    Pack::from_bytes(scene::bytes(&scene::compile_in(dir, text))).expect("valid")
}

/// A white floor of which every pixel sees the same point.
fn floor(sky: &str) -> String {
    format!(
        "rts 1
sky s: {sky}
material white: diffuse {{ color = linear(1) }}
instance floor {{ shape = rectangle(size: (200, 200)m), material = white }}
camera eye: perspective {{
  from = (-3, 0.5, 0)m
  to = (0, 0, 0)m
  up = (0.1, 0.2, 1)
  fov.vertical = 0.001deg
}}
film f {{ size = (16, 16)px }}
render main: path {{ camera = eye, film = f, samples = 16, depth = 2, seed = 11 }}
"
    )
}

/// The mean over pixels is `expected`, and known well enough to say so.
fn check(name: &str, pack: Pack<Checked>, samples: u32, expected: f64) {
    let outcome = picture::cpu(pack, |job| {
        job.samples = runtime::SampleRange { start: 0, end: samples };
    });
    let found = Estimate::of(&channel(outcome.film(), 1));
    let z = found.z(expected);
    console::line(&format!(
        "{name:<36} expected {expected:.6} found {:.6} +- {:.6}",
        found.mean, found.error
    ));
    let near = (found.mean - expected).abs() <= 4.0 * found.error + 2e-6 * expected;
    assert!(near && found.error <= 0.003 * expected, "{name}: z = {z:.2}, {found:?}");
}

#[test]
fn an_image_of_one_colour_is_a_constant_sky() {
    let dir = tempfile::tempdir().expect("dir");
    save(dir.path(), |_, _| 0.75);
    let image = floor("image { file = \"sky.exr\", strength = 2 }");
    check("image of one colour", pack_in(dir.path(), &image), 256, 1.5);
    check("constant", pack_in(dir.path(), &floor("constant { strength = 1.5 }")), 256, 1.5);
}

/// What a white floor reflects of one bright texel: interpolation spreads it as a tent over its neighbours.
/// The tent along the columns has the area of one texel, whatever the column and the turn. Not for the rows at
/// the poles, where half of the tent is flat.
fn tent_of(value: f64, y: f64) -> f64 {
    let fine = 400;
    let mut sum = 0.0;
    for i in 0..fine {
        let v = -1.0 + 2.0 * (f64::from(i) + 0.5) / f64::from(fine);
        let theta = PI * (y + 0.5 + v) / 32.0;
        sum += (1.0 - v.abs()) * theta.sin() * theta.cos().max(0.0);
    }
    value * sum * 2.0 / f64::from(fine) * (PI / 32.0) * (TAU / 64.0) / PI
}

#[test]
fn a_sun_of_one_texel_gives_radiance_times_solid_angle_times_cosine() {
    let dir = tempfile::tempdir().expect("dir");
    for (x, y) in [(10, 2), (63, 9), (0, 14), (40, 1)] {
        save(dir.path(), move |i, j| if (i, j) == (x, y) { 1000.0 } else { 0.0 });
        let text = floor("image { file = \"sky.exr\", rotate = 33deg }");
        let expected = tent_of(1000.0, y as f64);
        check(&format!("sun in texel {x}, {y}"), pack_in(dir.path(), &text), 1024, expected);
    }
}

#[test]
fn the_sky_is_seen_where_it_is_said_to_be() {
    let dir = tempfile::tempdir().expect("dir");
    // Which texels straddle a direction: the middle of the image is between columns 31 and 32.
    save(dir.path(), |x, y| if (31..33).contains(&x) && (15..17).contains(&y) { 9.0 } else { 1.0 });
    for (rotate, towards) in
        [(0, [0, 0, -1]), (90, [-1, 0, 0]), (180, [0, 0, 1]), (-90, [1, 0, 0]), (450, [-1, 0, 0])]
    {
        let [x, y, z] = towards;
        let text = format!(
            "rts 1
sky s: image {{ file = \"sky.exr\", rotate = {rotate}deg }}
camera eye: perspective {{ from = (0, 0, 0)m, to = ({x}, {y}, {z})m, fov.vertical = 1deg }}
film f {{ size = (4, 4)px }}
render main: path {{ camera = eye, film = f, samples = 4, seed = 11 }}
"
        );
        let outcome = picture::cpu(pack_in(dir.path(), &text), |_| {});
        let seen = channel(outcome.film(), 1);
        assert!(seen.iter().all(|value| (value - 9.0).abs() < 1e-5), "{rotate}: {seen:?}");
    }
    // The top row is straight up, and the right half of the image is towards +x.
    save(dir.path(), |x, y| {
        if y == 0 {
            5.0
        } else if x >= 32 {
            2.0
        } else {
            1.0
        }
    });
    for (towards, up, expected) in
        [((0, 1, 0), (0, 0, -1), 5.0), ((1, 0, 0), (0, 1, 0), 2.0), ((-1, 0, 0), (0, 1, 0), 1.0)]
    {
        let text = format!(
            "rts 1
sky s: image {{ file = \"sky.exr\" }}
camera eye: perspective {{ from = (0, 0, 0)m, to = {towards:?}m, up = {up:?}, fov.vertical = 1deg }}
film f {{ size = (4, 4)px }}
render main: path {{ camera = eye, film = f, samples = 4, seed = 11 }}
"
        );
        let outcome = picture::cpu(pack_in(dir.path(), &text), |_| {});
        let seen = channel(outcome.film(), 1);
        assert!(seen.iter().all(|value| (value - expected).abs() < 1e-5), "{towards:?}: {seen:?}");
    }
}

#[test]
fn suns_brighter_than_a_half_float_keep_their_light() {
    let dir = tempfile::tempdir().expect("dir");
    save(dir.path(), |x, y| if (x, y) == (20, 4) { 3e6 } else { 0.0 });
    let text = floor("image { file = \"sky.exr\" }");
    let expected = tent_of(3e6, 4.0);
    check("sun of 3e6", pack_in(dir.path(), &text), 1024, expected);
}

/// Things that scatter in every way under a sky with a small sun.
fn things(sky: &str) -> String {
    format!(
        "rts 1
sky s: {sky}
material white: diffuse {{ color = linear(0.7) }}
material brass: metal {{ color = linear(0.8, 0.6, 0.3), fuzz = 0.4 }}
material paint: principled {{ color = linear(0.2, 0.4, 0.7), roughness = 0.5 }}
material lamp: emissive {{ color = linear(1, 0.9, 0.8), strength = 3 }}
instance floor {{ shape = rectangle(size: (6, 6)m), material = white }}
instance block {{ shape = box(size: (1, 1, 1)m), material = paint, at = (1.3, 0.5, -0.6)m }}
instance ball {{ shape = sphere(radius: 70cm), material = brass, at = (-0.8, 0.7, 0)m }}
instance glow {{ shape = sphere(radius: 40cm), material = lamp, at = (0.6, 0.4, 1.0)m }}
camera eye: perspective {{ from = (0, 1.6, 5)m, to = (0, 0.8, 0)m, fov.vertical = 40deg }}
film f {{ size = (24, 24)px }}
render main: path {{ camera = eye, film = f, samples = 96, depth = 16, seed = 1 }}
"
    )
}

#[test]
fn light_samples_bsdf_samples_and_both_agree_under_every_sky() {
    let dir = tempfile::tempdir().expect("dir");
    save(dir.path(), |x, y| {
        let sun = (x as f32 - 40.0).abs() < 2.5 && (y as f32 - 8.0).abs() < 2.5;
        if sun { 30.0 } else { 0.2 + 0.3 * ((x + y) % 5) as f32 }
    });
    for (i, sky) in [
        "image { file = \"sky.exr\", rotate = 20deg }",
        "gradient { sun.direction = (0.5, 0.4, 0.3), disc.power = 60 }",
    ]
    .into_iter()
    .enumerate()
    {
        let bytes = scene::bytes(&scene::compile_in(dir.path(), &things(sky)));
        let mut found: Vec<(&str, Estimate)> = Vec::new();
        for (k, (name, estimator)) in
            [("both", 0), ("light samples", 1), ("bsdf samples", 2)].into_iter().enumerate()
        {
            let first = 1000 * (1 + u32::try_from(3 * i + k).expect("few"));
            let means: Vec<f64> = (0..24)
                .map(|seed| {
                    let pack = Pack::from_bytes(bytes.clone()).expect("valid");
                    let outcome = picture::cpu(pack, |job| {
                        job.estimator = estimator;
                        job.seed = first + seed;
                    });
                    Estimate::of(&channel(outcome.film(), 1)).mean
                })
                .collect();
            let estimate = Estimate::of(&means);
            console::line(&format!(
                "{sky}: {name:<14} {:.5} +- {:.5}",
                estimate.mean, estimate.error
            ));
            found.push((name, estimate));
        }
        for (k, (a_name, a)) in found.iter().enumerate() {
            for (b_name, b) in &found[..k] {
                let z = (a.mean - b.mean) / a.error.hypot(b.error);
                assert!(z.abs() < 4.0, "{sky}: {a_name} and {b_name}: z = {z:.2}");
            }
        }
    }
}

/// The sunset of the defaults, written as sums of smooth steps over t = (y + 0.15) / 1.15.
#[test]
fn the_default_gradient_is_the_published_sunset() {
    let sun = DVec3::new(0.692, 0.207, -0.692);
    let text = "rts 1
sky s: gradient { sun.direction = (0.692, 0.207, -0.692) }
camera c: perspective { from = (0, 0, 5)m, to = (0, 0, 0)m }
render r: path { camera = c }
";
    let lowered = scene::compile(text).lowered;
    let bench = Bench::new().sky(lowered.sky.expect("a sky"), &[]);
    let mut kernel = bench.double();
    let smooth = |from: f64, to: f64, x: f64| {
        let t = ((x - from) / (to - from)).clamp(0.0, 1.0);
        t * t * (3.0 - 2.0 * t)
    };
    let published = |dir: DVec3| {
        let zenith = DVec3::new(0.015, 0.025, 0.12);
        let middle = DVec3::new(0.55, 0.12, 0.28);
        let horizon = DVec3::new(0.98, 0.42, 0.12);
        let dark = DVec3::new(0.12, 0.04, 0.03);
        let base = if dir.y > -0.15 {
            let t = (dir.y + 0.15) / 1.15;
            if t < 0.38 {
                horizon.lerp(middle, smooth(0.0, 0.38, t))
            } else {
                middle.lerp(zenith, smooth(0.38, 1.0, t))
            }
        } else {
            horizon.lerp(dark, smooth(0.0, 1.0, ((-dir.y - 0.15) * 2.5).clamp(0.0, 1.0)))
        };
        let c = dir.dot(sun.normalize()).max(0.0);
        let glow = DVec3::new(1.0, 0.3, 0.05) * 2.0 * c.powi(6);
        let disc = DVec3::new(1.0, 0.85, 0.4) * 15.0 * c.powi(400);
        base * 0.25 + glow * 0.35 + disc
    };
    let mut stream = Stream::new(3, 3);
    for _ in 0..10_000 {
        let dir = (stream.direction() + sun * stream.unit()).normalize();
        let (found, expected) = (kernel.dispatch_sky(dir), published(dir));
        assert!(
            (found - expected).length() < 3e-5 * expected.length(),
            "{dir}: {found} {expected}"
        );
    }
}
