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

/// Linear Rec. 709 triple.
pub type Rgb = [f64; 3];
