//! Assignments of declarations before they are evaluated.

use std::collections::BTreeMap;

use crate::schema::Field;
use crate::source::Span;
use crate::syntax::Expr;

/// An assignment before it is evaluated.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Given<'p> {
    pub(crate) field: &'static Field,
    pub(crate) expr: &'p Expr,
    /// The whole assignment.
    pub(crate) span: Span,
    /// Where it is written, which decides what names it sees.
    pub(crate) module: u32,
}

/// The assignments of a declaration, its bases included.
pub(crate) type Givens<'p> = BTreeMap<&'static str, Given<'p>>;

/// What a declaration sets itself: the last assignment of each field. Others may be like it or refer to it
/// any number of times, so it is collected once.
#[derive(Debug, Default)]
pub(crate) struct OwnFields<'p> {
    pub(super) givens: Givens<'p>,
    /// Some of its fields do not exist or could not be read.
    pub(super) unsure: bool,
}
