//! `rtc --depfile`: the rule names every file that was read, and `make` understands it.

mod rtc_support;

use std::collections::BTreeSet;
use std::path::Path;
use std::process::Command;

const OBJ: &str = "mtllib my $5 #1.mtl
v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl m\nf 1/1 2/2 3/3\n";

/// A scene that reads an import, an OBJ with an MTL and its image, and a texture, under names that
/// make and shells are afraid of.
fn scene(folder: &Path) {
    let write = |name: &str, text: &str| {
        std::fs::write(folder.join(name), text).expect("the folder is writable");
    };
    std::fs::create_dir(folder.join("my parts")).expect("the folder is writable");
    write(
        "scene.rts",
        "rts 1
import \"my parts/light.rts\" { glow }
asset tri = obj(\"my parts/t.obj\", unit: m, up: +y)
texture tile = image(\"tile #2.png\", space: srgb)
material tiled: diffuse { color = tile }
instance a { shape = tri }
instance lamp { shape = sphere(radius: 10cm), material = glow, at = (0, 3, 0)m }
instance b { shape = rectangle(size: (1, 1)m), material = tiled }
camera eye: perspective { from = (0, 1, 6)m, to = (0, 1, 0)m }
render main: path { samples = 1 }
",
    );
    write(
        "my parts/light.rts",
        "rts 1\npub material glow: emissive { color = linear(1), strength = 5 }\n",
    );
    write("my parts/t.obj", OBJ);
    write("my parts/my $5 #1.mtl", "newmtl m\nKd 1 1 1\nmap_Kd a b.png\n");
    for name in ["my parts/a b.png", "tile #2.png"] {
        image::RgbImage::new(2, 2).save(folder.join(name)).expect("the folder is writable");
    }
}

fn compile(folder: &Path) -> String {
    rtc_support::rtc(folder, "cache", "out #1.pack", &["--depfile", "out.d"]);
    std::fs::read_to_string(folder.join("out.d")).expect("the depfile is there")
}

/// The prerequisites of the first rule, read as make reads them.
fn prerequisites(text: &str) -> (String, Vec<String>) {
    let text = text.replace("\\\n", " ");
    let rule = text.lines().next().expect("a rule");
    let (mut names, mut name) = (Vec::new(), String::new());
    let mut chars = rule.chars().peekable();
    while let Some(c) = chars.next() {
        match (c, chars.peek()) {
            ('\\', Some(&next @ (' ' | '#' | ':'))) => {
                name.push(next);
                chars.next();
            }
            ('$', Some('$')) => {
                name.push('$');
                chars.next();
            }
            (' ', _) => names.extend((!name.is_empty()).then(|| std::mem::take(&mut name))),
            _ => name.push(c),
        }
    }
    names.push(name);
    let target = names.remove(0).strip_suffix(':').expect("a target").to_owned();
    (target, names)
}

#[test]
fn a_depfile_names_every_file_that_was_read() {
    let folder = tempfile::tempdir().expect("a folder");
    scene(folder.path());
    let text = compile(folder.path());
    let (target, names) = prerequisites(&text);
    assert_eq!(target, "out #1.pack", "{text}");
    let expected = [
        "scene.rts",
        "my parts/light.rts",
        "my parts/t.obj",
        "my parts/my $5 #1.mtl",
        "my parts/a b.png",
        "tile #2.png",
    ];
    let sorted = |names: Vec<String>| names.into_iter().collect::<BTreeSet<_>>();
    assert_eq!(sorted(names), sorted(expected.map(str::to_owned).into()), "{text}");
}

/// Without make on this machine it says so and passes.
#[test]
#[expect(clippy::print_stderr, reason = "a skipped test says so")]
fn make_runs_again_when_a_file_of_the_scene_changes_and_only_then() {
    let folder = tempfile::tempdir().expect("a folder");
    scene(folder.path());
    compile(folder.path());
    let rule = "include out.d\nout\\ \\#1.pack:\n\t@echo compiled\n\t@touch 'out #1.pack'\n";
    let file = folder.path().join("Makefile");
    std::fs::write(&file, format!("all: out\\ \\#1.pack\n{rule}")).expect("writable");
    let make = || {
        let made = Command::new("make").current_dir(folder.path()).arg("-s").output().ok()?;
        let log = String::from_utf8_lossy(&made.stderr).into_owned();
        assert!(made.status.success(), "{log}");
        Some(String::from_utf8_lossy(&made.stdout).contains("compiled"))
    };
    let Some(first) = make() else {
        eprintln!("skipped: no make");
        return;
    };
    assert!(!first, "the pack is newer than everything");
    let later = std::time::SystemTime::now() + std::time::Duration::from_secs(5);
    let earlier = later - std::time::Duration::from_mins(1);
    let touch = |name: &str, time| {
        let file = std::fs::File::options().append(true).open(folder.path().join(name));
        file.and_then(|file| file.set_modified(time)).expect("the file is there");
    };
    for name in ["my parts/my $5 #1.mtl", "my parts/a b.png", "tile #2.png", "scene.rts"] {
        touch(name, later);
        assert_eq!(make(), Some(true), "{name}");
        touch(name, earlier);
        assert_eq!(make(), Some(false), "{name}");
    }
    // A file that is gone, with the line that named it, is no error of make.
    std::fs::remove_file(folder.path().join("my parts/a b.png")).expect("it was there");
    assert_eq!(make(), Some(true));
}
