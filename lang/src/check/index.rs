//! An index where there can be none becomes a diagnostic.

use crate::diagnostic::{Code, Diagnostic};
use crate::eval::Evaluator;
use crate::resolve::ItemId;
use crate::schema::Kind;

/// Reports an index on anything but an instance.
pub(super) fn refuse_index(ev: &mut Evaluator<'_>, kind: Kind, id: ItemId) -> bool {
    let Some(index) = ev.program.decl(id).and_then(|decl| decl.index.as_ref()) else {
        return false;
    };
    let text = format!("{} cannot have an index", kind.with_article());
    let error = Diagnostic::error(Code("E0802"), text);
    ev.fault(error.at(index.span, "only instances have one"));
    true
}
