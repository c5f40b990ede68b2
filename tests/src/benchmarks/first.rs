//! How long it takes from the start of a process until there is something to see.
//!
//! A child, the same program under another name, opens a pack and renders it on the CPU as `rtr` does; it says
//! when the first tile is done and when every pixel has a sample, and the parent has the clock.

use std::fmt::Write as _;
use std::io::{BufRead as _, BufReader};
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use compiler::bvh::Layout;
use runtime::{Control, DeviceChoice, Job, SampleRange, Scene, render};

use super::packs::Packs;
use super::{Outcome, ROUNDS, SCENES, median};
use crate::{console, mapped};

/// First argument of the process that renders.
pub(super) const CHILD: &str = "first-pixel";
/// What it says.
const PIXEL: &str = "pixel";
const PICTURE: &str = "picture";

/// In the process that renders. Returns the exit code.
pub(super) fn child(mut arguments: impl Iterator<Item = String>) -> u8 {
    let Some(path) = arguments.next() else { return 2 };
    let Ok(pack) = mapped::map(path) else { return 3 };
    let scene = Scene::new(pack);
    let mut job = Job::of_scene(&scene);
    job.samples = SampleRange { start: 0, end: 1 };
    let control = Control::default();
    let outcome = std::thread::scope(|scope| {
        let render = scope.spawn(|| render(&scene, &job, &DeviceChoice::Cpu, &control));
        while control.progress().done == 0 && !render.is_finished() {
            std::thread::sleep(Duration::from_micros(100));
        }
        console::line(PIXEL);
        render.join()
    });
    console::line(PICTURE);
    if matches!(outcome, Ok(Ok(_))) { 0 } else { 3 }
}

/// Seconds from the start of a process to its first pixel and to one sample of all.
fn once(pack: &Path) -> Result<[f64; 2], Box<dyn std::error::Error>> {
    let start = Instant::now();
    let mut process = Command::new(std::env::current_exe()?)
        .arg(CHILD)
        .arg(pack)
        .stdout(Stdio::piped())
        .spawn()?;
    let mut said = [(PIXEL, f64::NAN), (PICTURE, f64::NAN)];
    let out = process.stdout.take().ok_or("the output is a pipe")?;
    for line in BufReader::new(out).lines() {
        let line = line?;
        for (what, at) in &mut said {
            if line.contains(*what) {
                *at = start.elapsed().as_secs_f64();
            }
        }
    }
    if !process.wait()?.success() {
        return Err("the process that renders fails".into());
    }
    Ok(said.map(|(_, at)| at))
}

/// Scenes, at their own sizes.
pub(super) fn table(packs: &mut Packs, text: &mut String) -> Outcome {
    let _ = writeln!(
        text,
        "\n## From the start of the process to the first pixel, on the CPU\n\n\
        The process opens the pack, which is in the system's cache, and renders one sample of every pixel at the \
        scene's own size. Wall seconds.\n\n\
        | scene | size | first tile s | one sample of all s |\n|---|---|---|---|"
    );
    for name in SCENES {
        let path = packs.of(name, Layout::Wide)?;
        let [width, height] = mapped::map(&path)?.render().image_size;
        let mut times = Vec::new();
        for _ in 0..ROUNDS {
            times.push(once(&path)?);
        }
        let of = |k: usize| median(times.iter().map(|times| times[k]));
        let _ = writeln!(text, "| `{name}` | {width} x {height} | {:.3} | {:.3} |", of(0), of(1));
    }
    Ok(())
}
