//! Runs that are interrupted, killed or resumed wrongly: the picture is the same to the last bit, or
//! one line says why there is none.

mod common;

use common::{assert_same, scene};
use runtime::output::{Identity, read_exr};
use runtime::{
    Checkpoint, Control, DeviceChoice, Event, Film, Job, Keep, SampleRange, Session, Stop, render,
    render_session,
};
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Twenty batches.
const SPP: &str = "320";

fn command(folder: &Path, args: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_rtr"));
    command.current_dir(folder).args(["marbles.pack", "--device", "cpu"]).args(args);
    command
}

fn rtr(folder: &Path, args: &[&str]) -> (Option<i32>, String) {
    let Output { status, stderr, .. } = command(folder, args).output().expect("rtr starts");
    (status.code(), String::from_utf8_lossy(&stderr).into_owned())
}

/// A folder with `marbles.pack`.
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder for tests");
    let pack = common::pack_bytes(&common::features());
    std::fs::write(folder.path().join("marbles.pack"), pack).expect("it can be written");
    folder
}

/// The checkpoint of a run that was killed in `folder` as soon as there was one.
fn killed(folder: &Path, args: &[&str]) -> PathBuf {
    let checkpoint = folder.join("a.exr.checkpoint");
    // One thread, so that no machine is done before it is killed.
    let slowly = ["--threads", "1", "--checkpoint-every", "20ms", "--quiet"];
    let outputs = ["-o", "a.exr", "-o", "a.png"];
    let mut child = command(folder, args).args(slowly).args(outputs).spawn().expect("rtr starts");
    let start = Instant::now();
    while !checkpoint.is_file() {
        assert!(start.elapsed() < Duration::from_mins(2), "no checkpoint is written");
        assert!(child.try_wait().expect("a child").is_none(), "it ended before it was killed");
        std::thread::sleep(Duration::from_millis(1));
    }
    // SIGKILL: nothing can be tidied up.
    child.kill().expect("it can be killed");
    child.wait().expect("it was killed");
    assert!(!folder.join("a.exr").exists(), "it was killed before it was done");
    checkpoint
}

fn film(folder: &Path, name: &str) -> Film {
    read_exr(&folder.join(name)).expect("a picture").film
}

#[test]
fn a_killed_run_goes_on_to_the_same_picture() {
    let folder = folder();
    let at = |name: &str| std::fs::read(folder.path().join(name)).expect("it is there");
    let whole = rtr(folder.path(), &["--spp", SPP, "-o", "whole.exr", "-o", "whole.png"]);
    assert_eq!(whole.0, Some(0), "{}", whole.1);
    let checkpoint = killed(folder.path(), &["--spp", SPP]);
    let read = Checkpoint::read(&checkpoint).expect("it is sound").expect("it is there");
    let done = read.film.samples().0;
    assert!((16..320).contains(&done) && done.is_multiple_of(16), "{done}");
    let resumed = ["--spp", SPP, "-o", "a.exr", "-o", "a.png", "--resume"];
    let (code, log) = rtr(folder.path(), &resumed);
    assert_eq!(code, Some(0), "{log}");
    let line = format!("resuming from a.exr.checkpoint: {done} of 320 spp done");
    assert!(log.contains(&line), "{log}");
    assert_same(&film(folder.path(), "a.exr"), &film(folder.path(), "whole.exr"));
    assert_eq!(at("a.png"), at("whole.png"));
    assert!(!checkpoint.exists(), "the picture is complete");
    // Whoever restarts it once more gets the picture anew.
    let (code, log) = rtr(folder.path(), &resumed);
    assert_eq!(code, Some(0), "{log}");
    assert!(log.contains("there is no a.exr.checkpoint; starting afresh"), "{log}");
    assert_eq!(at("a.png"), at("whole.png"));
}

/// Checkpoints do not hold layers: whoever goes on makes them of all samples, and may ask for other ones.
#[test]
fn a_killed_run_goes_on_to_the_same_layers() {
    let folder = folder();
    let layers = ["--layers", "albedo,depth,crypto", "--transparent"];
    let whole = [&["--spp", SPP, "-o", "whole.exr"], layers.as_slice()].concat();
    let (code, log) = rtr(folder.path(), &whole);
    assert_eq!(code, Some(0), "{log}");
    killed(folder.path(), &["--spp", SPP]);
    let resumed = [&["--spp", SPP, "-o", "a.exr", "--resume"], layers.as_slice()].concat();
    let (code, log) = rtr(folder.path(), &resumed);
    assert_eq!(code, Some(0), "{log}");
    assert!(log.contains("resuming from a.exr.checkpoint: "), "{log}");
    let read = |name: &str| read_exr(&folder.path().join(name)).expect("a picture");
    let (resumed, whole) = (read("a.exr"), read("whole.exr"));
    assert_same(&resumed.film, &whole.film);
    assert!(whole.layers.is_some() && resumed.layers == whole.layers);
}

