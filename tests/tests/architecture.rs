//! The arrows between crates are a promise: any other is a failure here.

use std::collections::{BTreeMap, BTreeSet};

use cargo_metadata::{DependencyKind, Metadata, MetadataCommand};

/// Crate, what it may use when it runs, what only its build script may use.
const ARROWS: &[(&str, &[&str], &[&str])] = &[
    ("lang", &[], &[]),
    ("files", &[], &[]),
    ("pack", &["files"], &[]),
    ("native", &["naga"], &[]),
    ("shaders", &["pack", "naga"], &[]),
    ("compiler", &["lang", "shaders", "pack", "files"], &[]),
    ("commit", &[], &[]),
    ("runtime", &["pack", "files", "commit", "wgpu"], &["pack", "shaders", "native"]),
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
