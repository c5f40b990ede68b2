//! What `rtc` writes is none of what it reads, goes where it was sent, and is missed when it cannot be written.
#![cfg(unix)]

use std::os::unix::fs::{FileTypeExt as _, PermissionsExt as _, symlink};
use std::path::Path;
use std::process::{Command, Output, Stdio};

const SCENE: &str = "rts 1
import \"part.rts\" { clay }
asset tri = obj(\"t.obj\", unit: m, up: +y)
texture tile = image(\"tile.png\", space: srgb)
material tiled: diffuse { color = tile }
instance a { shape = tri }
instance b { shape = sphere(radius: 1m), material = tiled }
instance c { shape = sphere(radius: 1m), material = clay, at = (2, 0, 0)m }
light lamp: sphere { center = (0, 4, 3)m, radius = 25cm, color = linear(1), strength = 40 }
camera eye: perspective { from = (0, 1, 6)m, to = (0, 1, 0)m }
render main: path { samples = 1 }
";

/// A folder with a scene that reads a text, an OBJ, its MTL and an image.
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder for tests");
    for (name, text) in [
        ("scene.rts", SCENE),
        ("part.rts", "rts 1\npub material clay: diffuse { color = linear(0.5) }\n"),
        ("t.obj", "mtllib t.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\nf 1 2 3\n"),
        ("t.mtl", "newmtl m\nKd 1 1 1\n"),
    ] {
        std::fs::write(folder.path().join(name), text).expect("the folder is writable");
    }
    image::RgbImage::new(2, 2).save(folder.path().join("tile.png")).expect("it is writable");
    folder
}

fn rtc(folder: &Path, args: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_rtc"));
    command.current_dir(folder).env("RTC_CACHE_DIR", folder.join("cache")).args(args);
    command.output().expect("rtc starts")
}

fn error(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

#[test]
fn no_output_replaces_an_input_or_another_output() {
    let folder = folder();
    let at = |name: &str| folder.path().join(name);
    symlink("scene.rts", at("soft")).expect("links can be made");
    std::fs::hard_link(at("t.obj"), at("hard")).expect("links can be made");
    let before = ["scene.rts", "part.rts", "t.obj", "t.mtl", "tile.png"]
        .map(|name| (name, std::fs::read(at(name)).expect("it was written")));
    // Before anything was compiled, and when the pack is up to date already.
    for _ in 0..2 {
        for (args, says) in [
            (
                &["scene.rts", "-o", "scene.rts"][..],
                "scene.rts is the scene and cannot be the pack",
            ),
            (&["scene.rts", "-o", "soft"], "soft is the scene"),
            (&["scene.rts", "-o", "part.rts"], "part.rts is an input of the scene"),
            (&["scene.rts", "-o", "hard"], "it is the same file as"),
            (&["scene.rts", "--depfile", "t.mtl"], "t.mtl is an input"),
            (&["scene.rts", "--emit-wgsl", "tile.png"], "tile.png is an input"),
            (&["scene.rts", "-o", "x", "--depfile", "./x"], "cannot be the rule of --depfile"),
            (&["scene.rts", "-o", "-", "--emit-wgsl", "/dev/stdout"], "cannot be the kernel"),
        ] {
            let output = rtc(folder.path(), args);
            let text = error(&output);
            assert_eq!(output.status.code(), Some(2), "{args:?}: {text}");
            let line = text.lines().find(|line| line.starts_with("error: "));
            assert!(line.is_some_and(|line| line.contains(says)), "{args:?}: {text}");
            assert!(output.stdout.is_empty());
        }
        for (name, bytes) in &before {
            assert_eq!(&std::fs::read(at(name)).expect("it is there"), bytes, "{name}");
        }
        assert_eq!(rtc(folder.path(), &["scene.rts"]).status.code(), Some(0));
    }
}

#[test]
fn packs_go_to_streams_and_through_links() {
    let folder = folder();
    let at = |name: &str| folder.path().join(name);
    assert_eq!(rtc(folder.path(), &["scene.rts"]).status.code(), Some(0));
    let pack = std::fs::read(at("scene.pack")).expect("it was written");
    for name in ["-", "/dev/stdout"] {
        let output = rtc(folder.path(), &["scene.rts", "-o", name]);
        assert_eq!(output.status.code(), Some(0), "{}", error(&output));
        assert!(output.stdout == pack, "{name}");
    }
    assert_eq!(rtc(folder.path(), &["scene.rts", "-o", "/dev/null"]).status.code(), Some(0));
    let null = std::fs::metadata("/dev/null").expect("it is there").file_type();
    assert!(null.is_char_device());
    std::fs::write(at("real.pack"), "old").expect("the folder is writable");
    let mode = std::fs::Permissions::from_mode(0o604);
    std::fs::set_permissions(at("real.pack"), mode).expect("it is ours");
    symlink("real.pack", at("link.pack")).expect("links can be made");
    assert_eq!(rtc(folder.path(), &["scene.rts", "-o", "link.pack"]).status.code(), Some(0));
    assert!(std::fs::read(at("real.pack")).expect("it is there") == pack);
    let mode = std::fs::metadata(at("real.pack")).expect("it is there").permissions().mode();
    assert_eq!(mode & 0o777, 0o604);
    assert!(std::fs::symlink_metadata(at("link.pack")).expect("it is there").is_symlink());
}

#[test]
fn what_cannot_be_written_is_said_before_compiling() {
    let folder = folder();
    std::fs::create_dir(folder.path().join("dir")).expect("the folder is writable");
    for (args, says) in [
        (&["scene.rts", "-o", "none/a.pack"][..], "there is no folder none"),
        (&["scene.rts", "-o", "dir"], "dir is a folder"),
        (&["scene.rts", "--depfile", "none/d"], "there is no folder none"),
    ] {
        let output = rtc(folder.path(), args);
        let text = error(&output);
        assert_eq!(output.status.code(), Some(3), "{args:?}: {text}");
        assert!(text.contains(says) && text.lines().count() == 1, "{args:?}: {text}");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_standard_output_is_an_error_and_a_closed_one_is_not() {
    let folder = folder();
    assert_eq!(rtc(folder.path(), &["scene.rts"]).status.code(), Some(0));
    for args in [
        &["show", "--resolved", "scene.rts"][..],
        &["explain", "E0301"],
        &["inspect", "scene.pack"],
        &["cache"],
        &["scene.rts", "-o", "-"],
    ] {
        let run = |stdout: Stdio| {
            let mut command = Command::new(env!("CARGO_BIN_EXE_rtc"));
            command.current_dir(folder.path()).args(args).stdout(stdout).stderr(Stdio::piped());
            command.output().expect("rtc starts")
        };
        let full = std::fs::File::options().write(true).open("/dev/full").expect("Linux has it");
        let output = run(full.into());
        assert_eq!(output.status.code(), Some(3), "{args:?}");
        assert!(error(&output).contains("error: cannot write"), "{args:?}: {}", error(&output));
        let (reader, writer) = std::io::pipe().expect("pipes can be made");
        drop(reader);
        let output = run(writer.into());
        assert_eq!(output.status.code(), Some(0), "{args:?}: {}", error(&output));
        assert!(!error(&output).contains("error"), "{args:?}: {}", error(&output));
    }
}
