//! A pack that is up to date is not made again; everything that could change it is noticed.

mod rtc_support;

use std::path::Path;
use std::process::Command;

const SCENE: &str = "rts 1
param size: length = 20cm in 1cm..1m
texture tile = image(\"tile.png\", space: srgb)
material clay: diffuse { color = tile }
instance ball { shape = sphere(radius: size), material = clay }
light lamp: sphere { center = (0, 3, 0)m, radius = 10cm, strength = 5 }
camera eye: perspective { from = (0, 1, 6)m, to = (0, 1, 0)m }
render main: path { samples = 1 }
";

fn rtc(folder: &Path, args: &[&str]) -> String {
    rtc_support::rtc(folder, "cache", "a.pack", args)
}

#[test]
fn nothing_is_done_when_nothing_changed_and_everything_else_is_noticed() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = |name: &str| folder.path().join(name);
    let write = |name: &str, bytes: &[u8]| std::fs::write(at(name), bytes).expect("writable");
    let image = |w| image::RgbImage::new(w, 2).save(at("tile.png")).expect("writable");
    write("scene.rts", SCENE.as_bytes());
    image(2);
    let idle = |args: &[&str]| rtc(folder.path(), args).contains("a.pack is up to date");
    assert!(!idle(&[]));
    let pack = std::fs::read(at("a.pack")).expect("it is there");
    let log = rtc(folder.path(), &["--depfile", "a.d"]);
    assert_eq!(log, "a.pack is up to date: nothing changed in 2 files\n");
    let rule = std::fs::read_to_string(at("a.d")).expect("the depfile is there");
    assert!(rule.starts_with("a.pack: \\\n  scene.rts \\\n  tile.png\n"), "{rule}");
    assert_eq!(std::fs::read(at("a.pack")).expect("it is there"), pack);

    // A build tool that goes by times is content after a touch.
    let time = |name: &str| {
        let data = std::fs::metadata(at(name)).expect("it is there");
        data.modified().expect("the file system knows times")
    };
    write("scene.rts", SCENE.as_bytes());
    assert!(idle(&["--depfile", "a.d"]) && time("a.pack") >= time("scene.rts"));

    // The same bytes at another time are no change; other bytes of the same length are one.
    write("scene.rts", SCENE.as_bytes());
    assert!(idle(&[]));
    write("scene.rts", SCENE.replace("strength = 5", "strength = 6").as_bytes());
    assert!(!idle(&[]) && idle(&[]));
    image(3);
    assert!(!idle(&[]) && idle(&[]));
    // Other options, and back: the pack is another one then.
    assert!(!idle(&["-D", "size=30cm"]) && idle(&["-D", "size=30cm"]));
    assert!(!idle(&[]) && !idle(&["--bvh", "fast"]) && !idle(&["--no-cache"]));
    // The pack is gone, or not what was written.
    std::fs::remove_file(at("a.pack")).expect("it was there");
    assert!(!idle(&[]) && idle(&[]));
    let mut bytes = std::fs::read(at("a.pack")).expect("it is there");
    let last = bytes.iter().rposition(|byte| *byte != 0).expect("no pack is empty");
    bytes[last] ^= 1;
    write("a.pack", &bytes);
    assert!(!idle(&[]) && idle(&[]));
}

#[test]
fn warnings_are_said_every_time_and_need_no_new_pack() {
    let folder = tempfile::tempdir().expect("a folder");
    // A triangle without area is left out, with a warning.
    let obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 2 0 0\nf 1 2 3\nf 1 2 4\n";
    let scene = SCENE
        .replace(
            "texture tile = image(\"tile.png\", space: srgb)",
            "asset t = obj(\"t.obj\", unit: m, up: +y)",
        )
        .replace("color = tile", "color = linear(1)")
        .replace("shape = sphere(radius: size)", "shape = t");
    std::fs::write(folder.path().join("scene.rts"), scene).expect("writable");
    std::fs::write(folder.path().join("t.obj"), obj).expect("writable");
    let warnings = |log: &str| log.split("a.pack").next().unwrap_or_default().to_owned();
    for format in ["human", "short", "json"] {
        let _ = std::fs::remove_file(folder.path().join("a.pack"));
        let [first, second] = [0, 1].map(|_| rtc(folder.path(), &["--error-format", format]));
        assert!(first.contains("W0520") && !first.contains("up to date"), "{first}");
        assert_eq!(warnings(&first), warnings(&second));
        assert!(format == "json" || second.contains("a.pack is up to date"), "{second}");
    }
}

#[test]
fn features_are_told_also_of_a_pack_that_is_up_to_date() {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("scene.rts"), SCENE).expect("writable");
    image::RgbImage::new(2, 2).save(folder.path().join("tile.png")).expect("writable");
    let told = || {
        let output = Command::new(env!("CARGO_BIN_EXE_rtc"))
            .current_dir(folder.path())
            .env("RTC_CACHE_DIR", folder.path().join("cache"))
            .args(["scene.rts", "-o", "a.pack", "--color", "never", "--explain-features"])
            .output()
            .expect("rtc starts");
        assert_eq!(output.status.code(), Some(0));
        [output.stdout, output.stderr].map(|bytes| String::from_utf8_lossy(&bytes).into_owned())
    };
    let ([first, _], [again, log]) = (told(), told());
    assert!(log.contains("a.pack is up to date"), "{log}");
    assert_eq!(first, again);
    // Name, place, reason; a section with its binding; both kernels.
    let row = |start: &str| {
        let found = first.lines().find(|line| line.trim_start().starts_with(start));
        found.unwrap_or_else(|| panic!("no `{start}` in {first}")).to_owned()
    };
    for (start, parts) in [
        ("sRGB textures", ["scene.rts:4", "1 images, the first of: `clay`"]),
        ("spheres", ["scene.rts:5", "`ball`"]),
        ("several lights", ["scene.rts:6", "it is the only one: `lamp`"]),
        ("lens", ["scene.rts:7", "its aperture is 0: `eye`"]),
        ("fog", [" - ", "nothing uses it"]),
        ("SPHERE", [" 64 ", " 6 "]),
        ("kernel:", ["% of the ", "words of SPIR-V, "]),
    ] {
        let line = row(start);
        assert!(parts.iter().all(|part| line.contains(part)), "{line}");
    }
    let kept = first.split("features left out").next().expect("there are two lists");
    assert!(kept.contains("sphere lights") && !kept.contains("fog"), "{first}");
}