#[test]
fn a_checkpoint_of_another_run_is_refused_in_one_line() {
    let folder = folder();
    let checkpoint = killed(folder.path(), &["--spp", SPP]);
    let before = std::fs::read(&checkpoint).expect("it is there");
    let refused = |args: &[&str], message: &str| {
        let args = [args, &["-o", "a.exr", "--resume"]].concat();
        let (code, log) = rtr(folder.path(), &args);
        assert_eq!(code, Some(3), "{args:?} {log}");
        assert_eq!(log.lines().count(), 1, "{log}");
        let line = format!("error: a.exr.checkpoint belongs to another run: {message}; ");
        assert!(log.starts_with(&line), "{args:?} {log}");
    };
    refused(&["--spp", SPP, "--seed", "8"], "seed is 7 there and 8 here");
    refused(&["--spp", SPP, "--size", "36x20"], "size is 72x40 there and 36x20 here");
    refused(&["--spp", SPP, "--crop", "0,0,8,8"], "crop is 0,0,72,40 there and 0,0,8,8 here");
    refused(&["--spp", SPP, "--estimator", "bsdf"], "estimator is 0 there and 2 here");
    refused(&["--spp", SPP, "--precision", "f64"], "precision is f32 there and f64 here");
    refused(&["--spp", SPP, "--clamp-indirect", "2"], "clamp_indirect is off there and 2 here");
    refused(&["--spp", "64"], "samples is 0..320 there and 0..64 here");
    let kernel = shaders::link(&common::features()).expect("it links").text + "\n";
    let other = common::pack_with_kernel(&kernel);
    std::fs::write(folder.path().join("marbles.pack"), other).expect("it can be written");
    let (code, log) = rtr(folder.path(), &["--spp", SPP, "-o", "a.exr", "--resume"]);
    assert!(code == Some(3) && log.contains("another run: render_id is "), "{log}");
    assert_eq!(std::fs::read(&checkpoint).expect("it is there"), before, "it is left alone");
}

#[test]
fn a_damaged_checkpoint_is_refused_in_one_line() {
    let folder = folder();
    let checkpoint = killed(folder.path(), &["--spp", SPP]);
    let good = std::fs::read(&checkpoint).expect("it is there");
    let mut flipped = good.clone();
    *flipped.last_mut().expect("bytes") ^= 1;
    for (bytes, message) in [
        (&flipped[..], "a.exr.checkpoint is damaged: its checksum is wrong; "),
        (&good[..good.len() - 1], "a.exr.checkpoint is damaged: its checksum is wrong; "),
        (&good[..100], "a.exr.checkpoint is damaged: it is cut short; "),
        (&good[..20], "a.exr.checkpoint is damaged: it is cut short; "),
        (b"a letter", "a.exr.checkpoint is not a checkpoint of this rtr"),
        (b"", "a.exr.checkpoint is not a checkpoint of this rtr"),
    ] {
        std::fs::write(&checkpoint, bytes).expect("it can be written");
        let (code, log) = rtr(folder.path(), &["--spp", SPP, "-o", "a.exr", "--resume"]);
        assert_eq!((code, log.lines().count()), (Some(3), 1), "{log}");
        assert!(log.starts_with(&format!("error: {message}")), "{log}");
    }
    // Without --resume the run says that it is there, and begins.
    let (code, log) = rtr(folder.path(), &["--spp", "4", "-o", "a.exr"]);
    assert_eq!(code, Some(0), "{log}");
    assert!(log.contains("a.exr.checkpoint belongs to an unfinished run"), "{log}");
    assert!(checkpoint.is_file(), "it is not this run's");
}

