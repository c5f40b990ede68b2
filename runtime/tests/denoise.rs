//! `--denoise` with a library that is made here and foretells what it gives, and with none, or a wrong one.

#![cfg(feature = "denoise")]

mod common;

use exr::prelude::{AttributeValue, FlatSamples, ReadChannels as _, ReadLayers as _};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::OnceLock;

/// A folder with `marbles.pack`.
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder for tests");
    let pack = common::pack_bytes(&common::features());
    std::fs::write(folder.path().join("marbles.pack"), pack).expect("it can be written");
    folder
}

/// Runs `rtr` in `folder` without a denoiser of the machine's, with `FAKE_OIDN` in the environment.
fn rtr_with(folder: &Path, args: &[&str], mode: &str) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_rtr"));
    command.current_dir(folder).args(args).env("FAKE_OIDN", mode);
    command.env("PATH", "").env("HOME", folder).env_remove("OIDN_DIR");
    if args.first() != Some(&"merge") {
        command.args(["--device", "cpu", "--spp", "4"]);
    }
    command.output().expect("rtr starts")
}

fn rtr(folder: &Path, args: &[&str]) -> String {
    let output = rtr_with(folder, args, "");
    assert_eq!(output.status.code(), Some(0), "{args:?} {}", text(&output.stderr));
    text(&output.stderr)
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// The errors of a run that fails for the world's sake.
fn errors(output: &Output) -> Vec<String> {
    assert_eq!(output.status.code(), Some(3), "{}", text(&output.stderr));
    let log = text(&output.stderr);
    log.lines().filter(|line| line.starts_with("error: ")).map(str::to_owned).collect()
}

/// The library of `oidn/fake.rs`, which is compiled once.
fn fake() -> &'static str {
    static LIBRARY: OnceLock<(tempfile::TempDir, PathBuf)> = OnceLock::new();
    let (_, library) = LIBRARY.get_or_init(|| {
        let folder = tempfile::tempdir().expect("a folder for tests");
        let library = folder.path().join("fake_oidn.so");
        let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/oidn/fake.rs");
        let rustc = std::env::var_os("RUSTC").unwrap_or("rustc".into());
        let mut command = Command::new(rustc);
        command.args(["--edition", "2024", "--crate-type", "cdylib", "-o"]).arg(&library);
        let status = command.arg(source).status().expect("where cargo is there is rustc");
        assert!(status.success());
        (folder, library)
    });
    library.to_str().expect("a plain name")
}

type Channels = BTreeMap<String, Vec<f32>>;

/// Channels, and the text of the attribute `denoiser`.
fn read(path: &Path) -> (Channels, Option<String>) {
    let image = exr::prelude::read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .first_valid_layer()
        .all_attributes()
        .from_file(path)
        .expect("an EXR");
    let list = image.layer_data.channel_data.list.iter();
    let channels = list.filter_map(|channel| match &channel.sample_data {
        FlatSamples::F32(values) => Some((channel.name.to_string(), values.clone())),
        _ => None,
    });
    let attributes = image.layer_data.attributes.other;
    let denoiser = attributes.into_iter().find(|(name, _)| name.eq("denoiser"));
    let denoiser = denoiser.map(|(_, value)| match value {
        AttributeValue::Text(text) => text.to_string(),
        other => panic!("{other:?}"),
    });
    (channels.collect(), denoiser)
}

/// That the picture is what the library makes of its layers, in the plain style.
fn assert_denoised(channels: &Channels, sky: bool) {
    for (c, [albedo, normal]) in ["R", "G", "B"].into_iter().zip([
        ["albedo.R", "N.X"],
        ["albedo.G", "N.Y"],
        ["albedo.B", "N.Z"],
    ]) {
        let noisy = &channels[&format!("noisy.{c}")];
        let mut seen = 0;
        for (i, denoised) in channels[c].iter().enumerate() {
            let empty = !sky && channels["A"][i] == 0.0;
            let guides = 0.5 * (channels[albedo][i] + channels[normal][i]);
            let expected = if empty { 0.0 } else { noisy[i] + guides };
            assert!((denoised - expected).abs() <= 1e-5 * (1.0 + expected.abs()), "{c} of {i}");
            seen += u32::from(guides != 0.0);
        }
        assert!(seen > 100, "{seen} pixels have guides");
    }
}

