//! The arrows between crates are a promise: any other is a failure here.

use std::collections::{BTreeMap, BTreeSet};

use cargo_metadata::{DependencyKind, Metadata, MetadataCommand};

/// Crate, what it may use when it runs, what only its build script may use.
const ARROWS: &[(&str, &[&str], &[&str])] = &[
    ("host", &[], &[]),
    ("lang", &[], &[]),
    ("files", &[], &[]),
    ("pack", &["files"], &[]),
    ("native", &["naga"], &[]),
    ("shaders", &["pack", "naga"], &[]),
    ("compiler", &["host", "lang", "shaders", "pack", "files"], &[]),
    ("commit", &[], &[]),
    ("kernel_f32", &["pack"], &["shaders", "native"]),
    ("kernel_f64", &[], &["shaders", "native"]),
    ("kernel_target", &[], &[]),
    ("kernel_avx2", &["kernel_f32", "kernel_target"], &["shaders", "native"]),
    ("kernel_avx512", &["kernel_f32", "kernel_target"], &["shaders", "native"]),
    (
        "runtime",
        &[
            "host",
            "pack",
            "files",
            "commit",
            "kernel_f32",
            "kernel_f64",
            "kernel_avx2",
            "kernel_avx512",
            "wgpu",
        ],
        &["pack", "shaders"],
    ),
    ("scenes", &["compiler", "runtime", "files"], &[]),
];

fn metadata() -> Metadata {
    MetadataCommand::new()
        .manifest_path(concat!(env!("CARGO_MANIFEST_DIR"), "/../Cargo.toml"))
        .no_deps()
        .exec()
        .expect("cargo metadata runs wherever cargo test runs")
}

/// Watched dependencies of each workspace member, by kind; development ones are free.
fn dependencies(metadata: &Metadata, kind: DependencyKind) -> BTreeMap<String, BTreeSet<String>> {
    let watched: BTreeSet<&str> =
        ARROWS.iter().map(|row| row.0).chain(["naga", "wgpu", "tests"]).collect();
    let of = |package: &cargo_metadata::Package| {
        let names = package.dependencies.iter().filter(|d| d.kind == kind).map(|d| d.name.clone());
        names.filter(|name| watched.contains(name.as_str())).collect()
    };
    metadata.packages.iter().map(|p| (p.name.to_string(), of(p))).collect()
}

fn forbidden(found: &BTreeSet<String>, allowed: &[&str]) -> Vec<String> {
    found.iter().filter(|name| !allowed.contains(&name.as_str())).cloned().collect()
}

#[test]
fn no_crate_uses_another_that_it_may_not_know() {
    let metadata = metadata();
    let normal = dependencies(&metadata, DependencyKind::Normal);
    let build = dependencies(&metadata, DependencyKind::Build);
    for (name, runs_with, builds_with) in ARROWS {
        let extra = forbidden(&normal[*name], runs_with);
        assert!(extra.is_empty(), "`{name}` must not depend on {extra:?}");
        let extra = forbidden(&build[*name], builds_with);
        assert!(extra.is_empty(), "the build script of `{name}` must not depend on {extra:?}");
    }
}

#[test]
fn every_member_has_its_arrows_listed() {
    let listed: BTreeSet<&str> = ARROWS.iter().map(|row| row.0).chain(["tests"]).collect();
    for package in &metadata().packages {
        assert!(listed.contains(package.name.as_str()), "`{}` has no row here", package.name);
    }
}

#[test]
fn a_forbidden_arrow_is_caught() {
    let found = BTreeSet::from(["lang".to_string(), "pack".to_string()]);
    assert_eq!(forbidden(&found, &["pack", "wgpu"]), ["lang"]);
}

/// Crates whose comments hold no examples say so, which spares rustdoc a pass over each of them.
#[test]
fn examples_in_comments_are_run() {
    for package in &metadata().packages {
        let library =
            package.targets.iter().find(|target| target.is_lib() || target.is_proc_macro());
        let library = library.expect("a library");
        let folder = library.src_path.parent().expect("src");
        assert!(
            library.doctest || !has_example(folder.as_std_path()),
            "`{}`: `doctest = false`",
            package.name
        );
    }
}

/// Whether a comment holds Rust that rustdoc would run.
fn has_example(folder: &std::path::Path) -> bool {
    std::fs::read_dir(folder).expect("a folder of sources").any(|entry| {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            return has_example(&path);
        }
        let text = std::fs::read_to_string(&path).unwrap_or_default();
        let is_rust = path.extension().is_some_and(|extension| extension == "rs");
        is_rust && holds_example(&text)
    })
}

fn holds_example(text: &str) -> bool {
    let comments = text.lines().filter_map(|line| {
        let line = line.trim_start();
        line.strip_prefix("///").or_else(|| line.strip_prefix("//!"))
    });
    // Every second fence closes a block.
    let fences = comments.filter_map(|line| line.trim_start().strip_prefix("```"));
    fences.step_by(2).any(|kind| ["", "rust", "no_run", "should_panic"].contains(&kind.trim()))
}

#[test]
fn an_example_is_seen() {
    assert!(holds_example("/// ```text\n/// x\n/// ```\n/// ```no_run\n/// f();\n/// ```\n"));
    assert!(!holds_example("/// ```text\n/// x\n/// ```\nlet a = \"```\";\n"));
}
