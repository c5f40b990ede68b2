//! The program asked for its error: reports, plots, goals, references, and two packs compared.

mod common;

use std::path::Path;
use std::process::{Command, Output};

fn rtr(folder: &Path, args: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_rtr"));
    command.current_dir(folder).args(args).args(["--device", "cpu"]);
    command.output().expect("rtr starts")
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// A folder with `marbles.pack`.
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder for tests");
    let pack = common::pack_bytes(&common::features());
    std::fs::write(folder.path().join("marbles.pack"), pack).expect("it can be written");
    folder
}

/// Runs well, and gives what was said.
fn said(folder: &Path, args: &[&str]) -> String {
    let output = rtr(folder, args);
    assert_eq!(output.status.code(), Some(0), "{args:?} {}", text(&output.stderr));
    text(&output.stderr)
}

fn read(folder: &Path, name: &str) -> String {
    std::fs::read_to_string(folder.join(name)).expect("it is there")
}

#[test]
fn a_report_has_every_checkpoint_and_a_plot_is_drawn() {
    let folder = folder();
    let folder = folder.path();
    let files = ["--report", "a.json", "--report", "a.csv", "--plot", "a.svg", "--plot", "a.png"];
    let log = said(
        folder,
        &[&["marbles.pack", "-o", "a.exr", "--spp", "64", "--threads", "1"], &files[..]].concat(),
    );
    assert!(log.contains("64 spp  rel 0."), "{log}");
    assert!(log.contains("64 of 64 spp in "), "{log}");
    assert!(log.contains("times: load "), "{log}");
    let json: serde_json::Value = serde_json::from_str(&read(folder, "a.json")).expect("JSON");
    let spp: Vec<u64> = json["checkpoints"]
        .as_array()
        .expect("a list")
        .iter()
        .map(|row| row["spp"].as_u64().expect("a number"))
        .collect();
    assert_eq!(spp, [4, 8, 16, 32, 64]);
    assert_eq!((&json["replicates"], &json["stop"]), (&4.into(), &"complete".into()));
    assert_eq!(json["resolution"]["image"], serde_json::json!([72, 40]));
    // A release build asks git.
    let told = serde_json::json!(option_env!("RTR_COMMIT"));
    assert!(json["commit"] == told || !cfg!(debug_assertions), "{}", json["commit"]);
    assert_eq!(json["times"]["device"], serde_json::Value::Null, "the CPU has no timestamps");
    // The kernel of the pack: its sections with their bindings, its size against that of all features.
    let kernel = &json["kernel"];
    let sections = kernel["sections"].as_array().expect("a list");
    let spheres = sections.iter().find(|section| section["name"] == "SPHERE").expect("it has some");
    assert_eq!((&spheres["elements"], &spheres["binding"]), (&4.into(), &6.into()));
    let lines = |name: &str| kernel[name].as_u64().expect("a number");
    assert!(lines("full_wgsl_lines") > 2 * lines("wgsl_lines"), "{kernel}");
    assert_eq!(kernel["kept"], serde_json::json!([]), "this pack was not made by rtc");
    let last = &json["checkpoints"][4];
    assert_eq!(last["rays"], json["counters"]["rays"]);
    let number = |name: &str| last[name].as_f64().expect("a number");
    assert!(number("rel_lo") < number("rel") && number("rel") < number("rel_hi"));
    let fom = 1.0 / (number("rel").powi(2) * number("t_render_s"));
    assert!((number("fom") / fom - 1.0).abs() < 1e-9);
    let csv = read(folder, "a.csv");
    let rows: Vec<Vec<&str>> = csv.lines().map(|line| line.split(',').collect()).collect();
    assert_eq!((rows.len(), rows[0].len()), (6, 23));
    assert!(rows.iter().all(|row| row.len() == 23) && rows[5][2] == "64");
    assert!(read(folder, "a.svg").contains("64 spp</text>"));
    let png = std::fs::read(folder.join("a.png")).expect("it is there");
    assert!(image::load_from_memory(&png).is_ok_and(|image| image.width() == 1200));
}

