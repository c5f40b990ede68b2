//! Path tracing: rays and samples a second, on the CPU with one thread and with all, and on every adapter.

use std::fmt::Write as _;
use std::sync::mpsc;
use std::time::Instant;

use compiler::bvh::Layout;
use cpu_time::ProcessTime;
use runtime::{Control, DeviceChoice, Event, Job, SampleRange, Scene, render};

use super::packs::Packs;
use super::{Outcome, ROUNDS, SCENES, median};

/// Size and samples at which devices are compared: small enough for a software adapter.
pub(super) const SIZE: [u32; 2] = [320, 180];
pub(super) const SAMPLES: u32 = 16;
/// Those of GPUs, which a small picture does not fill.
const GPU_SIZE: [u32; 2] = [1280, 720];
const GPU_SAMPLES: u32 = 64;

/// One render: CPU seconds, wall seconds, rays.
pub(super) struct Cost {
    pub(super) cpu: f64,
    pub(super) wall: f64,
    pub(super) rays: u64,
    samples: f64,
    device: String,
    /// What the run said of loops that a driver cut short.
    cut: Option<String>,
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
    let (tell, heard) = mpsc::channel();
    let control = Control::new(move |event| {
        if let Event::Note(line) = event {
            // Nobody listens any more once the run has ended.
            let _ = tell.send(line.to_owned());
        }
    });
    let pixels = f64::from(job.image_size[0]) * f64::from(job.image_size[1]);
    let n_samples = pixels * f64::from(job.samples.count());
    let (cpu, wall) = (ProcessTime::now(), Instant::now());
    let outcome = render(scene, &job, device, &control).map_err(|error| error.to_string())?;
    Ok(Cost {
        cpu: cpu.elapsed().as_secs_f64(),
        wall: wall.elapsed().as_secs_f64(),
        rays: outcome.film().counters.rays,
        samples: n_samples,
        device: outcome.picture.meta.device.clone(),
        cut: heard.try_iter().find(|note| note.contains("cut loops short")),
    })
}

/// Who renders.
struct Renderer {
    choice: DeviceChoice,
    threads: Option<usize>,
    size: [u32; 2],
    samples: u32,
}

impl Renderer {
    fn software(choice: DeviceChoice, threads: Option<usize>) -> Self {
        Self { choice, threads, size: SIZE, samples: SAMPLES }
    }

    fn gpu(choice: DeviceChoice) -> Self {
        Self { choice, threads: None, size: GPU_SIZE, samples: GPU_SAMPLES }
    }

    fn cost(&self, scene: &Scene) -> Result<Cost, String> {
        cost(scene, &self.choice, self.samples, |job| {
            job.resize(self.size);
            job.threads = self.threads;
        })
    }
}

/// One thread, all threads, and the adapters that there are.
fn renderers(scene: &Scene) -> Vec<Renderer> {
    let adapters = [
        Renderer::software(DeviceChoice::Named("llvmpipe".to_owned()), None),
        Renderer::gpu(DeviceChoice::Gpu),
    ];
    let mut all = vec![
        Renderer::software(DeviceChoice::Cpu, Some(1)),
        Renderer::software(DeviceChoice::Cpu, None),
    ];
    // The first run compiles the kernel for the device; it is not counted.
    all.extend(
        adapters.into_iter().filter(|adapter| cost(scene, &adapter.choice, 1, |_| {}).is_ok()),
    );
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
    let (mut others, mut gpus, mut remarks) = (false, false, Vec::new());
    for name in SCENES {
        let scene = packs.scene(name, Layout::Wide)?;
        let renderers = renderers(&scene);
        others |= renderers.len() > 2;
        gpus |= renderers.iter().any(|renderer| renderer.size == GPU_SIZE);
        let mut runs: Vec<Vec<Cost>> = renderers.iter().map(|_| Vec::new()).collect();
        for _ in 0..ROUNDS {
            for (renderer, runs) in renderers.iter().zip(&mut runs) {
                runs.push(renderer.cost(&scene)?);
            }
        }
        rows(name, &runs, text);
        remarks.extend(shared_work(name, &runs));
    }
    if gpus {
        let [width, height] = GPU_SIZE;
        let _ = writeln!(
            text,
            "\nGPUs render {width} x {height}, {GPU_SAMPLES} samples a pixel, since a small picture does not fill \
            them; CPU seconds are compared per ray. Wall time includes opening the device, uploading the scene and building its kernel, \
            which the driver keeps on disk."
        );
    }
    for remark in remarks {
        let _ = writeln!(text, "{remark}");
    }
    if !others {
        text.push_str("\nNo Vulkan adapter was found, not even a software one.\n");
    }
    Ok(())
}

/// Remarks on renderers whose work others did in part: their times are of both.
fn shared_work<'a>(name: &'a str, runs: &'a [Vec<Cost>]) -> impl Iterator<Item = String> + 'a {
    let last = runs.iter().filter_map(|runs| runs.last());
    last.filter_map(move |run| {
        Some(format!("\n{} on `{name}`: {}.", run.device, run.cut.as_ref()?))
    })
}

fn rows(name: &str, runs: &[Vec<Cost>], text: &mut String) {
    let of = |runs: &[Cost], what: fn(&Cost) -> f64| median(runs.iter().map(what));
    // Every run of one renderer traces the same rays.
    let mrays = |runs: &[Cost]| runs[0].rays as f64 / 1e6;
    let cpu_per_mray = |runs: &[Cost]| of(runs, |run| run.cpu) / mrays(runs);
    let base = runs.first().map_or(f64::NAN, |runs| cpu_per_mray(runs));
    for runs in runs {
        let (cpu, wall) = (of(runs, |run| run.cpu), of(runs, |run| run.wall));
        let mrays = mrays(runs);
        let _ = writeln!(
            text,
            "| `{name}` | {} | {cpu:.2} | {wall:.2} | {mrays:.2} | {:.2} | {:.2} | {:.2} | {:.2}x |",
            runs[0].device,
            mrays / cpu,
            mrays / wall,
            runs[0].samples / wall / 1e6,
            cpu_per_mray(runs) / base,
        );
    }
}
