//! The program itself: files, exit codes, messages.

mod common;

use std::path::Path;
use std::process::{Command, Output};

/// Runs `rtr` in `folder`, on the CPU unless the arguments say otherwise.
fn rtr(folder: &Path, args: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_rtr"));
    command.current_dir(folder).args(args);
    if args.first() != Some(&"merge") && !args.contains(&"--device") {
        command.args(["--device", "cpu"]);
    }
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

fn files(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).expect("the folder");
    let mut names: Vec<String> = entries
        .map(|entry| text(entry.expect("an entry").file_name().as_encoded_bytes()))
        .collect();
    names.sort();
    names
}

#[test]
fn without_flags_it_does_the_whole_job() {
    let folder = folder();
    let output = rtr(folder.path(), &["marbles.pack"]);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    assert_eq!(text(&output.stdout), "wrote marbles.exr\nwrote marbles.png\n");
    let log = text(&output.stderr);
    assert!(
        log.contains("marbles.pack: 72x40, samples 0..32; triangles: 2, spheres: 4, lights: 1"),
        "{log}"
    );
    assert!(log.contains("device: CPU kernel (f32, "), "{log}");
    assert!(log.contains("32 of 32 spp in "), "{log}");
    assert_eq!(files(folder.path()), ["marbles.exr", "marbles.pack", "marbles.png"]);
}

#[test]
fn parts_made_by_two_runs_merge_to_one_picture() {
    let folder = folder();
    let run = |args: &[&str]| {
        let output = rtr(folder.path(), args);
        assert_eq!(output.status.code(), Some(0), "{args:?} {}", text(&output.stderr));
        text(&output.stderr)
    };
    run(&["marbles.pack", "--samples", "0..16", "-o", "a.exr", "--quiet"]);
    run(&["marbles.pack", "--samples", "16..32", "-o", "b.exr", "--no-mmap"]);
    let log = run(&["marbles.pack", "-o", "whole.png", "-o", "whole.exr", "--quiet"]);
    assert_eq!(log, "");
    run(&["merge", "b.exr", "a.exr", "-o", "merged.png", "-o", "merged.exr"]);
    let read = |name: &str| std::fs::read(folder.path().join(name)).expect("it is there");
    assert_eq!(read("merged.png"), read("whole.png"));
    let output = rtr(folder.path(), &["merge", "a.exr", "a.exr", "-o", "c.exr"]);
    assert_eq!(output.status.code(), Some(3));
    let log = text(&output.stderr);
    assert!(
        log.ends_with("error: part 2: samples 0..16 overlap 0..16 of the parts before it\n"),
        "{log}"
    );
}

