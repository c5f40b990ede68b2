//! What all parts of a scene have: names with their places, and colours.

use crate::source::Span;

/// A name with the place where it was declared.
#[derive(Clone, Debug, PartialEq)]
pub struct Name {
    /// The name as other declarations use it; imported names carry their prefix (`lantern.body`).
    pub text: String,
    /// Where it is declared.
    pub span: Span,
}

impl Name {
    /// Whether the instance of this name is the one that the scene names so, or a part of it: `a[3]` and `a.lid` are of
    /// `a`.
    #[must_use]
    pub fn covers(&self, instance: &str) -> bool {
        let rest = instance.strip_prefix(self.text.as_str());
        rest.is_some_and(|rest| rest.is_empty() || rest.starts_with(['[', '.']))
    }
}

/// Linear Rec. 709 triple.
pub type Rgb = [f64; 3];
