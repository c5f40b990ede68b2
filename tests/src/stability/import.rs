//! Meshes as files bring them: without area, with numbers that are none.

use std::fmt::Write as _;
use std::path::Path;

use super::tools::{diagnose, shot};
use super::{Case, Row};

/// The cases of this file.
pub const CASES: &[Case] = &[Case {
    id: "X15",
    input: "OBJ with NaN, Inf, 1e39; index 0, out of range, negative; no faces; a line of 1e7 characters",
    must: "an error with file and line, no panic",
    measure: bad_files,
}];

fn scene() -> String {
    format!(
        "sky heaven: constant {{ color = linear(1) }}
asset thing = obj(\"thing.obj\", unit: m, up: +y)
material m: diffuse {{ color = linear(0.5) }}
instance it {{ shape = thing, material = m }}
{}",
        shot([0.0, 0.0, 5.0], [0.0; 3], 40.0, 2)
    )
}

/// Compiles a scene of one OBJ file; what was said, and triangles if there is a pack.
fn compiled(obj: &str) -> (Option<usize>, String) {
    let dir = tempfile::tempdir().expect("a temporary directory can be made");
    std::fs::write(dir.path().join("thing.obj"), obj).expect("writable");
    let (compiled, said) = diagnose(dir.path(), &scene());
    (compiled.map(|c| c.lowered.triangles.len()), said)
}

/// What the importer does with triangles without area.
pub(super) fn no_area() -> Vec<Row> {
    let obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 2 0 0\nf 1 2 3\nf 1 1 1\nf 1 2 4\n";
    let (triangles, said) = compiled(obj);
    let counted = said.contains('2') && said.contains("area");
    vec![
        Row::fact(
            "triangles left of a good one and two without area",
            "1",
            &triangles.map_or("error".to_owned(), |n| n.to_string()),
            triangles == Some(1),
        ),
        Row::fact("they are reported", "2, with file and line", &without_folder(&said), counted),
    ]
}

/// The first line of what was said, its paths without their folders.
fn without_folder(said: &str) -> String {
    let line = &super::tools::first_error(said);
    let word = |w: &str| {
        let rest = w.rsplit('/').next().unwrap_or(w);
        if Path::new(w.trim_start_matches('`')).is_absolute() {
            rest.to_owned()
        } else {
            w.to_owned()
        }
    };
    let text: String = line.split(' ').map(word).collect::<Vec<_>>().join(" ");
    text.replace('|', "/")
}

fn bad_files() -> Vec<Row> {
    let good = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    let mut long = String::from(good);
    long.push_str("f 1 2 3");
    long.push_str(&" ".repeat(5_000_000));
    long.push_str(&"9".repeat(5_000_000));
    long.push('\n');
    let mut files = vec![("a line of 1e7 characters".to_owned(), long, Some(4))];
    for number in ["nan", "inf", "1e39"] {
        files.push((
            number.into(),
            format!("v 0 0 0\nv {number} 0 0\nv 0 1 0\nf 1 2 3\n"),
            Some(2),
        ));
    }
    for index in ["0", "4", "-4", "99999999999999999999"] {
        files.push((format!("index {index}"), format!("{good}f 1 2 {index}\n"), Some(4)));
    }
    files.push(("no faces".into(), good.into(), None));
    let mut rows = Vec::new();
    for (name, obj, line) in files {
        let (triangles, said) = compiled(&obj);
        let mut place = String::from("thing.obj");
        if let Some(line) = line {
            let _ = write!(place, ":{line}");
        }
        let holds = triangles.is_none() && said.contains("error[") && said.contains(&place);
        let shown: String = without_folder(&said).chars().take(140).collect();
        rows.push(Row::fact(name, &format!("error at {place}"), &shown, holds));
    }
    rows
}
