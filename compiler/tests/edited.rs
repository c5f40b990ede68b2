//! What `rtc` says of changes of a mesh file that name nothing, or are none.

use std::path::Path;
use std::process::Command;

use serde_json::Value;

const CAR: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nmtllib car.mtl\n\
    o body\nusemtl paint\nf 1 2 3\no wheel\nusemtl rubber\nf 1 2 4\n";

/// Codes, messages, helps and notes of a scene with this shape.
fn said(folder: &Path, shape: &str) -> Vec<String> {
    let text = format!(
        "rts 1\nasset car = obj(\"car.obj\", unit: m)\nmaterial m: diffuse {{ color = linear(0.5) }}\n\
         sky s: constant {{ }}\ncamera c: perspective {{ from = (0, 1, 5)m, to = (0, 1, 0)m }}\n\
         render r: path {{ camera = c }}\ninstance a {{ shape = {shape}, material = m }}\n"
    );
    std::fs::write(folder.join("a.rts"), text).expect("room for a text");
    let output = Command::new(env!("CARGO_BIN_EXE_rtc"))
        .current_dir(folder)
        .env("RTC_CACHE_DIR", folder.join("cache"))
        .args(["check", "a.rts", "--json"])
        .output()
        .expect("rtc starts");
    let object: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let list = object["diagnostics"].as_array().expect("a list").iter();
    list.map(|found| {
        let text = |value: &Value| value.as_str().unwrap_or("-").to_owned();
        let children = found["children"].as_array().expect("a list").iter();
        let more: Vec<String> = children.map(|child| text(&child["message"])).collect();
        format!("{} {} [{}]", text(&found["code"]), text(&found["message"]), more.join("; "))
    })
    .collect()
}

#[test]
fn what_names_nothing_and_what_is_no_change_is_said() {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("car.obj"), CAR).expect("room for a text");
    std::fs::write(folder.path().join("car.mtl"), "newmtl paint\nnewmtl rubber\n").expect("room");
    let cases: [(&str, &[&str]); 8] = [
        ("car { material \"paint\" = m, part \"wheel\" = none }", &[]),
        (
            "car { material \"Piant*\" = m }",
            &[
                "E0521 `car` shows no material named `Piant*` [a material with a similar name exists: `paint`]",
            ],
        ),
        (
            "car { part \"door\" = none }",
            &["E0521 `car` shows no part named `door` [there are: body, wheel]"],
        ),
        (
            "car.body { part \"wheel\" = none }",
            &["E0521 `car` shows no part named `wheel` [there are: body]"],
        ),
        (
            "car { glass \"paint\" = m }",
            &[
                "E0201 a mesh file has no `glass` to replace [it has `material \"name\"` and `part \"name\"`]",
            ],
        ),
        (
            "car { part \"body\" = 3 }",
            &[
                "E0305 this needs a material or `none`, found a plain number [`none` leaves out what has this name]",
            ],
        ),
        ("car { part \"body\" = wood }", &["E0202 no material named `wood` []"]),
        (
            "sphere(radius: 1m) { part \"x\" = none }",
            &[
                "E0305 only the materials and parts of a mesh file can be replaced [write `asset { material \"its name\" = mine }` after the name of an `asset`]",
            ],
        ),
    ];
    for (shape, expected) in cases {
        assert_eq!(said(folder.path(), shape), expected, "{shape}");
    }
}
