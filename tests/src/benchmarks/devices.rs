//! Path tracing: rays and samples a second, on the CPU with one thread and with all, and on every adapter.

use std::fmt::Write as _;
use std::time::Instant;

use compiler::bvh::Layout;
use cpu_time::ProcessTime;
use runtime::{Control, DeviceChoice, Job, SampleRange, Scene, render};

use super::packs::Packs;
use super::{Outcome, ROUNDS, SCENES, median};

/// Size and samples at which devices are compared: small enough for a software adapter.
pub(super) const SIZE: [u32; 2] = [320, 180];
pub(super) const SAMPLES: u32 = 16;

/// One render: CPU seconds, wall seconds, rays.
pub(super) struct Cost {
    pub(super) cpu: f64,
    pub(super) wall: f64,
    pub(super) rays: u64,
    device: String,
}

/// What rendering `samples` of every pixel costs.
pub(super) fn cost(
    scene: &Scene,
    device: &DeviceChoice,
    samples: u32,
    change: impl FnOnce(&mut Job),
) -> Result<Cost, String> {
    let mut job = Job::of_scene(scene);
    job.resize(SIZE);
    job.samples = SampleRange { start: 0, end: samples };
    change(&mut job);
    let control = Control::default();
    let (cpu, wall) = (ProcessTime::now(), Instant::now());
    let outcome = render(scene, &job, device, &control).map_err(|error| error.to_string())?;
    Ok(Cost {
        cpu: cpu.elapsed().as_secs_f64(),
        wall: wall.elapsed().as_secs_f64(),
        rays: outcome.film().counters.rays,
        device: outcome.picture.meta.device.clone(),
    })
}

/// Who renders, and with how many threads.
type Renderer = (DeviceChoice, Option<usize>);

/// One thread, all threads, and the adapters that there are.
fn renderers(scene: &Scene) -> Vec<Renderer> {
    let mut all = vec![(DeviceChoice::Cpu, Some(1)), (DeviceChoice::Cpu, None)];
    for choice in [DeviceChoice::Named("llvmpipe".to_owned()), DeviceChoice::Gpu] {
        let name = |cost: &Cost| cost.device.clone();
        // The first run compiles the kernel for the device; it is not counted.
        if cost(scene, &choice, 1, |_| {}).is_ok_and(|first| !name(&first).is_empty()) {
            all.push((choice, None));
        }
    }
    all
}

/// Scenes by renderers.
pub(super) fn table(packs: &mut Packs, text: &mut String) -> Outcome {
    let [width, height] = SIZE;
    let _ = writeln!(
        text,
        "\n## Path tracing: {width} x {height}, {SAMPLES} samples a pixel\n\n\
        | scene | device | CPU s | wall s | Mrays | Mrays per CPU s | Mrays/s | Msamples/s | against the first (CPU s) |\n\
        |---|---|---|---|---|---|---|---|---|"
    );
    let (mut others, mut short) = (false, Vec::new());
    for name in SCENES {
        let scene = packs.scene(name, Layout::Wide)?;
        let renderers = renderers(&scene);
        others |= renderers.len() > 2;
        let mut runs: Vec<Vec<Cost>> = renderers.iter().map(|_| Vec::new()).collect();
        for _ in 0..ROUNDS {
            for ((choice, threads), runs) in renderers.iter().zip(&mut runs) {
                runs.push(cost(&scene, choice, SAMPLES, |job| job.threads = *threads)?);
            }
        }
        rows(name, &runs, text);
        short.extend(fewer_rays(name, &runs));
    }
    for remark in short {
        let _ = writeln!(text, "{remark}");
    }
    if !others {
        text.push_str("\nNo Vulkan adapter was found, not even a software one.\n");
    }
    Ok(())
}

/// A remark on renderers that traced other rays than the first: their times are of other work.
fn fewer_rays(name: &str, runs: &[Vec<Cost>]) -> Option<String> {
    let rays = |runs: &[Cost]| runs.first().map_or(0, |run| run.rays);
    let first = rays(runs.first()?);
    let other = runs.iter().find(|runs| rays(runs) != first)?;
    Some(format!(
        "\n{} traced {:.0} % of the rays of `{name}`: llvmpipe ends the loops of an invocation after 65,535 turns, \
        which `rtr` says. Its times there are of less work.",
        other[0].device,
        100.0 * rays(other) as f64 / first as f64,
    ))
}

fn rows(name: &str, runs: &[Vec<Cost>], text: &mut String) {
    let cpu_of = |runs: &[Cost]| median(runs.iter().map(|run| run.cpu));
    let base = runs.first().map_or(f64::NAN, |runs| cpu_of(runs));
    let samples = f64::from(SIZE[0] * SIZE[1] * SAMPLES);
    for runs in runs {
        let (cpu, wall) = (cpu_of(runs), median(runs.iter().map(|run| run.wall)));
        let mrays = runs[0].rays as f64 / 1e6;
        let _ = writeln!(
            text,
            "| `{name}` | {} | {cpu:.2} | {wall:.2} | {mrays:.2} | {:.2} | {:.2} | {:.2} | {:.2}x |",
            runs[0].device,
            mrays / cpu,
            mrays / wall,
            samples / wall / 1e6,
            cpu / base,
        );
    }
}
