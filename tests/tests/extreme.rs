//! The 53 cases of `docs/stability.md`: each row holds, or is known not to and still does not.

use std::path::Path;

use tests::console;
use tests::stability::{cases, heavy};

fn check(group: std::ops::RangeInclusive<u32>) {
    let mut failures = Vec::new();
    for case in cases() {
        let number: u32 = case.id[1..].parse().expect("an id is X and a number");
        if !group.contains(&number) {
            continue;
        }
        for row in (case.measure)() {
            let what = format!("{} {}", case.id, row.what);
            console::line(&format!("{what}: {} | {} | {}", row.expected, row.single, row.double));
            failures.extend(row.judge().err().map(|error| format!("{}: {error}", case.id)));
        }
    }
    assert!(failures.is_empty(), "\n{}", failures.join("\n"));
}

macro_rules! groups {
    ($($name:ident: $range:expr;)*) => { $(#[test] fn $name() { check($range); })* };
}

groups! {
    needles_and_copies_of_triangles: 1..=4;
    planes_and_places: 5..=9;
    rays_at_edges_and_far_away: 10..=14;
    files_open_meshes_and_motion: 15..=20;
    indices_and_roughness: 21..=27;
    patterns_and_textures: 28..=32;
    media_from_nothing_to_opaque: 33..=37;
    phases_fog_and_water: 38..=41;
    lights: 42..=45;
    long_paths: 46..=48;
    dark_large_and_cut_short: 49..=53;
}

#[test]
fn there_are_53_cases_and_the_page_has_them() {
    let ids: Vec<&str> = cases().iter().map(|case| case.id).collect();
    let expected: Vec<String> = (1..=53).map(|i| format!("X{i:02}")).collect();
    assert_eq!(ids, expected);
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/stability.md");
    let page = std::fs::read_to_string(page).expect("the page is there");
    for case in cases() {
        assert!(page.contains(&format!("\n## {}: {}\n", case.id, case.input)), "{}", case.id);
    }
}

#[test]
fn heavy_measurements_were_made_as_they_are_said_to_be() {
    let results = std::fs::read_to_string(heavy::results()).unwrap_or_default();
    for line in results.lines() {
        let cells: Vec<&str> = line.split('\t').collect();
        let known = heavy::HEAVY
            .iter()
            .any(|(id, what, expected, _)| cells[..3] == [*id, *what, *expected]);
        assert!(known && cells.len() == 5, "no measurement makes this line: {line}");
    }
}
