//! Warns of light groups of things that give off no light.

use std::collections::BTreeMap;

use super::instance::Placed;
use super::material;
use crate::diagnostic::{Code, Diagnostic};
use crate::resolve::ItemId;
use crate::scene::Material;
use crate::source::Span;

/// Warnings of groups that are written where nothing gives off light. A mesh that brings its own materials may.
pub(super) fn groups<'m>(
    placed: &[Placed],
    material: impl Fn(ItemId) -> Option<&'m Material>,
) -> Vec<Diagnostic> {
    // By place: one that stands for many instances counts once.
    let mut emits: BTreeMap<Span, (bool, Option<Span>)> = BTreeMap::new();
    for thing in placed {
        let Some((_, span)) = &thing.group else { continue };
        let (emits, because) = emits.entry(*span).or_default();
        *emits |= match thing.material {
            Some((id, _)) => material(id).is_some_and(material::emits),
            None => true,
        };
        *because = because.or(thing.material.map(|(_, span)| span));
    }
    let dark = emits.into_iter().filter(|(_, (emits, _))| !emits);
    dark.map(|(span, (_, because))| {
        let text = "`group` has no effect: nothing that has it gives off light";
        let warning = Diagnostic::warning(Code("W0404"), "no_effect", text)
            .at(span, "a light group is of what gives off light")
            .with_help("give it an `emissive` material, or leave `group` out");
        match because {
            Some(because) => warning.because(because, "made of this"),
            None => warning,
        }
    })
    .collect()
}
