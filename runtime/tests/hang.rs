//! Kernels that never come back, and limits of the system: a run ends all the same, in time, with what is
//! complete or with one line.

#![cfg(unix)]

mod common;

use runtime::output::read_exr;
use runtime::{Checkpoint, Event, Film};
use std::io::{BufRead as _, BufReader};
use std::path::Path;
use std::process::{Child, ChildStderr, Command, ExitCode, Stdio};
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

/// A test that fails leaves nothing running.
struct Running(Child);

impl Drop for Running {
    fn drop(&mut self) {
        let _ = self.0.kill();
    }
}

/// A folder with `marbles.pack`.
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder for tests");
    let pack = common::pack_bytes(&common::features());
    std::fs::write(folder.path().join("marbles.pack"), pack).expect("it can be written");
    folder
}

/// What all of these tests say to `rtr`.
const ARGS: &[&str] = &["rtr", "marbles.pack", "--device", "cpu", "-o", "a.exr", "-o", "a.png"];

/// `rtr` that renders by now.
fn rendering(folder: &Path, args: &[&str]) -> (Running, BufReader<ChildStderr>) {
    started(Command::new(env!("CARGO_BIN_EXE_rtr")).args(&ARGS[1..]).args(args), folder)
}

/// Says to this very program that it is `rtr`, with these arguments.
const CHILD_ARGS: &str = "RTR_TEST_ARGS";
/// And which block of it never comes back, counted from 1.
const CHILD_STALL: &str = "RTR_TEST_STALL";

/// `rtr` that renders by now, and of which one block never comes back.
fn stalling(folder: &Path, block: u64, args: &[&str]) -> (Running, BufReader<ChildStderr>) {
    let mut child = Command::new(std::env::current_exe().expect("this program"));
    child.args(["--exact", "a_block_that_never_comes_back", "--nocapture"]);
    child.env(CHILD_ARGS, [ARGS, args].concat().join("\n")).env(CHILD_STALL, block.to_string());
    started(child.stdout(Stdio::null()), folder)
}

/// No test, but the process of others: see `stalling`.
#[test]
fn a_block_that_never_comes_back() {
    let (Ok(args), Ok(block)) = (std::env::var(CHILD_ARGS), std::env::var(CHILD_STALL)) else {
        return;
    };
    let left = AtomicU64::new(block.parse().expect("a number"));
    let observer = Box::leak(Box::new(move |event: Event<'_>| {
        if matches!(event, Event::Block) && left.fetch_sub(1, Ordering::Relaxed) == 1 {
            loop {
                std::thread::park();
            }
        }
    }));
    let ended = format!("{:?}", runtime::cli::run_observed(args.split('\n'), observer));
    let is_code = |code: &u8| format!("{:?}", ExitCode::from(*code)) == ended;
    std::process::exit((0..=u8::MAX).find(is_code).expect("an exit code").into());
}

fn started(command: &mut Command, folder: &Path) -> (Running, BufReader<ChildStderr>) {
    let mut child = command.current_dir(folder).stderr(Stdio::piped()).spawn().expect("rtr starts");
    let mut stderr = BufReader::new(child.stderr.take().expect("piped"));
    let mut line = String::new();
    while !line.starts_with("device: ") {
        line.clear();
        assert!(stderr.read_line(&mut line).expect("text") > 0, "it ended");
    }
    (Running(child), stderr)
}

/// The rest of what it says, its exit code, and how long it took from now.
fn ended(mut child: Running, stderr: BufReader<ChildStderr>) -> (String, Option<i32>, Duration) {
    let began = Instant::now();
    let log: Vec<String> = stderr.lines().map(|line| line.expect("text")).collect();
    let code = child.0.wait().expect("it ends").code();
    (log.join("\n"), code, began.elapsed())
}

fn signal(child: &Running, name: &str) {
    let pid = child.0.id().to_string();
    Command::new("kill").args([name, &pid]).status().expect("kill starts");
}

fn film(folder: &Path) -> Film {
    read_exr(&folder.join("a.exr")).expect("a picture").film
}

/// For ever, on two threads.
const LONG: &[&str] = &["--spp", "1000000", "--threads", "2"];

#[test]
fn an_interrupt_ends_a_run_whose_kernel_never_comes_back() {
    for name in ["-INT", "-TERM", "-HUP"] {
        let folder = folder();
        // The image has 3 x 2 blocks: the 20th is in the fourth batch.
        let (child, stderr) = stalling(folder.path(), 20, LONG);
        std::thread::sleep(Duration::from_millis(500));
        signal(&child, name);
        let (log, code, time) = ended(child, stderr);
        assert_eq!(code, Some(130), "{log}");
        assert!(time < Duration::from_secs(2), "{time:?}: {log}");
        assert!(log.contains("the kernel or the driver hangs"), "{log}");
        let film = film(folder.path());
        assert_eq!((film.samples(), film.ranges.len()), ((48, 48), 1));
        assert!(folder.path().join("a.png").is_file());
        // A run that goes on from it is one that was never interrupted.
        let checkpoint = folder.path().join("a.exr.checkpoint");
        assert!(
            log.ends_with("to resume, run the same command with --resume (a.exr.checkpoint)"),
            "{log}"
        );
        let read = Checkpoint::read(&checkpoint).expect("it is sound").expect("it is there");
        assert_eq!(read.film.samples(), (48, 48));
    }
}