#[test]
fn the_denoised_picture_is_shown_and_the_noisy_one_kept() {
    let folder = folder();
    let at = |name: &str| folder.path().join(name);
    rtr(folder.path(), &["marbles.pack", "-o", "plain.exr", "-o", "plain.png"]);
    let log = rtr(
        folder.path(),
        &[
            "marbles.pack",
            "--denoise",
            "--oidn",
            fake(),
            "--threads",
            "2",
            "--layer-names",
            "plain",
            "-o",
            "a.exr",
            "-o",
            "a.png",
        ],
    );
    assert!(log.contains("denoised by Open Image Denoise 2.99.7 in "), "{log}");
    assert!(log.contains("with albedo and normals"), "{log}");
    let (channels, denoiser) = read(&at("a.exr"));
    assert_eq!(denoiser.as_deref(), Some("Open Image Denoise 2.99.7"));
    assert_denoised(&channels, true);
    let (plain, none) = read(&at("plain.exr"));
    assert_eq!(none, None);
    for c in ["R", "G", "B"] {
        assert!(plain[c] == channels[&format!("noisy.{c}")], "{c}: the noisy picture is another");
    }
    let png = |name: &str| std::fs::read(at(name)).expect("it was written");
    assert!(png("a.png") != png("plain.png"));
    // Blender's names are the usual ones.
    rtr(folder.path(), &["marbles.pack", "--denoise", "--oidn", fake(), "-o", "b.exr"]);
    let (blender, _) = read(&at("b.exr"));
    for (own, other) in [
        ("ViewLayer.Combined.G", "G"),
        ("ViewLayer.Noisy Image.G", "noisy.G"),
        ("ViewLayer.Denoising Albedo.G", "albedo.G"),
    ] {
        assert!(blender[own] == channels[other], "{own}");
    }
}

#[test]
fn merging_and_resuming_use_noisy_values_only() {
    let folder = folder();
    let at = |name: &str| folder.path().join(name);
    let denoise = ["--denoise", "--oidn", fake(), "--layer-names", "plain"];
    let run = |own: &[&str], last: &[&str]| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_rtr"));
        command.current_dir(folder.path()).args(own).args(denoise).args(last);
        let output = command.output().expect("rtr starts");
        assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    };
    let cpu = ["--device", "cpu"];
    run(&["marbles.pack", "--spp", "32", "-o", "whole.exr"], &cpu);
    run(&["marbles.pack", "--samples", "0..16", "-o", "a.exr"], &cpu);
    run(&["marbles.pack", "--samples", "16..32", "-o", "b.exr"], &cpu);
    rtr(folder.path(), &["merge", "b.exr", "a.exr", "-o", "noisy.exr"]);
    let mut merge = vec!["merge", "b.exr", "a.exr", "-o", "merged.exr"];
    merge.extend(&denoise[..3]);
    let log = rtr(folder.path(), &merge);
    assert!(log.contains("with albedo and normals"), "{log}");
    let [whole, merged, noisy] =
        ["whole.exr", "merged.exr", "noisy.exr"].map(|name| read(&at(name)));
    assert_denoised(&merged.0, true);
    for c in ["R", "G", "B"] {
        let own = format!("noisy.{c}");
        assert!(whole.0[&own] == merged.0[&own], "{own}");
        assert!(whole.0[&own] == noisy.0[c] && whole.0[c] == merged.0[c], "{c}");
    }
    assert_eq!((noisy.1, noisy.0.get("noisy.R")), (None, None));
}

#[test]
fn crops_and_transparent_pictures_are_denoised() {
    let folder = folder();
    let common = ["marbles.pack", "--denoise", "--oidn", fake(), "--layer-names", "plain"];
    let run = |more: &[&str], name: &str| {
        rtr(folder.path(), &[&common, more, &["-o", name]].concat());
        read(&folder.path().join(name)).0
    };
    let crop = run(&["--crop", "3,12,61,25"], "crop.exr");
    assert_eq!(crop["noisy.R"].len(), 61 * 25);
    assert_denoised(&crop, true);
    let clear = run(&["--transparent"], "clear.exr");
    assert!(clear["A"].contains(&0.0));
    assert_denoised(&clear, false);
}

