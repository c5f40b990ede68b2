//! The contract of the one shading source: the CPU kernel and the WGSL on a software Vulkan adapter
//! give the same bits, for every feature and for all of them together.
//!
//! The specialised kernel of each pack runs on the adapter, without runtime checks, and the full
//! kernel on the CPU: so equality also shows that leaving code out changes nothing, and that nothing
//! relies on the checks. Real GPUs may contract products and sums; they are compared elsewhere, by
//! statistics.

use clap::ValueEnum as _;
use compiler::pipeline::Compiled;
use pack::abi::{Texture, TextureFormat};
use pack::{Checked, Pack};
use rayon::prelude::*;
use runtime::layers::{Layer, Wanted};
use runtime::{Control, DeviceChoice, Event, Film, Job, Outcome, Scene};
use std::sync::mpsc;
use tests::exr_file::File;
use tests::features::{CASES, case_pack, compiled, named};
use tests::{picture, scene, software};

/// Cases in which the estimators differ, one or more for each thing that they weigh. The kernel with everything
/// takes so long to compile that it is compared for the estimator of every picture only.
const ESTIMATED: [&str; 8] = [
    "lights of every kind",
    "tree of lights of every kind and the sky",
    "moving light with a picture and holes",
    "tinted light",
    "smoke",
    "fog",
    "petal",
    "every layer, textured",
];

/// What differs between the CPU and `device`, a line each.
fn differences(
    device: &DeviceChoice,
    name: &str,
    pack: impl Fn() -> Pack<Checked>,
    estimator: u32,
) -> Vec<String> {
    let set = |job: &mut runtime::Job| job.estimator = estimator;
    let (cpu, gpu) = (picture::cpu(pack(), set), picture::on(device, pack(), set));
    assert_eq!(gpu.device_error, None, "{name}");
    let mut found: Vec<String> = pixels(cpu.film(), gpu.film()).into_iter().collect();
    let (ours, theirs) = (&cpu.film().counters, &gpu.film().counters);
    if ours != theirs {
        found.push(format!("counters {ours:?} and {theirs:?}"));
    }
    found.into_iter().map(|line| format!("{name}, estimator {estimator}: {line}")).collect()
}

fn pixels(ours: &Film, theirs: &Film) -> Option<String> {
    let bits = |rgb: &[f64; 3]| rgb.map(f64::to_bits);
    let (ours, theirs) = (ours.means(), theirs.means());
    assert_eq!(ours.len(), theirs.len());
    let differ = ours.iter().zip(&theirs).filter(|(a, b)| bits(a) != bits(b)).count();
    let off = ours.iter().zip(&theirs).flat_map(|(a, b)| (0..3).map(|k| (a[k] - b[k]).abs()));
    let (n, worst) = (ours.len(), off.fold(0.0, f64::max));
    (differ > 0).then(|| format!("{differ} of {n} pixels differ, by up to {worst:.3e}"))
}

/// What differs between the CPU and `device` in a case, with each estimator that is compared there.
fn differences_of_case(device: &DeviceChoice, name: &str) -> Vec<String> {
    // One after another: the driver keeps the kernel.
    let ways = if ESTIMATED.contains(&name) { 0..4 } else { 0..1 };
    ways.flat_map(|way| differences(device, name, || case_pack(named(name)), way)).collect()
}

#[test]
fn cpu_and_software_adapter_give_the_same_bits_for_every_feature() {
    let this = "cpu_and_software_adapter_give_the_same_bits_for_every_feature";
    let Some(device) = software::device_without_optimiser(this) else { return };
    // The kernel with everything takes longest to compile: it is the last case, and goes first.
    let found: Vec<String> = (CASES.par_iter().rev().with_max_len(1))
        .flat_map_iter(|case| differences_of_case(&device, case.name))
        .collect();
    assert!(found.is_empty(), "{}", found.join("\n"));
}

