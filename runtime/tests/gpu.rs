//! The wgpu backend on a software adapter: bit for bit what the CPU kernel gives. Without an adapter
//! every test here says `skipped: no adapter` and passes.

#![cfg(feature = "gpu")]

mod common;

use common::{assert_same, scene};
use pack::Pack;
use runtime::convergence::Measure;
use runtime::gpu::layers_kernel;
use runtime::{Control, DeviceChoice, Event, Job, Outcome, Rect, SampleRange, Scene, Stop, render};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, OnceLock};
use std::time::Duration;

/// The software adapter to test with.
#[expect(clippy::print_stderr, reason = "a skipped test says so")]
fn device() -> Option<DeviceChoice> {
    let adapters = runtime::gpu::adapters();
    let software = adapters.iter().find(|adapter| adapter.is_software());
    if software.is_none() {
        eprintln!("skipped: no adapter");
    }
    software.map(|adapter| DeviceChoice::Named(adapter.name().to_owned()))
}

struct Rendered {
    outcome: Outcome,
    notes: String,
}

fn run(scene: &Scene, job: &Job, device: &DeviceChoice) -> Rendered {
    let notes = Arc::new(Mutex::new(String::new()));
    let sink = Arc::clone(&notes);
    let control = Control::new(move |event| {
        if let Event::Note(text) = event {
            let mut notes = sink.lock().expect("no panic");
            notes.push_str(text);
            notes.push('\n');
        }
    });
    let outcome = render(scene, job, device, &control).expect("the device renders");
    let notes = notes.lock().expect("no panic").clone();
    Rendered { outcome, notes }
}

#[test]
fn a_software_adapter_gives_the_bits_of_the_cpu_kernel() {
    let Some(device) = device() else { return };
    let scene = scene();
    let job = Job { samples: SampleRange { start: 3, end: 50 }, ..Job::of_scene(&scene) };
    let gpu = run(&scene, &job, &device);
    let cpu = run(&scene, &job, &DeviceChoice::Cpu);
    assert_eq!(gpu.outcome.device_error, None, "{}", gpu.notes);
    assert!(gpu.notes.contains("every line is known, runtime checks are off"), "{}", gpu.notes);
    assert_same(gpu.outcome.film(), cpu.outcome.film());
}

#[test]
fn tiles_submissions_and_crops_do_not_change_a_bit() {
    let Some(device) = device() else { return };
    let scene = scene();
    let crop = Rect { x: 5, y: 3, w: 61, h: 33 };
    let job = Job { crop, ..Job::of_scene(&scene) };
    let coarse = run(&scene, &job, &device);
    // The smallest submissions: one workgroup each.
    let fine = run(&scene, &Job { submission: Duration::from_nanos(1), ..job.clone() }, &device);
    assert_same(coarse.outcome.film(), fine.outcome.film());
    assert_same(coarse.outcome.film(), run(&scene, &job, &DeviceChoice::Cpu).outcome.film());
}

#[test]
fn timestamps_change_the_pace_and_no_bit() {
    let Some(device) = device() else { return };
    let scene = scene();
    let job = Job::of_scene(&scene);
    let timed = run(&scene, &job, &device);
    let untimed = run(&scene, &Job { timestamps: false, ..job }, &device);
    assert_same(timed.outcome.film(), untimed.outcome.film());
    assert!(untimed.notes.contains("by wall time"), "{}", untimed.notes);
    // Every submission is timed, in one way or the other.
    assert!(timed.notes.contains("the GPU was busy for "), "{}", timed.notes);
    let says = |text: &str| timed.notes.contains(text);
    assert!(says("submissions, by its timestamps") || says("by wall time"), "{}", timed.notes);
}

#[test]
fn a_report_has_the_time_by_timestamps_where_every_pass_has_them() {
    let Some(device) = device() else { return };
    let scene = scene();
    let measure = Some(Measure::default());
    let samples = SampleRange { start: 0, end: 16 };
    let job = Job { measure, samples, ..Job::of_scene(&scene) };
    let times = |outcome: &Outcome| outcome.convergence.as_ref().expect("it was measured").times;
    let timed = run(&scene, &job, &device);
    let by_timestamps = timed.notes.contains("submissions, by its timestamps");
    let found = times(&timed.outcome);
    assert_eq!(found.device.is_some(), by_timestamps, "{}", timed.notes);
    // Passes follow each other, so that all of them together take no longer than the run.
    let run_time = timed.outcome.elapsed.as_secs_f64();
    assert!(found.device.is_none_or(|time| time > 0.0 && time < run_time), "{found:?}");
    let untimed = run(&scene, &Job { timestamps: false, ..job.clone() }, &device);
    assert_eq!(times(&untimed.outcome).device, None);
    let cpu = run(&scene, &job, &DeviceChoice::Cpu);
    assert_eq!(times(&cpu.outcome).device, None);
}

