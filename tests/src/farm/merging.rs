//! Parts of an 8K frame, made up → what merging them takes: time, memory and open files.
//!
//! Their pixels are noise, which packs no better than those of a picture of few samples. Only some rows of the frame are
//! there: how much memory a merge takes does not depend on how many there are, which the table shows.

use std::error::Error;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode, Stdio};
use std::time::Instant;

use cpu_time::ProcessTime;
use exr::block::reader::ChunksReader as _;
use runtime::layers::{Layer, LayerNames, Layers, Matte, MatteKind, Nearest, Wanted};
use runtime::output::{ExrFile, Format, Meta, Picture, encode};
use runtime::{Film, Rect, SampleRange};

use super::cost::FRAME;
use crate::benchmarks::machine;
use crate::console;
use crate::edits::peak;
use crate::statistics::stream::Stream;

/// First argument of the process that merges.
pub const CHILD: &str = "merge-parts";
const PARTS: u32 = 64;
/// First sample of all.
const FIRST: u32 = 1000;
/// Samples of a part.
const SAMPLES: u32 = 4;
/// Files that the process may have open.
const HANDLES: u32 = 16;
const LAYERS: [Layer; 5] =
    [Layer::Albedo, Layer::Normal, Layer::Depth, Layer::Crypto, Layer::Alpha];
/// Rows of the frame, and whether there are layers.
const RUNS: [(u32, bool); 4] = [(64, false), (256, false), (32, true), (128, true)];

/// In the process that merges: OUTPUT PART... Returns the exit code.
pub fn child(arguments: impl Iterator<Item = String>) -> u8 {
    let start = ProcessTime::now();
    let words = ["rtr", "merge", "--quiet", "-o"].map(String::from);
    let code = runtime::cli::run(words.into_iter().chain(arguments));
    console::line(&format!("{} {}", start.elapsed().as_secs_f64(), peak()));
    if code == ExitCode::SUCCESS { 0 } else { 3 }
}

/// What a merge took.
struct Took {
    wall: f64,
    cpu: f64,
    /// Most memory, bytes.
    peak: f64,
}

/// Measures, and prints a section of `docs/farm.md`.
pub fn page() -> Result<String, Box<dyn Error>> {
    let [width, height] = FRAME;
    let mut text = format!(
        "## Merging\n\n\
        Printed by `cargo run --release -p tests --bin farm merging`.\n\n{}\n\n\
        {PARTS} parts of some rows of a frame of {width} x {height} pixels, made up of noise, merged to an EXR by a process \
        that may have {HANDLES} files open. Layers: {}. Bytes are those of the pixels before they are packed; where there \
        is Cryptomatte, parts are read twice. Unpacking: what the library for EXR takes to unpack all parts as often as they \
        are read, from the time of one; packing: what it takes to pack one picture. Memory is the most that the process \
        ever had.\n\n\
        | rows | layers | a part, MB | on the disk | wall s | CPU s | unpacking, CPU s | packing, CPU s | MB a CPU second | memory, MB |\n\
        |---|---|---|---|---|---|---|---|---|---|\n",
        machine(),
        LAYERS.map(Layer::name).join(", "),
    );
    for (rows, has_layers) in RUNS {
        row(&mut text, rows, has_layers)?;
    }
    Ok(text)
}

fn row(text: &mut String, rows: u32, has_layers: bool) -> Result<(), Box<dyn Error>> {
    let folder = tempfile::tempdir()?;
    let picture = picture(rows, has_layers);
    let start = ProcessTime::now();
    drop(encode(Format::Exr, &picture, true)?);
    let packing = start.elapsed().as_secs_f64();
    let paths = parts(&picture, folder.path())?;
    console::progress(&format!("{PARTS} parts of {rows} rows are written"));
    let packed = std::fs::metadata(&paths[0])?.len() as f64;
    let bytes = ExrFile::open(&paths[0])?.bytes_per_pixel() as f64;
    let bytes = bytes * picture.film.region.pixels() as f64;
    drop(picture);
    let took = merge(&paths, &folder.path().join("whole.exr"))?;
    let reads = f64::from(PARTS) * if has_layers { 2.0 } else { 1.0 };
    let _ = writeln!(
        text,
        "| {rows} | {} | {:.0} | {:.0} % | {:.1} | {:.1} | {:.1} | {packing:.1} | {:.0} | {:.0} |",
        if has_layers { "all of these" } else { "none" },
        bytes / 1e6,
        packed / bytes * 100.0,
        took.wall,
        took.cpu,
        unpacking(&paths[0])? * reads,
        bytes * reads / took.cpu / 1e6,
        took.peak / 1e6,
    );
    Ok(())
}

