//! Mixes of materials: which materials can be mixed, and that none is mixed from itself.

use std::collections::{BTreeMap, BTreeSet};

use super::fields::Fields;
use crate::diagnostic::{Code, Diagnostic};
use crate::eval::Evaluator;
use crate::material::{Reader, Traits as _};
use crate::resolve::{ItemId, item_kind};
use crate::scene::MaterialModel;
use crate::schema::Kind;

/// Name of the type of materials that are mixes.
const MIX: &str = "mix";

/// The fields of a mix that name materials.
const PARTS: [&str; 2] = ["a", "b"];

/// The materials that a mix is made of; none for others.
pub(super) fn parts(fields: &Fields) -> impl Iterator<Item = ItemId> {
    let names = if fields.schema.name == MIX { PARTS.as_slice() } else { &[] };
    names.iter().filter_map(|name| fields.item(name))
}

/// These materials and all that they are mixed from.
pub(super) fn with_parts(
    used: BTreeSet<ItemId>,
    fields: &BTreeMap<ItemId, Fields>,
) -> BTreeSet<ItemId> {
    let mut all = BTreeSet::new();
    let mut left: Vec<ItemId> = used.into_iter().collect();
    while let Some(id) = left.pop() {
        if all.insert(id) {
            left.extend(fields.get(&id).into_iter().flat_map(parts));
        }
    }
    all
}

/// Checks the parts of all mixes.
pub(super) fn check(ev: &mut Evaluator<'_>, checked: &BTreeMap<ItemId, Fields>) {
    for (id, fields) in checked.iter().filter(|(_, fields)| fields.schema.name == MIX) {
        for name in PARTS {
            let (Some(part), Some(at)) = (fields.item(name), fields.value_span(name)) else {
                continue;
            };
            let shown = ev.program.name(part).to_owned();
            if with_parts([part].into(), checked).contains(id) {
                let name = ev.program.name(*id);
                let text = format!("`{name}` is mixed from itself");
                let error = Diagnostic::error(Code("E0212"), text).at(at, "leads back to it");
                ev.fault(error.because(ev.program.name_span(*id), "declared here"));
            } else if let Some(reason) = why_not(ev, checked, part) {
                let text = format!("`{shown}` cannot be mixed with another material");
                let error = Diagnostic::error(Code("E0534"), text)
                    .at(at, reason)
                    .because(ev.program.name_span(part), "declared here")
                    .with_help("mix materials that only reflect or scatter light at their surface");
                ev.fault(error);
            }
        }
    }
}

/// Why the material cannot be part of a mix.
fn why_not(
    ev: &Evaluator<'_>,
    checked: &BTreeMap<ItemId, Fields>,
    id: ItemId,
) -> Option<&'static str> {
    // What is like a material of a file is looked at when the file has been read.
    let fields = checked.get(&id).filter(|fields| fields.ok && fields.of_file.is_none())?;
    // Only traits are asked, which depend on no index.
    let program = ev.program;
    let all = |kind| {
        let ids = program.ids().filter(|id| item_kind(program.item(*id)) == Some(kind));
        ids.map(|id| (id, 0)).collect()
    };
    let (media, materials) = (all(Kind::Medium), all(Kind::Material));
    let (textures, expressions) = (&|_| 0, &|_: &_| 0);
    let reader = Reader { fields, textures, expressions, media: &media, materials: &materials };
    MaterialModel::read(&reader)?.unmixable()
}
