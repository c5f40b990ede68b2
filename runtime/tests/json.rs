//! What `rtr` writes for other programs has the keys that `docs/json.md` lists.

mod common;
#[path = "../../tests/keys/mod.rs"]
mod keys;

use std::path::Path;
use std::process::{Command, Output};

use serde_json::Value;

fn rtr(folder: &Path, args: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_rtr"));
    if args[0] != "bench" {
        command.arg("marbles.pack");
    }
    command.current_dir(folder).args(args).args(["--device", "cpu"]);
    let output = command.output().expect("rtr starts");
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    output
}

/// A folder with `marbles.pack`.
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder for tests");
    let pack = common::pack_bytes(&common::features());
    std::fs::write(folder.path().join("marbles.pack"), pack).expect("it can be written");
    folder
}

#[test]
fn lines_have_the_keys_of_the_page() {
    let folder = folder();
    let output = rtr(folder.path(), &["--spp", "64", "-o", "a.png", "--progress", "json"]);
    let log = String::from_utf8(output.stderr).expect("text");
    let lines: Vec<Value> =
        log.lines().map(|line| serde_json::from_str(line).expect("JSON")).collect();
    for schema in ["rtr.progress/1", "rtr.message/1"] {
        let of: Vec<Value> =
            lines.iter().filter(|line| line["schema"] == schema).cloned().collect();
        keys::check(schema, &of);
    }
}

fn read(folder: &Path, name: &str) -> Value {
    let text = std::fs::read_to_string(folder.join(name)).expect("it is there");
    serde_json::from_str(&text).expect("JSON")
}

#[test]
fn benches_have_the_keys_of_the_page() {
    let folder = folder();
    let args = ["bench", "marbles.pack", "marbles.pack", "--time", "20ms", "--runs", "1"];
    rtr(folder.path(), &[&args[..], &["--report", "b.json"]].concat());
    let report = read(folder.path(), "b.json");
    assert_eq!(report["runs"][1][0]["schema"], "rtr.report/1");
    keys::check("rtr.bench/1", &[report]);
}

#[cfg(feature = "gpu")]
#[test]
fn ablations_have_the_keys_of_the_page() {
    let folder = folder();
    let args = ["--ablate=full", "--size", "8x6", "--spp", "1", "--report", "a.json"];
    rtr(folder.path(), &args);
    let mut report = read(folder.path(), "a.json");
    // The CPU is no device that kernels are built for.
    assert_eq!(report["rows"][1]["measured"], Value::Null);
    let (build_s, ms, specialised_ms) = (1.0, 1.0, 1.0);
    let measured = runtime::ablation::Measured {
        build_s,
        ms,
        specialised_ms,
        differ: 0,
        differ_cpu: 0,
        z: None,
    };
    report["rows"][1]["measured"] = serde_json::to_value(measured).expect("numbers");
    keys::check("rtr.ablation/1", &[report]);
}

#[test]
fn reports_have_the_keys_of_the_page() {
    let folder = folder();
    let args = ["--spp", "16", "-o", "a.exr", "--report", "a.json", "--clamp-indirect", "10"];
    rtr(folder.path(), &args);
    let mut report = read(folder.path(), "a.json");
    // A pack made by hand has no reasons.
    assert_eq!(report["kernel"]["kept"], serde_json::json!([]));
    let reason = serde_json::json!([{ "name": "", "reason": "", "by": null, "at": null }]);
    report["kernel"]["kept"] = reason.clone();
    report["kernel"]["left_out"] = reason;
    keys::check("rtr.report/1", &[report]);
}
