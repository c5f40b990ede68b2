//! `cargo run --release -p tests --bin denoise [-- --oidn PATH]`: how much of the error Open Image Denoise takes away on
//! four scenes; rewrites `docs/denoise.md` and `docs/denoise.png`.

use std::error::Error;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::time::Instant;

use clap::Parser;
use pack::Pack;
use runtime::convergence::Measure;
use runtime::denoise::Denoiser;
use runtime::layers::{Layer, Wanted};
use runtime::output::{Picture, tone_map};
use runtime::{Control, DeviceChoice, Job, SampleRange, Scene, render};
use tests::truth::Truth;
use tests::{console, scene};

/// Pixels of each picture.
const SIZE: [u32; 2] = [192, 108];
/// Samples of a pixel.
const SAMPLES: [u32; 2] = [4, 32];
/// Of each of the four replicates behind a reference, which have other seeds.
const REFERENCE: u32 = 512;
const SCENES: [&str; 4] = ["cornell_sphere", "materials", "gltf", "weekend"];
/// Those that the picture shows.
const SHOWN: [&str; 2] = ["cornell_sphere", "gltf"];
/// A usual picture, for its time.
const LARGE: [u32; 2] = [1920, 1080];

/// Measures what denoising gives.
#[derive(Parser)]
struct Args {
    /// As for `rtr --denoise`.
    #[arg(long)]
    oidn: Option<PathBuf>,
}

fn main() -> Result<(), Box<dyn Error>> {
    let denoiser = Denoiser::open(Args::parse().oidn.as_deref(), None)?;
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs");
    let mut text = HEADER.replace("DENOISER", &denoiser.name());
    let mut rows = Vec::new();
    for name in SCENES {
        let found = Measured::of(name, &denoiser)?;
        text += &found.rows;
        console::line(&found.rows);
        if SHOWN.contains(&name) {
            rows.extend(found.shown);
        }
    }
    writeln!(text, "\n{}\n{FOOTER}", large(&denoiser)?)?;
    std::fs::write(docs.join("denoise.md"), text)?;
    let [width, height] = [3 * SIZE[0], u32::try_from(rows.len())? / (3 * SIZE[0])];
    let bytes = rows.as_flattened();
    image::save_buffer(docs.join("denoise.png"), bytes, width, height, image::ColorType::Rgb8)?;
    Ok(())
}

/// What is found out about a scene.
struct Measured {
    /// Of the table.
    rows: String,
    /// Pixels, row by row, of the pictures beside each other: noisy, denoised, reference.
    shown: Vec<[u8; 3]>,
}

impl Measured {
    fn of(name: &str, denoiser: &Denoiser) -> Result<Self, Box<dyn Error>> {
        let scene = scene_of(name)?;
        let mut job = Job::of_scene(&scene);
        job.resize(SIZE);
        (job.seed, job.samples.end) = (77, REFERENCE);
        job.measure = Some(Measure::default());
        let reference = rendered(&scene, &job)?;
        let truth = Truth::of(&reference.film);
        let (mut rows, mut shown) = (String::new(), Vec::new());
        for spp in SAMPLES {
            let mut picture = sampled(&scene, SIZE, spp)?;
            let noisy = truth.trimmed_rel_mse(&picture.shown());
            let mut colour = Picture { layers: None, ..picture.clone() };
            denoiser.denoise(&mut colour, &|| false)?;
            let began = Instant::now();
            denoiser.denoise(&mut picture, &|| false)?;
            let seconds = began.elapsed().as_secs_f64();
            let [alone, guided] = [&colour, &picture].map(|p| truth.trimmed_rel_mse(&p.shown()));
            writeln!(
                rows,
                "| `{name}` | {spp} | {noisy:.5} | {alone:.5} | {guided:.5} | {:.0}x | {:.0} | {seconds:.2} s |",
                noisy / guided,
                f64::from(spp) * noisy / guided,
            )?;
            if spp == SAMPLES[0] {
                let noisy = Picture { denoised: None, ..picture.clone() };
                shown = beside(&[&noisy, &picture, &reference]);
            }
        }
        Ok(Self { rows, shown })
    }
}

fn scene_of(name: &str) -> Result<Scene, Box<dyn Error>> {
    let example = scenes::catalog::find(name).ok_or("no such scene")?;
    let compiled = scene::full_example(example, &[], compiler::bvh::Layout::default());
    Ok(Scene::new(Pack::from_bytes(scene::bytes(&compiled))?))
}

fn rendered(scene: &Scene, job: &Job) -> Result<Picture, Box<dyn Error>> {
    Ok(render(scene, job, &DeviceChoice::Cpu, &Control::default())?.picture)
}

