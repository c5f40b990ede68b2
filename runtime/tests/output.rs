//! Pictures as files: what goes in comes out, parts merge, strangers are refused.

mod common;

use common::scene;
use runtime::output::{OutputError, Picture, encode_png, merge, read_exr, write};
use runtime::{Control, DeviceChoice, Job, Rect, SampleRange, render};
use std::path::PathBuf;

fn picture(samples: SampleRange, crop: Option<Rect>) -> Picture {
    let scene = scene();
    let job = Job::of_scene(&scene);
    let job = Job { samples, crop: crop.unwrap_or(job.crop), ..job };
    let outcome = render(&scene, &job, &DeviceChoice::Cpu, &Control::default());
    outcome.expect("the CPU renders").picture
}

fn range(start: u32, end: u32) -> SampleRange {
    SampleRange { start, end }
}

fn folder() -> (tempfile::TempDir, impl Fn(&str) -> PathBuf) {
    let folder = tempfile::tempdir().expect("a folder for tests");
    let root = folder.path().to_owned();
    (folder, move |name: &str| root.join(name))
}

#[test]
fn an_exr_file_gives_the_picture_back() {
    let (_folder, at) = folder();
    let crop = Some(Rect { x: 8, y: 4, w: 33, h: 17 });
    for (crop, residual, tolerance) in
        [(None, true, 1e-14), (crop, true, 1e-14), (crop, false, 6e-8)]
    {
        let mut written = picture(range(16, 21), crop);
        written.meta.commit = "v0.1.0-12-g0123456789ab".to_owned();
        write(&at("a.exr"), &written, residual).expect("it can be written");
        let read = read_exr(&at("a.exr")).expect("it can be read");
        assert_eq!(read.meta, written.meta);
        let (a, b) = (&read.film, &written.film);
        assert_eq!((a.image_size, a.region, &a.ranges), (b.image_size, b.region, &b.ranges));
        assert_eq!((&a.counts, a.counters), (&b.counts, b.counters));
        for (a, b) in a.sums.iter().flatten().zip(b.sums.iter().flatten()) {
            assert!((a - b).abs() <= tolerance * b.abs(), "{a} {b}");
        }
    }
}

#[test]
fn uneven_samples_survive_the_file() {
    let (_folder, at) = folder();
    let mut written = picture(range(0, 16), None);
    written.film.counts[5] = 0;
    written.film.sums[5] = [0.0; 3];
    write(&at("a.exr"), &written, true).expect("it can be written");
    let read = read_exr(&at("a.exr")).expect("it can be read");
    assert_eq!(read.film.counts, written.film.counts);
    let error = merge(vec![read]).expect_err("a part must be even").to_string();
    assert!(error.contains("between 0 and 16 samples"), "{error}");
}

#[test]
fn parts_from_files_merge_to_the_whole() {
    let (_folder, at) = folder();
    write(&at("a.exr"), &picture(range(0, 32), None), true).expect("it can be written");
    let mut later = picture(range(32, 64), None);
    later.meta.commit = "01ab".to_owned();
    write(&at("b.exr"), &later, true).expect("it can be written");
    let read = |name: &str| read_exr(&at(name)).expect("it can be read");
    let merged = merge(vec![read("a.exr"), read("b.exr")]).expect("they are parts");
    let whole = picture(range(0, 64), None);
    assert!(merged.meta.commit.ends_with("01ab"), "{}", merged.meta.commit);
    assert_eq!(merged.film.ranges, whole.film.ranges);
    assert_eq!(merged.film.counters, whole.film.counters);
    for (a, b) in merged.film.sums.iter().flatten().zip(whole.film.sums.iter().flatten()) {
        // Two parts of 2^-48 each, and the order of the f64 sum.
        assert!((a - b).abs() <= 2e-14 * b.abs(), "{a} {b}");
    }
    assert_eq!(encode_png(&merged).expect("a PNG"), encode_png(&whole).expect("a PNG"));
}

#[test]
fn only_parts_of_one_picture_are_merged() {
    let a = picture(range(0, 16), None);
    let b = picture(range(16, 32), None);
    let error =
        |parts: Vec<Picture>| merge(parts).expect_err("not parts of one picture").to_string();
    let other = |change: &dyn Fn(&mut Picture)| {
        let mut other = b.clone();
        change(&mut other);
        error(vec![a.clone(), other])
    };
    assert_eq!(error(Vec::new()), "no pictures to merge");
    assert_eq!(
        other(&|p| p.film.ranges = vec![range(8, 24)]),
        "part 2: samples 8..24 overlap 0..16 of the parts before it"
    );
    let text = other(&|p| p.meta.seed = 9);
    assert_eq!(
        text,
        "part 2: seed is 9, but part 1 has 7; only parts of one picture can be merged"
    );
    assert!(other(&|p| p.meta.render_id.clear()).starts_with("part 2: render_id is "));
    let text = other(&|p| p.film.region.x = 1);
    assert!(text.starts_with("part 2: crop 1,0,72,40 overlaps crop 0,0,72,40 of part 1"), "{text}");
    assert!(other(&|p| p.film.image_size = [9, 9]).starts_with("part 2: size is 9x9"));
}

#[test]
fn the_png_has_the_tone_curve_and_nothing_random() {
    let (_folder, at) = folder();
    let mut written = picture(range(0, 4), None);
    write(&at("a.png"), &written, false).expect("it can be written");
    let bytes = std::fs::read(at("a.png")).expect("it is there");
    assert_eq!(bytes, encode_png(&written).expect("a PNG"));
    let image = image::load_from_memory(&bytes).expect("a PNG").to_rgb8();
    assert_eq!(image.dimensions(), (72, 40));
    written.meta.exposure = 1.0;
    let brighter = encode_png(&written).expect("a PNG");
    let brighter = image::load_from_memory(&brighter).expect("a PNG").to_rgb8();
    assert!(image.pixels().zip(brighter.pixels()).all(|(a, b)| a.0 <= b.0));
}

#[test]
fn files_of_strangers_are_refused_with_one_line() {
    let (folder, at) = folder();
    std::fs::write(at("a.exr"), b"not an image").expect("it can be written");
    assert!(matches!(read_exr(&at("a.exr")), Err(OutputError::Read { .. })));
    assert!(matches!(read_exr(&at("none.exr")), Err(OutputError::Open(_))));
    exr::prelude::write_rgb_file(at("b.exr"), 4, 4, |_, _| (0.0_f32, 0.0_f32, 0.0_f32))
        .expect("it can be written");
    let error = read_exr(&at("b.exr")).expect_err("it has no attributes").to_string();
    assert!(error.contains("was not written by rtr: attribute `render_id` is missing"), "{error}");
    let error = write(&at("a.tiff"), &picture(range(0, 1), None), false);
    assert!(matches!(error, Err(OutputError::Format { .. })));
    // A failed write leaves nothing behind.
    assert!(write(&at("none/a.exr"), &picture(range(0, 1), None), false).is_err());
    assert_eq!(std::fs::read_dir(folder.path()).expect("the folder").count(), 2);
}
