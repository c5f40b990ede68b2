//! `.ci/kill-tasks [RTR]`: renders a picture as 200 tasks, kills each of them at random moments, lets it run again until
//! its part is whole, merges the parts and compares the pixels with those of one run. Prints a section of
//! `docs/farm.md`; fails at the first promise that is broken.
//!
//! Moments are drawn from a fixed seed. Most are anywhere in a run; of eight kills one waits for a file that is being
//! written and one for the part, because those are too short to be met often.

use std::error::Error;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::atomic::{AtomicU32, Ordering};
use std::time::Duration;

use pack::abi::BATCH;
use runtime::output::read_exr;
use runtime::{Job, SampleRange, Scene};
use tests::benchmarks::machine;
use tests::kills::{Ended, Fault, Kill, Kind, Left, Moment, Pace, STAGES, Spent, Task};
use tests::statistics::stream::Stream;
use tests::{console, mapped, scene};

const TASKS: u32 = 200;
/// Of a task: 24 batches.
const SAMPLES: u32 = 384;
const SIZE: [u32; 2] = [64, 36];
const EVERY: Duration = Duration::from_millis(100);
/// A kill may cost the time between checkpoints, two batches, and so many seconds for a disk that takes its time while
/// rendering goes on.
const PATIENCE: f64 = 0.5;
const SEED: u64 = 200;

fn main() -> Result<(), Box<dyn Error>> {
    let beside = std::env::current_exe()?.with_file_name("rtr");
    let rtr = std::env::args_os().nth(1).map_or(beside, PathBuf::from);
    let folder = tempfile::tempdir()?;
    let folder = folder.path();
    let mut kind = kind(rtr, folder)?;
    let times = Times::measure(&kind, folder)?;
    kind.pace = times.pace();
    kind.most_lost = (EVERY.as_secs_f64() + PATIENCE) / kind.pace.sample + 2.0 * f64::from(BATCH);
    let killed = kill_all(&kind, &times, folder)?;
    compare(&kind, folder)?;
    console::line(&page(&kind, &times, &killed));
    Ok(())
}

/// Tasks of `weekend`, with the pack in `folder`.
fn kind(rtr: PathBuf, folder: &Path) -> Result<Kind, Box<dyn Error>> {
    let example = scenes::catalog::find("weekend").ok_or("there is no such example")?;
    let pack = folder.join("weekend.pack");
    std::fs::write(&pack, scene::bytes(&scene::example(example, &[])))?;
    let scene = Scene::new(mapped::map(&pack)?);
    let mut job = Job::of_scene(&scene);
    job.resize(SIZE);
    let pace = Pace { start_up: 0.0, sample: 1.0 };
    Ok(Kind { rtr, pack, scene, job, every: EVERY, pace, most_lost: f64::INFINITY })
}

/// What runs take that nobody kills, with as many at once as later.
struct Times {
    whole: Spent,
    start_up: Spent,
}

impl Times {
    fn measure(kind: &Kind, folder: &Path) -> Result<Self, Fault> {
        let once = |worker: u32| {
            let task = task(kind, &folder.join(format!("calibrate.{worker}")), 0)?;
            let Ended::Well(whole) = task.run(&Left::default(), Moment::End)? else {
                return Err(lost_itself());
            };
            let Ended::Well(start_up) = task.run(&task.look()?, Moment::End)? else {
                return Err(lost_itself());
            };
            Ok(Self { whole, start_up })
        };
        let all = std::thread::scope(|scope| {
            let workers: Vec<_> = (0..n_workers()).map(|k| scope.spawn(move || once(k))).collect();
            let joined =
                workers.into_iter().map(|worker| worker.join().map_err(|_| lost_itself())?);
            joined.collect::<Result<Vec<Self>, Fault>>()
        })?;
        let slowest = all.into_iter().max_by(|a, b| a.whole.cpu.total_cmp(&b.whole.cpu));
        slowest.ok_or_else(lost_itself)
    }

    fn pace(&self) -> Pace {
        let sample = (self.whole.cpu - self.start_up.cpu).max(1e-3) / f64::from(SAMPLES);
        Pace { start_up: self.start_up.cpu, sample }
    }
}