/// A white room whose paths end after 1024 segments: a dispatch of 16 samples takes more turns of loops than
/// llvmpipe gives to all loops of an invocation.
const LONG_PATHS: &str = "rts 1
material white: diffuse { color = linear(0.9) }
material lamp: emissive { color = linear(1), strength = 1 }
instance room { shape = box(size: (4, 4, 4)m), material = white }
instance light { shape = sphere(radius: 200mm), material = lamp, at = (0, 1, 0)m }
camera main: perspective { from = (0m, 0m, 1.5m), to = (0m, 0m, 0m), fov.vertical = 60deg }
film small { size = (8, 8)px }
render long: path { samples = 16, depth = 1024, roulette = 1024 }
";

#[test]
fn pixels_whose_loops_a_driver_cuts_short_are_rendered_by_the_cpu() {
    let Some(device) = software::device() else { return };
    let (tell, heard) = mpsc::channel();
    let control = Control::new(move |event| {
        if let Event::Note(line) = event {
            tell.send(line.to_owned()).unwrap();
        }
    });
    let scene = Scene::new(scene::pack(LONG_PATHS));
    let film = runtime::render(&scene, &Job::of_scene(&scene), &device, &control);
    let film = film.expect("a small room").picture.film;
    let own = picture::cpu(scene::pack(LONG_PATHS), |_| {});
    assert_eq!((pixels(own.film(), &film), &own.film().counters), (None, &film.counters));
    // Or the test would see nothing.
    let notes: Vec<String> = heard.try_iter().collect();
    let told = "the driver cut loops short in 1 of 1 tiles; the CPU rendered them";
    assert!(notes.iter().any(|note| note == told), "{notes:?}");
}

/// Cases with what layers tell apart: names, normals and media, what is specular, what is not there, the camera's kinds.
const LAYERED: [&str; 9] = [
    "instances, brushed and of their own material",
    "instances of glass, filled",
    "moving light with a picture and holes",
    "partial coverage on spheres",
    "panoramic camera",
    "sea",
    "conductor",
    "smoke",
    "every layer, textured",
];

/// Layers of every kind that the kernel makes, and the picture without its sky.
fn layered(device: &DeviceChoice, name: &str) -> (Vec<String>, Outcome) {
    let (tell, heard) = mpsc::channel();
    let control = Control::new(move |event| {
        if let Event::Note(line) = event {
            tell.send(line.to_owned()).expect("the test listens");
        }
    });
    let scene = Scene::new(case_pack(named(name)));
    let mut job = Job::of_scene(&scene);
    // The others do not come from the kernel of layers.
    let other = [Layer::Variance, Layer::Lights];
    let layers = Layer::value_variants().iter().copied().filter(|layer| !other.contains(layer));
    job.wanted = Wanted { layers: layers.collect(), transparent: true, ..Wanted::default() };
    let outcome = runtime::render(&scene, &job, device, &control).expect("a small picture");
    assert_eq!(outcome.device_error, None, "{name}");
    (heard.try_iter().collect(), outcome)
}

#[test]
fn layers_have_the_same_bits_on_both() {
    let Some(device) = software::device_without_optimiser("layers_have_the_same_bits_on_both")
    else {
        return;
    };
    for name in LAYERED {
        let [(_, ours), (notes, theirs)] =
            [&DeviceChoice::Cpu, &device].map(|device| layered(device, name));
        let made = |line: &&String| line.starts_with("layers: ") && !line.contains("CPU");
        assert!(notes.iter().any(|line| made(&line)), "{name}: {notes:?}");
        assert!(!notes.iter().any(|line| line.contains("the CPU makes")), "{name}: {notes:?}");
        assert_eq!(pixels(ours.film(), theirs.film()), None, "{name}");
        let [ours, theirs] =
            [&ours, &theirs].map(|own| File::written(&own.picture, false).channels);
        assert!(ours.len() > 20, "{name}: {:?}", ours.keys());
        assert!(ours.keys().eq(theirs.keys()), "{name}");
        for (channel, values) in &ours {
            let pairs = values.iter().zip(&theirs[channel]);
            let first = pairs.clone().find(|(a, b)| a.to_bits() != b.to_bits());
            let n = pairs.filter(|(a, b)| a.to_bits() != b.to_bits()).count();
            assert_eq!(first, None, "{name}: {channel} differs in {n} pixels");
        }
    }
}

