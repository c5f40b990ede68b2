//! Light groups: together they are the picture to the last bit, and each is the light of its own lights.

use runtime::convergence::{Goal, Measure, Quantity};
use runtime::layers::{Group, Layer, LayerNames, Wanted};
use runtime::output::{self, Picture, merge, read_exr};
use runtime::{CpuWay, Film, Job, Outcome, Precision, SampleRange};
use std::collections::BTreeMap;
use tests::exr_file::File;
use tests::features::{CASES, case_pack};
use tests::picture::{self, Estimate};
use tests::{scene, software};

/// A box without a ceiling, a mirror and a ball of glass in it, lit by everything that can.
const BOX: &str = "rts 1
param key_on: number = 1
param bulbs_on: number = 1
param day_on: number = 1
param spare_on: number = 1
material white: diffuse { color = linear(0.7) }
material red: diffuse { color = linear(0.6, 0.05, 0.05) }
material mirror: metal { color = linear(0.9) }
material glass: dielectric { ior = 1.5 }
material panel: emissive { color = linear(1, 0.8, 0.6), strength = 9 * key_on }
material bulb: emissive { color = linear(0.3, 0.5, 1), strength = 20 * bulbs_on }
material spare_bulb: emissive { color = linear(0.2, 1, 0.3), strength = 5 * spare_on }
instance floor { shape = rectangle(size: (4, 4)m), material = white }
instance back { shape = rectangle(size: (4, 4)m), material = white, rotate = (90, 0, 0)deg, at = (0, 2, -2)m }
instance left { shape = rectangle(size: (4, 4)m), material = red, rotate = (0, 0, -90)deg, at = (-2, 2, 0)m }
instance pane { shape = rectangle(size: (1, 2)m), material = mirror, rotate = (90, 0, 0)deg, at = (-0.8, 1, -1.7)m }
instance ball { shape = sphere(radius: 50cm), material = glass, at = (0.8, 0.5, 0)m }
instance lamp { shape = box(size: (80, 10, 80)cm), material = panel, at = (0, 3, 0)m, group = \"key\" }
instance bulbs[i in 0..2] { shape = sphere(radius: 8cm), material = bulb, at = (-1 + 2 * i, 0.4, 0.8)m, group = \"bulbs\" }
instance spare { shape = sphere(radius: 10cm), material = spare_bulb, at = (1.5, 2, -1)m }
sky day: constant { color = linear(0.4, 0.6, 1), strength = 0.3 * day_on }
camera eye: perspective { from = (0, 1.6, 6)m, to = (0, 1.4, 0)m, fov.vertical = 40deg }
film small { size = (32, 32)px }
render main: path { camera = eye, film = small, samples = 32, depth = 8, seed = 3 }
";

const NAMES: [&str; 4] = ["bulbs", "key", "rest", "sky"];

/// The box with one of its lights declared otherwise.
fn pack(text: &str) -> pack::Pack<pack::Checked> {
    scene::pack(text)
}

fn wanted() -> Wanted {
    Wanted { layers: [Layer::Lights].into(), transparent: false, names: LayerNames::Blender }
}

fn render(text: &str, set: impl FnOnce(&mut Job)) -> Outcome {
    picture::cpu(pack(text), |job| {
        job.wanted = wanted();
        set(job);
    })
}

fn lights(outcome: &Outcome) -> &[Group] {
    &outcome.picture.layers.as_ref().expect("there are layers").lights
}

/// Adds the channels of all groups in the order of the file and backwards, and compares each sum with the picture.
fn adds_up(picture: &Picture) {
    let file = File::written(picture, false);
    let is_blender = file.texts["layer_names"] == "blender";
    let (stem, whole) =
        if is_blender { ("ViewLayer.Combined_", "ViewLayer.Combined.") } else { ("lights.", "") };
    for colour in ["R", "G", "B"] {
        let end = format!(".{colour}");
        let groups = file.channels.iter().filter(|(n, _)| n.starts_with(stem) && n.ends_with(&end));
        let groups: Vec<&Vec<f32>> = groups.map(|(_, values)| values).collect();
        assert!(!groups.is_empty());
        for (i, whole) in file.channels[&format!("{whole}{colour}")].iter().enumerate() {
            let forwards = groups.iter().fold(0.0, |sum: f32, values| sum + values[i]);
            let backwards = groups.iter().rev().fold(0.0, |sum: f32, values| sum + values[i]);
            assert_eq!([forwards, backwards].map(f32::to_bits), [whole.to_bits(); 2], "pixel {i}");
            assert!(groups.iter().all(|values| values[i] >= 0.0));
        }
    }
}

/// How far the sums of the groups are from those of the film, before anything is rounded off: relative to the pixel.
fn off(film: &Film, groups: &[Group]) -> f64 {
    let mut worst = 0.0_f64;
    for (i, sum) in film.sums.iter().enumerate() {
        let brightest = sum.iter().copied().fold(1e-6, f64::max);
        for (c, sum) in sum.iter().enumerate() {
            let of_groups: f64 = groups.iter().map(|group| group.sums[i][c]).sum();
            worst = worst.max((of_groups - sum).abs() / brightest);
        }
    }
    worst
}

/// A batch of 16 samples is a sum in single precision.
const ROUNDING: f64 = 16.0 / (1 << 24) as f64;

type Set = fn(&mut Job);

#[test]
fn groups_add_up_to_the_picture_in_every_way_to_render_it() {
    let ways: [(&str, Set); 7] = [
        ("as it is", |_| ()),
        ("plain names", |job| job.wanted.names = LayerNames::Plain),
        ("clamped", |job| job.clamp_indirect = Some(0.3)),
        ("transparent", |job| {
            job.wanted.transparent = true;
            job.wanted.layers.insert(Layer::Alpha);
        }),
        ("twice the precision", |job| job.precision = Precision::F64),
        ("a part of it", |job| job.crop = runtime::Rect { x: 5, y: 7, w: 9, h: 4 }),
        ("odd samples", |job| job.samples = SampleRange { start: 3, end: 40 }),
    ];
    for (name, set) in ways {
        let plain = picture::cpu(pack(BOX), |job| {
            set(job);
            job.wanted.layers.remove(&Layer::Lights);
        });
        let outcome = render(BOX, set);
        assert_eq!(plain.picture.film, outcome.picture.film, "{name}");
        let names: Vec<&str> = lights(&outcome).iter().map(|group| group.name.as_str()).collect();
        assert_eq!(names, NAMES, "{name}");
        let off = off(outcome.film(), lights(&outcome));
        // What is transparent has lost much of its own digits.
        let most = if name == "transparent" { 1e-4 } else { ROUNDING };
        assert!(off < most, "{name}: {off:e}");
        adds_up(&outcome.picture);
    }
}

#[test]
fn groups_add_up_with_every_feature() {
    for case in CASES {
        let outcome = picture::cpu(case_pack(case), |job| {
            job.wanted = wanted();
            job.samples = SampleRange { start: 0, end: 4 };
        });
        let off = off(outcome.film(), lights(&outcome));
        assert!(off < ROUNDING, "{}: {off:e}", case.name);
        adds_up(&outcome.picture);
    }
}

#[test]
fn every_kernel_gives_the_same_groups() {
    let whole = render(BOX, |_| ());
    for (by_hand, lanes) in [(true, 8), (true, 1), (false, 1)] {
        let other = render(BOX, |job| job.way = CpuWay { by_hand, lanes });
        assert_eq!(whole.picture.layers, other.picture.layers);
        adds_up(&other.picture);
    }
    let Some(device) = software::device() else { return };
    let other = picture::on(&device, pack(BOX), |job| job.wanted = wanted());
    assert_eq!(other.device_error, None);
    let bits = |outcome: &Outcome| File::written(&outcome.picture, false).channels;
    assert_eq!(bits(&whole), bits(&other));
}

#[test]
fn parts_of_groups_merge_to_the_groups_of_one_run() {
    let folder = tempfile::tempdir().expect("a folder");
    // Means over 37 samples are no multiples of a power of two.
    for (names, last) in [(LayerNames::Blender, 32), (LayerNames::Plain, 37)] {
        let range = |start, end| {
            move |job: &mut Job| {
                job.samples = SampleRange { start, end };
                job.wanted.names = names;
            }
        };
        let part = |name: &str, start, end| {
            let path = folder.path().join(name);
            let outcome = render(BOX, range(start, end));
            output::write(&path, &outcome.picture, true).expect("it can be written");
            adds_up(&outcome.picture);
            read_exr(&path).expect("it can be read")
        };
        let parts = vec![part("b.exr", 16, last), part("a.exr", 0, 16)];
        let merged = merge(parts).expect("they are parts");
        let whole = render(BOX, range(0, last));
        adds_up(&merged);
        let [merged, whole] =
            [&merged, &whole.picture].map(|picture| File::written(picture, false));
        assert_eq!(
            merged.channels.keys().collect::<Vec<_>>(),
            whole.channels.keys().collect::<Vec<_>>()
        );
        for name in whole.channels.keys() {
            assert!(merged.bits(name) == whole.bits(name), "{name} differs");
        }
    }
    // The same pixels with other groups are parts of another picture.
    let mut parts = [
        render(BOX, |job| job.samples.end = 16),
        render(BOX, |job| {
            job.samples.start = 16;
        }),
    ]
    .map(|outcome| outcome.picture);
    let groups = parts[1].layers.as_mut().map(|layers| &mut layers.lights[1].name);
    "fill".clone_into(groups.expect("there are groups"));
    let error = merge(parts.into()).expect_err("they are not").to_string();
    assert!(error.contains("groups bulbs fill rest sky") && error.contains("bulbs key"), "{error}");
}

/// The box with all lights off but those of one group.
fn alone(group: &str) -> String {
    let mut text = BOX.to_owned();
    for (name, param) in NAMES.into_iter().zip(["bulbs_on", "key_on", "spare_on", "day_on"]) {
        if name != group {
            text = text.replace(
                &format!("param {param}: number = 1"),
                &format!("param {param}: number = 0"),
            );
        }
    }
    text
}

/// Where lights are only met, never sampled, other lights change no path: a group is what the others' absence leaves.
#[test]
fn a_group_is_the_picture_without_the_other_lights() {
    const ONLY_MET: u32 = 2;
    let whole = render(BOX, |job| job.estimator = ONLY_MET);
    for (group, name) in lights(&whole).iter().zip(NAMES) {
        let alone = picture::cpu(pack(&alone(name)), |job| job.estimator = ONLY_MET);
        assert!(alone.film().sums.iter().flatten().sum::<f64>() > 1.0, "{name}");
        let mut lit = 0;
        for (own, alone) in group.sums.iter().zip(&alone.film().sums) {
            for (own, alone) in own.iter().zip(alone) {
                assert!((own - alone).abs() <= 1e-5 * alone.abs(), "{name}: {own} and {alone}");
                lit += u32::from(*own > 0.0);
            }
        }
        assert!(lit > 100, "{name}: {lit}");
    }
}

/// With lights sampled, the same holds within the noise.
#[test]
fn a_group_converges_to_the_picture_without_the_other_lights() {
    let mut of_groups: BTreeMap<&str, Vec<f64>> = BTreeMap::new();
    let mut of_pictures: BTreeMap<&str, Vec<f64>> = BTreeMap::new();
    let mean = |sums: &[[f64; 3]]| sums.iter().flatten().sum::<f64>();
    for seed in 0..8 {
        let whole = render(BOX, |job| job.seed = seed);
        for (group, name) in lights(&whole).iter().zip(NAMES) {
            of_groups.entry(name).or_default().push(mean(&group.sums));
            let alone = picture::cpu(pack(&alone(name)), |job| job.seed = 100 + seed);
            of_pictures.entry(name).or_default().push(mean(&alone.film().sums));
        }
    }
    for (name, own) in of_groups {
        let (own, alone) = (Estimate::of(&own), Estimate::of(&of_pictures[name]));
        let z = (own.mean - alone.mean) / (own.error.powi(2) + alone.error.powi(2)).sqrt();
        // Four comparisons at a level of 1e-4 or so.
        assert!(z.abs() < 4.5, "{name}: {own:?} and {alone:?}");
        assert!(own.error < 0.05 * own.mean, "{name}: {own:?} says nothing");
    }
}

#[test]
fn a_ray_that_sees_sky_and_sun_gives_each_its_own_light() {
    let text = "rts 1
material black: diffuse { color = linear(0) }
instance behind { shape = sphere(radius: 1m), material = black, at = (0, 0, 9)m }
sky day: constant { color = linear(0.5) }
light sun: directional { direction = (0, 0, -1), angular_diameter = 90deg, strength = 2, group = \"sun\" }
light moon: directional { direction = (0, 0.1, -1), angular_diameter = 90deg, strength = 0.25 }
camera eye: perspective { from = (0, 0, 0)m, to = (0, 0, -1)m, fov.vertical = 10deg }
film small { size = (8, 8)px }
render main: path { camera = eye, film = small, samples = 16, depth = 2, seed = 3 }
";
    let outcome = render(text, |_| {});
    adds_up(&outcome.picture);
    for (name, expected) in [("sun", 2.0), ("rest", 0.25), ("sky", 0.5)] {
        let group = lights(&outcome).iter().find(|group| group.name == name);
        for sum in &group.expect("the group is there").sums {
            assert!((sum[1] / 16.0 - expected).abs() < 1e-6, "{name}: {sum:?}");
        }
    }
}

#[test]
fn what_names_no_group_is_in_sky_or_rest() {
    let text = BOX.replace(", group = \"key\"", "").replace(", group = \"bulbs\"", "");
    let outcome = render(&text, |_| ());
    let names: Vec<&str> = lights(&outcome).iter().map(|group| group.name.as_str()).collect();
    assert_eq!(names, ["rest", "sky"]);
    adds_up(&outcome.picture);
    // A sky may be in the group of a light, and `rest` without light is no layer.
    let text = BOX
        .replace("0.3 * day_on", "0.3 * day_on, group = \"key\"")
        .replace("= spare_bulb", "= white");
    let outcome = render(&text, |_| ());
    let file = File::written(&outcome.picture, false);
    let reds: Vec<&str> = file
        .channels
        .keys()
        .map(String::as_str)
        .filter(|name| name.strip_suffix(".R").is_some())
        .collect();
    assert_eq!(
        reds,
        ["ViewLayer.Combined.R", "ViewLayer.Combined_bulbs.R", "ViewLayer.Combined_key.R"]
    );
    adds_up(&outcome.picture);
}

#[test]
fn a_run_to_a_goal_has_layers_of_its_own_samples() {
    let layers = [Layer::Lights, Layer::Albedo, Layer::Alpha, Layer::Samples, Layer::Variance];
    let outcome = picture::cpu(pack(BOX), |job| {
        job.wanted = Wanted { layers: layers.into(), ..wanted() };
        job.samples = SampleRange { start: 0, end: 4096 };
        let goal = Some(Goal { quantity: Quantity::Rel, limit: 0.2 });
        job.measure = Some(Measure { goal, ..Measure::default() });
    });
    assert_eq!(outcome.stop, runtime::Stop::ErrorReached);
    let film = outcome.film();
    let (least, most) = film.samples();
    assert!(least == most && most < 4 * 4096, "{most} samples");
    let layers = outcome.picture.layers.as_ref().expect("there are layers");
    assert_eq!(layers.samples, most, "of all replicates");
    assert!(layers.covered.iter().all(|n| *n == most), "the sky is part of the picture");
    let off = off(film, &layers.lights);
    assert!(off < ROUNDING, "{off:e}");
    adds_up(&outcome.picture);
    let file = File::written(&outcome.picture, false);
    assert!(
        file.channels["ViewLayer.Debug Sample Count.X"]
            .iter()
            .all(|n| n.to_bits() == (most as f32).to_bits())
    );
    assert!(file.channels["variance.Y"].iter().any(|v| *v > 0.0));
}
