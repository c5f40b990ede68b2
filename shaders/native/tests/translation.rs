//! The generated text of every probe is checked in, so that a change of the generator shows as a
//! change of text: for f32 without the scalar rules, which all have; for f64 where it is more than
//! other types and literals. `UPDATE=1 cargo test -p native` writes it again.

mod twin;

use native::{ByHand, Lanes, Precision, Seam, generate, generate_wide, generate_with};
use std::fmt::Write as _;
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

/// A file of the goldens is what is `expected`, or becomes it.
fn check_golden(name: &str, expected: &str) -> Option<PathBuf> {
    let path = tests_folder().join("generated").join(name);
    if fs::read_to_string(&path).is_ok_and(|old| old == expected) {
        return None;
    }
    if std::env::var_os("UPDATE").is_none() {
        return Some(path);
    }
    fs::write(&path, expected).expect("a folder of the crate");
    None
}

/// What a probe becomes, without the scalar rules at its end.
fn translate(stem: &str, precision: Precision) -> String {
    let probe = tests_folder().join(format!("probes/{stem}.wgsl"));
    let source = fs::read_to_string(probe).expect("a probe");
    let text = generate(&source, precision).unwrap_or_else(|e| panic!("{stem}.wgsl:{e}"));
    let rules = include_str!("../src/prelude/scalar.rs");
    let rules = &rules[rules.find("use super::Real;").expect("they speak of it")..];
    let text = text.strip_suffix(&format!("\nmod wgsl {{\n{rules}}}\n"));
    text.unwrap_or_else(|| panic!("{stem} does not end with the scalar rules")).to_owned()
}

#[test]
fn generated_text_is_current() {
    let mut exceptions = String::from(
        "// Lines of the f64 twins that `tests/twin` does not make of the f32 line: probe and line, both texts.\n",
    );
    let mut stale = Vec::new();
    let mut translated = Vec::new();
    for stem in probes() {
        let [single, double] = [Precision::F32, Precision::F64].map(|p| translate(&stem, p));
        assert_eq!(
            single.lines().count(),
            double.lines().count(),
            "{stem}: the twin has its lines"
        );
        for (number, (single, double)) in (1..).zip(single.lines().zip(double.lines())) {
            if twin::by_rules(single) != double {
                writeln!(exceptions, "{stem} {number}\n- {single}\n+ {double}").unwrap();
            }
        }
        stale.extend(check_golden(&format!("{stem}.rs"), &single));
        translated.push((stem, single, double));
    }
    stale.extend(check_golden("f64.txt", &exceptions));
    assert!(stale.is_empty(), "run `UPDATE=1 cargo test -p native`; stale: {stale:?}");
    for (stem, single, double) in translated {
        assert_eq!(
            twin::twin(&stem, &single, &exceptions),
            double,
            "what the build script compiles"
        );
    }
}

/// The probe that is also translated into lanes, without the operations on them at its end.
#[test]
fn generated_text_in_lanes_is_current() {
    let probe = tests_folder().join("probes/lanes.wgsl");
    let source = fs::read_to_string(probe).expect("a probe");
    for (lanes, name) in [(Lanes::Avx2, "wide/avx2.rs"), (Lanes::Avx512, "wide/avx512.rs")] {
        let text = generate_wide(&source, "crate::scalar", lanes, ByHand::default())
            .unwrap_or_else(|error| panic!("lanes.wgsl:{error}"));
        let end = text.find("\npub mod v {").expect("it ends with the operations");
        let stale = check_golden(name, &text[..end]);
        assert!(stale.is_none(), "run `UPDATE=1 cargo test -p native`; stale: {stale:?}");
    }
}

#[test]
fn every_generated_file_has_a_probe() {
    let stems = probes();
    for entry in fs::read_dir(tests_folder().join("generated")).unwrap() {
        let name = entry.unwrap().file_name().to_string_lossy().into_owned();
        let of_probe = name.strip_suffix(".rs").is_some_and(|stem| stems.iter().any(|s| s == stem));
        assert!(of_probe || name == "f64.txt" || name == "wide", "{name} belongs to no probe");
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
    let by_hand =
        ByHand { seams: &[seam], companion: Some("crate::hand::Tools<'a>"), ..ByHand::default() };
    let text = generate_with(SEAM_SOURCE, Precision::F32, by_hand).unwrap();
    let lines: Vec<&str> = text.lines().map(str::trim).collect();
    let at = |line: &str| lines.iter().position(|l| *l == line).unwrap_or_else(|| panic!("{line}"));
    let call = at("pub fn twice(&mut self, x: Real) -> Real {");
    assert_eq!(lines[call + 1], "crate::hand::twice(self, x)");
    assert_eq!(
        lines[at("pub fn generated_twice(&mut self, x: Real) -> Real {") + 1],
        "return x + x;"
    );
    assert!(text.contains("pub companion: crate::hand::Tools<'a>,"));
    let main = generate(SEAM_SOURCE, Precision::F32).unwrap();
    assert!(
        !main.contains("companion")
            && !main.contains("generated_twice")
            && main.contains("self.twice(")
    );
    assert!(text.contains("self.twice("), "callers go through the seam");
}

#[test]
fn a_seam_for_no_function_is_an_error() {
    let seam = Seam { function: "thrice", path: "crate::hand::thrice" };
    let by_hand = ByHand { seams: &[seam], ..ByHand::default() };
    let error = generate_with(SEAM_SOURCE, Precision::F32, by_hand).unwrap_err();
    assert_eq!(error.message, "there is no function `thrice` for a seam");
}
