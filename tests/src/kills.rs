//! Tasks of a farm that are killed again and again → at which moments, and what was lost; or what is wrong.
//!
//! A task is `rtr` with `--resume`, `--skip-complete` and a short time between checkpoints, in a folder of its own. After
//! every kill the folder is looked at as the next run will find it: what has its final name is whole, what was saved
//! before is saved still, and what was rendered since is no more than one interval. It does not know how `rtr` keeps
//! these promises.

use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use runtime::output::{is_whole, read_exr};
use runtime::{Checkpoint, Job, SampleRange, Scene};

/// What is wrong.
pub type Fault = String;

/// All tasks are of one scene.
pub struct Kind {
    /// The program.
    pub rtr: PathBuf,
    /// The pack.
    pub pack: PathBuf,
    /// The same, opened.
    pub scene: Scene,
    /// The picture; samples are those of each task.
    pub job: Job,
    /// Time between checkpoints.
    pub every: Duration,
    /// What a run takes.
    pub pace: Pace,
    /// Most samples of every pixel that a kill may cost.
    pub most_lost: f64,
}

/// CPU seconds of a run that nobody kills: what others do on the machine meanwhile does not count.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pace {
    /// Of a process that finds its part there.
    pub start_up: f64,
    /// A sample of every pixel.
    pub sample: f64,
}

/// Some samples of every pixel, rendered into `folder`.
pub struct Task<'a> {
    /// What it has in common with others.
    pub kind: &'a Kind,
    /// Its own folder.
    pub folder: PathBuf,
    /// Its samples.
    pub samples: SampleRange,
}

/// When a run is killed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Moment {
    /// So long after its start.
    After(Duration),
    /// So long after it has begun to write a file.
    Writing(Duration),
    /// So long after its part is there.
    Written(Duration),
    /// Never.
    End,
}

/// Where a kill met a run, by what it has left.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// There is nothing yet.
    Nothing,
    /// There is a checkpoint.
    Saved,
    /// A file was being written.
    Writing,
    /// The part is there.
    Whole,
}

/// All of them.
pub const STAGES: [(Stage, &str); 4] = [
    (Stage::Nothing, "before the first checkpoint"),
    (Stage::Saved, "between checkpoints"),
    (Stage::Writing, "while a file was being written"),
    (Stage::Whole, "when the part was there"),
];

/// What a task's folder holds.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Left {
    /// Whether the part is there; then it is whole.
    pub part: bool,
    /// Samples of every pixel in the checkpoint; 0 without one.
    pub saved: u32,
    /// Names of files that were not renamed to their own.
    pub unfinished: Vec<PathBuf>,
}

/// A kill.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Kill {
    /// Where it met the run.
    pub stage: Stage,
    /// Samples of every pixel that were rendered and that no file has, by the CPU time of the run.
    pub lost: f64,
}

/// How a run ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Ended {
    /// It was killed.
    Killed(Kill),
    /// Before it could be killed.
    Well(Spent),
}

/// What a run took, in seconds.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Spent {
    /// Since its start.
    pub wall: f64,
    /// User + system; wall where the system does not say.
    pub cpu: f64,
}

impl Spent {
    fn of(process: &Child, began: Instant) -> Self {
        let wall = began.elapsed().as_secs_f64();
        Self { wall, cpu: cpu(process.id()).unwrap_or(wall) }
    }
}

/// CPU seconds of a process, by Linux: the 14th and 15th word of its `stat`, in hundredths of a second; the second word
/// is a name in brackets, which may hold anything: `proc_pid_stat(5)`.
fn cpu(id: u32) -> Option<f64> {
    let text = std::fs::read_to_string(format!("/proc/{id}/stat")).ok()?;
    let words: Vec<&str> = text.rsplit_once(')')?.1.split_whitespace().collect();
    let ticks: u32 = words.get(11)?.parse::<u32>().ok()? + words.get(12)?.parse::<u32>().ok()?;
    Some(f64::from(ticks) / 100.0)
}