/// CPU seconds to unpack a part, which is looked at no further.
fn unpacking(path: &Path) -> Result<f64, Box<dyn Error>> {
    let start = ProcessTime::now();
    let reader = exr::block::read(std::io::BufReader::new(std::fs::File::open(path)?), false)?;
    reader.all_chunks(false)?.decompress_sequential(false, |_, _| Ok(()))?;
    Ok(start.elapsed().as_secs_f64())
}

/// The parts' files. They differ in their samples only, which are text of one length in the header, so the pixels are
/// packed once.
fn parts(picture: &Picture, folder: &Path) -> Result<Vec<PathBuf>, Box<dyn Error>> {
    let samples = |i: u32| {
        let start = FIRST + i * SAMPLES;
        SampleRange { start, end: start + SAMPLES }
    };
    let mut part = picture.clone();
    part.film.ranges = vec![samples(0)];
    let mut bytes = encode(Format::Exr, &part, true)?;
    let first = samples(0).to_string();
    let mut places = bytes.windows(first.len());
    let at = places.position(|text| text == first.as_bytes()).ok_or("the header says them")?;
    let mut paths = Vec::new();
    for i in 0..PARTS {
        bytes[at..at + first.len()].copy_from_slice(samples(i).to_string().as_bytes());
        paths.push(folder.join(format!("part.{i}.exr")));
        std::fs::write(&paths[paths.len() - 1], &bytes)?;
    }
    Ok(paths)
}

fn merge(paths: &[PathBuf], output: &Path) -> Result<Took, Box<dyn Error>> {
    let start = Instant::now();
    let told = Command::new("sh")
        .args(["-c", &format!("ulimit -n {HANDLES}; exec \"$0\" \"$@\"")])
        .arg(std::env::current_exe()?)
        .args([Path::new(CHILD), output])
        .args(paths)
        .stdout(Stdio::piped())
        .output()?;
    let wall = start.elapsed().as_secs_f64();
    if !told.status.success() {
        return Err(String::from_utf8_lossy(&told.stderr).into_owned().into());
    }
    let text = String::from_utf8_lossy(&told.stdout).into_owned();
    let numbers: Vec<f64> = text.split_whitespace().map(str::parse).collect::<Result<_, _>>()?;
    let &[cpu, peak] = numbers.as_slice() else { return Err("it tells two numbers".into()) };
    Ok(Took { wall, cpu, peak })
}

/// Some rows of the frame.
fn picture(rows: u32, has_layers: bool) -> Picture {
    let region = Rect { x: 0, y: 0, w: FRAME[0], h: rows };
    let mut film = Film::new(FRAME, region);
    film.counts.fill(SAMPLES);
    let mut noise = Stream::new(1, 0);
    film.sums = colours(&mut noise, region);
    let layers = has_layers.then(|| layers(&mut || colours(&mut noise, region)));
    let meta =
        Meta { render_id: "0".into(), precision: "f32".into(), complete: true, ..Meta::default() };
    Picture { layers, ..Picture::new(film, meta) }
}

fn colours(noise: &mut Stream, region: Rect) -> Vec<[f64; 3]> {
    (0..region.pixels()).map(|_| [noise.unit(), noise.unit(), noise.unit()]).collect()
}

/// Layers with the noise that `colours` gives.
fn layers(colours: &mut dyn FnMut() -> Vec<[f64; 3]>) -> Layers {
    let nearest = colours().into_iter();
    #[expect(clippy::cast_possible_truncation, reason = "any depth will do")]
    let nearest = nearest.map(|[depth, ..]| Nearest { depth: depth as f32, ..Nearest::NONE });
    let wanted = Wanted { layers: LAYERS.into(), transparent: false, names: LayerNames::default() };
    let matte = |kind| {
        let mut matte = Matte::new(kind, ["lantern", "gate", "pond"]);
        let ids: Vec<u32> = matte.names.values().copied().collect();
        // One name in the middle of things, two at their edges.
        let shares = |[x, ..]: [f64; 3]| {
            let all = vec![(ids[0], SAMPLES)];
            if x < 0.9 { all } else { vec![(ids[0], 1), (ids[1], SAMPLES - 1)] }
        };
        matte.shares = colours().into_iter().map(shares).collect();
        matte
    };
    let mattes = MatteKind::ALL.map(matte).into();
    Layers {
        wanted,
        samples: SAMPLES,
        albedo: colours(),
        normal: colours(),
        covered: colours().iter().map(|[x, ..]| if *x < 0.9 { SAMPLES } else { 1 }).collect(),
        nearest: nearest.collect(),
        mattes,
        ..Layers::default()
    }
}
