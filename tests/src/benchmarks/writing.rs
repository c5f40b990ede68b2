//! What writing pictures of a run that goes on costs, and how soon the first of them is there.
//!
//! A child, the same program under another name, is `rtr` as it is on the command line; the parent looks for the file and
//! has the clock, the child tells its CPU seconds.

use std::fmt::Write as _;
use std::path::Path;
use std::process::{Command, ExitCode, Stdio};
use std::time::{Duration, Instant};

use compiler::bvh::Layout;
use cpu_time::ProcessTime;

use super::packs::Packs;
use super::{Outcome, ROUNDS, median};
use crate::console;

/// First argument of the process that renders.
pub(super) const CHILD: &str = "write-pictures";
/// Image in pixels.
const SIZE: &str = "640x360";
/// Scenes, and samples that take some pictures' time.
const RUNS: [(&str, &str); 3] = [("mesh", "96"), ("materials", "96"), ("shrine", "16")];
/// What is compared with the first.
const EVERY: [&str; 2] = ["never", "5s"];

/// In the process that renders: PACK OUTPUT SPP TIME. Returns the exit code.
pub(super) fn child(arguments: impl Iterator<Item = String>) -> u8 {
    let arguments: Vec<String> = arguments.collect();
    let [pack, output, spp, every] = arguments.as_slice() else { return 2 };
    let words = ["rtr", pack, "--device", "cpu", "--quiet", "--size", SIZE, "--spp", spp];
    let words = words.into_iter().chain(["-o", output, "--write-every", every]);
    let start = ProcessTime::now();
    let code = runtime::cli::run(words.map(std::ffi::OsString::from));
    console::line(&start.elapsed().as_secs_f64().to_string());
    if code == ExitCode::SUCCESS { 0 } else { 3 }
}

/// CPU seconds of a run, and seconds until its file was there.
fn once(pack: &Path, spp: &str, every: &str) -> Result<[f64; 2], Box<dyn std::error::Error>> {
    let folder = tempfile::tempdir()?;
    let output = folder.path().join("a.png");
    let start = Instant::now();
    let mut process = Command::new(std::env::current_exe()?)
        .arg(CHILD)
        .args([pack, &output])
        .args([spp, every])
        .stdout(Stdio::piped())
        .spawn()?;
    while !output.exists() && process.try_wait()?.is_none() {
        std::thread::sleep(Duration::from_millis(2));
    }
    let first = start.elapsed().as_secs_f64();
    let told = process.wait_with_output()?;
    let cpu = String::from_utf8_lossy(&told.stdout).trim().lines().last().map(str::parse);
    if !told.status.success() {
        return Err("the process that renders fails".into());
    }
    Ok([cpu.ok_or("it tells its time")??, first])
}

/// Scenes by what is written.
pub(super) fn table(packs: &mut Packs, text: &mut String) -> Outcome {
    let _ = writeln!(
        text,
        "\n## Pictures while rendering: {SIZE}, PNG, the CPU kernel\n\n\
        `rtr` in a process of its own, without and with `--write-every 5s`, which is what it does unless told otherwise. \
        First file: seconds from the start of the process until there is one, a coarse picture with `5s` and the last \
        picture with `never`.\n\n\
        | scene | spp | CPU s, never | CPU s, 5s | ratio | first file s, never | first file s, 5s |\n\
        |---|---|---|---|---|---|---|"
    );
    for (name, spp) in RUNS {
        let path = packs.of(name, Layout::Wide)?;
        let mut times = [Vec::new(), Vec::new()];
        for _ in 0..ROUNDS {
            for (times, every) in times.iter_mut().zip(EVERY) {
                times.push(once(&path, spp, every)?);
            }
        }
        let of = |side: usize, k: usize| median(times[side].iter().map(|times| times[k]));
        let [without, with] = [of(0, 0), of(1, 0)];
        let ratio = with / without;
        let _ = writeln!(
            text,
            "| `{name}` | {spp} | {without:.2} | {with:.2} | {ratio:.3} | {:.2} | {:.2} |",
            of(0, 1),
            of(1, 1),
        );
    }
    Ok(())
}
