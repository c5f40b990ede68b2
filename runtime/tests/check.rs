//! `rtr check` as a program: what it prints, what it writes, how it exits.

mod common;

use std::path::Path;
use std::process::{Command, Output};

fn rtr(folder: &Path, args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_rtr"))
        .current_dir(folder)
        .args(args)
        .output()
        .expect("rtr starts")
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder for tests");
    let pack = common::pack_bytes(&common::features());
    std::fs::write(folder.path().join("marbles.pack"), pack).expect("it can be written");
    folder
}

#[test]
fn it_compares_and_writes_a_heat_map() {
    let folder = folder();
    let args = ["check", "marbles.pack", "--size", "36x20", "--spp", "4", "--heat", "heat.png"];
    let output = rtr(folder.path(), &args);
    let said = text(&output.stdout);
    assert_eq!(output.status.code(), Some(0), "{said}{}", text(&output.stderr));
    for part in
        ["36x20, 4 spp, in f32 and in f64", "f32: ", "f64: ", "wrote heat.png", "verdict: stable"]
    {
        assert!(said.contains(part), "{part}: {said}");
    }
    let heat = image::open(folder.path().join("heat.png")).expect("a picture");
    assert_eq!((heat.width(), heat.height()), (36, 20));
    let again = rtr(folder.path(), &args);
    assert_eq!(said, text(&again.stdout), "the same numbers on every run");
}

#[test]
fn it_replays_a_sample_ray_by_ray() {
    let folder = folder();
    let replay = |more: &[&str]| {
        let args = [&["check", "marbles.pack", "--pixel", "30,25", "--sample", "3"], more].concat();
        let output = rtr(folder.path(), &args);
        assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
        text(&output.stdout)
    };
    let (short, long) = (replay(&[]), replay(&["--trace"]));
    assert!(short.starts_with("pixel 30,25, sample 3, seed "), "{short}");
    assert!(short.contains("f32: radiance ") && short.contains("f64: radiance "), "{short}");
    assert!(!short.contains("ray 0") && long.contains("ray 0\n  f32 path from ("), "{long}");
    assert!(short.lines().all(|line| long.contains(line)), "{long}");
}

#[test]
fn wrong_arguments_are_usage() {
    let folder = folder();
    for args in [
        &["check"] as &[&str],
        &["check", "marbles.pack", "--pixel", "72,0"],
        &["check", "marbles.pack", "--pixel", "7"],
        &["check", "marbles.pack", "--trace"],
        &["check", "marbles.pack", "--spp", "0"],
    ] {
        let output = rtr(folder.path(), args);
        assert_eq!(output.status.code(), Some(2), "{args:?}");
        assert!(!output.stderr.is_empty(), "{args:?}");
    }
    let missing = rtr(folder.path(), &["check", "none.pack"]);
    assert_eq!(missing.status.code(), Some(3));
}
