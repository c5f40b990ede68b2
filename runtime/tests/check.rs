//! `rtr check` as a program: what it prints, what it writes, how it exits.

mod common;

use std::path::Path;
use std::process::{Command, Output};

fn rtr(folder: &Path, args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_rtr"))
        .current_dir(folder)
        .args(args)
        .output()
        .expect("rtr starts")
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder for tests");
    let pack = common::pack_bytes(&common::features());
    std::fs::write(folder.path().join("marbles.pack"), pack).expect("it can be written");
    folder
}

#[test]
fn it_compares_and_writes_a_heat_map() {
    let folder = folder();
    let args = ["check", "marbles.pack", "--size", "36x20", "--spp", "4", "--heat", "heat.png"];
    let output = rtr(folder.path(), &args);
    let said = text(&output.stdout);
    assert_eq!(output.status.code(), Some(0), "{said}{}", text(&output.stderr));
    for part in
        ["36x20, 4 spp, in f32 and in f64", "f32: ", "f64: ", "wrote heat.png", "verdict: stable"]
    {
        assert!(said.contains(part), "{part}: {said}");
    }
    let heat = image::open(folder.path().join("heat.png")).expect("a picture");
    assert_eq!((heat.width(), heat.height()), (36, 20));
    let again = rtr(folder.path(), &args);
    assert_eq!(said, text(&again.stdout), "the same numbers on every run");
}

#[test]
fn it_replays_a_sample_ray_by_ray() {
    let folder = folder();
    let replay = |more: &[&str]| {
        let args = [&["check", "marbles.pack", "--pixel", "30,25", "--sample", "3"], more].concat();
        let output = rtr(folder.path(), &args);
        assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
        text(&output.stdout)
    };
    let (short, long) = (replay(&[]), replay(&["--trace"]));
    assert!(short.starts_with("pixel 30,25, sample 3, seed "), "{short}");
    assert!(short.contains("f32: radiance ") && short.contains("f64: radiance "), "{short}");
    assert!(!short.contains("ray 0") && long.contains("ray 0\n  f32 path from ("), "{long}");
    assert!(short.lines().all(|line| long.contains(line)), "{long}");
}

/// A red wall that fills the left half of the picture and a green one in the right half, each lit by the sky alone.
const WALLS: &str = "rts 1
sky heaven: constant { color = linear(1) }
material brick: diffuse { color = linear(0.8, 0.1, 0.1) }

material moss: diffuse { color = linear(0.1, 0.8, 0.1) }
instance left { shape = rectangle(size: (2, 2)m), material = brick, at = (-1, 0, 0)m }
instance right { shape = rectangle(size: (2, 2)m), material = moss, at = (1, 0, 0)m }
camera eye: perspective { from = (0, 5, 0)m, to = (0, 0, 0)m, up = (0, 0, -1), fov.vertical = 20deg }
film f { size = (8, 8)px }
render main: path { camera = eye, film = f, samples = 16, depth = 4, seed = 1 }
";

/// Compiles `text` as `walls.rts` and gives the first ray of the pixel in column `x`, in both precisions.
fn first_ray(text_of_scene: &str, x: u32) -> [String; 2] {
    let folder = tempfile::tempdir().expect("a folder for tests");
    let at = |name: &str| folder.path().join(name);
    std::fs::write(at("walls.rts"), text_of_scene).expect("it can be written");
    let mut arguments = vec!["rtc".into(), at("walls.rts").into_os_string(), "-o".into()];
    arguments.extend([at("walls.pack").into_os_string(), "--no-cache".into()]);
    assert_eq!(compiler::cli::run(arguments), 0);
    let pixel = format!("{x},4");
    let args = ["check", "walls.pack", "--pixel", &pixel, "--sample", "2", "--trace"];
    let output = rtr(folder.path(), &args);
    let said = text(&output.stdout);
    assert_eq!(output.status.code(), Some(0), "{said}{}", text(&output.stderr));
    let rays: Vec<&str> = said.lines().skip_while(|line| !line.starts_with("ray 0")).collect();
    [rays[1].to_owned(), rays[2].to_owned()]
}

