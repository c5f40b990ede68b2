//! What sound `texture` and `asset` declarations say of a file.

use crate::scene::{AssetFormat, ColorSpace, Wrap};
use crate::source::Span;
use crate::texture::Placement;

/// A sound `texture` declaration.
#[derive(Clone, Debug)]
pub(crate) struct TextureInfo {
    pub(crate) path: String,
    pub(crate) path_span: Span,
    pub(crate) space: ColorSpace,
    /// `space: srgb`.
    pub(crate) space_span: Span,
    /// `srgb`.
    pub(crate) space_value: Span,
    pub(crate) wrap: [Wrap; 2],
    pub(crate) placement: Placement,
}

/// A sound `asset` declaration.
#[derive(Clone, Debug)]
pub(crate) struct AssetInfo {
    pub(crate) path: String,
    pub(crate) path_span: Span,
    pub(crate) format: AssetFormat,
}