impl Task<'_> {
    /// The picture.
    #[must_use]
    pub fn part(&self) -> PathBuf {
        self.folder.join("part.exr")
    }

    fn checkpoint(&self) -> PathBuf {
        self.folder.join("part.exr.checkpoint")
    }

    /// What is in the folder.
    ///
    /// # Errors
    /// When something there is not what its name says.
    pub fn look(&self) -> Result<Left, Fault> {
        let Kind { scene, job, .. } = self.kind;
        let job = Job { samples: self.samples, ..job.clone() };
        let (part, checkpoint) = (self.part(), self.checkpoint());
        if part.exists() {
            let picture = read_exr(&part).map_err(|error| error.to_string())?;
            if !is_whole(&picture, scene, &job) {
                return Err(format!("{} is not whole", part.display()));
            }
        }
        let found = Checkpoint::read(&checkpoint).map_err(|error| error.to_string())?;
        let saved = match &found {
            None => 0,
            Some(found) => {
                found.check(&checkpoint, scene, &job).map_err(|error| error.to_string())?;
                found.film.samples().1
            }
        };
        Ok(Left { part: part.exists(), saved, unfinished: unfinished(&self.folder)? })
    }

    /// Starts a run, kills it and looks at what is left, after `had` from the runs before.
    ///
    /// # Errors
    /// When it fails, or breaks a promise.
    pub fn run(&self, had: &Left, moment: Moment) -> Result<Ended, Fault> {
        let log = self.folder.join("log");
        let began = Instant::now();
        let mut process = self.start(&log)?;
        let (spent, is_over) = self.wait(&mut process, &had.unfinished, moment, began)?;
        // What is saved now must be saved still when the process is dead.
        let seen = Checkpoint::read(&self.checkpoint()).map_err(|error| error.to_string())?;
        if !is_over {
            process.kill().map_err(|error| error.to_string())?;
        }
        let status = process.wait().map_err(|error| error.to_string())?;
        let said = std::fs::read_to_string(&log).map_err(|error| error.to_string())?;
        let left = self.look()?;
        if status.success() {
            return self.ended(had, &left, &said).map(|()| Ended::Well(spent));
        }
        if status.code().is_some() {
            return Err(format!("rtr fails: {said}"));
        }
        went_on(had, &said, false)?;
        let seen = seen.map_or(0, |seen| seen.film.samples().1);
        self.judge(had, &left, seen, spent.cpu).map(Ended::Killed)
    }

    fn start(&self, log: &Path) -> Result<Child, Fault> {
        let Kind { rtr, pack, job, every, .. } = self.kind;
        let file = std::fs::File::create(log).map_err(|error| error.to_string())?;
        let [width, height] = job.image_size;
        let mut command = Command::new(rtr);
        command.arg(pack).args(["--device", "cpu", "--threads", "1", "--write-every", "never"]);
        command.args(["--size", &format!("{width}x{height}")]);
        command.args(["--samples", &self.samples.to_string(), "--resume", "--skip-complete"]);
        command.args(["--checkpoint-every", &format!("{}ms", every.as_millis()), "-o"]);
        command.arg(self.part()).stdin(Stdio::null()).stdout(Stdio::null()).stderr(file);
        command.spawn().map_err(|error| format!("{}: {error}", rtr.display()))
    }

    /// Until the moment has come. What the process has taken, and whether it has ended before.
    fn wait(
        &self,
        process: &mut Child,
        old: &[PathBuf],
        moment: Moment,
        began: Instant,
    ) -> Result<(Spent, bool), Fault> {
        let part = self.part();
        let (mut since, mut spent) = (None, Spent::default());
        loop {
            if process.try_wait().map_err(|error| error.to_string())?.is_some() {
                return Ok((spent, true));
            }
            spent = Spent::of(process, began);
            let has_come = match moment {
                Moment::End => false,
                Moment::After(delay) => began.elapsed() >= delay,
                Moment::Writing(delay) => {
                    let writes = since.is_some() || is_new(&unfinished(&self.folder)?, old);
                    writes && since.get_or_insert_with(Instant::now).elapsed() >= delay
                }
                Moment::Written(delay) => {
                    let is_there = since.is_some() || part.exists();
                    is_there && since.get_or_insert_with(Instant::now).elapsed() >= delay
                }
            };
            if has_come {
                return Ok((spent, false));
            }
            std::thread::sleep(Duration::from_micros(300));
        }
    }

    /// What a run that was not killed must have done.
    fn ended(&self, had: &Left, left: &Left, said: &str) -> Result<(), Fault> {
        if !left.part {
            return Err(format!("rtr ended well, but there is no {}", self.part().display()));
        }
        if had.part {
            let is_left_alone = said.contains("complete already");
            return is_left_alone
                .then_some(())
                .ok_or_else(|| format!("a part is made anew: {said}"));
        }
        went_on(had, said, true)
    }

    /// Whether a run that was killed after `cpu` seconds kept what it had to, and `seen`, which was saved by then.
    fn judge(&self, had: &Left, left: &Left, seen: u32, cpu: f64) -> Result<Kill, Fault> {
        let is_new = is_new(&left.unfinished, &had.unfinished);
        if left.part {
            return Ok(Kill { stage: Stage::Whole, lost: 0.0 });
        }
        if had.part {
            return Err(format!("{} was there and is gone", self.part().display()));
        }
        let saved = had.saved.max(seen);
        if left.saved < saved {
            return Err(format!("{saved} samples were saved, and {} are now", left.saved));
        }
        let Kind { pace, most_lost: most, .. } = self.kind;
        let rendered = (cpu - pace.start_up) / pace.sample;
        let lost = (rendered - f64::from(left.saved - had.saved)).max(0.0);
        if lost > *most {
            return Err(format!("{lost:.0} samples are lost, and {most:.0} may be"));
        }
        let stage = match left.saved {
            _ if is_new => Stage::Writing,
            0 => Stage::Nothing,
            _ => Stage::Saved,
        };
        Ok(Kill { stage, lost })
    }
}

