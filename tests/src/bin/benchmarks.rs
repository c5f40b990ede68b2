//! `cargo run --release -p tests --bin benchmarks`: measures and rewrites `docs/benchmarks.md`.
//! With the argument `edits` it only prints what compiling again costs after edits, with `ablation [SCENE...]`
//! only what leaving out features is worth.
//!
//! Everything is measured in this one process on this one machine: CPU seconds (user + system of
//! the whole process, so that threads of a software adapter count), medians of interleaved rounds.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::{Duration, Instant};

use compiler::bvh::{Fragment, Input, Layout, Preset, build};
use cpu_time::ProcessTime;
use pack::abi::Triangle;
use pack::{MapMode, Pack};
use runtime::{Control, DeviceChoice, Job, Outcome, SampleRange, Scene, render};
use tests::{ablation, edits, scene};

/// Rounds of each measurement; odd, so that the median is a measured value.
const ROUNDS: usize = 3;
/// Size and samples at which devices are compared: small enough for a software adapter.
const SIZE: [u32; 2] = [480, 270];
const SAMPLES: u32 = 16;

fn main() -> Result<ExitCode, Box<dyn std::error::Error>> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let mut arguments = std::env::args().skip(1);
    match arguments.next().as_deref() {
        None => all(&root)?,
        Some(edits::CHILD) => return Ok(ExitCode::from(edits::child(arguments))),
        Some("edits") => {
            let mut text = String::new();
            compiling_again(&root, &mut text)?;
            tests::console::line(&text);
        }
        Some("ablation") => {
            let names: Vec<String> = arguments.collect();
            let names: Vec<&str> = names.iter().map(String::as_str).collect();
            let names = if names.is_empty() { ablation::all_scenes() } else { names };
            let mut text = String::new();
            ablation::tables(&mut text, ablation::PAGE, &names)?;
            tests::console::line(&text);
        }
        Some(other) => {
            return Err(format!("`{other}` is none of the tables: edits, ablation").into());
        }
    }
    Ok(ExitCode::SUCCESS)
}

fn all(root: &Path) -> Result<(), Box<dyn std::error::Error>> {
    let pack = pack_of("mesh", Layout::Wide)?;
    let mut text = header();
    devices(&pack, &mut text)?;
    walks(&mut text)?;
    bvh(&pack, &mut text)?;
    open("mesh", &pack, &mut text)?;
    compiling_again(root, &mut text)?;
    ablation::tables(&mut text, ablation::PAGE, &ablation::all_scenes())?;
    let target = root.join("docs/benchmarks.md");
    std::fs::write(&target, &text)?;
    tests::console::line(&text);
    Ok(())
}

fn header() -> String {
    let threads = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
    format!(
        "# Benchmarks\n\n\
        Made by `cargo run --release -p tests --bin benchmarks`; edit the program, not this page. \
        CPU seconds are user + system time of the process, medians of {ROUNDS} interleaved rounds. \
        Compare rows of one page, not pages: machines differ.\n\n\
        Machine: {} {}, {threads} hardware threads, {}.\n",
        std::env::consts::ARCH,
        std::env::consts::OS,
        processor(),
    )
}

fn processor() -> String {
    let info = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let line = info.lines().find_map(|line| line.strip_prefix("model name"));
    let name = line.and_then(|line| line.split_once(':')).map(|(_, name)| name.trim().to_owned());
    name.unwrap_or_else(|| "unknown processor".to_owned())
}

/// Generates and compiles an example into a temporary file.
fn pack_of(name: &str, layout: Layout) -> Result<PathBuf, Box<dyn std::error::Error>> {
    let example = scenes::catalog::find(name).ok_or("there is no such example")?;
    let compiled = scene::full_example(example, layout);
    let file = format!("benchmark-{}-{name}-{layout}.pack", std::process::id());
    let path = std::env::temp_dir().join(file);
    std::fs::write(&path, scene::bytes(&compiled))?;
    Ok(path)
}

/// One render: CPU seconds, wall seconds, rays.
struct Cost {
    cpu: f64,
    wall: f64,
    rays: u64,
    device: String,
}

fn cost(scene: &Scene, device: &DeviceChoice, samples: u32) -> Result<Cost, String> {
    cost_of(scene, device, samples, |_| {})
}

fn cost_of(
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
    let outcome: Outcome =
        render(scene, &job, device, &control).map_err(|error| error.to_string())?;
    Ok(Cost {
        cpu: cpu.elapsed().as_secs_f64(),
        wall: wall.elapsed().as_secs_f64(),
        rays: outcome.film().counters.rays,
        device: outcome.picture.meta.device.clone(),
    })
}

fn devices(pack: &Path, text: &mut String) -> Result<(), Box<dyn std::error::Error>> {
    let scene = Scene::new(Pack::open(pack, MapMode::Map)?);
    let mut choices = vec![DeviceChoice::Cpu];
    for choice in [DeviceChoice::Named("llvmpipe".to_owned()), DeviceChoice::Gpu] {
        // The first run compiles the kernel for the device; it is not counted.
        if cost(&scene, &choice, 1).is_ok() {
            choices.push(choice);
        }
    }
    let mut runs: Vec<Vec<Cost>> = choices.iter().map(|_| Vec::new()).collect();
    for _ in 0..ROUNDS {
        for (choice, runs) in choices.iter().zip(&mut runs) {
            runs.push(cost(&scene, choice, SAMPLES)?);
        }
    }
    let [width, height] = SIZE;
    let _ = writeln!(
        text,
        "\n## Path tracing: `mesh`, {width} x {height}, {SAMPLES} samples a pixel\n\n\
        | device | CPU s | wall s | Mrays | Mrays per CPU s | against the CPU kernel (CPU s) |\n\
        |---|---|---|---|---|---|"
    );
    let base = median(runs[0].iter().map(|run| run.cpu));
    for run in &runs {
        let (cpu, wall) =
            (median(run.iter().map(|run| run.cpu)), median(run.iter().map(|run| run.wall)));
        let mrays = run[0].rays as f64 / 1e6;
        let _ = writeln!(
            text,
            "| {} | {cpu:.2} | {wall:.2} | {mrays:.2} | {:.2} | {:.2}x |",
            run[0].device,
            mrays / cpu,
            cpu / base,
        );
    }
    if choices.len() == 1 {
        text.push_str("\nNo Vulkan adapter was found, not even a software one.\n");
    }
    Ok(())
}