#[test]
fn an_error_that_is_reached_ends_the_run_and_one_that_is_not_does_not() {
    let folder = folder();
    let folder = folder.path();
    let args = ["marbles.pack", "-o", "a.png", "--until-error", "0.2", "--crop", "0,32,72,8"];
    let log = said(folder, &[&args[..], &["--spp", "65536"]].concat());
    assert!(log.contains("error reached"), "{log}");
    let args = ["marbles.pack", "-o", "a.png", "--until-error", "p95:1e-9", "--spp", "66"];
    let log = said(folder, &args);
    // Rounded up to four equal parts.
    assert!(log.contains("68 of 68 spp in ") && !log.contains("error reached"), "{log}");
    let args = ["marbles.pack", "-o", "a.png", "--until-error", "1e-9", "--time", "1s"];
    let log = said(folder, &args);
    assert!(log.contains(", time limit: "), "{log}");
}

#[test]
fn a_reference_judges_and_must_show_the_same() {
    let folder = folder();
    let folder = folder.path();
    let report = ["--report", "a.json"];
    said(
        folder,
        &[&["marbles.pack", "-o", "ref.exr", "--spp", "256", "--seed", "9"], &report[..]].concat(),
    );
    let args = ["marbles.pack", "-o", "a.png", "--reference", "ref.exr"];
    let log = said(folder, &args);
    assert!(log.contains("against the reference: rmse ") && log.contains("): unbiased"), "{log}");
    let output = rtr(folder, &[&args[..], &["--size", "36x20"]].concat());
    assert_eq!(output.status.code(), Some(2));
    let log = text(&output.stderr);
    assert!(log.contains("error: the reference shows 72x40 pixels"), "{log}");
    let output = rtr(folder, &["marbles.pack", "-o", "a.png", "--reference", "none.exr"]);
    assert_eq!(output.status.code(), Some(3));
}

#[test]
fn crops_of_a_measured_run_merge_and_cannot_be_resumed() {
    let folder = folder();
    let folder = folder.path();
    let measured = ["--spp", "16", "--report", "a.csv"];
    let of = |name, crop: &[&str]| {
        said(folder, &[&["marbles.pack", "-o", name][..], crop, &measured].concat());
    };
    of("whole.exr", &[]);
    of("left.exr", &["--crop", "0,0,30,40"]);
    of("right.exr", &["--crop", "30,0,42,40"]);
    said(folder, &["marbles.pack", "-o", "other.exr", "--samples", "0..4", "--crop", "30,0,42,40"]);
    let merge = |parts: &[&str]| {
        let mut merge = Command::new(env!("CARGO_BIN_EXE_rtr"));
        merge.current_dir(folder).arg("merge").args(parts).args(["-o", "b.exr"]);
        let output = merge.output().expect("rtr starts");
        (output.status.code(), text(&output.stderr))
    };
    let (code, log) = merge(&["right.exr", "left.exr"]);
    assert_eq!(code, Some(0), "{log}");
    let read = |name: &str| {
        let film = runtime::output::read_exr(&folder.join(name)).expect("a picture").film;
        (film.means(), film.variance, film.counts, film.ranges)
    };
    assert!(read("b.exr") == read("whole.exr"));
    assert!(!read("b.exr").1.is_empty());
    let (code, log) = merge(&["left.exr", "other.exr"]);
    assert_eq!(code, Some(3));
    assert!(log.contains("the mean of the replicates"), "{log}");
    for other in [&["--resume"][..], &["--samples", "0..4"], &["--watch"]] {
        let output = rtr(folder, &[&["marbles.pack", "--report", "a.csv"], other].concat());
        assert_eq!(output.status.code(), Some(2), "{other:?}");
    }
    let output = rtr(folder, &["marbles.pack", "--report", "a.txt"]);
    assert_eq!(output.status.code(), Some(3));
    assert!(text(&output.stderr).contains("a.txt: the name must end in .json or .csv"));
}

