//! What `rtc` reads: only regular files, only inside of `--root`, only as much as `--memory` allows.
#![cfg(unix)]

use std::os::unix::fs::symlink;
use std::path::Path;
use std::process::{Command, Output};

const REST: &str = "
material plain: diffuse { color = linear(0.5) }
instance floor { shape = rectangle(size: (1, 1)m), material = plain }
light lamp: sphere { center = (0, 4, 3)m, radius = 25cm, color = linear(1), strength = 40 }
camera eye: perspective { from = (0, 1, 6)m, to = (0, 1, 0)m }
render main: path { samples = 1 }
";
const OBJ: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl m\nf 1/1 2/2 3/3\n";

fn write(folder: &Path, name: &str, bytes: impl AsRef<[u8]>) {
    let path = folder.join(name);
    std::fs::create_dir_all(path.parent().expect("a folder")).expect("writable");
    std::fs::write(path, bytes).expect("writable");
}

fn scene(folder: &Path, name: &str, uses: &str) {
    write(folder, name, format!("rts 1\n{uses}{REST}"));
}

fn texture(name: &str, space: &str) -> String {
    format!(
        "texture tile = image(\"{name}\", space: {space})\nmaterial tiled: diffuse {{ color = tile }}\n\
         instance b {{ shape = rectangle(size: (1, 1)m), material = tiled }}\n"
    )
}

fn rtc(folder: &Path, args: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_rtc"));
    let command = command.current_dir(folder).env("RTC_CACHE_DIR", folder.join("cache"));
    command.args(args).args(["--color", "never"]).output().expect("rtc starts")
}

/// It ends with `code` and says each of `words`.
fn check(output: &Output, code: i32, words: &[&str]) {
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(code), "{said}");
    for word in words {
        assert!(said.contains(word), "no `{word}` in\n{said}");
    }
}

#[test]
fn no_file_of_a_scene_lies_outside_of_the_root() {
    let folder = tempfile::tempdir().expect("temporary folder");
    let folder = folder.path();
    let png = {
        let mut png = std::io::Cursor::new(Vec::new());
        image::RgbImage::new(1, 1).write_to(&mut png, image::ImageFormat::Png).expect("in memory");
        png.into_inner()
    };
    for place in ["in", "out"] {
        write(folder, &format!("{place}/part.rts"), "rts 1\npub let one = 1\n");
        write(folder, &format!("{place}/plain.obj"), OBJ);
        write(folder, &format!("{place}/a.mtl"), "newmtl m\nmap_Kd a.png\n");
        write(folder, &format!("{place}/a.png"), &png);
        write(folder, &format!("{place}/buffer.bin"), [0; 36]);
    }
    write(folder, "in/far.obj", format!("mtllib ../out/a.mtl\n{OBJ}"));
    write(folder, "in/b.mtl", "newmtl m\nmap_Kd ../out/a.png\n");
    write(folder, "in/far_image.obj", format!("mtllib b.mtl\n{OBJ}"));
    let gltf = r#"{"asset": {"version": "2.0"}, "buffers": [{"byteLength": 36, "uri": "../out/buffer.bin"}]}"#;
    write(folder, "in/far.gltf", gltf);
    symlink("../out/a.png", folder.join("in/link.png")).expect("writable");
    symlink(folder.join("out"), folder.join("in/folder")).expect("writable");
    let absolute = folder.join("in/a.png").display().to_string();
    let mesh =
        |call: &str| format!("asset t = {call}\ninstance a {{ shape = t, material = plain }}\n");
    let obj = |name: &str| mesh(&format!("obj(\"{name}\", unit: m, up: +y)"));
    let import = |name: &str| format!("import \"{name}\" as part\n");
    let good = [
        import("part.rts"),
        obj("plain.obj"),
        texture("../in/a.png", "srgb"),
        texture(&absolute, "srgb"),
    ];
    for uses in good {
        scene(folder, "in/scene.rts", &uses);
        check(&rtc(folder, &["check", "in/scene.rts", "--root", "in"]), 0, &[]);
    }
    let bad = [
        (import("../out/part.rts"), "scene.rts:2:8"),
        (import("folder/part.rts"), "scene.rts:2:8"),
        (import("../out/none.rts"), "scene.rts:2:8"),
        (obj("../out/plain.obj"), "scene.rts:2:"),
        (obj("folder/plain.obj"), "scene.rts:2:"),
        (obj("far.obj"), "in/../out/a.mtl: it lies outside"),
        (obj("far_image.obj"), "in/../out/a.png: it lies outside"),
        (mesh("gltf(\"far.gltf\")"), "in/../out/buffer.bin: it lies outside"),
        (texture("link.png", "srgb"), "in/link.png: it lies outside"),
        (texture("../out/none.png", "srgb"), "in/../out/none.png: it lies outside"),
        (texture("/dev/null", "srgb"), "/dev/null: it lies outside"),
    ];
    for (uses, place) in bad {
        scene(folder, "in/scene.rts", &uses);
        let output = rtc(folder, &["check", "in/scene.rts", "--root", "in"]);
        check(&output, 1, &[place, "which --root forbids"]);
    }
    scene(folder, "out/scene.rts", "");
    check(&rtc(folder, &["check", "out/scene.rts", "--root", "in"]), 2, &["it lies outside"]);
    check(&rtc(folder, &["check", "out/scene.rts", "--root", "none"]), 2, &["--root none"]);
}

