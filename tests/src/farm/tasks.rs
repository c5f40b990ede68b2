//! Tasks of a farm as they are: `rtr` in a process of its own, which starts, opens the pack, renders some batches of a
//! crop and writes a part; and `rtr merge`. Turns them into seconds and bytes.
//!
//! The processes are this program under another name, so that they can tell their CPU seconds.

use std::error::Error;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode, Stdio};
use std::time::Instant;

use cpu_time::ProcessTime;
use pack::abi::BATCH;
use runtime::{Rect, Scene};

use crate::{console, mapped};

/// First argument of a process that is `rtr`; what follows are its arguments.
pub const CHILD: &str = "rtr";
/// Rounds of what is over soon; odd, so that the median is a measured value.
const ROUNDS: usize = 5;

/// In the process that is `rtr`. Returns the exit code.
pub fn child(arguments: impl Iterator<Item = String>) -> u8 {
    let start = ProcessTime::now();
    let code = runtime::cli::run([CHILD.to_owned()].into_iter().chain(arguments));
    console::line(&start.elapsed().as_secs_f64().to_string());
    if code == ExitCode::SUCCESS { 0 } else { 3 }
}

/// What a process took, in seconds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spent {
    /// From its start to its end.
    pub wall: f64,
    /// User + system.
    pub cpu: f64,
}

fn rtr(arguments: &[String]) -> Result<Spent, Box<dyn Error>> {
    let start = Instant::now();
    let mut command = Command::new(std::env::current_exe()?);
    let told = command.arg(CHILD).args(arguments).stderr(Stdio::inherit()).output()?;
    let wall = start.elapsed().as_secs_f64();
    if !told.status.success() {
        return Err(format!("rtr {} fails", arguments.join(" ")).into());
    }
    let text = String::from_utf8_lossy(&told.stdout).into_owned();
    let cpu = text.trim().lines().last().ok_or("it tells its time")?.parse()?;
    Ok(Spent { wall, cpu })
}

fn text(path: &Path) -> String {
    path.display().to_string()
}

/// One task: samples `from .. to` of a crop of the frame that the pack asks for, with the flags of `rtr job`.
fn task(
    pack: &Path,
    crop: Rect,
    (from, to): (u32, u32),
    part: &Path,
) -> Result<Spent, Box<dyn Error>> {
    let fixed = ["--device", "cpu", "--quiet", "--resume", "--skip-complete"].map(str::to_owned);
    let own =
        ["--crop", &crop.to_string(), "--samples", &format!("{from}..{to}"), "-o", &text(part)]
            .map(str::to_owned);
    rtr(&[&[text(pack)], &fixed[..], &own[..]].concat())
}

/// What a task takes besides rendering, in seconds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StartUp {
    /// A process that renders one sample of eight by eight pixels and writes them.
    pub process: Spent,
    /// Making the tree of the CPU kernel, which so small a picture does without.
    pub tree: Spent,
}

impl StartUp {
    /// # Errors
    /// When the pack cannot be rendered.
    pub fn measure(pack: &Path, folder: &Path, at: Rect) -> Result<Self, Box<dyn Error>> {
        let crop = Rect { w: 8, h: 8, ..at };
        let (mut processes, mut trees) = (Vec::new(), Vec::new());
        for round in 0..ROUNDS {
            let part = folder.join(format!("start.{round}.exr"));
            processes.push(task(pack, crop, (0, 1), &part)?);
            let scene = Scene::new(mapped::map(pack)?);
            let (cpu, wall) = (ProcessTime::now(), Instant::now());
            scene.prepare();
            let [wall, cpu] = [wall.elapsed(), cpu.elapsed()].map(|time| time.as_secs_f64());
            trees.push(Spent { wall, cpu });
        }
        Ok(Self { process: median(processes), tree: median(trees) })
    }

    /// Of a whole task.
    #[must_use]
    pub fn whole(&self) -> Spent {
        let Self { process, tree } = self;
        Spent { wall: process.wall + tree.wall, cpu: process.cpu + tree.cpu }
    }
}

/// The one with the median time.
fn median(mut rounds: Vec<Spent>) -> Spent {
    rounds.sort_by(|a, b| a.wall.total_cmp(&b.wall));
    rounds[rounds.len() / 2]
}

/// A crop that was rendered by tasks of one batch each.
pub struct Parts {
    /// The files.
    pub paths: Vec<PathBuf>,
    /// What each task took.
    pub spent: Vec<Spent>,
    /// Bytes of all files.
    pub bytes: f64,
}

impl Parts {
    /// Renders `samples` samples of every pixel of `crop`, one task after the other.
    ///
    /// # Errors
    /// When a task fails.
    pub fn render(
        pack: &Path,
        folder: &Path,
        crop: Rect,
        samples: u32,
    ) -> Result<Self, Box<dyn Error>> {
        let mut parts = Self { paths: Vec::new(), spent: Vec::new(), bytes: 0.0 };
        for from in (0..samples).step_by(BATCH as usize) {
            let part = folder.join(format!("part.{from}.exr"));
            let to = (from + BATCH).min(samples);
            parts.spent.push(task(pack, crop, (from, to), &part)?);
            parts.bytes += std::fs::metadata(&part)?.len() as f64;
            parts.paths.push(part);
            console::progress(&format!("crop: {to} of {samples} samples are rendered"));
        }
        Ok(parts)
    }
}

/// What merging takes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Merging {
    /// Of the fewest parts, and of all: how many, and seconds.
    pub rounds: [(usize, f64); 2],
    /// Seconds for each pixel of each part.
    pub part_pixel: f64,
    /// Seconds for each pixel of the picture, as EXR and PNG.
    pub pixel: f64,
}

impl Merging {
    /// Merges two parts and all of them; the last picture is `picture`, a PNG.
    ///
    /// # Errors
    /// When they cannot be merged.
    pub fn measure(
        parts: &[PathBuf],
        pixels: f64,
        folder: &Path,
        picture: &Path,
    ) -> Result<Self, Box<dyn Error>> {
        let exr = folder.join("merged.exr");
        let seconds_of = |parts: &[PathBuf]| -> Result<(usize, f64), Box<dyn Error>> {
            let outputs = ["-o", &text(&exr), "-o", &text(picture), "--quiet"].map(str::to_owned);
            let names: Vec<String> = parts.iter().map(|part| text(part)).collect();
            let arguments = [&["merge".to_owned()], &names[..], &outputs[..]].concat();
            let rounds: Result<Vec<Spent>, _> = (0..ROUNDS).map(|_| rtr(&arguments)).collect();
            Ok((parts.len(), median(rounds?).wall))
        };
        let few = seconds_of(&parts[..2.min(parts.len())])?;
        let all = seconds_of(parts)?;
        let part = (all.1 - few.1).max(0.0) / all.0.saturating_sub(few.0).max(1) as f64;
        let rest = (few.1 - few.0 as f64 * part).max(0.0);
        Ok(Self { rounds: [few, all], part_pixel: part / pixels, pixel: rest / pixels })
    }
}
