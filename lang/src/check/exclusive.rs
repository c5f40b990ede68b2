//! Fields that say the same thing in two ways become a diagnostic.

use super::fields::Fields;
use crate::diagnostic::{Code, Diagnostic};
use crate::eval::Evaluator;

/// At most one of these fields may be written; says whether that is so.
pub(crate) fn one_of(ev: &mut Evaluator<'_>, fields: &Fields, names: &[&str], what: &str) -> bool {
    one_of_noting(ev, fields, names, what, |_| "this says it, too".to_owned())
}

/// At most one of these fields may be written; `note` says of the earlier one what it means.
pub(super) fn one_of_noting(
    ev: &mut Evaluator<'_>,
    fields: &Fields,
    names: &[&str],
    what: &str,
    note: impl FnOnce(&str) -> String,
) -> bool {
    let written: Vec<&str> = names.iter().copied().filter(|name| fields.has(name)).collect();
    let [first, second, ..] = written.as_slice() else { return true };
    let (Some(a), Some(b)) = (fields.span(first), fields.span(second)) else { return true };
    let (earlier, later) = if a <= b { (first, second) } else { (second, first) };
    let (a, b) = (a.min(b), a.max(b));
    let text = format!("`{earlier}` and `{later}` both set {what}");
    let error = Diagnostic::error(Code("E0703"), text).at(b, "keep one of them");
    ev.fault(error.because(a, note(earlier)));
    false
}
