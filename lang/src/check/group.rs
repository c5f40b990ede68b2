//! Light groups: which names they may have.

use std::rc::Rc;

use super::fields::Fields;
use crate::diagnostic::{Code, Diagnostic, Fix};
use crate::schema::MAX_GROUP;
use crate::source::Span;

/// The group that is written, with its place.
pub(super) type Group = Option<(Rc<str>, Span)>;

/// The group of these fields.
pub(super) fn group(fields: &Fields) -> Group {
    let name = fields.text("group")?;
    Some((name.into(), fields.value_span("group")?))
}

fn is_plain(c: char) -> bool {
    c.is_ascii_alphanumeric() || c == '_' || c == '-'
}

/// What is wrong with the name of a group written at `span`, if anything is: names become parts of names of channels,
/// in which a full stop divides.
pub(super) fn fault(name: &str, span: Span, literal: bool) -> Option<Diagnostic> {
    let error = |text: String| Diagnostic::error(Code("E0401"), text);
    if let Some(wrong) = name.chars().find(|c| !is_plain(*c)) {
        let text =
            format!("`group` has letters, digits, `_` and `-`, found `{}`", wrong.escape_debug());
        let error = error(text).at(span, "part of the names of channels");
        let plain: String = name.chars().map(|c| if is_plain(c) { c } else { '_' }).collect();
        return Some(if literal {
            error.with_fix(Fix::guess(format!("write `{plain}`"), span, format!("\"{plain}\"")))
        } else {
            error
        });
    }
    (name.len() > MAX_GROUP).then(|| {
        let text = format!("`group` has at most {MAX_GROUP} letters, found {}", name.len());
        error(text).at(span, "too long")
    })
}