#[test]
fn every_feature_gives_light_and_no_bad_sample() {
    for case in CASES {
        let outcome = picture::cpu(case_pack(case), |_| {});
        let sum: f64 = picture::channel(outcome.film(), 1).iter().sum();
        assert!(sum.is_finite() && sum > 0.0, "{}: {sum}", case.name);
        assert_eq!(outcome.film().counters.bad, 0, "{}", case.name);
    }
}

#[test]
fn the_cases_cover_every_feature_of_a_pack() {
    let of = |pack: Pack<Checked>| pack::features::names(pack.features());
    let every: Vec<&str> = pack::features::NAMES.iter().map(|(_, name)| *name).collect();
    let mut seen: Vec<&str> = CASES.iter().flat_map(|case| of(case_pack(case))).collect();
    seen.sort_by_key(|name| every.iter().position(|known| known == name));
    seen.dedup();
    assert_eq!(seen, every);
    // A scene has one sky, one sampler, one camera and one filter; that is all that the last case lacks.
    let all = of(case_pack(named("all")));
    let lacks: Vec<&&str> = every.iter().filter(|name| !all.contains(name)).collect();
    let others = [
        "constant sky",
        "box filter",
        "tent filter",
        "gaussian filter",
        "Blackman-Harris filter",
        "independent samples",
        "image sky",
        "orthographic camera",
        "panoramic camera",
    ];
    assert_eq!(lacks, others.each_ref());
}

/// Width and height of an image larger than a binding, in texels: 151 MB.
const LARGE: [u32; 2] = [4096, 9216];

#[test]
fn texels_beyond_one_binding_are_read_through_windows() {
    let Some(device) = software::device() else { return };
    let scene = large_texture();
    assert!(scene.kernel.text.contains("texel_words_1"));
    let pack_of = |scene: &Compiled| {
        let bytes = scene::bytes(scene);
        move || Pack::from_bytes(bytes.clone()).expect("what was written can be read")
    };
    let pack = pack_of(&scene);
    assert_eq!(differences(&device, "large texture", &pack, 0), Vec::<String>::new());
    // The second window can be seen: without it the picture is another.
    let mut cut = scene;
    let mut texels = cut.lowered.texels.to_vec();
    texels[shaders::WINDOW_WORDS as usize..].fill([0; 4]);
    cut.lowered.texels = texels.into();
    let films = [pack(), pack_of(&cut)()].map(|pack| picture::cpu(pack, |_| {}));
    assert!(pixels(films[0].film(), films[1].film()).is_some());
}

/// A scene with one texture of size `LARGE`.
fn large_texture() -> Compiled {
    let mut scene = compiled(named("mixed wraps, without spheres"));
    let [width, height] = LARGE;
    let texture = scene.lowered.textures[0];
    let format = TextureFormat::Rgba8Srgb as u32;
    assert_eq!((scene.lowered.textures.len(), texture.format), (1, format));
    scene.lowered.textures = vec![Texture { width, height, ..texture }];
    let words = width * height / 4;
    assert!(words > shaders::WINDOW_WORDS);
    // Every word tells where it is.
    let word = |i: u32| [i.wrapping_mul(0x9e37_79b1), i >> 3, !i, i.rotate_left(9)];
    scene.lowered.texels = (0..words).map(word).collect::<Vec<_>>().into();
    scene.features.windows.texel = 2;
    scene.kernel = shaders::link(&scene.features).expect("two windows are few bindings");
    scene
}