/// A picture with what guides a denoiser.
fn sampled(scene: &Scene, size: [u32; 2], spp: u32) -> Result<Picture, Box<dyn Error>> {
    let mut job = Job::of_scene(scene);
    job.resize(size);
    (job.seed, job.samples) = (1, SampleRange { start: 0, end: spp });
    job.wanted = Wanted { layers: [Layer::Albedo, Layer::Normal].into(), ..Wanted::default() };
    rendered(scene, &job)
}

/// Tone-mapped pictures of one size, side by side.
fn beside(pictures: &[&Picture]) -> Vec<[u8; 3]> {
    let [width, height] = SIZE.map(|n| n as usize);
    let mapped = pictures.iter().map(|p| tone_map(&p.shown(), p.meta.exposure, p.meta.tone_map));
    let mapped: Vec<_> = mapped.collect();
    let row = |y: usize| mapped.iter().flat_map(move |p| &p[y * width..(y + 1) * width]);
    (0..height).flat_map(row).copied().collect()
}

/// What it takes to denoise a picture of a usual size.
fn large(denoiser: &Denoiser) -> Result<String, Box<dyn Error>> {
    let mut picture = sampled(&scene_of("cornell_sphere")?, LARGE, 1)?;
    let mut seconds = f64::INFINITY;
    // What else the machine does makes it longer only.
    for _ in 0..3 {
        let began = Instant::now();
        denoiser.denoise(&mut picture, &|| false)?;
        seconds = seconds.min(began.elapsed().as_secs_f64());
    }
    let threads = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
    let [width, height] = LARGE;
    Ok(format!(
        "A picture of {width}x{height}, with its guides, takes {seconds:.1} s on {threads} hardware threads, the least of three."
    ))
}

const HEADER: &str = "# Denoising\n\n\
    Made by `cargo run --release -p tests --bin denoise`; edit the program, not this page.\n\n\
    \x20   pip install pyoidn\n\
    \x20   rtr scene.pack --spp 32 --denoise -o a.exr -o a.png\n\
    \x20   rtr merge part1.exr part2.exr --denoise -o a.exr\n\n\
    `rtr --denoise` takes the noise out of the last picture with [Open Image Denoise](https://www.openimagedenoise.org) \
    2, a library that is no part of `rtr` and is loaded at run time. It is looked for at `--oidn PATH` (the library or \
    the folder of a release), else at `OIDN_DIR`, else where the system looks for libraries, else in the Python wheel \
    `pyoidn` beside the first `python3` of `PATH`. Where there is none, one line says so before anything is rendered.\n\n\
    ![Two scenes with 4 samples a pixel, denoised, and as they should be](denoise.png)\n\
    <sub>4 samples a pixel; denoised; 2048 samples</sub>\n\n\
    ## What it gives\n\n\
    relMSE in luminance without the worst 0.1 % of the pixels (see [error.md](error.md)), which would be most of it, against a \
    reference of 2048 samples with other seeds, whose own variance is taken out; 192x108 pixels, CPU kernel, DENOISER. `colour`: denoised without guides. `guided`: with albedo \
    and normals, as `rtr` does. `samples`: what the same error takes without a denoiser, as noise falls with the number \
    of samples.\n\n\
    | scene | spp | noisy | colour | guided | gain | samples | time |\n|---|---|---|---|---|---|---|---|\n";

const FOOTER: &str = "\n## How it works\n\n\
    - After the picture, `rtr` makes the [layers](guide.md#layers) `albedo` and `normal` of the same samples: those of \
    the first surface that is not specular, so that reflections and what is behind glass keep their edges. Both are \
    denoised alone (\"prefiltered\") and then guide the picture, which is filtered as HDR with `cleanAux`.\n\
    - An EXR shows the denoised picture, keeps the noisy one in `ViewLayer.Noisy Image.R` `G` `B` (Blender's names) or \
    `noisy.R` `G` `B` (`--layer-names plain`), has both guides as layers, and names the denoiser and its version in the \
    attribute `denoiser`. A PNG holds the denoised picture only.\n\
    - Nothing is computed from denoised values. Checkpoints hold sums, so `--resume` goes on as if there were no \
    denoiser; parts hold the noisy means and `rtr merge` adds those, and denoises the sum if it is told to; errors of \
    `--report` and `--until-error` are those of the noisy picture. Pictures that are written while it renders, and one \
    that is interrupted, are noisy.\n\
    - `--crop`, `--transparent`, `--time` and `--adaptive` work as without. Parts without `albedo` and `normal` are \
    denoised by colour alone; `rtr merge` says so.\n\
    - The noisy picture is in the files before the denoiser begins. If it fails, one line says why, the noisy picture \
    stays, and the exit code is 3. Ctrl-C ends it soon, with exit code 130, and the noisy picture stays.\n\n\
    ## What it does not promise\n\n\
    Denoised pixels are biased, and no part of any promise about bits: they are those of the library, on the CPU. The \
    same library gave the same bits again on the same machine; another version, or other hardware, gives others. What \
    is noisy has the bits that it always had.";
