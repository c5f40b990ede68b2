//! What a camera sees: frames that fit, where everything is, and warnings about what cannot be seen.

use std::path::Path;
use std::process::Command;

use serde_json::Value;

/// What was printed on standard output.
fn rtc(folder: &Path, args: &[&str]) -> String {
    let output = Command::new(env!("CARGO_BIN_EXE_rtc"))
        .current_dir(folder)
        .env("RTC_CACHE_DIR", folder.join("cache"))
        .args(args)
        .output()
        .expect("rtc starts");
    String::from_utf8_lossy(&output.stdout).into_owned()
}

/// A tetrahedron of four triangles, 2 m wide, 1 m high, in two parts.
const ROCK: &str =
    "v -1 0 -1\nv 1 0 -1\nv 0 0 1\nv 0 1 0\ng base\nf 1 2 3\ng sides\nf 1 4 2\nf 2 4 3\nf 3 4 1\n";

fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("rock.obj"), ROCK).expect("room for a text");
    folder
}

/// Codes, messages and helps of a scene, each as `CODE message (help)`.
fn said(folder: &Path, text: &str) -> Vec<String> {
    let text = format!("rts 1\nmaterial m: diffuse {{ color = linear(0.5) }}\n{text}");
    std::fs::write(folder.join("a.rts"), text).expect("room for a text");
    let object: Value =
        serde_json::from_str(&rtc(folder, &["check", "a.rts", "--json"])).expect("JSON");
    let list = object["diagnostics"].as_array().expect("a list").iter();
    list.map(|found| {
        let text = |value: &Value| value.as_str().unwrap_or("-").to_owned();
        let children = found["children"].as_array().expect("a list");
        let help = children.iter().rev().find(|child| child["level"] == "help");
        let help = help.map_or(String::new(), |child| format!(" ({})", text(&child["message"])));
        format!("{} {}{help}", text(&found["code"]), text(&found["message"]))
    })
    .collect()
}

const VIEW: &str = "sky s: constant { }
camera c: perspective { from = (0, 1, 5)m, to = (0, 1, 0)m }
render r: path { camera = c }
";

/// Declarations before `VIEW`, and what is said of them.
const CASES: &[(&str, &[&str])] = &[
    ("instance ball { shape = sphere(radius: 1m), material = m }", &[]),
    // Nothing in the image.
    (
        "instance floor { shape = rectangle(size: (1, 1)m), material = m, at = (0, 0, 9)m }
         instance ball[i in 0..2] { shape = sphere(radius: 1m), material = m, at = (9 + i, 0, 0)m }",
        &["W0716 nothing is in the image of `c` (write `fit = ball` in the camera)"],
    ),
    ("instance near { shape = sphere(radius: 1m), material = m, at = (2.7, 1, 0)m }", &[]),
    (
        "instance behind { shape = sphere(radius: 1m), material = m, at = (0, 0, 9)m }
         light l: sphere { center = (0, 1, 0)m, radius = 1cm, strength = 9 }",
        &[],
    ),
    // A camera in something.
    (
        "instance ball { shape = sphere(radius: 9m), material = m }",
        &["W0717 the camera is inside of `ball`, and no light is in there (write `fit = ball` in the camera)"],
    ),
    (
        "instance room { shape = box(size: (20, 20, 20)m), material = m }
         instance ball { shape = sphere(radius: 1m), material = m }",
        &["W0717 the camera is inside of `room`, and no light is in there (write `fit = room` in the camera)"],
    ),
    (
        "asset rock = obj(\"rock.obj\", unit: m, up: +y)
         instance hill { shape = rock, material = m, scale = 30, at = (0, -2, 0)m }",
        &["W0717 the camera is inside of `hill`, and no light is in there (write `fit = hill` in the camera)"],
    ),
    // A room is no mistake, nor is what is open or lets light through.
    (
        "instance room { shape = box(size: (20, 20, 20)m), material = m }
         light l: sphere { center = (0, 5, 0)m, radius = 10cm, strength = 9 }",
        &[],
    ),
    (
        "asset rock = obj(\"rock.obj\", unit: m, up: +y)
         instance hill { shape = rock.sides, material = m, scale = 30, at = (0, -2, 0)m }",
        &[],
    ),
    (
        "material glass: dielectric { }
         instance ball { shape = sphere(radius: 9m), material = glass }
         instance other { shape = sphere(radius: 1m), material = m }",
        &[],
    ),
    (
        "material glow: emissive { color = linear(1), strength = 1 }
         instance ball { shape = sphere(radius: 9m), material = glow }
         instance other { shape = sphere(radius: 1m), material = m }",
        &[],
    ),
    // A light in something.
    (
        "instance ball { shape = sphere(radius: 1m), material = m }
         light l: sphere { center = (0.1, 0, 0)m, radius = 10cm, strength = 9 }",
        &["W0718 `l` is inside of `ball`: it lights nothing (to put it above, write `center = (0.1, 1.2, 0)m`)"],
    ),
    (
        "material glow: emissive { color = linear(1), strength = 1 }
         instance crate { shape = box(size: (1, 1, 1)m), material = m }
         instance lamp { shape = sphere(radius: 10cm), material = glow }",
        &["W0718 `lamp` is inside of `crate`: it lights nothing (move it out; `rtc show --bounds` prints where both are)"],
    ),
    (
        "instance ball { shape = sphere(radius: 1m), material = m }
         light l: sphere { center = (0.95, 0, 0)m, radius = 10cm, strength = 9 }",
        &[],
    ),
];

