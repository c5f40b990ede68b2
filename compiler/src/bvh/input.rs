//! What a tree is built over: fragments, and the corners of triangles that may be split.

use std::borrow::Cow;

use super::fragment::Fragment;

/// What a tree is built over.
#[derive(Clone, Debug)]
pub struct Input<'a> {
    /// `fragments[i]` has index `i`.
    pub fragments: Vec<Fragment>,
    /// The corners of each triangle; empty where fragments are not to be split.
    pub corners: Cow<'a, [[[f32; 3]; 3]]>,
}

/// Corners by index of a primitive; none where nothing may be split.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Corners<'a>(&'a [[[f32; 3]; 3]]);

impl<'a> Corners<'a> {
    pub(super) fn new(corners: &'a [[[f32; 3]; 3]]) -> Self {
        Self(corners)
    }

    /// The corners of what is not `whole`.
    pub(super) fn of(self, fragment: &Fragment) -> &'a [[f32; 3]; 3] {
        &self.0[fragment.index() as usize]
    }
}

impl<'a> Input<'a> {
    /// Triangles that may be split, where they stand still and have finite corners.
    #[must_use]
    pub fn of_triangles(corners: &'a [[[f32; 3]; 3]]) -> Self {
        let fragments = (0..).zip(corners).map(|(i, t)| Fragment::of_triangle(t, i)).collect();
        Self { fragments, corners: Cow::Borrowed(corners) }
    }

    /// Boxes that are never split.
    #[must_use]
    pub fn of_boxes(fragments: Vec<Fragment>) -> Self {
        Self { fragments, corners: Cow::Borrowed(&[]) }
    }
}