#[test]
fn what_is_up_to_date_elsewhere_is_refused_inside_of_a_root() {
    let folder = tempfile::tempdir().expect("temporary folder");
    let folder = folder.path();
    write(folder, "out/t.obj", OBJ.replace("usemtl m\n", ""));
    let uses = "asset t = obj(\"../out/t.obj\", unit: m, up: +y)\ninstance a { shape = t, material = plain }\n";
    scene(folder, "in/scene.rts", uses);
    let args = ["in/scene.rts", "-o", "a.pack"];
    check(&rtc(folder, &args), 0, &[]);
    check(&rtc(folder, &args), 0, &["up to date"]);
    check(&rtc(folder, &[&args[..], &["--root", "in"]].concat()), 1, &["it lies outside"]);
    check(&rtc(folder, &[&args[..], &["--root", "."]].concat()), 0, &["up to date"]);
}

#[test]
fn what_is_no_regular_file_is_refused_at_once() {
    let folder = tempfile::tempdir().expect("temporary folder");
    let folder = folder.path();
    let made = Command::new("mkfifo").arg(folder.join("pipe.png")).status().expect("mkfifo");
    assert!(made.success());
    std::fs::create_dir(folder.join("folder.png")).expect("writable");
    for name in ["pipe.png", "folder.png", "/dev/zero"] {
        scene(folder, "scene.rts", &texture(name, "srgb"));
        check(&rtc(folder, &["check", "scene.rts"]), 1, &["this is not a regular file"]);
    }
    if cfg!(target_os = "linux") {
        scene(folder, "scene.rts", &texture("/proc/self/maps", "srgb"));
        check(&rtc(folder, &["check", "scene.rts"]), 1, &["it holds more than its size says"]);
    }
    check(&rtc(folder, &["check", "pipe.png"]), 3, &["this is not a regular file"]);
}

/// The header of an EXR image, and nothing behind it.
fn exr_header(width: u32, height: u32) -> Vec<u8> {
    let mut out = b"\x76\x2f\x31\x01\x02\0\0\0".to_vec();
    let mut attribute = |name: &str, kind: &str, value: &[u8]| {
        out.extend([name.as_bytes(), b"\0", kind.as_bytes(), b"\0"].concat());
        out.extend(u32::try_from(value.len()).expect("short").to_le_bytes());
        out.extend(value);
    };
    let channel =
        |name: u8| [&[name, 0, 2, 0, 0, 0, 0, 0, 0, 0][..], &[1, 0, 0, 0, 1, 0, 0, 0]].concat();
    attribute(
        "channels",
        "chlist",
        &[b'B', b'G', b'R'].map(channel).concat().into_iter().chain([0]).collect::<Vec<_>>(),
    );
    attribute("compression", "compression", &[3]);
    let corners = [0, 0, width - 1, height - 1].map(u32::to_le_bytes).concat();
    attribute("dataWindow", "box2i", &corners);
    attribute("displayWindow", "box2i", &corners);
    attribute("lineOrder", "lineOrder", &[0]);
    attribute("pixelAspectRatio", "float", &1_f32.to_le_bytes());
    attribute("screenWindowCenter", "v2f", &[0; 8]);
    attribute("screenWindowWidth", "float", &1_f32.to_le_bytes());
    out.push(0);
    let n_blocks = height.div_ceil(16) as usize;
    let end = (out.len() + 8 * n_blocks) as u64;
    out.extend(end.to_le_bytes().repeat(n_blocks));
    out.extend([0; 64]);
    out
}