#[test]
fn what_cannot_be_seen_is_warned_about() {
    let folder = folder();
    for (text, expected) in CASES {
        assert_eq!(said(folder.path(), &format!("{text}\n{VIEW}")), *expected, "{text}");
    }
}

/// Written in the scene, too, only what is closed has an inside.
#[test]
fn an_open_mesh_around_the_camera_is_no_room() {
    let folder = folder();
    let faces = ["(0, 2, 1)", "(0, 1, 3)", "(1, 2, 3)", "(2, 0, 3)"];
    let tent = |faces: &[&str]| {
        let points = "(-30, -20, -20)m, (30, -20, -20)m, (0, -20, 40)m, (0, 40, 0)m";
        let shape = format!("mesh(points: [{points}], faces: [{}])", faces.join(", "));
        said(folder.path(), &format!("instance tent {{ shape = {shape}, material = m }}\n{VIEW}"))
    };
    let inside = "W0717 the camera is inside of `tent`, and no light is in there (write `fit = tent` in the camera)";
    assert_eq!(tent(&faces), [inside]);
    for missing in 0..faces.len() {
        let open: Vec<&str> =
            (0..faces.len()).filter(|i| *i != missing).map(|i| faces[i]).collect();
        assert!(tent(&open).is_empty(), "without face {missing}");
    }
}

#[test]
fn what_cannot_be_framed_is_an_error() {
    let folder = folder();
    let framed = |things: &str, camera: &str| {
        let text = format!(
            "{things}\nsky s: constant {{ }}\ncamera c: perspective {{ {camera} }}\nrender r: path {{ camera = c }}"
        );
        said(folder.path(), &text)
    };
    let ball = "instance ball { shape = sphere(radius: 1m), material = m }";
    assert_eq!(framed(ball, "fit = ball"), Vec::<String>::new());
    assert_eq!(
        framed(
            "instance ball[i in 0..0] { shape = sphere(radius: 1m), material = m }",
            "fit = ball"
        ),
        [
            "E0713 the camera cannot frame `ball`, which is not in the world (name an `instance` that is in the world; `rtc show --bounds` lists them)"
        ]
    );
    assert_eq!(
        framed(ball, "fit = ball, from = (0, 5, 0)m"),
        ["E0704 the camera looks along its own `up`"]
    );
    assert_eq!(
        framed(ball, "fit = ball, from = (0, 0, 0)m"),
        ["E0704 the camera is in the middle of what it frames"]
    );
}

#[test]
fn everything_is_listed_where_it_is() {
    let folder = folder();
    let text = format!(
        "rts 1
material m: diffuse {{ color = linear(0.5) }}
asset rock = obj(\"rock.obj\", unit: m, up: +y)
instance ball {{ shape = sphere(radius: 1m), material = m, at = (0, 1, 0)m }}
instance hill[i in 0..2] {{ shape = rock, material = m, rotate = (0, 90 * i, 0)deg, at = (5 * i, 0, 0)m }}
light lamp: sphere {{ center = (0, 4, 0)m, radius = 50cm, strength = 9 }}
{VIEW}"
    );
    std::fs::write(folder.path().join("a.rts"), text).expect("room for a text");
    let expected = "\
world             (-1, 0, -1)m .. (6, 4.5, 1)m, 7 x 4.5 x 2 m  8 triangles
asset rock        (-1, 0, -1)m .. (1, 1, 1)m, 2 x 1 x 2 m  4 triangles in 2 parts
  part \"base\"     (-1, 0, -1)m .. (1, 0, 1)m, 2 x 0 x 2 m  1 triangle
  part \"sides\"    (-1, 0, -1)m .. (1, 1, 1)m, 2 x 1 x 2 m  3 triangles
instance ball     (-1, 0, -1)m .. (1, 2, 1)m, 2 x 2 x 2 m  sphere
instance hill[0]  (-1, 0, -1)m .. (1, 1, 1)m, 2 x 1 x 2 m  4 triangles
instance hill[1]  (4, 0, -1)m .. (6, 1, 1)m, 2 x 1 x 2 m  4 triangles
light lamp        (-0.5, 3.5, -0.5)m .. (0.5, 4.5, 0.5)m, 1 x 1 x 1 m  sphere
";
    let found = rtc(folder.path(), &["show", "--bounds", "a.rts"]);
    assert!(found.starts_with(expected), "{found}");
}
