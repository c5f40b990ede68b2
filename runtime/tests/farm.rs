//! Jobs for many machines: what `rtr job` writes is run as it says, with tasks that run twice or never, and the parts
//! merge to the bits of one run.

mod common;

use runtime::SampleRange;
use runtime::output::read_exr;
use std::path::Path;
use std::process::{Command, Output};

/// Five batches, the last of which is short.
const SPP: &str = "70";

fn run(command: &mut Command) -> (Option<i32>, String) {
    let Output { status, stdout, stderr } = command.output().expect("it starts");
    let text = [stdout, stderr].map(|bytes| String::from_utf8_lossy(&bytes).into_owned());
    (status.code(), text.concat())
}

fn rtr(folder: &Path, args: &[&str]) -> (Option<i32>, String) {
    run(Command::new(env!("CARGO_BIN_EXE_rtr")).current_dir(folder).args(args))
}

/// A folder with `marbles.pack` and a job for it, two batches a task.
fn job(format: &str, more: &[&str]) -> (tempfile::TempDir, String) {
    let folder = tempfile::tempdir().expect("a folder for tests");
    let pack = common::pack_bytes(&common::features());
    std::fs::write(folder.path().join("marbles.pack"), pack).expect("it can be written");
    let args = [
        "job",
        "marbles.pack",
        "--format",
        format,
        "--chunk",
        "2",
        "--spp",
        SPP,
        "--device",
        "cpu",
    ];
    let (code, log) = rtr(folder.path(), &[&args, more].concat());
    assert_eq!(code, Some(0), "{log}");
    (folder, log)
}

/// The bits of the pixels, as they are shown.
fn pixels(folder: &Path, name: &str) -> Vec<[u32; 3]> {
    let film = read_exr(&folder.join(name)).expect("a picture").film;
    assert_eq!(film.ranges, [SampleRange { start: 0, end: 70 }]);
    #[expect(clippy::cast_possible_truncation, reason = "the precision of pictures")]
    let mean = |(sum, n): (&[f64; 3], &u32)| sum.map(|c| ((c / f64::from(*n)) as f32).to_bits());
    film.sums.iter().zip(&film.counts).map(mean).collect()
}

/// The script of the job, as `sh marbles.job.sh` with these words.
fn script(folder: &Path, words: &[&str]) -> (Option<i32>, String) {
    let mut command = Command::new("sh");
    command.current_dir(folder).arg("marbles.job.sh").args(words);
    run(command.env("RTR", env!("CARGO_BIN_EXE_rtr")))
}

#[test]
fn parts_of_a_script_merge_to_one_run() {
    let (folder, log) = job("sh", &[]);
    let folder = folder.path();
    assert!(log.contains("3 tasks of 2 batches (32 samples)"), "{log}");
    // In another order, and one of them twice.
    for task in ["2", "0", "0"] {
        let (code, log) = script(folder, &["task", task]);
        assert_eq!(code, Some(0), "{log}");
    }
    let (_, log) = script(folder, &["task", "0"]);
    assert!(log.contains("parts/marbles.0.exr complete already"), "{log}");
    let (code, log) = script(folder, &["merge"]);
    assert_eq!(code, Some(3), "{log}");
    assert!(
        log.contains("samples 32..64 are missing") && log.contains("--samples 32..64"),
        "{log}"
    );
    assert!(!folder.join("marbles.exr").exists());
    let (code, log) = script(folder, &["all"]);
    assert_eq!(code, Some(0), "{log}");
    // A picture that may be merged keeps more digits than one that may not.
    let range = format!("0..{SPP}");
    let outputs = ["--samples", &range, "-o", "whole.exr", "-o", "whole.png"];
    let whole = rtr(folder, &[&["marbles.pack", "--device", "cpu"], &outputs[..]].concat());
    assert_eq!(whole.0, Some(0), "{}", whole.1);
    assert_eq!(pixels(folder, "marbles.exr"), pixels(folder, "whole.exr"));
    let png = |name: &str| std::fs::read(folder.join(name)).expect("it is there");
    assert_eq!(png("marbles.png"), png("whole.png"));
}