/// One line that names the file, exit 3; nobody is blamed but the memory.
fn check_refused(output: &Output, name: &str) {
    check(output, 3, &[&format!("error: {name}: it needs "), "allow more with --memory"]);
    assert_eq!(String::from_utf8_lossy(&output.stderr).lines().count(), 1, "{output:?}");
}

#[test]
fn memory_has_a_budget_that_files_are_held_to_before_it_is_taken() {
    let folder = tempfile::tempdir().expect("temporary folder");
    let folder = folder.path();
    image::RgbImage::new(600, 600).save(folder.join("a.png")).expect("writable");
    image::RgbImage::new(600, 600).save(folder.join("a.jpg")).expect("writable");
    let hdr = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 16384 +X 16384\n";
    write(folder, "a.hdr", [&hdr[..], &[0; 64]].concat());
    write(folder, "a.exr", exr_header(16_384, 16_384));
    write(folder, "faces.obj", format!("{OBJ}{}", "f 1 2 3\n".repeat(20_000)));
    write(
        folder,
        "names.obj",
        OBJ.to_owned() + &(0..20_000).map(|i| format!("o n{i}\n")).collect::<Vec<_>>().concat(),
    );
    let nodes =
        format!(r#"{{"asset": {{"version": "2.0"}}, "nodes": [{}{{}}]}}"#, "{},".repeat(20_000));
    write(folder, "nodes.gltf", nodes);
    let asset =
        |call: &str| format!("asset t = {call}\ninstance a {{ shape = t, material = plain }}\n");
    for (name, uses) in [
        ("a.png", texture("a.png", "srgb")),
        ("a.jpg", texture("a.jpg", "srgb")),
        ("a.hdr", texture("a.hdr", "linear")),
        ("a.exr", texture("a.exr", "linear")),
        ("faces.obj", asset("obj(\"faces.obj\", unit: m, up: +y)")),
        ("names.obj", asset("obj(\"names.obj\", unit: m, up: +y)")),
        ("nodes.gltf", asset("gltf(\"nodes.gltf\")")),
    ] {
        scene(folder, "scene.rts", &uses);
        let named = match name {
            "faces.obj" | "names.obj" => format!("{name}:"),
            name => name.to_owned(),
        };
        let output = rtc(folder, &["check", "scene.rts", "--memory", "2MB"]);
        check(
            &output,
            3,
            &[
                &format!("error: {named}"),
                "it needs ",
                "of 2.0 MB are left: allow more with --memory",
            ],
        );
        assert_eq!(String::from_utf8_lossy(&output.stderr).lines().count(), 1, "{output:?}");
    }
    // The default is what the system has, which a limit of the shell is a part of.
    for name in ["a.exr", "a.hdr"] {
        scene(folder, "scene.rts", &texture(name, "linear"));
        let mut shell = Command::new("sh");
        shell.args(["-c", "ulimit -v 4000000; exec \"$0\" check scene.rts"]);
        let output = shell.arg(env!("CARGO_BIN_EXE_rtc")).current_dir(folder).output();
        if cfg!(target_os = "linux") {
            check_refused(&output.expect("a shell"), name);
        }
    }
    scene(folder, "scene.rts", &texture("a.png", "srgb"));
    check(&rtc(folder, &["check", "scene.rts", "--memory", "20MB"]), 0, &[]);
    check(&rtc(folder, &["check", "scene.rts", "--memory", "20"]), 2, &["as in 8GB"]);
}
