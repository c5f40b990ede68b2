//! Indices, references and products as faults say them.

use std::fmt;

use crate::abi::{self, ChildRef};

/// An optional index in words.
pub(super) fn index_or_none(index: u32) -> String {
    if index == abi::NONE { "none".to_owned() } else { index.to_string() }
}

/// The name of an axis.
pub(super) fn axis(index: usize) -> &'static str {
    ["x", "y", "z"].get(index).copied().unwrap_or("?")
}

/// A product that may not fit.
pub(super) struct Product(pub(super) u64, pub(super) u32);

impl fmt::Display for Product {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "{}", u128::from(self.0) * u128::from(self.1))
    }
}

/// A child reference in words.
pub(super) struct Reference(pub(super) u32);

impl fmt::Display for Reference {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut leaf = |kind: &str, first: u32, count: u32| {
            write!(out, "{kind} {first}..{}", u64::from(first) + u64::from(count))
        };
        match ChildRef::decode(self.0) {
            ChildRef::Triangles { first, count } => leaf("triangles", first, count),
            ChildRef::Spheres { first, count } => leaf("spheres", first, count),
            ChildRef::Inner(index) => write!(out, "node {index}"),
            ChildRef::Instance(index) => write!(out, "instance {index}"),
            ChildRef::Empty => write!(out, "none"),
        }
    }
}

/// `0, 1, 4`.
pub(super) fn list(tags: &[u32]) -> String {
    tags.iter().map(u32::to_string).collect::<Vec<_>>().join(", ")
}
