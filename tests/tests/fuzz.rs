//! Every seed of every target is read as its name says, and so are a few thousand mutations of them,
//! without a panic and within a bound of memory.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::{Duration, Instant};

use tests::fuzz::{Mutator, Runner, TARGETS, Target, corpus, target, write};

/// Peak of the whole process, MiB; no input is longer than 64 KiB.
const MOST_MEMORY: u64 = 512;

/// For one input, on a busy machine in a debug build.
const LONGEST: Duration = Duration::from_secs(20);

/// Runs an input; a panic says which one it was.
fn run(runner: &Runner, target: &Target, name: &str, bytes: &[u8]) -> Result<(), String> {
    let start = Instant::now();
    let outcome = catch_unwind(AssertUnwindSafe(|| runner.run(bytes)));
    let in_time = start.elapsed() < LONGEST;
    outcome.ok().filter(|_| in_time).unwrap_or_else(|| {
        let path =
            std::env::temp_dir().join(format!("fuzz-{}-{}", target.name, name.replace(' ', "-")));
        std::fs::write(&path, bytes).expect("the input can be kept");
        let took = start.elapsed();
        panic!(
            "`{}` fails on {name} after {took:?}; it is kept in {}",
            target.name,
            path.display()
        );
    })
}

fn check(name: &str) {
    let target = target(name).expect("a target of this name");
    if std::env::var_os("UPDATE").is_some() {
        write(target).expect("the corpus can be written");
    }
    let seeds = corpus::seeds(target).expect("every target has a corpus");
    let runner = Runner::new(target).expect("a temporary folder");
    for seed in &seeds {
        let outcome = run(&runner, target, &seed.name, &seed.bytes);
        let expected = seed.is_good().unwrap_or(outcome.is_ok());
        let hint = "after a change of the format: UPDATE=1 cargo test --workspace --test fuzz";
        assert_eq!(outcome.is_ok(), expected, "{name}/{}: {outcome:?}; {hint}", seed.name);
    }
    for good in [true, false] {
        assert!(seeds.iter().any(|seed| seed.is_good() == Some(good)), "{name}: no seed is {good}");
    }
    let mut mutator = Mutator::new(target, &seeds, 15);
    let mut n_accepted = 0;
    for i in 0..target.tries {
        let input = mutator.make();
        let outcome = run(&runner, target, &format!("mutation {i}"), &input);
        n_accepted += u32::from(outcome.is_ok());
        mutator.learn(&input, &outcome);
    }
    // Otherwise mutations would not reach what lies behind the first checks.
    assert!(n_accepted * 200 > target.tries, "{name}: {n_accepted} mutations were accepted");
    assert!(mutator.outcomes() >= 3, "{name}: only {} outcomes", mutator.outcomes());
    if let Some(peak) = peak_memory() {
        assert!(peak < MOST_MEMORY, "{name}: {peak} MiB");
    }
}

/// Most memory that this process ever had, MiB, where the system says so.
fn peak_memory() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    line.trim().strip_suffix(" kB")?.parse::<u64>().ok().map(|kib| kib >> 10)
}

macro_rules! targets {
    ($($test:ident: $name:literal;)*) => {
        $(#[test] fn $test() { check($name); })*
        const TESTED: &[&str] = &[$($name),*];
    };
}

targets! {
    text: "text";
    obj: "obj";
    mtl: "mtl";
    ply: "ply";
    stl: "stl";
    gltf: "gltf";
    glb: "glb";
    png: "png";
    jpeg: "jpeg";
    ktx2: "ktx2";
    hdr: "hdr";
    ies: "ies";
    exr: "exr";
    merge: "merge";
    checkpoint: "checkpoint";
    http: "http";
    entry: "entry";
    pack: "pack";
    pack_table: "pack-table";
    pack_contents: "pack-contents";
}

#[test]
fn every_target_is_tested_and_has_its_libfuzzer_binary() {
    let names: Vec<&str> = TARGETS.iter().map(|target| target.name).collect();
    assert_eq!(TESTED, names);
    let manifest = concat!(env!("CARGO_MANIFEST_DIR"), "/fuzz/Cargo.toml");
    let manifest = std::fs::read_to_string(manifest).expect("the manifest of the fuzzers");
    let binaries: Vec<&str> =
        manifest.split("[[bin]]").skip(1).filter_map(|bin| bin.split('"').nth(1)).collect();
    assert_eq!(binaries, names);
}

#[test]
fn the_corpora_are_small() {
    let size = |target: &Target| {
        let seeds = corpus::seeds(target).expect("every target has a corpus");
        seeds.iter().map(|seed| seed.bytes.len()).sum::<usize>()
    };
    let total: usize = TARGETS.iter().map(size).sum();
    assert!(total < 300_000, "{total} bytes");
}
