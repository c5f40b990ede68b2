//! Parts of one picture, some samples of some crop each, merged a few rows at a time: the bits of one run, and what is
//! missing named.

mod common;

use runtime::output::{
    Expected, ExrFile, Merge, Meta, Picture, encode_exr, merge, read_exr, write,
};
use runtime::{Film, Rect, SampleRange};
use std::path::Path;
use std::process::Command;

fn rtr(folder: &Path, args: &[&str]) -> (Option<i32>, String) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_rtr"));
    let output = command.current_dir(folder).args(args).output().expect("it starts");
    let text = [output.stdout, output.stderr].map(|b| String::from_utf8_lossy(&b).into_owned());
    (output.status.code(), text.concat())
}

fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder for tests");
    let pack = common::pack_bytes(&common::features());
    std::fs::write(folder.path().join("marbles.pack"), pack).expect("it can be written");
    folder
}

fn bytes(folder: &Path, name: &str) -> Vec<u8> {
    std::fs::read(folder.join(name)).expect("it is there")
}

/// The tiles of an image of 72 x 40 pixels, and their samples.
const PARTS: [(&str, &str); 5] = [
    ("0,0,40,24", "0..16"),
    ("0,0,40,24", "16..32"),
    ("40,0,32,24", "0..32"),
    ("0,24,72,16", "16..32"),
    ("0,24,72,16", "0..16"),
];
const LAYERS: [&str; 2] = ["--layers", "albedo,normal,depth,crypto,lights,alpha"];

fn render_parts(folder: &Path) {
    for (i, (crop, samples)) in PARTS.into_iter().enumerate() {
        let name = format!("part.{i}.exr");
        let which = ["marbles.pack", "--device", "cpu", "--crop", crop, "--samples", samples];
        let (code, log) = rtr(folder, &[&which[..], &["-o", &name], &LAYERS].concat());
        assert_eq!(code, Some(0), "{log}");
    }
}

#[test]
fn crops_and_samples_merge_to_one_run() {
    let folder = folder();
    let folder = folder.path();
    render_parts(folder);
    let whole = ["marbles.pack", "--device", "cpu", "--samples", "0..32"];
    let outputs = ["-o", "whole.exr", "-o", "whole.png", "--format", "png16"];
    let (code, log) = rtr(folder, &[&whole[..], &outputs, &LAYERS].concat());
    assert_eq!(code, Some(0), "{log}");
    let names = ["part.3.exr", "part.0.exr", "part.2.exr", "part.4.exr", "part.1.exr"];
    let outputs =
        ["-o", "merged.exr", "-o", "merged.png", "--format", "png16", "--crop", "0,0,72,40"];
    let (code, log) = rtr(folder, &[&["merge"], &names[..], &outputs].concat());
    assert_eq!(code, Some(0), "{log}");
    assert_eq!(bytes(folder, "merged.png"), bytes(folder, "whole.png"));
    let read = |name: &str| read_exr(&folder.join(name)).expect("an EXR");
    let (merged, whole) = (read("merged.exr"), read("whole.exr"));
    assert_eq!(merged.film.ranges, whole.film.ranges);
    assert_eq!(merged.film.counters, whole.film.counters);
    assert_eq!(merged.film.region, whole.film.region);
    #[expect(clippy::cast_possible_truncation, reason = "the precision of pictures")]
    let shown = |picture: &Picture| -> Vec<_> {
        picture.film.means().iter().map(|rgb| rgb.map(|x| (x as f32).to_bits())).collect()
    };
    assert!(shown(&merged) == shown(&whole));
    let (merged, whole) = (merged.layers.expect("layers"), whole.layers.expect("layers"));
    assert_eq!(merged.nearest, whole.nearest);
    assert_eq!(merged.covered, whole.covered);
    let mattes = |layers: &runtime::layers::Layers| -> Vec<_> {
        let ranked = |shares: &Vec<(u32, u32)>| runtime::layers::Matte::ranked(shares);
        layers.mattes.iter().map(|m| m.shares.iter().map(ranked).collect::<Vec<_>>()).collect()
    };
    assert_eq!(mattes(&merged), mattes(&whole));
}

