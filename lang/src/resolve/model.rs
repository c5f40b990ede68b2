//! What a declaration is built on: its type, and the declarations that it is like.

use super::ItemId;
use crate::schema::TypeSchema;
use crate::source::Span;

/// What a declaration is built on.
#[derive(Clone, Debug)]
pub(crate) struct Model {
    /// Its table of fields.
    pub(crate) schema: &'static TypeSchema,
    /// Itself, then what it is like, and so on.
    pub(crate) chain: Vec<ItemId>,
    /// For `instance name: object`: the object and where it is named.
    pub(crate) object: Option<(ItemId, Span)>,
    /// What of a mesh file the last of the chain is like.
    pub(crate) of_file: Option<InFile>,
}

/// What a declaration takes from a mesh file.
#[derive(Clone, Debug)]
pub(crate) struct InFile {
    pub(crate) asset: ItemId,
    /// Name in the file.
    pub(crate) name: String,
    /// Where the name is written.
    pub(crate) span: Span,
}
