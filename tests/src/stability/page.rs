//! Cases → `docs/stability.md`.

use std::fmt::Write as _;

use super::{Case, Row, cases, heavy};

/// Measures everything and writes the page.
#[must_use]
pub fn page() -> String {
    let measured: Vec<(Case, Vec<Row>)> =
        cases().into_iter().map(|case| (case, (case.measure)())).collect();
    let mut text = header(&measured);
    for (case, rows) in &measured {
        section(case, rows, &mut text);
    }
    text
}

fn header(measured: &[(Case, Vec<Row>)]) -> String {
    let rows = || measured.iter().flat_map(|(_, rows)| rows);
    let holds = rows().filter(|row| row.holds).count();
    let whole = measured.iter().filter(|(_, rows)| rows.iter().all(|row| row.holds)).count();
    let mut text = format!(
        "# Stability\n\n\
        Made by `cargo run --release -p tests --bin stability`; edit the program, not this page. Seeds are \
        fixed: every run gives the same numbers. `cargo test -p tests --test extreme` asserts them.\n\n\
        {} inputs at the edge of what numbers can hold, each with what must come out and what does, in the \
        kernel's single precision and in its twin in double precision. A value that does not hold is kept \
        here with its reason, and the test fails as soon as it does hold. \"se\" is the standard error of a \
        mean, written after ±; tolerances are written after ± in the column of what must come out. To see \
        where a scene of your own loses precision, run `rtr check scene.pack`.\n\n\
        {whole} of {} cases hold in every row; {holds} of {} rows hold.\n",
        measured.len(),
        measured.len(),
        rows().count(),
    );
    let open: Vec<&str> = measured
        .iter()
        .filter(|(_, rows)| rows.iter().any(|row| !row.holds))
        .map(|(case, _)| case.id)
        .collect();
    let _ = writeln!(text, "\nWith a row that does not hold: {}.", open.join(", "));
    text
}

fn section(case: &Case, rows: &[Row], text: &mut String) {
    let Case { id, input, must, .. } = case;
    let _ = write!(
        text,
        "\n## {id}: {input}\n\nMust hold: {must}.\n\n| measured | expected | f32 | f64 | |\n|---|---|---|---|---|\n"
    );
    for row in rows {
        let Row { what, expected, single, double, holds, known } = row;
        let verdict = match (holds, known) {
            (true, _) => "holds".to_owned(),
            (false, Some(why)) => format!("**does not hold**: {why}"),
            (false, None) => "**does not hold**".to_owned(),
        };
        let cells = [what, expected, single, double, &verdict].map(|cell| cell.replace('|', "\\|"));
        let _ = writeln!(text, "| {} |", cells.join(" | "));
    }
    let results = std::fs::read_to_string(heavy::results()).unwrap_or_default();
    for (of, what, expected, _) in heavy::HEAVY.iter().filter(|(of, ..)| of == id) {
        let line = results.lines().find_map(|line| line.strip_prefix(&format!("{of}\t{what}\t")));
        let mut cells = line.unwrap_or_default().split('\t').skip(1);
        let (found, verdict) = (cells.next().unwrap_or("not measured"), cells.next().unwrap_or(""));
        let _ = writeln!(text, "| {what} (`--heavy`) | {expected} | {found} | - | {verdict} |");
    }
}