#[test]
fn the_same_seed_stops_at_the_same_sample_on_any_number_of_threads() {
    let folder = folder();
    let folder = folder.path();
    let run = |name: &str, threads: &str, more: &[&str]| {
        let args = ["marbles.pack", "--crop", "0,24,72,16", "--until-error", "0.01", "-o", name];
        let log = said(folder, &[&args[..], &["--threads", threads], more].concat());
        assert!(log.contains("error reached"), "{log}");
        (log, runtime::output::read_exr(&folder.join(name)).expect("a picture"))
    };
    let same = |a: &runtime::Film, b: &runtime::Film| {
        assert_eq!((&a.ranges, &a.counts), (&b.ranges, &b.counts));
        assert!(a.sums == b.sums && a.variance == b.variance);
    };
    let [(_, one), (_, two)] = [run("a.exr", "1", &[]), run("b.exr", "2", &[])];
    assert!(!one.meta.adaptive && one.film.is_even());
    same(&one.film, &two.film);
    let [(log, one), (_, two)] =
        [run("c.exr", "1", &["--adaptive"]), run("d.exr", "2", &["--adaptive"])];
    same(&one.film, &two.film);
    assert!(one.meta.adaptive && !one.film.is_even(), "{log}");
    assert!(log.contains("adaptive: from here on a block of 8x8 pixels gets "), "{log}");
    assert!(log.contains("--adaptive gave pixels "), "{log}");
    let output = rtr(folder, &["marbles.pack", "-o", "e.exr", "--adaptive"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(text(&output.stderr).contains("--until-error"), "{}", text(&output.stderr));
}

#[test]
fn what_clamping_took_away_is_told() {
    let folder = folder();
    let folder = folder.path();
    let args = ["marbles.pack", "-o", "a.exr", "--spp", "16", "--report", "a.json"];
    let log = said(folder, &[&args[..], &["--clamp-indirect", "0.01"]].concat());
    assert!(log.contains("--clamp-indirect 0.01 removed ") && log.contains("is biased"), "{log}");
    let json: serde_json::Value = serde_json::from_str(&read(folder, "a.json")).expect("JSON");
    let removed = json["clamp_indirect"]["removed"].as_f64().expect("a number");
    assert!(removed > 0.0 && removed < 1.0, "{removed}");
    let picture = runtime::output::read_exr(&folder.join("a.exr")).expect("a picture");
    assert_eq!(picture.meta.clamp_indirect, Some(0.01));
    assert!((picture.film.removed() - removed).abs() < 1e-6);
    let log = said(folder, &args);
    assert!(!log.contains("clamp"), "{log}");
    let json: serde_json::Value = serde_json::from_str(&read(folder, "a.json")).expect("JSON");
    assert_eq!(json["clamp_indirect"], serde_json::Value::Null);
    for value in ["0", "-1", "inf", "nan", "much"] {
        let value = format!("--clamp-indirect={value}");
        let output = rtr(folder, &["marbles.pack", "-o", "b.exr", &value]);
        assert_eq!(output.status.code(), Some(2), "{value}");
        assert!(text(&output.stderr).contains("a number above 0, such as 10"), "{value}");
    }
}

#[test]
fn two_packs_are_compared_in_equal_time() {
    let folder = folder();
    let folder = folder.path();
    std::fs::copy(folder.join("marbles.pack"), folder.join("same.pack")).expect("writable");
    let times = [
        "--time",
        "200ms",
        "--runs",
        "4",
        "--size",
        "36x20",
        "--threads",
        "1",
        "--report",
        "b.json",
    ];
    let output = rtr(folder, &[&["bench", "marbles.pack", "same.pack"], &times[..]].concat());
    let log = text(&output.stdout);
    assert_eq!(output.status.code(), Some(0), "{log} {}", text(&output.stderr));
    assert!(log.contains("median of 4 runs") && log.contains("times the fom"), "{log}");
    let json: serde_json::Value = serde_json::from_str(&read(folder, "b.json")).expect("JSON");
    assert_eq!(json["runs"][1].as_array().map(Vec::len), Some(4));
    // The pictures are of the same seeds. With one thread no round overtakes another, so that the
    // first point is always that of the first round.
    let first = |side: usize| json["runs"][side][0]["checkpoints"][0]["rmse"].as_f64();
    assert!(first(0).is_some() && first(0) == first(1));
}