#[test]
fn what_is_missing_comes_with_the_command_that_renders_it() {
    let folder = folder();
    let folder = folder.path();
    render_parts(folder);
    let parts = ["merge", "part.0.exr", "part.1.exr", "part.2.exr", "part.3.exr"];
    let wanted = ["--samples", "0..32", "--crop", "0,0,72,40", "-o", "a.exr"];
    let (code, log) = rtr(folder, &[&parts[..], &wanted].concat());
    assert_eq!(code, Some(3), "{log}");
    assert!(log.contains("error: samples 0..16 of crop 0,24,72,16 are missing"), "{log}");
    let help = log.lines().find_map(|line| line.split_once("rtr SCENE.pack ")).expect("help").1;
    let (code, log) = rtr(folder, &[&parts[..4], &wanted].concat());
    assert_eq!(code, Some(3), "{log}");
    assert!(log.contains("samples 0..32 of crop 0,24,72,16 are missing"), "{log}");
    assert!(!folder.join("a.exr").exists());
    // What the help says is what was missing.
    let words: Vec<&str> = help.split(' ').collect();
    let again = [&["marbles.pack", "--device", "cpu"], &words[..], &LAYERS].concat();
    assert_eq!(rtr(folder, &again).0, Some(0));
    let part = words.last().expect("a name");
    let (code, log) = rtr(folder, &[&parts[..], &[part], &wanted].concat());
    assert_eq!(code, Some(0), "{log}");
}

#[test]
fn a_damaged_part_is_one_line_and_no_picture() {
    let folder = folder();
    let folder = folder.path();
    render_parts(folder);
    let whole = bytes(folder, "part.2.exr");
    for (i, cut) in [(1, whole.len() / 2), (2, whole.len() - 9)] {
        std::fs::write(folder.join("part.2.exr"), &whole[..cut]).expect("it can be written");
        let parts = ["part.0.exr", "part.1.exr", "part.2.exr", "part.3.exr", "part.4.exr"];
        let name = format!("{i}.exr");
        let (code, log) = rtr(folder, &[&["merge"], &parts[..], &["-o", &name]].concat());
        assert_eq!(code, Some(3), "{log}");
        assert!(log.contains("error: cannot read part.2.exr: "), "{log}");
        assert_eq!(log.lines().count(), 1, "{log}");
        assert!(!folder.join(name).exists());
    }
}

/// A picture whose pixels tell where they are.
fn marked(region: Rect, samples: SampleRange) -> Picture {
    let mut film = Film::new([1100, 600], region);
    film.ranges = vec![samples];
    film.counts.fill(samples.count());
    for (i, sum) in (0_u32..).zip(film.sums.iter_mut()) {
        let (x, y) = (i % region.w + region.x, i / region.w + region.y);
        let at = f64::from(x) + f64::from(y) / 1024.0;
        *sum = [at, at * f64::from(samples.end), 1.0 / 3.0];
    }
    Picture::new(film, Meta { render_id: "0a".into(), precision: "f32".into(), ..Meta::default() })
}

/// Larger than what is read at a time.
#[test]
fn a_picture_that_is_merged_by_rows_is_the_one_that_is_merged_at_once() {
    let folder = tempfile::tempdir().expect("a folder for tests");
    let (left, right) =
        (Rect { x: 0, y: 0, w: 500, h: 600 }, Rect { x: 500, y: 0, w: 600, h: 250 });
    let below = Rect { y: 250, h: 350, ..right };
    let range = |start, end| SampleRange { start, end };
    let parts = [
        marked(left, range(0, 32)),
        marked(right, range(0, 16)),
        marked(below, range(0, 32)),
        marked(right, range(16, 32)),
    ];
    let mut files = Vec::new();
    for (i, part) in parts.iter().enumerate() {
        let path = folder.path().join(format!("{i}.exr"));
        write(&path, part, true).expect("it can be written");
        let read = read_exr(&path).expect("it can be read");
        assert_eq!(read.film.region, part.film.region);
        files.push(ExrFile::open(&path).expect("a part"));
    }
    let read = files.iter().map(|file| file.read().expect("a part")).collect();
    let at_once = encode_exr(&merge(read).expect("parts"), true).expect("a picture");
    let by_rows = Merge::new(files, Expected::default()).expect("parts");
    let mut heights = Vec::new();
    let mut file = std::io::Cursor::new(Vec::new());
    by_rows.write_exr(&mut file, |rows| heights.push(rows.film.region.h)).expect("a picture");
    assert!(heights.len() > 1 && heights.iter().sum::<u32>() == 600, "{heights:?}");
    // Attributes have no order in a file, so the bytes may differ.
    let read = |name: &str, bytes: Vec<u8>| {
        let path = folder.path().join(name);
        std::fs::write(&path, bytes).expect("it can be written");
        read_exr(&path).expect("a picture")
    };
    assert!(read("by_rows.exr", file.into_inner()) == read("at_once.exr", at_once));
}