#[test]
fn layers_go_through_files_and_merging() {
    let folder = folder();
    let run = |args: &[&str]| {
        let output = rtr(folder.path(), args);
        assert_eq!(output.status.code(), Some(0), "{args:?} {}", text(&output.stderr));
        text(&output.stderr)
    };
    let layers = ["--layers", "albedo,normal,depth,crypto,alpha", "--layer-names", "plain"];
    let with = |args: &[&'static str]| [&["marbles.pack"], args, &layers].concat();
    let log = run(&with(&["-o", "whole.exr", "-o", "whole.png", "--transparent"]));
    assert!(log.contains("layers: albedo,normal,depth,crypto,alpha (CPU kernel"), "{log}");
    run(&with(&["-o", "a.exr", "--transparent", "--samples", "0..16"]));
    run(&with(&["-o", "b.exr", "--transparent", "--samples", "16..32"]));
    run(&["merge", "a.exr", "b.exr", "-o", "merged.png"]);
    let read = |name: &str| std::fs::read(folder.path().join(name)).expect("it is there");
    assert_eq!(read("merged.png"), read("whole.png"));
    let picture = runtime::output::read_exr(&folder.path().join("whole.exr")).expect("an EXR");
    let layers = picture.layers.expect("it has layers");
    assert_eq!((layers.samples, layers.nearest.len()), (32, 72 * 40));
}

#[test]
fn layers_that_cannot_be_are_refused_in_a_line() {
    let folder = folder();
    for (args, expected) in [
        (["--layers", "depht", "-o", "a.exr"], "a similar value exists: 'depth'"),
        (["--layers", "depht", "-o", "a.exr"], "[possible values: albedo, normal, depth, "),
        (
            ["--layers", "variance", "-o", "a.exr"],
            "error: the layer `variance` is there only where",
        ),
        (["--layers", "depth", "-o", "a.png"], "error: a PNG has no layer `depth`: write an EXR"),
    ] {
        let output = rtr(folder.path(), &[&["marbles.pack"], args.as_slice()].concat());
        assert_eq!(output.status.code(), Some(2), "{args:?}");
        let log = text(&output.stderr);
        assert!(log.contains(expected), "{log}");
    }
    assert_eq!(files(folder.path()), ["marbles.pack"]);
}

#[test]
fn what_is_wrong_is_said_in_one_line_with_an_exit_code() {
    let folder = folder();
    std::fs::write(folder.path().join("scene.rts"), "rts 1\n").expect("it can be written");
    std::fs::write(folder.path().join("source.pack"), "rts 1\n").expect("it can be written");
    std::fs::write(folder.path().join("noise.pack"), [7; 4096]).expect("it can be written");
    let mut cut = common::pack_bytes(&common::features());
    cut.truncate(9000);
    std::fs::write(folder.path().join("cut.pack"), cut).expect("it can be written");
    for (args, code, message) in [
        (
            &["scene.rts"][..],
            3,
            "scene.rts is a scene source, compile it first: rtc scene.rts -o scene.pack",
        ),
        (&["source.pack"], 3, "is this a scene source? compile it first"),
        (&["noise.pack"], 3, "not a render pack"),
        (&["cut.pack"], 3, "truncated"),
        (&["none.pack"], 3, "none.pack"),
        (&["marbles.pack", "-o", "a.tiff"], 3, "a.tiff: the name must end in .exr or .png"),
        (&["marbles.pack", "-o", "no/a.png"], 3, "cannot create no/a.png: there is no folder no"),
        (&["marbles.pack", "--crop", "70,0,9,9"], 2, "crop 70,0,9,9 is empty or leaves the image"),
        (&["marbles.pack", "--size", "99999x1"], 2, "an image of 99999x1 pixels"),
        (&["marbles.pack", "--size", "abc"], 2, "write it as 640x360"),
        (&["marbles.pack", "--spp", "0"], 2, "--spp"),
        (&["marbles.pack", "--spp", "4", "--samples", "0..4"], 2, "cannot be used with"),
        (&["marbles.pack", "--tme", "4"], 2, "--time"),
        (&[], 2, "SCENE.pack"),
        (&["marbles.pack", "--device", "no such thing"], 3, "error: "),
        (&["merge", "marbles.pack", "-o", "a.exr"], 3, "cannot read marbles.pack"),
    ] {
        let output = rtr(folder.path(), args);
        let log = text(&output.stderr);
        assert_eq!(output.status.code(), Some(code), "{args:?} {log}");
        assert!(log.contains(message), "{args:?} {log}");
        assert!(!log.contains("panicked"), "{args:?} {log}");
    }
}

#[test]
fn help_and_devices_are_printed() {
    let folder = folder();
    let help = rtr(folder.path(), &["--help"]);
    assert_eq!(help.status.code(), Some(0));
    let help = text(&help.stdout);
    for word in
        ["Examples:", "Exit codes:", "--time", "rtr merge a.exr b.exr", "--crop", "--resume"]
    {
        assert!(help.contains(word), "{word}");
    }
    let devices = rtr(folder.path(), &["--list-devices"]);
    assert_eq!(devices.status.code(), Some(0));
    assert!(text(&devices.stdout).starts_with("cpu: CPU kernel ("));
}

#[test]
fn a_time_limit_writes_what_there_is() {
    let folder = folder();
    let args = ["marbles.pack", "--spp", "1000000", "--time", "500ms", "-o", "a.exr"];
    let output = rtr(folder.path(), &args);
    let log = text(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{log}");
    assert!(log.contains(" of 1000000 spp in ") && log.contains(", time limit: "), "{log}");
    assert!(folder.path().join("a.exr").is_file());
}

#[cfg(unix)]
#[test]
fn an_interrupt_writes_what_is_complete() {
    let folder = folder();
    let mut child = Command::new(env!("CARGO_BIN_EXE_rtr"))
        .current_dir(folder.path())
        .args(["marbles.pack", "--spp", "1000000", "--device", "cpu"])
        .stderr(std::process::Stdio::piped())
        .spawn()
        .expect("rtr starts");
    // It renders as soon as it names the device.
    let stderr = child.stderr.take().expect("piped");
    let mut lines = std::io::BufRead::lines(std::io::BufReader::new(stderr));
    assert!(lines.any(|line| line.expect("text").starts_with("device: ")));
    std::thread::sleep(std::time::Duration::from_millis(500));
    let pid = child.id().to_string();
    let kill = Command::new("kill").args(["-INT", &pid]).status().expect("kill starts");
    assert!(kill.success());
    let rest: Vec<String> = lines.map(|line| line.expect("text")).collect();
    let log = rest.join("\n");
    assert_eq!(child.wait().expect("it ends").code(), Some(130), "{log}");
    assert!(log.contains("interrupted: writing what is complete"), "{log}");
    let expected = ["marbles.exr", "marbles.exr.checkpoint", "marbles.pack", "marbles.png"];
    assert_eq!(files(folder.path()), expected);
}

#[test]
fn a_pack_may_ask_for_a_plain_name_in_the_working_folder() {
    let folder = folder();
    for (output, expected) in [
        ("pic.png", "wrote pic.exr\nwrote pic.png\n"),
        ("../x.png", "wrote marbles.exr\nwrote marbles.png\n"),
    ] {
        let pack = common::pack_with_output(output);
        std::fs::write(folder.path().join("marbles.pack"), pack).expect("it can be written");
        let output = rtr(folder.path(), &["marbles.pack", "--spp", "1"]);
        assert_eq!(text(&output.stdout), expected, "{}", text(&output.stderr));
    }
}

#[test]
#[cfg(feature = "gpu")]
fn kernels_are_compared_also_without_a_device() {
    let folder = folder();
    let args = ["--ablate", "marbles.pack", "--size", "8x6", "--spp", "2", "--report", "a.json"];
    let output = rtr(folder.path(), &args);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let table = text(&output.stdout);
    for line in ["kernel ", "specialised ", "full ", "fog ", "CPU kernel, which has all features: "]
    {
        assert!(table.lines().any(|found| found.starts_with(line)), "{line}: {table}");
    }
    assert!(table.contains("no adapter: only texts were compared"), "{table}");
    assert_eq!(files(folder.path()), ["a.json", "marbles.pack"]);
    let report = std::fs::read_to_string(folder.path().join("a.json")).expect("it was written");
    let report: serde_json::Value = serde_json::from_str(&report).expect("it is JSON");
    let rows = report["rows"].as_array().expect("a list");
    assert!(rows.len() > 20, "{}", rows.len());
    let lines = |i: usize| rows[i]["wgsl_lines"].as_u64().expect("a number");
    let words = |i: usize| rows[i]["spirv_words"].as_u64();
    assert_eq!((&rows[0]["kernel"], &rows[1]["kernel"]), (&"specialised".into(), &"full".into()));
    assert!(lines(1) > 2 * lines(0) && words(1) > words(0), "{report}");
    assert!(rows.iter().all(|row| row["measured"].is_null()), "{report}");
    assert!(report["cpu_ms"].as_f64().is_some_and(|ms| ms > 0.0), "{report}");
    let fewer =
        rtr(folder.path(), &["--ablate=full", "marbles.pack", "--size", "8x6", "--spp", "1"]);
    assert!(!text(&fewer.stdout).contains("fog"), "{}", text(&fewer.stdout));
}

#[test]
#[cfg(feature = "gpu")]
fn kernels_are_not_compared_where_that_makes_no_sense() {
    let folder = folder();
    let code = |args: &[&str]| {
        let output = rtr(folder.path(), args);
        (output.status.code(), text(&output.stderr))
    };
    for args in [
        &["--ablate=some", "marbles.pack"][..],
        &["--ablate", "marbles.pack", "--time", "3s"],
        &["--ablate", "marbles.pack", "-o", "a.png"],
        &["--ablate", "marbles.pack", "--report", "a.csv"],
    ] {
        let (code, log) = code(args);
        assert_eq!(code, Some(2), "{args:?}: {log}");
        assert!(log.starts_with("error: "), "{log}");
    }
    let (exit, log) = code(&["--ablate", "marbles.pack", "--device", "no such thing"]);
    assert_eq!(exit, Some(3), "{log}");
    assert!(log.contains("no adapter named `no such thing`"), "{log}");
    let (exit, log) = code(&["--ablate", "none.pack"]);
    assert_eq!(exit, Some(3), "{log}");
    // A kernel that is not ours cannot be taken apart.
    let kernel =
        shaders::link(&common::features()).expect("it links").text + "\nconst MINE: u32 = 1u;\n";
    std::fs::write(folder.path().join("other.pack"), common::pack_with_kernel(&kernel))
        .expect("it can be written");
    let (exit, log) = code(&["--ablate", "other.pack"]);
    assert_eq!(exit, Some(3), "{log}");
    assert!(log.contains("is not from this rtr: compile the scene again"), "{log}");
}
