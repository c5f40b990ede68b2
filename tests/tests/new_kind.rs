//! What a new kind costs, and that a kind is known wherever it must be.
//!
//! `tests/new_kind/velvet.patch` adds a made-up material to this tree. Here it must still apply and stay small;
//! `.ci/new-kind` builds it in a copy of the tree and renders it on the CPU and on the software adapter.

use std::collections::BTreeSet;
use std::process::Command;

use lang::schema::Kind;
use pack::abi::{LightKind, Lobes, MaterialKind, SamplerKind, SkyKind};

const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/..");
const PATCH: &str = "tests/new_kind/velvet.patch";

/// Most files that are written by hand for a new material.
const MOST_FILES: usize = 5;

#[test]
fn a_new_material_is_at_most_five_files() {
    let text = std::fs::read_to_string(format!("{ROOT}/{PATCH}")).expect("the patch is there");
    let files: Vec<&str> = text.lines().filter_map(|line| line.strip_prefix("+++ b/")).collect();
    assert!((1..=MOST_FILES).contains(&files.len()), "{files:?}");
    let git = Command::new("git").args(["apply", "--check", PATCH]).current_dir(ROOT).output();
    let git = git.expect("git can be started");
    let fault = String::from_utf8_lossy(&git.stderr);
    assert!(git.status.success(), "`.ci/new-kind --edit` makes the patch anew\n{fault}");
}

/// Whether the module has all of these functions; the fault names what lacks.
fn lacks(module: &str, functions: &[String]) -> Vec<String> {
    let Some((_, text)) = shaders::module_texts().iter().find(|row| row.0 == module) else {
        return vec![format!("shaders/wgsl/{module} is not there")];
    };
    let lacking = functions.iter().filter(|function| !text.contains(&format!("fn {function}(")));
    lacking.map(|function| format!("shaders/wgsl/{module} has no `{function}`")).collect()
}

fn named(stem: &str, suffixes: &[&str]) -> Vec<String> {
    suffixes.iter().map(|suffix| format!("{stem}_{suffix}")).collect()
}

#[test]
fn every_kind_has_its_functions() {
    let mut wrong = Vec::new();
    for kind in MaterialKind::ALL {
        let (stem, traits) = (kind.stem(), kind.traits());
        let mut functions = Vec::new();
        if !traits.generated {
            functions = named(&stem, &["sample", "eval"]);
        }
        if traits.pattern {
            functions.push(format!("{stem}_pattern"));
        }
        functions.extend(traits.straight.filter(|_| !traits.generated).map(str::to_owned));
        wrong.extend(lacks(&format!("bsdf/{stem}.wgsl"), &functions));
        if traits.lobes == Lobes::None && !traits.numbers.is_empty() {
            wrong.push(format!("`{stem}` scatters nothing and takes random numbers"));
        }
    }
    for stem in LightKind::ALL.map(LightKind::stem) {
        wrong.extend(lacks(&format!("light/{stem}.wgsl"), &named(&stem, &["light_sample"])));
    }
    for stem in SkyKind::ALL.map(SkyKind::stem) {
        wrong.extend(lacks(&format!("sky/{stem}.wgsl"), &named(&stem, &["radiance"])));
    }
    for stem in SamplerKind::ALL.map(SamplerKind::stem) {
        wrong.extend(lacks(&format!("sampler/{stem}.wgsl"), &named(&stem, &["1d", "2d"])));
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// One name ties the language's half of a kind to the pack's.
#[test]
fn the_language_and_the_pack_have_the_same_kinds() {
    fn types(kind: Kind) -> BTreeSet<String> {
        lang::schema::types_of(kind).iter().map(|schema| schema.name.to_owned()).collect()
    }
    let mut materials: BTreeSet<String> = MaterialKind::ALL.map(MaterialKind::stem).into();
    // `dielectric` with a roughness.
    materials.remove("rough_dielectric");
    assert_eq!(types(Kind::Material), materials, "lang/src/material.rs, pack/src/abi/material.rs");
    let skies: BTreeSet<String> = SkyKind::ALL.map(SkyKind::stem).into();
    let mut declared = types(Kind::Sky);
    // An image and a directional light.
    assert!(declared.remove("sun_sky"));
    assert_eq!(declared, skies, "lang/src/sky.rs, pack/src/abi/sky.rs");
}
