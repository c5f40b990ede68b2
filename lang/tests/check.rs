//! Checking: what is said about scenes that are wrong, and what scenes that are right become.
//!
//! Cases are data in `tests/check/*.rts`: `--- name`, the expected diagnostics as comments, then the
//! text. A line `=== path` starts another file of the case, a line `// -D name=value` is a
//! definition. A case whose name does not end in `(whole)` gets a camera, a sky and a render behind
//! it. `UPDATE=1 cargo test -p lang` writes the diagnostics as they are; review the difference.

mod common;

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use common::{ROOT, apply, check_files, describe};
use lang::diagnostic::Applicability;

/// Makes a scene of any declarations.
const TAIL: &str = "sky tail_sky: constant { }
camera tail_camera: perspective { from = (0, 1, 5)m, to = (0, 1, 0)m }
render tail_render: path { camera = tail_camera, sky = tail_sky }
";

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/check")
}

fn read(name: &str) -> String {
    std::fs::read_to_string(folder().join(name)).expect("the test's own file")
}

/// One case: its files and definitions.
struct Case<'a> {
    title: &'a str,
    expected: &'a str,
    body: &'a str,
    files: BTreeMap<String, String>,
    defines: Vec<(String, String)>,
}

fn cases(text: &str) -> Vec<Case<'_>> {
    text.split("--- ")
        .skip(1)
        .map(|case| {
            let (title, rest) = case.split_once('\n').expect("a line with the name");
            let is_header = |line: &&str| {
                ["// Error:", "// Warning:", "//   "].iter().any(|start| line.starts_with(start))
            };
            let header = rest.split_inclusive('\n').take_while(is_header).map(str::len).sum();
            let (expected, body) = rest.split_at(header);
            let mut parts = body.split("=== ");
            let mut root = parts.next().unwrap_or("").to_owned();
            if !title.ends_with("(whole)") {
                root.push_str(TAIL);
            }
            let mut files = BTreeMap::from([(ROOT.to_owned(), root)]);
            for part in parts {
                let (name, text) = part.split_once('\n').expect("a line with the path");
                files.insert(name.to_owned(), text.to_owned());
            }
            let defines = body
                .lines()
                .filter_map(|line| line.strip_prefix("// -D "))
                .map(|define| define.split_once('=').expect("name=value"))
                .map(|(name, value)| (name.to_owned(), value.to_owned()))
                .collect();
            Case { title, expected, body, files, defines }
        })
        .collect()
}

/// Checks every case of a file; with `UPDATE=1`, rewrites it.
fn check_cases(name: &str) {
    let text = read(name);
    let mut rewritten = String::new();
    for case in cases(&text) {
        let found = describe(&check_files(&case.files, &case.defines));
        let _ = write!(rewritten, "--- {}\n{found}{}", case.title, case.body);
        if std::env::var_os("UPDATE").is_none() {
            assert_eq!(case.expected, found, "case `{}` of {name}", case.title);
        }
    }
    if std::env::var_os("UPDATE").is_some() {
        std::fs::write(folder().join(name), rewritten).expect("the test's own file");
    }
}

fn all_files() -> Vec<String> {
    let entries = std::fs::read_dir(folder()).expect("the test's own folder");
    let mut names: Vec<String> =
        entries.filter_map(|entry| entry.ok()?.file_name().into_string().ok()).collect();
    names.sort();
    names
}

#[test]
fn faults_are_worded_and_placed() {
    for name in all_files() {
        check_cases(&name);
    }
}

#[test]
fn sure_fixes_cure_what_they_fix_and_break_nothing() {
    let mut n_fixes = 0;
    for name in all_files() {
        for case in cases(&read(&name)) {
            let before = check_files(&case.files, &case.defines);
            for diagnostic in &before.diagnostics {
                for fix in &diagnostic.fixes {
                    if fix.applicability != Applicability::MachineApplicable {
                        continue;
                    }
                    n_fixes += 1;
                    let files = apply(&before.sources, &case.files, fix);
                    if files == case.files {
                        continue; // the command line is no file to edit
                    }
                    let after = check_files(&files, &case.defines);
                    let same = |other: &&lang::diagnostic::Diagnostic| {
                        other.code == diagnostic.code && other.message == diagnostic.message
                    };
                    let count =
                        |list: &[lang::diagnostic::Diagnostic]| list.iter().filter(same).count();
                    let title = format!("case `{}` of {name}: {}", case.title, diagnostic.message);
                    assert!(
                        count(&after.diagnostics) < count(&before.diagnostics),
                        "not cured: {title}\n{}",
                        describe(&after)
                    );
                    let syntax = |list: &[lang::diagnostic::Diagnostic]| {
                        list.iter().filter(|d| d.code.0.starts_with("E01")).count()
                    };
                    let (was, is) = (syntax(&before.diagnostics), syntax(&after.diagnostics));
                    assert!(is <= was, "broken: {title}");
                }
            }
        }
    }
    assert!(n_fixes > 20, "{n_fixes} sure fixes in all cases");
}

#[test]
fn every_code_has_a_case() {
    let mut found = BTreeSet::new();
    for name in all_files() {
        for case in cases(&read(&name)) {
            let analysis = check_files(&case.files, &case.defines);
            found.extend(analysis.diagnostics.iter().map(|d| d.code.0));
        }
    }
    // Faults of files are found by the compiler, and tested there.
    let of_files = |code: &str| {
        let elsewhere =
            |page: String| page.contains("```rts files") || page.contains("```rts compiled");
        code.starts_with("W052") || lang::explain(code).is_some_and(elsewhere)
    };
    let here = lang::codes().filter(|code| !code.starts_with("E01") && !of_files(code));
    let missing: Vec<&str> = here.filter(|code| !found.contains(code)).collect();
    assert_eq!(missing, Vec::<&str>::new(), "codes without a case");
    let unexplained: Vec<&&str> =
        found.iter().filter(|code| lang::explain(code).is_none()).collect();
    assert_eq!(unexplained, Vec::<&&str>::new(), "codes without a page");
}
