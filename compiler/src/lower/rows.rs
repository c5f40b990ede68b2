//! Records of a large section: made now, or as an earlier pack has them.

use std::fmt;
use std::ops::Deref;
use std::sync::Arc;

use pack::{Kind, Pack, Section};

/// A list of records that need not be copied out of the pack that has them.
#[derive(Clone)]
pub enum Rows<T: 'static> {
    /// Made now.
    Made(Vec<T>),
    /// Those of a pack, which is open as long as anybody reads them.
    Kept(Kept<T>),
}

/// The section of an earlier pack.
#[derive(Clone)]
pub struct Kept<T: 'static> {
    pack: Arc<Pack>,
    kind: Kind,
    rows: fn(&Pack) -> &[T],
}

impl<T> Rows<T> {
    /// The records that `rows` finds in the section `kind` of a pack.
    pub(crate) fn kept(pack: &Arc<Pack>, kind: Kind, rows: fn(&Pack) -> &[T]) -> Self {
        Self::Kept(Kept { pack: Arc::clone(pack), kind, rows })
    }

    /// The section of the earlier pack; `None` for what was made now or is empty.
    pub(crate) fn section(&self) -> Option<Section<'_>> {
        match self {
            Self::Made(_) => None,
            Self::Kept(kept) => kept.pack.sections().find(|section| section.kind == kept.kind),
        }
    }
}

impl<T> Deref for Rows<T> {
    type Target = [T];

    fn deref(&self) -> &[T] {
        match self {
            Self::Made(rows) => rows,
            Self::Kept(kept) => (kept.rows)(&kept.pack),
        }
    }
}

impl<T> From<Vec<T>> for Rows<T> {
    fn from(rows: Vec<T>) -> Self {
        Self::Made(rows)
    }
}

impl<'a, T> IntoIterator for &'a Rows<T> {
    type Item = &'a T;
    type IntoIter = std::slice::Iter<'a, T>;

    fn into_iter(self) -> Self::IntoIter {
        self.iter()
    }
}

impl<T: PartialEq> PartialEq for Rows<T> {
    fn eq(&self, other: &Self) -> bool {
        **self == **other
    }
}

impl<T: fmt::Debug> fmt::Debug for Rows<T> {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.debug_list().entries(self.iter()).finish()
    }
}