/// The line of `text` that declares `name`, from 1.
fn line_of(text: &str, name: &str) -> usize {
    let declares = |line: &str| line.starts_with(&format!("material {name}:"));
    1 + text.lines().position(declares).expect("it is declared")
}

#[test]
fn a_trace_names_materials_and_the_lines_that_declare_them() {
    // The same scene with the two declarations in each other's place.
    let lines: Vec<&str> = WALLS.lines().collect();
    let mut other = lines.clone();
    other.swap(2, 4);
    for scene in [WALLS.to_owned(), other.join("\n") + "\n"] {
        for (x, name, absent) in [(1, "brick", "moss"), (6, "moss", "brick")] {
            let met = format!("meets {name} (walls.rts:{}), triangle ", line_of(&scene, name));
            for ray in first_ray(&scene, x) {
                assert!(ray.contains(&met) && !ray.contains(absent), "{met}: {ray}");
            }
        }
    }
    assert_eq!((line_of(WALLS, "brick"), line_of(WALLS, "moss")), (3, 5));
}

#[test]
fn a_trace_tells_places_in_the_world_in_metres() {
    // The walls lie at y = 7, the camera is 5 m above them.
    let scene = WALLS
        .replace("at = (-1, 0, 0)m", "at = (99, 7, 3)m")
        .replace("at = (1, 0, 0)m", "at = (101, 7, 3)m")
        .replace("from = (0, 5, 0)m, to = (0, 0, 0)m", "from = (100, 12, 3)m, to = (100, 7, 3)m");
    for ray in first_ray(&scene, 1) {
        let numbers = |after: &str| -> Vec<f64> {
            let text = ray.split(after).nth(1).expect("it is said");
            let text = text.trim_start_matches('(').split([')', 'm']).next().expect("text");
            text.split_whitespace().map(|n| n.parse().expect("a number")).collect()
        };
        let (from, along, at) = (numbers(" from "), numbers(" along "), numbers(" at "));
        for (found, expected) in from.iter().zip([100.0, 12.0, 3.0]) {
            assert!((found - expected).abs() < 1e-4, "{ray}");
        }
        assert!((from[1] + at[0] * along[1] - 7.0).abs() < 1e-4, "{ray}");
    }
}

#[test]
fn wrong_arguments_are_usage() {
    let folder = folder();
    for args in [
        &["check"] as &[&str],
        &["check", "marbles.pack", "--pixel", "72,0"],
        &["check", "marbles.pack", "--pixel", "7"],
        &["check", "marbles.pack", "--trace"],
        &["check", "marbles.pack", "--spp", "0"],
    ] {
        let output = rtr(folder.path(), args);
        assert_eq!(output.status.code(), Some(2), "{args:?}");
        assert!(!output.stderr.is_empty(), "{args:?}");
    }
    let missing = rtr(folder.path(), &["check", "none.pack"]);
    assert_eq!(missing.status.code(), Some(3));
}

#[test]
fn a_pixel_is_picked_as_text_and_as_json() {
    let folder = folder();
    let pick = |more: &[&str]| rtr(folder.path(), &[&["marbles.pack", "--pick"], more].concat());
    let said = text(&pick(&["36,5"]).stdout);
    assert!(said.starts_with("pixel 36,5 of 72x40: the sky"), "{said}");
    let output = pick(&["36,35", "--json"]);
    let found: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
    assert_eq!(found["pixel"], serde_json::json!([36, 35]));
    assert!(found["surface"]["distance"].as_f64().is_some_and(|metres| metres > 0.0), "{found}");
    let output = pick(&["72,0"]);
    assert_eq!(output.status.code(), Some(2));
    assert_eq!(text(&output.stderr), "error: pixel 72,0 is not in the image of 72x40 pixels\n");
}