fn lost_itself() -> Fault {
    "a run that nobody kills dies".to_owned()
}

fn n_workers() -> u32 {
    std::thread::available_parallelism().map_or(1, |n| u32::try_from(n.get()).unwrap_or(1))
}

/// Task `number`, in a folder that is made.
fn task<'a>(kind: &'a Kind, folder: &Path, number: u32) -> Result<Task<'a>, Fault> {
    std::fs::create_dir_all(folder).map_err(|error| error.to_string())?;
    let samples = SampleRange { start: number * SAMPLES, end: (number + 1) * SAMPLES };
    Ok(Task { kind, folder: folder.to_owned(), samples })
}

/// What became of a task.
#[derive(Debug, Default)]
struct Story {
    kills: Vec<Kill>,
    /// Files that nobody needs any more.
    litter: usize,
}

/// All tasks, as many at once as there are processors.
fn kill_all(kind: &Kind, times: &Times, folder: &Path) -> Result<Vec<Story>, Fault> {
    let next = AtomicU32::new(0);
    let work = || {
        let mut stories = Vec::new();
        loop {
            let number = next.fetch_add(1, Ordering::Relaxed);
            if number >= TASKS {
                return Ok(stories);
            }
            let task = task(kind, &folder.join(number.to_string()), number)?;
            let story = kill_one(&task, times, &mut Stream::new(SEED, u64::from(number)));
            stories.push(story.map_err(|fault| {
                next.store(TASKS, Ordering::Relaxed);
                format!("task {number}: {fault}")
            })?);
            if (number + 1).is_multiple_of(20) {
                console::progress(&format!("{} of {TASKS} tasks", number + 1));
            }
        }
    };
    std::thread::scope(|scope| {
        let workers: Vec<_> = (0..n_workers()).map(|_| scope.spawn(work)).collect();
        let joined =
            workers.into_iter().map(|worker| worker.join().map_err(|_| "a panic".to_owned())?);
        Ok(joined.collect::<Result<Vec<Vec<Story>>, Fault>>()?.into_iter().flatten().collect())
    })
}

/// Kills a task once to three times, and then lets it end.
fn kill_one(task: &Task<'_>, times: &Times, stream: &mut Stream) -> Result<Story, Fault> {
    let mut story = Story::default();
    let mut had = Left::default();
    let wanted = 1 + stream.index(3);
    while story.kills.len() < wanted {
        let ended = task.run(&had, moment(&had, times, stream))?;
        had = task.look()?;
        match ended {
            Ended::Killed(kill) => story.kills.push(kill),
            // It was faster; a task that was never killed says nothing.
            Ended::Well(_) if story.kills.is_empty() => {
                std::fs::remove_file(task.part()).map_err(|error| error.to_string())?;
                had = task.look()?;
            }
            Ended::Well(_) => break,
        }
        if had.part {
            break;
        }
    }
    let Ended::Well(_) = task.run(&had, Moment::End)? else { return Err(lost_itself()) };
    let left = task.look()?;
    story.litter = left.unfinished.len() + usize::from(left.saved > 0);
    Ok(story)
}

/// When the next run is killed.
fn moment(had: &Left, times: &Times, stream: &mut Stream) -> Moment {
    let rest = 1.0 - f64::from(had.saved) / f64::from(SAMPLES);
    let soon = |stream: &mut Stream| Duration::from_secs_f64(stream.between(0.0, 2e-3));
    match stream.index(8) {
        0 => Moment::Writing(soon(stream)),
        1 => Moment::Written(soon(stream)),
        _ => {
            let Times { whole, start_up } = times;
            let most = start_up.wall + rest * (whole.wall - start_up.wall).max(0.0);
            Moment::After(Duration::from_secs_f64(stream.between(0.0, most)))
        }
    }
}

