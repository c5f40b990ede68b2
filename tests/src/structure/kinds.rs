//! The patch of a made-up material and the recipes of ARCHITECTURE.md become the files that a new kind touches.

use std::fs;
use std::path::Path;

/// The patch that `.ci/new-kind` applies.
const PATCH: &str = "tests/new_kind/velvet.patch";
/// Has the recipes.
const RECIPES: &str = "ARCHITECTURE.md";

/// How a kind is added.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Recipe {
    /// Number of files that the heading states.
    pub stated: usize,
    /// The file that each numbered line begins with.
    pub files: Vec<String>,
}

/// Files that the patch of a new material changes; nothing where there is no patch.
#[must_use]
pub fn new_material(tree: &Path) -> Option<Vec<String>> {
    let text = fs::read_to_string(tree.join(PATCH)).ok()?;
    Some(text.lines().filter_map(|line| line.strip_prefix("+++ b/")).map(str::to_owned).collect())
}

/// The recipe for a new `kind`; nothing where there is none.
#[must_use]
pub fn recipe(tree: &Path, kind: &str) -> Option<Recipe> {
    let text = fs::read_to_string(tree.join(RECIPES)).ok()?;
    let mut lines = text.lines();
    let heading = lines.find(|line| line.starts_with(&format!("**Add a {kind}**")))?;
    let stated = heading.split_once(" files").and_then(|(before, _)| {
        before.rsplit(|mark: char| !mark.is_ascii_digit()).next()?.parse().ok()
    })?;
    let items = lines.skip_while(|line| line.is_empty()).map_while(|line| {
        let (number, item) = line.split_once(". ")?;
        number.parse::<usize>().ok()?;
        Some(item.split('`').nth(1).unwrap_or_default().to_owned())
    });
    Some(Recipe { stated, files: items.collect() })
}
