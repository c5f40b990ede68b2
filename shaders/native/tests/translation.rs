//! The generated text of every probe is checked in, so that a change of the generator shows as a
//! change of text. `UPDATE=1 cargo test -p native` writes it again.

use native::{Precision, Seam, generate, generate_with};
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

const SEAM_SOURCE: &str = "
fn twice(x: f32) -> f32 { return x + x; }
@group(0) @binding(0) var<storage, read_write> out: array<f32>;
@compute @workgroup_size(1) fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    out[id.x] = twice(f32(id.x));
}
";

#[test]
fn a_seam_calls_rust_and_keeps_the_translation() {
    let seam = Seam { function: "twice", path: "crate::hand::twice" };
    let text = generate_with(SEAM_SOURCE, Precision::F32, &[seam]).unwrap();
    let lines: Vec<&str> = text.lines().map(str::trim).collect();
    let at = |line: &str| lines.iter().position(|l| *l == line).unwrap_or_else(|| panic!("{line}"));
    let call = at("pub fn twice(&mut self, x: Real) -> Real {");
    assert_eq!(lines[call + 1], "crate::hand::twice(self, x)");
    assert_eq!(
        lines[at("pub fn generated_twice(&mut self, x: Real) -> Real {") + 1],
        "return x + x;"
    );
    let main = generate(SEAM_SOURCE, Precision::F32).unwrap();
    assert!(!main.contains("generated_twice") && main.contains("self.twice("));
    assert!(text.contains("self.twice("), "callers go through the seam");
}

#[test]
fn a_seam_for_no_function_is_an_error() {
    let seam = Seam { function: "thrice", path: "crate::hand::thrice" };
    let error = generate_with(SEAM_SOURCE, Precision::F32, &[seam]).unwrap_err();
    assert_eq!(error.message, "there is no function `thrice` for a seam");
}
