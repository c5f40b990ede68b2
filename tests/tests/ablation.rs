//! Kernels that are taken apart to find what features cost: the table in `rtr` puts together what the linker
//! links, and no feature that a scene does not need changes its picture.

use std::collections::BTreeSet;

use pack::abi::{MaterialKind, SkyKind, TextureFormat};
use rayon::prelude::*;
use runtime::ablation::{Ablation, Event, Measured, Plan, Row, ablate, kernel_texts, relinked};
use runtime::gpu::layers_kernel;
use runtime::{Control, DeviceChoice, Job, SampleRange, Scene};
use shaders::FeatureSet;
use tests::features::{CASES, Case, case_pack, compiled, named};
use tests::software;

/// The declarations of a kernel, in no order.
fn declarations(kernel: &str) -> BTreeSet<String> {
    let lines = kernel.lines().filter(|line| !line.starts_with("// ---- "));
    let (mut all, mut open, mut depth) = (BTreeSet::new(), String::new(), 0_i32);
    for line in lines.chain([""]) {
        if line.trim().is_empty() && depth == 0 {
            all.insert(std::mem::take(&mut open));
        } else {
            open += line;
            open += "\n";
            let code = line.split("//").next().unwrap_or_default();
            let count = |c| i32::try_from(code.matches(c).count()).expect("lines are short");
            depth += count('{') - count('}');
        }
    }
    all.remove("");
    all
}

fn scene_of(case: &Case) -> Scene {
    Scene::new(case_pack(case))
}

#[test]
fn the_table_puts_every_kernel_together_again() {
    let wrong: Vec<&str> = (CASES.par_iter())
        .filter(|case| {
            let scene = scene_of(case);
            let again = relinked(&scene).map(|text| declarations(&text));
            again.as_ref() != Some(&declarations(scene.pack().kernel()))
        })
        .map(|case| case.name)
        .collect();
    assert_eq!(wrong, Vec::<&str>::new());
}

#[test]
fn layers_of_every_case_have_a_valid_kernel() {
    let wrong: Vec<String> = (CASES.par_iter())
        .filter_map(|case| {
            let scene = scene_of(case);
            let Some(text) = layers_kernel(&scene) else {
                let plain = scene.pack().kernel().contains("fn trace(");
                return plain.then(|| format!("{}: none", case.name));
            };
            let module = match naga::front::wgsl::parse_str(&text) {
                Ok(module) => module,
                Err(error) => return Some(format!("{}: {error}", case.name)),
            };
            let (flags, all) =
                (naga::valid::ValidationFlags::all(), naga::valid::Capabilities::empty());
            let valid = naga::valid::Validator::new(flags, all).validate(&module);
            valid.err().map(|error| format!("{}: {error:?}", case.name))
        })
        .collect();
    assert_eq!(wrong, Vec::<String>::new());
}

type Switch = fn(&mut FeatureSet);

/// Features by their names in the table, as the linker is told of them.
const SWITCHES: &[(&str, Switch)] = &[
    ("fog", |f| f.fog = true),
    ("lens", |f| f.lens = true),
    ("several lights", |f| f.light_choice = true),
    ("light tree", |f| {
        f.light_choice = true;
        f.light_tree = true;
    }),
    ("scattering media", |f| {
        f.media = true;
        f.scattering = true;
    }),
    ("motion", |f| f.motion = true),
    ("instances", |f| {
        f.triangles = true;
        f.instances = true;
    }),
    ("image sky", |f| _ = f.skies.insert(SkyKind::Image)),
    ("half-float textures", |f| _ = f.textures.insert(TextureFormat::Rgba16Float)),
    ("normal maps", |f| {
        f.normal_maps = true;
        f.tangents = true;
        if f.textures.is_empty() {
            f.textures.insert(TextureFormat::Rgba8Srgb);
        }
    }),
    ("petal", |f| _ = f.materials.insert(MaterialKind::Petal)),
    ("wood", |f| _ = f.materials.insert(MaterialKind::Wood)),
    ("principled coat", |f| {
        f.materials.insert(MaterialKind::Principled);
        f.principled_coat = true;
    }),
    ("smooth normals", |f| f.smooth_normals = true),
];

#[test]
fn a_feature_more_is_what_the_linker_makes_of_it() {
    for name in ["spheres alone", "mirror", "lens", "all formats", "instances", "fog"] {
        let case = named(name);
        let own = compiled(case).features;
        let texts = kernel_texts(&scene_of(case), true);
        assert_eq!(texts[0].0, "specialised");
        assert_eq!(texts[1], ("full".to_owned(), linked(&FeatureSet::full())));
        let lines = pack::manifest::KernelSize::lines_of;
        let shorter = texts.iter().find(|(_, text)| lines(text) < lines(&texts[0].1));
        assert_eq!(shorter.map(|(name, _)| name), None, "{name}");
        let mut compared = 0;
        for (feature, switch) in SWITCHES {
            let mut more = own.clone();
            switch(&mut more);
            let found = texts.iter().find(|(known, _)| known == feature);
            // What the scene has already, or what has no code of its own, is not there.
            let Some((_, text)) = found else {
                let same = declarations(&linked(&more)) == declarations(&linked(&own));
                assert!(same, "{name}: {feature} is missing");
                continue;
            };
            compared += 1;
            let (ours, theirs) = (declarations(text), declarations(&linked(&more)));
            let differ: Vec<&String> = ours.symmetric_difference(&theirs).collect();
            assert!(differ.is_empty(), "{name} + {feature}: {differ:?}");
        }
        assert!(compared > 4, "{name}: {compared}");
    }
}

