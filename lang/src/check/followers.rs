//! What seems to be missing where a field is misspelt, or could not be read, is not reported: that field is what is
//! missing.

use crate::diagnostic::{Code, Diagnostic};
use crate::eval::Evaluator;
use crate::source::Span;

/// Leaves out that a field is missing wherever a declaration has fields that are not known.
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
        error.code == Code("E0207")
            && places.any(|place| unsure.iter().any(|outer| holds(outer, place)))
    };
    ev.diagnostics.retain(|error| !follows(error));
}
