//! The generated text of every probe is checked in, so that a change of the generator shows as a
//! change of text. `UPDATE=1 cargo test -p native` writes it again.

use native::{Precision, generate};
use std::fs;
use std::path::{Path, PathBuf};

fn tests_folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests")
}

/// The stems of the probes, in order.
fn probes() -> Vec<String> {
    let mut stems: Vec<String> = fs::read_dir(tests_folder().join("probes"))
        .expect("the folder of probes is part of the crate")
        .map(|entry| entry.expect("a readable folder").path())
        .map(|path| path.file_stem().expect("a file").to_string_lossy().into_owned())
        .collect();
    stems.sort();
    stems
}

#[test]
fn generated_text_is_current() {
    let update = std::env::var_os("UPDATE").is_some();
    let mut stale = Vec::new();
    for stem in probes() {
        let source =
            fs::read_to_string(tests_folder().join(format!("probes/{stem}.wgsl"))).unwrap();
        for (precision, suffix) in [(Precision::F32, "f32"), (Precision::F64, "f64")] {
            let text = generate(&source, precision).unwrap_or_else(|e| panic!("{stem}.wgsl:{e}"));
            let path = tests_folder().join(format!("generated/{stem}_{suffix}.rs"));
            if fs::read_to_string(&path).is_ok_and(|old| old == text) {
                continue;
            }
            if update {
                fs::write(&path, text).unwrap();
            } else {
                stale.push(path);
            }
        }
    }
    assert!(stale.is_empty(), "run `UPDATE=1 cargo test -p native`; stale: {stale:?}");
}

#[test]
fn every_generated_file_has_a_probe() {
    let stems = probes();
    for entry in fs::read_dir(tests_folder().join("generated")).unwrap() {
        let name = entry.unwrap().file_name().to_string_lossy().into_owned();
        let stem = name.trim_end_matches("_f32.rs").trim_end_matches("_f64.rs");
        assert!(stems.iter().any(|s| s == stem), "{name} belongs to no probe");
    }
}
