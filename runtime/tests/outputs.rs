//! What `rtr` writes is none of what it reads, goes where it was sent, and is never lost.
#![cfg(unix)]

mod common;

use std::os::unix::fs::symlink;
use std::path::Path;
use std::process::{Command, Output, Stdio};

/// A run of eight pixels.
fn command(folder: &Path, args: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_rtr"));
    command.current_dir(folder).args(args);
    match args[0] {
        "merge" => &mut command,
        "check" => command.args(["--size", "4x2", "--spp", "1"]),
        "bench" => command.args(["--size", "4x2", "--device", "cpu"]),
        _ => command.args(["--size", "4x2", "--spp", "1", "--device", "cpu"]),
    };
    command
}

fn rtr(folder: &Path, args: &[&str]) -> Output {
    command(folder, args).output().expect("rtr starts")
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

#[test]
fn no_output_replaces_an_input_or_another_output() {
    let folder = folder();
    let at = |name: &str| folder.path().join(name);
    let made = rtr(folder.path(), &["marbles.pack", "-o", "a.exr"]);
    assert_eq!(made.status.code(), Some(0), "{}", text(&made.stderr));
    std::fs::copy(at("marbles.pack"), at("pack.png")).expect("it can be copied");
    std::fs::hard_link(at("a.exr"), at("b.exr")).expect("links can be made");
    symlink("pack.png", at("c.exr")).expect("links can be made");
    let before = ["pack.png", "a.exr"].map(|name| (name, std::fs::read(at(name)).expect("there")));
    for (args, says) in [
        (&["pack.png", "-o", "pack.png"][..], "pack.png is the pack and cannot be the picture"),
        (&["pack.png", "-o", "c.exr"], "it is the same file as pack.png"),
        (&["pack.png"], "pack.png is the pack"),
        (&["marbles.pack", "-o", "d.exr", "-o", "./d.exr"], "cannot be the picture as well"),
        (&["marbles.pack", "-o", "-", "-o", "/dev/stdout"], "cannot be the picture as well"),
        (&["marbles.pack", "-o", "b.exr", "--reference", "a.exr"], "is the reference"),
        (&["marbles.pack", "-o", "x.png", "--plot", "x.png"], "cannot be the plot"),
        (&["merge", "a.exr", "-o", "b.exr"], "is a part and cannot be the merged picture"),
        (&["check", "pack.png", "--heat", "pack.png"], "cannot be the picture of --heat"),
        (&["bench", "pack.png", "pack.png", "--report", "pack.png"], "cannot be the report"),
    ] {
        let output = rtr(folder.path(), args);
        let error = text(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{args:?}: {error}");
        assert!(error.contains(says), "{args:?}: {error}");
        assert!(output.stdout.is_empty(), "{args:?}");
    }
    for (name, bytes) in before {
        assert!(std::fs::read(at(name)).expect("it is there") == bytes, "{name}");
    }
}

#[test]
fn pictures_go_to_streams_and_nothing_else_does() {
    let folder = folder();
    let run = |args: &[&str]| {
        let output = rtr(folder.path(), args);
        assert_eq!(output.status.code(), Some(0), "{args:?}: {}", text(&output.stderr));
        output.stdout
    };
    run(&["marbles.pack", "-o", "a.png", "-o", "a.exr"]);
    let png = std::fs::read(folder.path().join("a.png")).expect("it was written");
    assert!(run(&["marbles.pack", "-o", "-"]) == png);
    assert!(run(&["marbles.pack", "-o", "/dev/stdout", "--format", "png"]) == png);
    let exr = run(&["marbles.pack", "-o", "-", "--format", "exr", "-o", "b.png"]);
    std::fs::write(folder.path().join("piped.exr"), exr).expect("the folder is writable");
    let read = |name: &str| runtime::output::read_exr(&folder.path().join(name)).expect("an EXR");
    assert_eq!(read("piped.exr").film, read("a.exr").film);
    run(&["marbles.pack", "-o", "/dev/null"]);
    assert!(!std::fs::metadata("/dev/null").expect("it is there").is_file());
    run(&["merge", "a.exr", "-o", "-"]);
}

#[test]
fn the_name_that_a_pack_carries_replaces_nothing() {
    let folder = folder();
    let at = |name: &str| folder.path().join(name);
    let pack = common::pack_with_output("family_photo.png");
    std::fs::write(at("marbles.pack"), pack).expect("the folder is writable");
    std::fs::write(at("family_photo.png"), "dear").expect("the folder is writable");
    let output = rtr(folder.path(), &["marbles.pack"]);
    assert_eq!(text(&output.stdout), "wrote marbles.exr\nwrote marbles.png\n");
    assert!(text(&output.stderr).contains("--scene-output replaces it"));
    assert_eq!(std::fs::read(at("family_photo.png")).expect("it is there"), b"dear");
    let output = rtr(folder.path(), &["marbles.pack", "--scene-output"]);
    assert_eq!(text(&output.stdout), "wrote family_photo.exr\nwrote family_photo.png\n");
}

#[test]
fn what_cannot_be_written_is_said_before_the_first_sample() {
    let folder = folder();
    for (args, says) in [
        (&["marbles.pack", "-o", "none/a.png"][..], "there is no folder none"),
        (&["marbles.pack", "-o", "a.png", "--report", "none/a.json"], "there is no folder none"),
        (&["check", "marbles.pack", "--heat", "none/a.png"], "there is no folder none"),
    ] {
        let output = rtr(folder.path(), args);
        let error = text(&output.stderr);
        assert_eq!(output.status.code(), Some(3), "{args:?}: {error}");
        assert!(error.contains(says) && !error.contains("spp in"), "{args:?}: {error}");
    }
}

#[test]
fn a_picture_whose_folder_vanishes_is_saved_elsewhere() {
    let folder = folder();
    let at = |name: &str| folder.path().join(name);
    std::fs::create_dir(at("away")).expect("the folder is writable");
    let mut command = Command::new(env!("CARGO_BIN_EXE_rtr"));
    let args = ["marbles.pack", "-o", "away/a.png", "--time", "1s", "--spp", "100000"];
    command.current_dir(folder.path()).args(args);
    command.args(["--device", "cpu", "--checkpoint-every", "never"]);
    command.stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = command.spawn().expect("rtr starts");
    std::thread::sleep(std::time::Duration::from_millis(500));
    std::fs::remove_dir_all(at("away")).expect("it is ours");
    assert_eq!(child.wait().expect("it ends").code(), Some(3));
    let output = child.wait_with_output().expect("it has ended");
    assert!(
        text(&output.stderr).contains("it was saved as ./a.png instead"),
        "{}",
        text(&output.stderr)
    );
    assert!(at("a.png").is_file());
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_standard_output_is_an_error_and_a_closed_one_is_not() {
    let folder = folder();
    for args in [&["marbles.pack", "-o", "a.png"][..], &["marbles.pack", "-o", "-"]] {
        let run = |stdout: Stdio| {
            let mut command = command(folder.path(), args);
            command.stdout(stdout).stderr(Stdio::piped()).output().expect("rtr starts")
        };
        let full = std::fs::File::options().write(true).open("/dev/full").expect("Linux has it");
        let output = run(full.into());
        assert_eq!(output.status.code(), Some(3), "{args:?}: {}", text(&output.stderr));
        assert!(text(&output.stderr).contains("error: cannot write"), "{args:?}");
        let (reader, writer) = std::io::pipe().expect("pipes can be made");
        drop(reader);
        let output = run(writer.into());
        assert_eq!(output.status.code(), Some(0), "{args:?}: {}", text(&output.stderr));
        assert!(!text(&output.stderr).contains("error"), "{args:?}: {}", text(&output.stderr));
    }
}