/// Interrupts, again and again, whenever another batch is done.
#[test]
fn many_interruptions_do_not_change_a_bit() {
    let scene = scene();
    let folder = tempfile::tempdir().expect("a folder for tests");
    let path = folder.path().join("a.exr.checkpoint");
    // The range begins and ends inside of a batch.
    let samples = SampleRange { start: 5, end: 170 };
    // One thread, so that a busy machine has time to interrupt it.
    let job = Job { samples, threads: Some(1), ..Job::of_scene(&scene) };
    let keep = Some(Keep { path: path.clone(), every: Duration::from_hours(1) });
    let (mut interruptions, mut rounds) = (0, 0);
    let outcome = loop {
        let from = Checkpoint::read(&path).expect("it is sound");
        if let Some(from) = &from {
            from.check(&path, &scene, &job).expect("it is of this run");
        }
        let control = Arc::new(Control::default());
        let batch = job.crop.pixels() * 16;
        let before = from.as_ref().map_or(0, |from| from.film.total_samples());
        let end = before + batch + batch / 3;
        let session = Session { from, keep: keep.clone() };
        let outcome = std::thread::scope(|scope| {
            scope.spawn(|| {
                let all = job.crop.pixels() * u64::from(job.samples.count());
                while control.progress().done < end.min(all) {
                    std::thread::sleep(Duration::from_millis(1));
                }
                control.cancel();
            });
            render_session(&scene, &job, &DeviceChoice::Cpu, &control, session)
        });
        let outcome = outcome.expect("the CPU renders");
        if outcome.stop == Stop::Complete {
            break outcome;
        }
        // A thread that was held up may have kept the only batch from being complete.
        interruptions += usize::from(outcome.saved);
        rounds += 1;
        assert!(rounds < 200, "it does not come to an end");
    };
    assert!(interruptions >= 2, "{interruptions}");
    let whole = render(&scene, &job, &DeviceChoice::Cpu, &Control::default());
    let whole = whole.expect("the CPU renders");
    assert_same(outcome.film(), whole.film());
    assert_eq!(outcome.picture.meta.device, whole.picture.meta.device);
}

/// Killed between the last batch and the picture.
#[test]
fn a_run_that_was_done_only_writes_the_picture() {
    let scene = scene();
    let job = Job::of_scene(&scene);
    let whole = render(&scene, &job, &DeviceChoice::Cpu, &Control::default());
    let whole = whole.expect("the CPU renders");
    let from = Checkpoint {
        identity: Identity::of(&scene, &job),
        samples: job.samples,
        film: whole.film().clone(),
        device: whole.picture.meta.device.clone(),
        seconds: 2.0,
    };
    for time_limit in [None, Some(Duration::from_secs(9))] {
        let control = Control::default();
        let (from, job) = (Some(from.clone()), Job { time_limit, ..job.clone() });
        let session = Session { from, keep: None };
        let outcome = render_session(&scene, &job, &DeviceChoice::Cpu, &control, session);
        let outcome = outcome.expect("nothing is left to do");
        assert_eq!((outcome.stop, control.progress().rays), (Stop::Complete, 0));
        assert_same(outcome.film(), whole.film());
        assert!(outcome.picture.meta.complete && outcome.elapsed >= Duration::from_secs(2));
    }
}