#[test]
fn a_foreign_kernel_runs_with_checks_and_gives_the_same_picture() {
    let Some(device) = device() else { return };
    let kernel = shaders::link(&common::features()).expect("it links").text;
    let foreign = format!("{kernel}\nfn stranger() {{ }}\n");
    let bytes = common::pack_with_kernel(&foreign);
    let scene = Scene::new(pack::Pack::from_bytes(bytes).expect("a pack takes any text"));
    let gpu = run(&scene, &Job::of_scene(&scene), &device);
    assert!(gpu.notes.contains("runtime checks are on"), "{}", gpu.notes);
    let cpu = run(&scene, &Job::of_scene(&scene), &DeviceChoice::Cpu);
    assert_same(gpu.outcome.film(), cpu.outcome.film());
}

#[test]
fn a_kernel_that_does_not_compile_is_an_error() {
    let Some(device) = device() else { return };
    for kernel in ["fn render(", "@compute @workgroup_size(8, 8) fn other() {}"] {
        let bytes = common::pack_with_kernel(kernel);
        let scene = Scene::new(pack::Pack::from_bytes(bytes).expect("a pack takes any text"));
        let gpu = run(&scene, &Job::of_scene(&scene), &device).outcome;
        let error = gpu.device_error.as_deref().unwrap_or_default();
        assert!(error.starts_with("the kernel does not compile on this device"), "{error}");
        assert_eq!((gpu.stop, gpu.film().samples()), (Stop::Failed, (0, 0)));
    }
}

#[test]
fn a_kernel_that_renders_nothing_is_found_out() {
    let Some(device) = device() else { return };
    let kernel = "
        @group(0) @binding(0) var<uniform> frame_words: array<vec4<u32>, 5>;
        @group(0) @binding(1) var<storage, read_write> film_words: array<vec4<u32>>;
        @compute @workgroup_size(8, 8) fn render() {
            if (frame_words[0].x == 12345u) { film_words[0] = vec4<u32>(1u); }
        }";
    let bytes = common::pack_with_kernel(kernel);
    let scene = Scene::new(pack::Pack::from_bytes(bytes).expect("a pack takes any text"));
    let gpu = run(&scene, &Job::of_scene(&scene), &device).outcome;
    let error = gpu.device_error.as_deref().unwrap_or_default();
    assert_eq!(error, "the device gives wrong results: pixels without a single ray");
}

#[test]
fn an_unknown_name_lists_what_there_is() {
    let scene = scene();
    let choice = DeviceChoice::Named("no such adapter".to_owned());
    let error = render(&scene, &Job::of_scene(&scene), &choice, &Control::default());
    let text = error.expect_err("there is none").to_string();
    assert!(text.starts_with("no adapter named `no such adapter`; "), "{text}");
}

#[test]
fn a_lost_device_is_replaced_and_the_picture_is_the_same() {
    let Some(device) = device() else { return };
    let scene = scene();
    let samples = SampleRange { start: 0, end: 128 };
    let job = Job { submission: Duration::from_nanos(1), samples, ..Job::of_scene(&scene) };
    let notes = Arc::new(Mutex::new(Vec::new()));
    let sink = Arc::clone(&notes);
    let (gpu, n_submissions) = (OnceLock::new(), AtomicU64::new(0));
    let control = Control::new(move |event| match event {
        Event::Note(text) => sink.lock().expect("no panic").push(text.to_owned()),
        // The first device is destroyed while it renders its third submission.
        Event::Device(device) => drop(gpu.set(device.clone())),
        Event::Submission => {
            if n_submissions.fetch_add(1, Ordering::Relaxed) == 2 {
                gpu.get().expect("it was opened").destroy();
            }
        }
        Event::Block => {}
    });
    let outcome = render(&scene, &job, &device, &control).expect("it renders");
    let notes = notes.lock().expect("no panic").join("\n");
    assert!(notes.contains("the device was lost"), "{notes}");
    assert_eq!(outcome.device_error, None, "{notes}");
    assert_same(outcome.film(), run(&scene, &job, &DeviceChoice::Cpu).outcome.film());
}

#[test]
fn a_device_that_is_lost_again_and_again_leaves_what_was_complete() {
    let Some(device) = device() else { return };
    let scene = scene();
    // No device lives long enough to finish anything.
    let control = Control::new(|event| {
        if let Event::Device(device) = event {
            device.destroy();
        }
    });
    let outcome = render(&scene, &Job::of_scene(&scene), &device, &control).expect("an outcome");
    let error = outcome.device_error.as_deref().unwrap_or_default();
    assert!(error.starts_with("the device was lost"), "{error}");
    assert_eq!((outcome.stop, outcome.film().samples().0), (Stop::Failed, 0));
}

#[test]
fn a_gpu_makes_layers_only_with_a_kernel_that_is_known() {
    let own = shaders::link(&common::features()).expect("it links").text;
    let is_made = |kernel: &str| {
        let pack = Pack::from_bytes(common::pack_with_kernel(kernel)).expect("a pack");
        layers_kernel(&Scene::new(pack)).is_some()
    };
    assert!(is_made(&own));
    assert!(!is_made(&format!("{own}\nconst MINE: u32 = 1u;\n")));
    // A stack that is too small for the tree: the kernel of layers has the same one, and no checks.
    let (before, rest) = own.split_once("const STACK_SIZE: u32 = ").expect("it has a stack");
    let (_, after) = rest.split_once(';').expect("and a size");
    assert!(!is_made(&format!("{before}const STACK_SIZE: u32 = 0x0u;{after}")));
}