fn linked(features: &FeatureSet) -> String {
    shaders::link(features).expect("it links").text
}

#[test]
fn every_kernel_with_a_feature_more_is_valid() {
    let names = ["sky alone", "spheres alone", "triangles alone", "every pattern", "water"];
    let texts = names.map(|name| kernel_texts(&scene_of(named(name)), true));
    assert!(texts.iter().map(Vec::len).sum::<usize>() > 100);
    let wrong: Vec<String> = (texts.par_iter().flatten())
        .filter_map(|(name, text)| {
            let module = match naga::front::wgsl::parse_str(text) {
                Ok(module) => module,
                Err(error) => return Some(format!("{name}: {error}")),
            };
            let flags = naga::valid::ValidationFlags::all();
            let mut validator =
                naga::valid::Validator::new(flags, naga::valid::Capabilities::empty());
            validator.validate(&module).err().map(|error| format!("{name}: {error}"))
        })
        .collect();
    assert_eq!(wrong, Vec::<String>::new());
}

/// Compares the kernels of `plan` for the case called `name` on `device`, and returns their names.
fn compared(device: &DeviceChoice, name: &str, plan: Plan) -> Vec<String> {
    let scene = scene_of(named(name));
    let mut job = Job::of_scene(&scene);
    job.resize([16, 12]);
    job.samples = SampleRange { start: 0, end: 2 };
    let (mut begun, mut ended) = (Vec::new(), Vec::new());
    let mut tell = |event: Event<'_>| match event {
        Event::Begin(name) => begun.push(name.to_owned()),
        Event::End(row) => ended.push(row.kernel.clone()),
    };
    let found = ablate(&scene, &job, device, plan, &Control::default(), &mut tell);
    let found = found.expect("the adapter is there");
    assert_eq!(begun, ended);
    assert_eq!(found.rows.len(), ended.len());
    assert!(found.wrong().is_empty(), "{:?}", found.wrong());
    let own = &found.rows[0];
    let told = scene.pack().manifest().expect("readable").kernel;
    assert_eq!((own.wgsl_lines, own.spirv_words), (told.lines, Some(told.words)));
    for row in &found.rows[1..] {
        let Row { kernel, wgsl_lines, spirv_words, measured } = row;
        assert!(*wgsl_lines >= told.lines && *spirv_words >= Some(told.words), "{kernel}");
        let measured = measured.expect("there is a device");
        assert!(measured.ms > 0.0 && measured.specialised_ms > 0.0, "{kernel}");
        assert!(measured.build_s > 0.0, "{kernel}");
    }
    ended
}

#[test]
fn on_a_software_adapter_a_feature_more_gives_the_bits_of_the_cpu() {
    let this = "on_a_software_adapter_a_feature_more_gives_the_bits_of_the_cpu";
    let Some(device) = software::device_without_optimiser(this) else { return };
    let names = compared(&device, "sky alone", Plan { rounds: 1, full: false, each: true });
    assert!(names.len() > 3 && names[0] == "specialised", "{names:?}");
}

#[test]
#[ignore = "the driver takes minutes: `cargo test --workspace --test ablation -- --ignored`"]
fn on_a_software_adapter_the_full_kernel_gives_the_bits_of_the_cpu() {
    let this = "on_a_software_adapter_the_full_kernel_gives_the_bits_of_the_cpu";
    let Some(device) = software::device_without_optimiser(this) else { return };
    for name in ["sky alone", "triangles alone"] {
        let names = compared(&device, name, Plan { rounds: 1, full: true, each: false });
        assert_eq!(names, ["specialised", "full"], "{name}");
    }
}

#[test]
fn another_picture_is_told() {
    let same =
        Measured { build_s: 1.0, ms: 3.0, specialised_ms: 2.0, differ: 0, differ_cpu: 0, z: None };
    assert!((same.ratio() - 1.5).abs() < 1e-12);
    let row = |measured| Row {
        kernel: "full".to_owned(),
        wgsl_lines: 1,
        spirv_words: None,
        measured: Some(measured),
    };
    let of = |software, measured| Ablation {
        schema: "",
        version: "1",
        scene: String::new(),
        image: [1, 1],
        samples: 1,
        rounds: 1,
        device: None,
        software,
        cpu_ms: 1.0,
        rows: vec![row(measured)],
        interrupted: false,
    };
    let wrong = |software, measured| of(software, measured).wrong().len();
    assert_eq!(wrong(true, same), 0);
    assert_eq!(wrong(true, Measured { differ: 1, ..same }), 1);
    // A software adapter must give the bits of the CPU, a GPU may round.
    assert_eq!(wrong(true, Measured { differ_cpu: 1, ..same }), 1);
    assert_eq!(wrong(false, Measured { differ_cpu: 1, ..same }), 0);
    assert_eq!(wrong(false, Measured { differ: 9, z: Some(2.0), ..same }), 0);
    assert_eq!(wrong(false, Measured { differ: 9, z: Some(5.0), ..same }), 1);
    assert_eq!(wrong(false, Measured { differ: 9, z: None, ..same }), 1);
}
