//! The commit of this checkout → `BUILT_FROM`, if there is one to be known.
//!
//! `RTR_COMMIT` wins. Otherwise git is asked, in a release build only: a development build is of a tree that is being
//! edited, and must not be made again for every commit. This is a crate of its own because the build script of
//! `runtime` translates the kernel, which takes much longer than to ask.

#[path = "src/ask.rs"]
mod ask;

use std::env;
use std::path::Path;

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-changed=src/ask.rs");
    println!("cargo::rerun-if-env-changed=RTR_COMMIT");
    let told = env::var("RTR_COMMIT").ok().filter(|text| !text.trim().is_empty());
    let release = env::var("PROFILE").is_ok_and(|profile| profile == "release");
    let commit = match told {
        Some(text) => text.lines().next().map(|line| line.trim().to_owned()),
        None if release => asked(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")),
        None => None,
    };
    if let Some(commit) = commit {
        println!("cargo::rustc-env=BUILT_FROM={commit}");
    }
}

/// What git says, and when it is to be asked again: after a commit or a checkout, and when something that `rtr` is
/// made of has changed, after which `rtr` is built again anyway.
fn asked(root: &Path) -> Option<String> {
    let (commit, log) = ask::git(root)?;
    println!("cargo::rerun-if-changed={}", log.display());
    for path in ask::SOURCES {
        println!("cargo::rerun-if-changed={}", root.join(path).display());
    }
    Some(commit)
}
