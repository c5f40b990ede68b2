//! Feeds one reader with damaged inputs for a time: `cargo run --release -p tests --bin fuzz -- TARGET
//! --seconds 60`. Without a target it lists them.
//!
//! It starts from `tests/corpus/TARGET` and keeps inputs whose outcome is new. The input under way is
//! always on disk, so that one which kills the process is kept, too. Exit code: 0 nothing was found, 1 an
//! input broke a promise or took too long, 2 usage.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

use clap::Parser;
use tests::console;
use tests::fuzz::{Mutator, Runner, TARGETS, Target, corpus, target};

/// Feeds one reader with damaged inputs for a time.
#[derive(Parser)]
struct Args {
    /// Which reader; without it, all of them are listed.
    target: Option<String>,
    /// For how long.
    #[arg(long, default_value_t = 60)]
    seconds: u64,
    /// Other inputs for another number.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Run these inputs once instead.
    #[arg(long, num_args = 1..)]
    replay: Vec<PathBuf>,
    /// Longest time for one input, seconds.
    #[arg(long, default_value_t = 10)]
    patience: u64,
    /// Where inputs that fail are kept.
    #[arg(long, default_value = concat!(env!("CARGO_MANIFEST_DIR"), "/../target/fuzz"))]
    out: PathBuf,
}

fn main() -> Result<ExitCode, Box<dyn std::error::Error>> {
    let args = Args::parse();
    let Some(name) = &args.target else {
        for target in TARGETS {
            console::line(&format!("{:14} {}", target.name, target.reads));
        }
        return Ok(ExitCode::SUCCESS);
    };
    let Some(target) = target(name) else {
        console::line(&format!("no target `{name}`; without a name, all of them are listed"));
        return Ok(ExitCode::from(2));
    };
    if args.replay.is_empty() { fuzz(target, &args) } else { replay(target, &args.replay) }
}

fn replay(
    target: &'static Target,
    files: &[PathBuf],
) -> Result<ExitCode, Box<dyn std::error::Error>> {
    let runner = Runner::new(target)?;
    for file in files {
        let outcome = runner.run(&std::fs::read(file)?);
        console::line(&format!(
            "{}: {}",
            file.display(),
            outcome.err().unwrap_or("accepted".to_owned())
        ));
    }
    Ok(ExitCode::SUCCESS)
}

fn fuzz(target: &'static Target, args: &Args) -> Result<ExitCode, Box<dyn std::error::Error>> {
    std::fs::create_dir_all(&args.out)?;
    let under_way = args.out.join(format!("{}.under-way", target.name));
    let runner = Runner::new(target)?;
    let mut mutator = Mutator::new(target, &corpus::seeds(target)?, args.seed);
    let start = Instant::now();
    watch(target, start, Duration::from_secs(args.patience), &under_way);
    let (mut n_runs, mut n_accepted, mut next_word) = (0_u64, 0_u64, 10);
    while start.elapsed().as_secs() < args.seconds {
        let input = mutator.make();
        std::fs::write(&under_way, &input)?;
        BEGUN.store(millis(start) + 1, Ordering::Relaxed);
        let outcome = catch_unwind(AssertUnwindSafe(|| runner.run(&input)));
        BEGUN.store(0, Ordering::Relaxed);
        n_runs += 1;
        let Ok(outcome) = outcome else {
            let kept = keep(target, &under_way)?;
            console::line(&format!("{}: run {n_runs} failed; {kept}", target.name));
            return Ok(ExitCode::from(1));
        };
        n_accepted += u64::from(outcome.is_ok());
        mutator.learn(&input, &outcome);
        if start.elapsed().as_secs() >= next_word {
            say(target, start, [n_runs, n_accepted], mutator.outcomes());
            next_word += 10;
        }
    }
    std::fs::remove_file(&under_way)?;
    say(target, start, [n_runs, n_accepted], mutator.outcomes());
    console::line(&format!("{}: nothing was found", target.name));
    Ok(ExitCode::SUCCESS)
}

/// When the input under way was begun, milliseconds after the start and one more; 0: none.
static BEGUN: AtomicU64 = AtomicU64::new(0);

fn millis(start: Instant) -> u64 {
    u64::try_from(start.elapsed().as_millis()).unwrap_or(u64::MAX)
}

/// Ends the process when an input takes too long.
fn watch(target: &'static Target, start: Instant, patience: Duration, under_way: &Path) {
    let under_way = under_way.to_owned();
    std::thread::spawn(move || {
        loop {
            std::thread::sleep(Duration::from_millis(200));
            let begun = BEGUN.load(Ordering::Relaxed);
            let most = u64::try_from(patience.as_millis()).unwrap_or(u64::MAX);
            if begun != 0 && millis(start).saturating_sub(begun) > most {
                let kept = keep(target, &under_way).unwrap_or_else(|error| error.to_string());
                console::line(&format!(
                    "{}: an input takes more than {patience:?}; {kept}",
                    target.name
                ));
                std::process::exit(1);
            }
        }
    });
}

/// Gives the input under way a name of its own; says which.
fn keep(target: &Target, under_way: &Path) -> std::io::Result<String> {
    let name = blake3::hash(&std::fs::read(under_way)?).to_hex();
    let path = under_way.with_file_name(format!("{}-{}", target.name, &name[..12]));
    std::fs::rename(under_way, &path)?;
    let path = path.display();
    Ok(format!("it is kept in {path}, see it again with `fuzz {} --replay {path}`", target.name))
}

fn say(target: &Target, start: Instant, [n_runs, n_accepted]: [u64; 2], n_outcomes: usize) {
    let seconds = start.elapsed().as_secs_f64();
    console::line(&format!(
        "{}: {n_runs} runs in {seconds:.0} s ({:.0} a second), {n_accepted} accepted, {n_outcomes} different outcomes",
        target.name,
        n_runs as f64 / seconds,
    ));
}