/// Merges the parts, renders the same in one run, and compares the bits.
fn compare(kind: &Kind, folder: &Path) -> Result<(), Box<dyn Error>> {
    console::progress("one run of all samples, to compare with");
    let samples = format!("0..{}", TASKS * SAMPLES);
    let size = format!("{}x{}", SIZE[0], SIZE[1]);
    let rtr = |arguments: &[&str], name: &str| -> Result<(), Box<dyn Error>> {
        let mut command = Command::new(&kind.rtr);
        command.current_dir(folder).args(arguments).args(["--samples", &samples, "--quiet"]);
        command.args(["-o", &format!("{name}.exr"), "-o", &format!("{name}.png")]);
        let is_well = command.status()?.success();
        is_well.then_some(()).ok_or_else(|| format!("rtr {arguments:?} fails").into())
    };
    rtr(&["weekend.pack", "--size", &size, "--device", "cpu"], "whole")?;
    let parts: Vec<String> = (0..TASKS).map(|number| format!("{number}/part.exr")).collect();
    let parts = parts.iter().map(String::as_str);
    rtr(&["merge"].into_iter().chain(parts).collect::<Vec<_>>(), "merged")?;
    if pixels(&folder.join("merged.exr"))? != pixels(&folder.join("whole.exr"))? {
        return Err("the merged pixels are not those of one run".into());
    }
    if std::fs::read(folder.join("merged.png"))? != std::fs::read(folder.join("whole.png"))? {
        return Err("the merged PNG is not that of one run".into());
    }
    Ok(())
}

/// The bits of the pixels, as they are shown.
fn pixels(path: &Path) -> Result<Vec<[u32; 3]>, Box<dyn Error>> {
    let film = read_exr(path)?.film;
    if film.ranges != [SampleRange { start: 0, end: TASKS * SAMPLES }] {
        return Err(format!("{} does not hold all samples", path.display()).into());
    }
    #[expect(clippy::cast_possible_truncation, reason = "the precision of pictures")]
    let bits = |rgb: [f64; 3]| rgb.map(|channel| (channel as f32).to_bits());
    Ok(film.means().into_iter().map(bits).collect())
}

fn page(kind: &Kind, times: &Times, stories: &[Story]) -> String {
    let kills: Vec<Kill> = stories.iter().flat_map(|story| story.kills.clone()).collect();
    let often = stories.iter().filter(|story| story.kills.len() > 1).count();
    let mut text = format!(
        "## Killed at any moment\n\n\
        Printed by `.ci/kill-tasks`, which fails at the first promise that is broken.\n\n{}\n\n\
        {} tasks, each {SAMPLES} samples of every pixel of `weekend`, {} x {} pixels, on one thread, with a checkpoint \
        every {} ms; a task that nobody kills takes {:.2} s. Each was killed with SIGKILL at a moment that a fixed seed \
        drew, {often} of them several times, and ran again until its part was whole: {} kills.\n\n\
        | killed | times | lost on average | lost at most |\n|---|---|---|---|\n",
        machine(),
        stories.len(),
        SIZE[0],
        SIZE[1],
        kind.every.as_millis(),
        times.whole.wall,
        kills.len(),
    );
    for (stage, name) in STAGES {
        row(&mut text, name, kills.iter().filter(|kill| kill.stage == stage));
    }
    row(&mut text, "all", kills.iter());
    let twice: f64 = kills.iter().map(|kill| kill.lost).sum();
    let all = f64::from(TASKS * SAMPLES);
    let litter: usize = stories.iter().map(|story| story.litter).sum();
    let _ = write!(
        text,
        "\nLost are samples of every pixel that were rendered, by the CPU time of the run, and that no file has: {twice:.0} of \
        {all:.0} were rendered twice, {:.1} %. At most {:.0} were allowed to a kill: what is rendered in the time between \
        checkpoints, two batches of {BATCH}, and {PATIENCE} s for a disk that takes its time.\n\nAfter each kill, what had a \
        final name was whole, no checkpoint was older than one that was seen before, and the next run said that it goes \
        on there. {litter} temporary files and checkpoints of whole parts were left over. The merged pixels are those of \
        one run, bit for bit.",
        100.0 * twice / all,
        kind.most_lost,
    );
    text
}

fn row<'a>(text: &mut String, name: &str, kills: impl Iterator<Item = &'a Kill>) {
    let lost: Vec<f64> = kills.map(|kill| kill.lost).collect();
    let mean = lost.iter().sum::<f64>() / lost.len().max(1) as f64;
    let most = lost.iter().copied().fold(0.0, f64::max);
    let _ = writeln!(text, "| {name} | {} | {mean:.1} | {most:.0} |", lost.len());
}
