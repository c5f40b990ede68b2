//! A name becomes what has it in a mesh file.

use lang::diagnostic::{Code, Diagnostic};
use lang::scene::{FileBase, Scene};

use crate::lower::edited::listed;

/// Indices of what has the name of `base`: exactly, else whatever the case.
pub(super) fn named<'a>(
    (scene, base): (&Scene, &FileBase),
    what: &str,
    names: impl Iterator<Item = &'a str> + Clone,
) -> Result<Vec<usize>, Box<Diagnostic>> {
    let wanted = &base.name.text;
    let find = |same: &dyn Fn(&str) -> bool| -> Vec<usize> {
        let found = names.clone().enumerate().filter(|(_, name)| same(name));
        found.map(|(index, _)| index).collect()
    };
    let exact = find(&|name| name == wanted);
    let lower = wanted.to_lowercase();
    let found = if exact.is_empty() { find(&|name| name.to_lowercase() == lower) } else { exact };
    if !found.is_empty() {
        return Ok(found);
    }
    let asset = &scene.assets[base.asset];
    let text = format!("`{}` has no {what} named `{wanted}`", asset.name.text);
    let error = Diagnostic::error(Code("E0521"), text)
        .at(base.name.span, "not in the file")
        .because(asset.path_span, "the file");
    let known: Vec<&str> = names.filter(|name| !name.is_empty()).collect();
    Err(Box::new(listed(error, (what, wanted, base.name.span), known)))
}