#[test]
fn a_denoiser_that_fails_costs_no_picture() {
    let folder = folder();
    rtr(folder.path(), &["marbles.pack", "-o", "plain.exr", "-o", "plain.png"]);
    let file = |name: &str| std::fs::read(folder.path().join(name)).expect("it was written");
    for (mode, message) in [
        ("fail", "error: Open Image Denoise: out of memory"),
        ("infinite", "error: Open Image Denoise gave pixels that are not finite"),
    ] {
        let args = ["marbles.pack", "--denoise", "--oidn", fake(), "-o", "a.png", "-o", "a.exr"];
        let output = rtr_with(folder.path(), &args, mode);
        assert_eq!(errors(&output), [message]);
        let log = text(&output.stderr);
        assert!(log.contains("the picture is written as it is, noisy"), "{log}");
        assert!(file("a.png") == file("plain.png"), "{mode}");
        let (channels, denoiser) = read(&folder.path().join("a.exr"));
        let (plain, _) = read(&folder.path().join("plain.exr"));
        assert_eq!(denoiser, None);
        assert!(channels["ViewLayer.Combined.R"] == plain["R"], "{mode}");
    }
}

#[cfg(unix)]
#[test]
fn an_interrupted_denoiser_costs_no_picture() {
    let folder = folder();
    rtr(folder.path(), &["marbles.pack", "-o", "plain.exr"]);
    let args = ["marbles.pack", "--denoise", "--oidn", fake(), "-o", "a.exr"];
    let output = rtr_with(folder.path(), &args, "interrupt");
    assert_eq!(output.status.code(), Some(130), "{}", text(&output.stderr));
    assert!(text(&output.stderr).contains("interrupted: the picture is not denoised"));
    let [(noisy, none), (plain, _)] =
        ["a.exr", "plain.exr"].map(|name| read(&folder.path().join(name)));
    assert_eq!(none, None);
    assert!(noisy["ViewLayer.Combined.R"] == plain["R"]);
}

/// What `--oidn` and `OIDN_DIR` say, and the one line that is the answer. Nothing is rendered.
#[test]
fn a_library_that_is_not_there_or_another_is_one_line() {
    let folder = folder();
    std::fs::write(folder.path().join("text.so"), "no library").expect("it can be written");
    std::fs::create_dir(folder.path().join("empty")).expect("a folder");
    let error_of = |path: &str, mode: &str| {
        let args = ["marbles.pack", "--denoise", "--oidn", path, "-o", "a.exr"];
        let output = rtr_with(folder.path(), &args, mode);
        assert!(!folder.path().join("a.exr").exists());
        let errors = errors(&output);
        assert_eq!(errors.len(), 1, "{errors:?}");
        errors[0].clone()
    };
    for path in ["nowhere", "empty"] {
        let expected = format!("error: --oidn: there is no Open Image Denoise at {path}");
        assert_eq!(error_of(path, ""), expected);
    }
    let found = error_of("text.so", "");
    assert!(found.starts_with("error: cannot load ") && found.contains("text.so: "), "{found}");
    assert!(!found.contains("No such file"), "the loader has looked elsewhere: {found}");
    let newer = error_of(fake(), "newer");
    assert!(newer.ends_with("is Open Image Denoise 3.99.7, but version 2 is needed"), "{newer}");
    if let Some(libm) = libm() {
        let expected = "is not Open Image Denoise 2: it has no function `oidnNewDevice`";
        let found = error_of(&libm, "");
        assert!(found.contains("libm") && found.ends_with(expected), "{found}");
    }
    let mut command = Command::new(env!("CARGO_BIN_EXE_rtr"));
    command.current_dir(folder.path()).args(["marbles.pack", "--denoise"]).env("OIDN_DIR", "empty");
    let expected = "error: OIDN_DIR: there is no Open Image Denoise at empty";
    assert_eq!(errors(&command.output().expect("rtr starts")), [expected]);
}

/// The mathematics library that this test runs with, where the system tells.
fn libm() -> Option<String> {
    let maps = std::fs::read_to_string("/proc/self/maps").ok()?;
    let paths = maps.lines().filter_map(|line| line.find('/').map(|at| &line[at..]));
    paths.into_iter().find(|path| path.contains("/libm.so")).map(str::to_owned)
}

#[test]
fn without_a_library_one_line_says_where_to_get_it() {
    let folder = folder();
    let output = rtr_with(folder.path(), &["marbles.pack", "--denoise", "-o", "a.exr"], "");
    if output.status.success() {
        // The system has one.
        assert!(text(&output.stderr).contains("denoised by Open Image Denoise"));
        return;
    }
    let errors = errors(&output);
    assert_eq!(errors.len(), 1, "{errors:?}");
    for part in ["is not found", "pip install pyoidn", "https://www.openimagedenoise.org", "--oidn"]
    {
        assert!(errors[0].contains(part), "{errors:?}");
    }
    assert!(!folder.path().join("a.exr").exists());
}