/// Layouts of nodes, and who walks them on the CPU.
const WALKS: [(Layout, bool, &str); 3] = [
    (Layout::Binary, false, "binary nodes, generated walk"),
    (Layout::Wide, false, "wide nodes, generated walk"),
    (Layout::Wide, true, "wide nodes, walk by hand"),
];

fn walks(text: &mut String) -> Result<(), Box<dyn std::error::Error>> {
    let [width, height] = SIZE;
    let _ = writeln!(
        text,
        "\n## The walk through the tree: {width} x {height}, {SAMPLES} samples a pixel, the CPU kernel\n\n\
        `generated`: `trace` as it was translated from the WGSL; `by hand`: four lanes at a time \
        (`runtime/src/walk.rs`). The same picture, bit for bit; all of path tracing is in the times.\n\n\
        | scene | nodes and walk | CPU s | Mrays | Mrays per CPU s | against the first |\n\
        |---|---|---|---|---|---|"
    );
    for name in ["mesh", "shrine"] {
        let packs = Layout::ALL.map(|layout| pack_of(name, layout));
        let [wide, binary] = packs;
        let (wide, binary) = (wide?, binary?);
        let open = |path: &Path| Pack::open(path, MapMode::Map).map(Scene::new);
        let (wide_scene, binary_scene) = (open(&wide)?, open(&binary)?);
        let mut runs: [Vec<Cost>; 3] = Default::default();
        for _ in 0..ROUNDS {
            for ((layout, native, _), runs) in WALKS.iter().zip(&mut runs) {
                let scene = if *layout == Layout::Wide { &wide_scene } else { &binary_scene };
                let change = |job: &mut Job| job.native_walk = *native;
                runs.push(cost_of(scene, &DeviceChoice::Cpu, SAMPLES, change)?);
            }
        }
        let base = median(runs[0].iter().map(|run| run.cpu));
        for ((_, _, what), runs) in WALKS.iter().zip(&runs) {
            let cpu = median(runs.iter().map(|run| run.cpu));
            let mrays = runs[0].rays as f64 / 1e6;
            let _ = writeln!(
                text,
                "| `{name}` | {what} | {cpu:.2} | {mrays:.2} | {:.2} | {:.2}x |",
                mrays / cpu,
                cpu / base,
            );
        }
        std::fs::remove_file(wide)?;
        std::fs::remove_file(binary)?;
    }
    Ok(())
}

fn bvh(pack: &Path, text: &mut String) -> Result<(), Box<dyn std::error::Error>> {
    let pack = Pack::open(pack, MapMode::Map)?;
    let triangles = pack.records::<Triangle>();
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build()?;
    let mut seconds = Vec::new();
    for _ in 0..ROUNDS {
        let fragments: Vec<Fragment> = (0..)
            .zip(triangles)
            .map(|(i, t)| Fragment::of_triangle(&[t.v0, t.v1, t.v2], i))
            .collect();
        let start = ProcessTime::now();
        pool.install(|| build(Preset::Fast, Input::of_boxes(fragments)))?;
        seconds.push(start.elapsed().as_secs_f64());
    }
    let cpu = median(seconds);
    let _ = writeln!(
        text,
        "\n## BVH build: `mesh`, {} triangles, one thread\n\n\
        {cpu:.3} CPU s, {:.2} CPU s per million triangles.",
        triangles.len(),
        cpu * 1e6 / triangles.len() as f64,
    );
    Ok(())
}

/// Compiling the shrine after edits, and opening its pack.
fn compiling_again(root: &Path, text: &mut String) -> Result<(), Box<dyn std::error::Error>> {
    let folder = tempfile::tempdir()?;
    let pack = edits::table(&root.join("scenes"), folder.path(), text)?;
    open("shrine", &pack, text)
}

fn open(name: &str, path: &Path, text: &mut String) -> Result<(), Box<dyn std::error::Error>> {
    let size = std::fs::metadata(path)?.len();
    let mut walls = Vec::new();
    for _ in 0..ROUNDS {
        let start = Instant::now();
        let pack = Pack::open(path, MapMode::Map)?;
        walls.push(start.elapsed());
        drop(pack);
    }
    let wall = median(walls.iter().map(Duration::as_secs_f64));
    let _ = writeln!(
        text,
        "\n## Opening the pack of `{name}`: map and check every rule\n\n\
        {:.1} MB in {:.1} ms wall: {:.2} GB/s.",
        size as f64 / 1e6,
        wall * 1e3,
        size as f64 / 1e9 / wall,
    );
    Ok(())
}

fn median(values: impl IntoIterator<Item = f64>) -> f64 {
    let mut values: Vec<f64> = values.into_iter().collect();
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}