#[test]
fn what_a_first_batch_has_is_written_though_a_block_of_it_hangs() {
    let folder = folder();
    let (child, stderr) = stalling(folder.path(), 2, LONG);
    std::thread::sleep(Duration::from_millis(500));
    signal(&child, "-INT");
    let (log, code, _) = ended(child, stderr);
    assert_eq!(code, Some(130), "{log}");
    assert!(log.contains("warning: pixels have between 0 and 16 samples"), "{log}");
    assert_eq!(film(folder.path()).samples(), (0, 16));
    assert!(!folder.path().join("a.exr.checkpoint").exists(), "nothing to go on from");
}

#[test]
fn a_time_limit_ends_a_run_whose_kernel_never_comes_back() {
    let folder = folder();
    // Probes are blocks, too: the picture has room for one round of 16.
    let (child, stderr) = stalling(folder.path(), 36, &[LONG, &["--time", "500ms"]].concat());
    let (log, code, time) = ended(child, stderr);
    assert_eq!(code, Some(3), "{log}");
    assert!(time < Duration::from_millis(2500), "{time:?}: {log}");
    assert!(log.contains("error: the kernel or the driver did not respond in time"), "{log}");
    assert_eq!(film(folder.path()).samples(), (48, 48));
}

#[test]
fn a_film_that_is_too_large_for_the_time_ends_in_time_and_says_so() {
    let folder = folder();
    let args = ["--size", "1200x1200", "--precision", "f64", "--time", "1ms", "--threads", "1"];
    let (child, stderr) = rendering(folder.path(), &args);
    let (log, code, _) = ended(child, stderr);
    assert_eq!(code, Some(0), "{log}");
    let line = "warning: the time was enough for ";
    assert!(log.contains(line) && log.contains(" % of the pixels, the others are black"), "{log}");
    let seconds = log.split(" spp in ").nth(1).and_then(|rest| rest.split('s').next());
    let seconds: f64 = seconds.expect("a time").parse().expect("a number");
    assert!(seconds < 1.0, "{log}");
    let film = film(folder.path());
    assert_eq!(film.samples(), (0, 1));
    // As many pixels are black as it says.
    let merged = Command::new(env!("CARGO_BIN_EXE_rtr"))
        .current_dir(folder.path())
        .args(["merge", "a.exr", "-o", "b.exr"])
        .output()
        .expect("rtr starts");
    assert_eq!(merged.status.code(), Some(3));
    let text = String::from_utf8_lossy(&merged.stderr);
    assert!(text.contains("its pixels have between 0 and 1 samples"), "{text}");
}

#[test]
fn sighup_is_ignored_where_whoever_started_it_wants_that() {
    let folder = folder();
    let rtr = env!("CARGO_BIN_EXE_rtr");
    let line =
        format!("trap '' HUP; exec '{rtr}' marbles.pack --device cpu --spp 1000000 -o a.png");
    let mut child = Running(
        Command::new("sh")
            .current_dir(folder.path())
            .args(["-c", &line])
            .stderr(Stdio::null())
            .spawn()
            .expect("sh starts"),
    );
    std::thread::sleep(Duration::from_millis(700));
    signal(&child, "-HUP");
    std::thread::sleep(Duration::from_millis(700));
    assert!(child.0.try_wait().expect("a child").is_none(), "it goes on");
    signal(&child, "-TERM");
    assert_eq!(child.0.wait().expect("it ends").code(), Some(130));
}

/// Runs `rtr` under limits of the shell: it renders, or says in one line why not.
#[test]
fn limits_of_the_system_are_one_line_and_no_panic() {
    let folder = folder();
    let rtr = env!("CARGO_BIN_EXE_rtr");
    let small = "--spp 1 --threads 2";
    let large = "--spp 1 --threads 2 --size 4096x4096 --crop 0,0,4096,2048";
    let mut refused = 0;
    for (limit, args) in [
        ("-v 20000", small),
        ("-v 60000", small),
        ("-v 100000", small),
        ("-v 150000", small),
        ("-v 250000", small),
        ("-v 500000", small),
        ("-v 500000", large),
        ("-v 1000000", large),
        ("-d 20000", small),
        ("-s 64", small),
        ("-s 32", small),
        ("-n 4", small),
        ("-n 6", small),
        ("-n 12", small),
    ] {
        let line =
            format!("ulimit {limit} && exec '{rtr}' marbles.pack --device cpu {args} -o a.png");
        let output = Command::new("sh").current_dir(folder.path()).args(["-c", &line]).output();
        let output = output.expect("sh starts");
        let log = String::from_utf8_lossy(&output.stderr);
        match output.status.code() {
            Some(0) => {}
            Some(3) => {
                let errors = log.lines().filter(|line| line.starts_with("error: ")).count();
                assert_eq!(errors, 1, "{limit} {args}: {log}");
                refused += 1;
            }
            code => panic!("{limit} {args}: {code:?} {:?} {log}", output.status),
        }
        assert!(!log.contains("panicked") && !log.contains("RUST_BACKTRACE"), "{limit}: {log}");
    }
    assert!((3..14).contains(&refused), "{refused} of 14");
}