/// Crops as well as samples: the frame of 72 x 40 pixels is cut into two columns and three rows.
#[test]
fn tiles_of_a_script_merge_to_one_run() {
    let (folder, log) = job("sh", &["--tile", "40x16"]);
    let folder = folder.path();
    assert!(log.contains("18 tasks of 2 batches (32 samples) of 40x16 pixels"), "{log}");
    let (code, log) = script(folder, &["task", "11"]);
    assert_eq!(code, Some(0), "{log}");
    let part = read_exr(&folder.join("parts/marbles.11.exr")).expect("a part").film;
    assert_eq!(part.region.to_string(), "40,32,32,8");
    assert_eq!(part.ranges, [SampleRange { start: 32, end: 64 }]);
    let (code, log) = script(folder, &["merge"]);
    assert!(code == Some(3) && log.contains("0..70 of crop 0,0,72,32"), "{log}");
    let (code, log) = script(folder, &["all"]);
    assert_eq!(code, Some(0), "{log}");
    assert!(log.contains("parts/marbles.11.exr complete already"), "{log}");
    let range = format!("0..{SPP}");
    let whole =
        rtr(folder, &["marbles.pack", "--device", "cpu", "--samples", &range, "-o", "whole.exr"]);
    assert_eq!(whole.0, Some(0), "{}", whole.1);
    assert_eq!(pixels(folder, "marbles.exr"), pixels(folder, "whole.exr"));
}

/// A part of another pack, of other samples, or that is no picture is rendered again.
#[test]
fn what_is_no_part_of_this_run_is_not_skipped() {
    let (folder, _) = job("sh", &[]);
    let folder = folder.path();
    let part = folder.join("parts/marbles.0.exr");
    std::fs::create_dir(folder.join("parts")).expect("it can be made");
    let foreign: [&[&str]; 2] =
        [&["--samples", "0..16"], &["--samples", "0..32", "--seed", "4711"]];
    for args in foreign {
        let fixed = ["marbles.pack", "--device", "cpu", "-o", "parts/marbles.0.exr"];
        let (code, log) = rtr(folder, &[&fixed, args].concat());
        assert_eq!(code, Some(0), "{log}");
        let (code, log) = script(folder, &["task", "0"]);
        assert!(code == Some(0) && !log.contains("complete already"), "{log}");
        assert!(script(folder, &["task", "0"]).1.contains("complete already"));
    }
    std::fs::write(&part, "no picture").expect("it can be written");
    let (code, log) = script(folder, &["task", "0"]);
    assert!(code == Some(0) && !log.contains("complete already"), "{log}");
    let (code, log) = rtr(folder, &["marbles.pack", "--skip-complete", "-o", "a.png"]);
    assert!(code == Some(2) && log.contains("--skip-complete needs an .exr output"), "{log}");
}

/// What others read: the shape of each file. Whether they accept it is tried by `.ci/farm`.
#[test]
fn every_format_says_what_to_render() {
    let (folder, log) = job("slurm", &[]);
    let read = |name: &str| std::fs::read_to_string(folder.path().join(name)).expect("it is there");
    let render = read("marbles.render.sbatch");
    assert!(
        render.contains("#SBATCH --array=0-2\n") && render.contains("--device cpu\n"),
        "{render}"
    );
    assert!(render.contains("end=$((first + 32))") && render.contains("-gt 70"), "{render}");
    assert!(read("marbles.merge.sbatch").contains("--samples 0..70"));
    assert!(log.contains("sbatch --dependency=afterok:$render marbles.merge.sbatch"), "{log}");
    let (folder, _) = job("openjd", &[]);
    let text =
        std::fs::read_to_string(folder.path().join("marbles.openjd.yaml")).expect("it is there");
    for part in [
        "type: CHUNK[INT]",
        "name: LastBatch, type: INT, minValue: 0, default: 4",
        "default: \"--device cpu\"",
    ] {
        assert!(text.contains(part), "{part}: {text}");
    }
    let (folder, _) = job("openjd", &["--tile", "40x16"]);
    let text =
        std::fs::read_to_string(folder.path().join("marbles.openjd.yaml")).expect("it is there");
    for part in
        ["name: Tile, type: INT, range: \"0-5\"", "--crop \"$x,$y,$w,$h\"", "--crop 0,0,72,40"]
    {
        assert!(text.contains(part), "{part}: {text}");
    }
}

/// Without `--chunk` a short measurement says how much a task gets.
#[test]
fn a_measurement_gives_the_size_of_tasks() {
    let (folder, _) = job("sh", &[]);
    let args = [
        "job",
        "marbles.pack",
        "--format",
        "sh",
        "--spp",
        "4096",
        "--measure",
        "300ms",
        "--task-time",
        "1h",
        "--device",
        "cpu",
    ];
    let (code, log) = rtr(folder.path(), &args);
    assert_eq!(code, Some(0), "{log}");
    assert!(
        log.contains("a batch of 16 samples takes about")
            && log.contains("1 tasks of 256 batches (4096 samples)"),
        "{log}"
    );
}
