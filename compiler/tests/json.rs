//! What `rtc` writes for other programs has the keys that `docs/json.md` lists.

#[path = "../../tests/keys/mod.rs"]
mod keys;

use std::path::Path;
use std::process::Command;

use serde_json::Value;

const GOOD: &str = "rts 1
sky s: constant { }
camera c: perspective { from = (0, 1, 5)m, to = (0, 1, 0)m }
render r: path { camera = c, sky = s, samples = 96 }
texture t = image(\"t.png\", space: srgb)
material clay: diffuse { color = t.rgb }
material glow: emissive { color = linear(1), strength = 2 }
instance ball { shape = sphere(radius: 1m), material = clay }
instance panel { shape = rectangle(size: (1, 1)m), material = glow, at = (0, 3, 0)m }
light lamp: sphere { center = (2, 2, 0)m, radius = 10cm, strength = 20 }
let unused = 1m
";

/// What was printed, and the exit code.
fn rtc(folder: &Path, args: &[&str]) -> (Option<i32>, String, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_rtc"))
        .current_dir(folder)
        .env("RTC_CACHE_DIR", folder.join("cache"))
        .args(args)
        .output()
        .expect("rtc starts");
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    (output.status.code(), text(&output.stdout), text(&output.stderr))
}

fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text);
    write("good.rts", GOOD).expect("room for a text");
    let bad = GOOD.replace("material = clay }", "material = clya, radius = 1 }");
    write("bad.rts", &bad).expect("room for a text");
    let texture = image::RgbImage::from_pixel(2, 2, image::Rgb([200, 100, 50]));
    texture.save(folder.path().join("t.png")).expect("room for an image");
    folder
}

fn json(text: &str) -> Value {
    serde_json::from_str(text).unwrap_or_else(|error| panic!("{error}: {text}"))
}

#[test]
fn a_check_is_one_object_with_the_keys_of_the_page() {
    let folder = folder();
    let (code, good, log) = rtc(folder.path(), &["check", "good.rts", "--json"]);
    assert_eq!((code, log.as_str()), (Some(0), ""));
    let (code, bad, log) = rtc(folder.path(), &["check", "bad.rts", "--json"]);
    assert_eq!((code, log.as_str()), (Some(1), ""));
    let [good, bad] = [good, bad].map(|text| json(&text));
    keys::check("rtc.check/1", &[good.clone(), bad.clone()]);
    assert_eq!((&good["ok"], &good["errors"]), (&Value::Bool(true), &0.into()));
    assert_eq!((&bad["ok"], &bad["holds"]), (&Value::Bool(false), &Value::Null));
    assert!(good["warnings"].as_u64().is_some_and(|n| n >= 1), "{good}");
    assert!(bad["errors"].as_u64().is_some_and(|n| n >= 2), "{bad}");
    assert_eq!(good["holds"]["image"], serde_json::json!([960, 540]));
    let all = |object: &Value| object["diagnostics"].as_array().expect("a list").clone();
    let diagnostics = [all(&good), all(&bad)].concat();
    keys::check("rtc.diagnostic/1", &diagnostics);
    // The same as lines.
    let (_, _, lines) = rtc(folder.path(), &["check", "bad.rts", "--error-format", "json"]);
    let lines: Vec<Value> = lines.lines().map(json).collect();
    assert_eq!(lines, all(&bad));
}

#[test]
fn what_is_no_fault_of_the_scene_is_a_line_and_no_object() {
    let folder = folder();
    let (code, out, log) = rtc(folder.path(), &["check", "none.rts", "--json"]);
    assert_eq!((code, out.as_str()), (Some(3), ""));
    let line = json(&log);
    assert_eq!((&line["schema"], &line["level"]), (&"rtc.diagnostic/1".into(), &"error".into()));
    let (code, _, _) =
        rtc(folder.path(), &["check", "good.rts", "--json", "--error-format", "short"]);
    assert_eq!(code, Some(2));
}

#[test]
fn a_pack_is_one_object_with_the_keys_of_the_page() {
    let folder = folder();
    let (code, _, log) = rtc(folder.path(), &["good.rts", "-o", "a.pack"]);
    assert_eq!(code, Some(0), "{log}");
    let (code, text, _) = rtc(folder.path(), &["inspect", "a.pack", "--json", "--verify"]);
    assert_eq!(code, Some(0));
    let pack = json(&text);
    assert_eq!(pack["instances"][0], serde_json::json!({ "name": "ball", "at": "good.rts:8" }));
    assert_eq!((&pack["samples"], &pack["image"][0]), (&96.into(), &960.into()));
    keys::check("rtc.inspect/1", &[pack]);
    let (code, out, log) = rtc(folder.path(), &["inspect", "good.rts", "--json"]);
    assert_eq!((code, out.as_str()), (Some(3), ""));
    assert_eq!(json(&log)["level"], "error");
}