/// A run without `--resume` replaces no checkpoint but its own, whatever becomes of it.
#[test]
fn a_checkpoint_of_another_run_is_kept_aside_and_can_be_gone_on_from() {
    let folder = folder();
    let at = |name: &str| folder.path().join(name);
    let read = |name: &str| std::fs::read(at(name)).ok();
    let whole = rtr(folder.path(), &["--spp", SPP, "-o", "whole.exr", "--quiet"]);
    assert_eq!(whole.0, Some(0), "{}", whole.1);
    killed(folder.path(), &["--spp", SPP]);
    let first = read("a.exr.checkpoint").expect("it is there");
    // Another one is killed with a checkpoint of its own.
    let args = ["--spp", SPP, "--threads", "1", "--checkpoint-every", "20ms", "-o", "a.exr"];
    let mut child =
        command(folder.path(), &args).stderr(Stdio::null()).spawn().expect("rtr starts");
    let start = Instant::now();
    // The name is taken, by an empty file, before the checkpoint gets it.
    let is_aside = || read("a.exr.checkpoint.1").as_ref() == Some(&first);
    while !(is_aside() && at("a.exr.checkpoint").is_file()) {
        assert!(start.elapsed() < Duration::from_mins(2), "no checkpoint is written");
        std::thread::sleep(Duration::from_millis(1));
    }
    child.kill().expect("it can be killed");
    child.wait().expect("it was killed");
    assert_eq!(read("a.exr.checkpoint.1").as_ref(), Some(&first));
    let second = read("a.exr.checkpoint").expect("it is there");
    // A third one comes to its end, with checkpoints, and says what it keeps.
    let (code, log) = rtr(folder.path(), &args);
    assert_eq!(code, Some(0), "{log}");
    let line = "a.exr.checkpoint belongs to another run and was renamed to a.exr.checkpoint.2; \
                to resume that one: --resume=a.exr.checkpoint.2";
    assert!(log.contains(line), "{log}");
    let left = ["a.exr.checkpoint", "a.exr.checkpoint.1", "a.exr.checkpoint.2"].map(read);
    assert_eq!(left, [None, Some(first), Some(second)], "only its own is removed");
    // Either can be gone on from, and goes with the picture.
    for name in ["a.exr.checkpoint.1", "a.exr.checkpoint.2"] {
        let resume = format!("--resume={name}");
        let (code, log) = rtr(folder.path(), &["--spp", SPP, "-o", "a.exr", &resume]);
        assert_eq!(code, Some(0), "{log}");
        assert!(log.contains(&format!("resuming from {name}: ")), "{log}");
        assert_same(&film(folder.path(), "a.exr"), &film(folder.path(), "whole.exr"));
        assert!(!at(name).exists());
        let (code, log) = rtr(folder.path(), &["--spp", SPP, "-o", "a.exr", &resume]);
        assert_eq!((code, log.lines().count()), (Some(3), 1), "{log}");
        assert!(log.starts_with(&format!("error: cannot read {name}: ")), "{log}");
    }
}

#[cfg(unix)]
#[test]
fn an_interrupt_leaves_a_checkpoint_unless_none_is_wanted() {
    let folder = folder();
    for (every, signal, expected) in
        [("1h", "-INT", true), ("never", "-TERM", false), ("1h", "-HUP", true)]
    {
        let mut child = command(folder.path(), &["--spp", "1000000", "-o", "b.png"])
            .args(["--checkpoint-every", every])
            .stderr(Stdio::piped())
            .spawn()
            .expect("rtr starts");
        let stderr = child.stderr.take().expect("piped");
        let mut lines = std::io::BufRead::lines(std::io::BufReader::new(stderr));
        assert!(lines.any(|line| line.expect("text").starts_with("device: ")));
        std::thread::sleep(Duration::from_millis(800));
        let pid = child.id().to_string();
        Command::new("kill").args([signal, &pid]).status().expect("kill starts");
        let log: Vec<String> = lines.map(|line| line.expect("text")).collect();
        let log = log.join("\n");
        assert_eq!(child.wait().expect("it ends").code(), Some(130), "{log}");
        let checkpoint = folder.path().join("b.png.checkpoint");
        assert_eq!(checkpoint.is_file(), expected, "{log}");
        let hint = "to resume, run the same command with --resume (b.png.checkpoint)";
        assert_eq!(log.contains(hint), expected, "{log}");
        if expected {
            let read = Checkpoint::read(&checkpoint).expect("it is sound").expect("it is there");
            assert!(read.film.samples().0 >= 16, "{log}");
            std::fs::remove_file(checkpoint).expect("it can be removed");
        }
    }
}

#[test]
fn a_run_that_cannot_be_saved_goes_on() {
    let scene = scene();
    let job = Job { samples: SampleRange { start: 0, end: 64 }, ..Job::of_scene(&scene) };
    let path = Path::new("no such folder/a.checkpoint").to_owned();
    let notes = Arc::new(std::sync::Mutex::new(Vec::new()));
    let sink = Arc::clone(&notes);
    let control = Control::new(move |event| {
        if let Event::Note(text) = event {
            sink.lock().expect("no panic").push(text.to_owned());
        }
    });
    let session = Session { from: None, keep: Some(Keep { path, every: Duration::ZERO }) };
    let outcome = render_session(&scene, &job, &DeviceChoice::Cpu, &control, session);
    let outcome = outcome.expect("the CPU renders");
    assert_eq!((outcome.stop, outcome.saved), (Stop::Complete, false));
    let warned =
        |text: &&String| text.starts_with("warning: cannot write the checkpoint no such folder");
    assert_eq!(notes.lock().expect("no panic").iter().filter(warned).count(), 1);
}
