//! What seems to be missing, or without effect, where a field is misspelt or could not be read, is not reported: that
//! field is what is missing.

use crate::diagnostic::{Code, Diagnostic};
use crate::eval::Evaluator;
use crate::source::Span;

/// Codes of a field that is missing, and of one that has no effect.
const FOLLOWERS: [Code; 2] = [Code("E0207"), Code("W0404")];

/// Leaves out that a field is missing or has no effect wherever a declaration has fields that are not known.
pub(super) fn leave_out(ev: &mut Evaluator<'_>) {
    let program = ev.program;
    let unsure: Vec<Span> = (program.ids())
        .filter(|id| ev.is_unsure(*id))
        .filter_map(|id| program.decl(id))
        .map(|decl| decl.kind_span.to(decl.block))
        .collect();
    let holds = |outer: &Span, inner: Span| outer.to(inner) == *outer;
    let follows = |error: &Diagnostic| {
        let mut places = error.labels.iter().map(|label| label.span);
        FOLLOWERS.contains(&error.code)
            && places.any(|place| unsure.iter().any(|outer| holds(outer, place)))
    };
    ev.diagnostics.retain(|error| !follows(error));
}