/// Files in a folder that are not renamed to their own names yet, or never will be.
fn unfinished(folder: &Path) -> Result<Vec<PathBuf>, Fault> {
    let entries = std::fs::read_dir(folder).map_err(|error| error.to_string())?;
    let paths = entries.filter_map(|entry| Some(entry.ok()?.path()));
    Ok(paths.filter(|path| path.extension().is_some_and(|end| end == "tmp")).collect())
}

fn is_new(files: &[PathBuf], old: &[PathBuf]) -> bool {
    files.iter().any(|file| !old.contains(file))
}

/// Whether a run began where the one before had stopped, by what it said; one that was killed may have said nothing.
fn went_on(had: &Left, said: &str, has_ended: bool) -> Result<(), Fault> {
    let from = said.lines().find_map(|line| {
        let (_, count) = line.strip_prefix("resuming from ")?.rsplit_once(": ")?;
        count.split_once(" of ")?.0.parse::<u32>().ok()
    });
    let afresh = said.lines().any(|line| line.contains("starting afresh"));
    match (from, had.saved) {
        (Some(from), saved) if from == saved => Ok(()),
        (Some(from), saved) => Err(format!("it goes on at {from} samples, {saved} were saved")),
        (None, 1..) if afresh => Err("it starts afresh beside a checkpoint".to_owned()),
        (None, 1..) if has_ended => Err(format!("it does not say that it goes on: {said}")),
        (None, _) => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use runtime::output::{Identity, write};
    use runtime::{Control, DeviceChoice, render};

    const SAMPLES: SampleRange = SampleRange { start: 32, end: 64 };

    fn kind() -> Kind {
        let text = "rts 1\nsky s: gradient {}\ncamera c: perspective { from = (0, 0, 5)m, to = (0, 0, 0)m }\n\
                    film f { size = (8, 8)px }\nrender r: path { camera = c, film = f, sky = s, samples = 4 }\n";
        let scene = Scene::new(crate::scene::pack(text));
        let job = Job::of_scene(&scene);
        let every = Duration::from_millis(100);
        let pace = Pace { start_up: 0.5, sample: 0.125 };
        Kind { rtr: PathBuf::new(), pack: PathBuf::new(), scene, job, every, pace, most_lost: 10.0 }
    }

    fn task<'a>(kind: &'a Kind, folder: &Path) -> Task<'a> {
        Task { kind, folder: folder.to_owned(), samples: SAMPLES }
    }

    fn picture(kind: &Kind, samples: SampleRange) -> runtime::output::Picture {
        let job = Job { samples, ..kind.job.clone() };
        let outcome = render(&kind.scene, &job, &DeviceChoice::Cpu, &Control::default());
        outcome.expect("it can be rendered").picture
    }

    /// Leaves a checkpoint of the first batch.
    fn save(task: &Task<'_>) {
        let kind = task.kind;
        let film = picture(kind, SampleRange { start: 32, end: 48 }).film;
        let job = Job { samples: SAMPLES, ..kind.job.clone() };
        let identity = Identity::of(&kind.scene, &job);
        let device = String::new();
        let checkpoint = Checkpoint { identity, samples: SAMPLES, film, device, seconds: 1.5 };
        checkpoint.write(&task.checkpoint()).expect("it can be written");
    }

    #[test]
    fn a_part_that_is_not_whole_is_a_fault() {
        let (kind, folder) = (kind(), tempfile::tempdir().unwrap());
        let task = task(&kind, folder.path());
        assert_eq!(task.look(), Ok(Left::default()));
        write(&task.part(), &picture(&kind, SAMPLES), true).unwrap();
        assert!(task.look().unwrap().part);
        let bytes = std::fs::read(task.part()).unwrap();
        std::fs::write(task.part(), &bytes[..bytes.len() / 2]).unwrap();
        assert!(task.look().is_err(), "it is cut short");
        write(&task.part(), &picture(&kind, SampleRange { start: 32, end: 48 }), true).unwrap();
        assert!(task.look().is_err(), "samples are missing");
    }

    #[test]
    fn a_checkpoint_that_is_damaged_or_foreign_is_a_fault() {
        let (kind, folder) = (kind(), tempfile::tempdir().unwrap());
        let own = task(&kind, folder.path());
        save(&own);
        assert_eq!(own.look().unwrap().saved, 16);
        let other =
            Task { samples: SampleRange { start: 64, end: 96 }, ..task(&kind, folder.path()) };
        assert!(other.look().is_err(), "it is of other samples");
        let mut bytes = std::fs::read(own.checkpoint()).unwrap();
        *bytes.last_mut().unwrap() ^= 1;
        std::fs::write(own.checkpoint(), bytes).unwrap();
        assert!(own.look().is_err(), "a bit is flipped");
    }

    #[test]
    fn what_was_saved_and_is_lost_is_a_fault() {
        let (kind, folder) = (kind(), tempfile::tempdir().unwrap());
        let task = task(&kind, folder.path());
        let left = |saved| Left { saved, ..Left::default() };
        let kill = |stage, lost| Ok(Kill { stage, lost });
        let none = Left::default();
        // Eight samples a second, after half of one.
        assert_eq!(task.judge(&none, &none, 0, 1.0), kill(Stage::Nothing, 4.0));
        assert_eq!(task.judge(&none, &none, 0, 0.25), kill(Stage::Nothing, 0.0));
        assert_eq!(task.judge(&left(16), &left(32), 32, 3.0), kill(Stage::Saved, 4.0));
        let writing = Left { unfinished: vec![".a.tmp".into()], ..left(16) };
        assert_eq!(task.judge(&left(16), &writing, 16, 1.0), kill(Stage::Writing, 4.0));
        assert_eq!(task.judge(&writing, &writing, 16, 1.0), kill(Stage::Saved, 4.0));
        let whole = Left { part: true, ..left(16) };
        assert_eq!(task.judge(&none, &whole, 16, 9.0), kill(Stage::Whole, 0.0));
        assert!(task.judge(&whole, &none, 0, 0.1).is_err(), "the part is gone");
        assert!(task.judge(&left(32), &left(16), 0, 0.1).is_err(), "an older one");
        assert!(task.judge(&none, &left(16), 32, 0.1).is_err(), "older than it was");
        assert!(task.judge(&none, &none, 0, 2.0).is_err(), "no checkpoint in time");
    }

    #[test]
    fn a_run_that_goes_on_elsewhere_is_a_fault() {
        let had = |saved| Left { saved, ..Left::default() };
        let said = "x.pack\nresuming from part.exr.checkpoint: 16 of 32 spp done\n";
        assert_eq!(went_on(&had(16), said, true), Ok(()));
        assert!(went_on(&had(32), said, true).is_err());
        assert!(went_on(&had(16), "there is no a.checkpoint; starting afresh\n", false).is_err());
        assert_eq!(went_on(&had(16), "", false), Ok(()));
        assert!(went_on(&had(16), "", true).is_err());
        assert_eq!(went_on(&had(0), "there is no a.checkpoint; starting afresh\n", true), Ok(()));
    }
}
