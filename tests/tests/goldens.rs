//! Goldens of the example scenes: the CPU kernel gives these bits.
//!
//! `tests/goldens/NAME.txt` holds the hash of the film and its mean; the PNG beside it is for
//! people. `UPDATE=1 cargo test -p tests --test goldens` rewrites both: look at the pictures then.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use pack::Pack;
use runtime::Film;
use scenes::catalog::{EXAMPLES, Example};
use tests::{picture, scene};

/// Longest side of a golden in pixels, and its samples.
const SIDE: u32 = 96;
const SAMPLES: u32 = 8;

fn goldens() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("goldens")
}

/// The example compiled as `scene::example` does, the largest one with less in it.
fn example_pack(example: &Example) -> Pack<pack::Checked> {
    let compiled = scene::example(example, &[]);
    Pack::from_bytes(scene::bytes(&compiled)).expect("what was written can be read")
}

fn describe(film: &Film) -> String {
    let mut hasher = blake3::Hasher::new();
    let means = film.means();
    for value in means.iter().flatten() {
        #[expect(clippy::cast_possible_truncation, reason = "as the EXR stores it")]
        let value = *value as f32;
        hasher.update(&value.to_bits().to_le_bytes());
    }
    let mut text = format!("blake3 {}\n", hasher.finalize().to_hex());
    for (name, k) in [("red", 0), ("green", 1), ("blue", 2)] {
        let mean = means.iter().map(|rgb| rgb[k]).sum::<f64>() / means.len() as f64;
        let _ = writeln!(text, "mean {name} {mean:.6}");
    }
    text
}

#[test]
fn every_example_renders_as_it_always_did() {
    let update = std::env::var_os("UPDATE").is_some();
    let mut changed = Vec::new();
    for example in EXAMPLES {
        let outcome = picture::cpu(example_pack(example), |job| {
            let [w, h] = job.image_size;
            job.resize(if w >= h { [SIDE, SIDE * h / w] } else { [SIDE * w / h, SIDE] });
            job.samples = runtime::SampleRange { start: 0, end: SAMPLES };
        });
        let found = describe(outcome.film());
        let path = goldens().join(example.name).with_extension("txt");
        if update {
            std::fs::create_dir_all(goldens()).expect("writable");
            std::fs::write(&path, &found).expect("writable");
            let png = path.with_extension("png");
            runtime::output::write(&png, &outcome.picture, false).expect("writable");
            continue;
        }
        let golden = std::fs::read_to_string(&path).unwrap_or_default();
        if golden != found {
            changed.push(format!("{}\n expected\n{golden} found\n{found}", example.name));
        }
    }
    assert!(changed.is_empty(), "{}UPDATE=1 accepts the new pictures", changed.join("\n"));
}

#[test]
fn every_golden_belongs_to_an_example() {
    for entry in std::fs::read_dir(goldens()).expect("there are goldens") {
        let path = entry.expect("readable").path();
        let stem = path.file_stem().and_then(|stem| stem.to_str()).unwrap_or_default();
        assert!(scenes::catalog::find(stem).is_some(), "{} is dead", path.display());
    }
}
