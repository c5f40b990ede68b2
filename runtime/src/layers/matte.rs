//! How many samples of each pixel show which name: Cryptomatte before it is ranked.

use super::crypto::id_of;
use std::collections::BTreeMap;

/// What is told apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MatteKind {
    /// Instances with all their copies.
    Object,
    /// Instances.
    Instance,
    /// Materials.
    Material,
}

impl MatteKind {
    /// All kinds, in the order of `Nearest::numbers`.
    pub const ALL: [Self; 3] = [Self::Object, Self::Instance, Self::Material];

    /// `CryptoObject`.
    #[must_use]
    pub fn layer(self) -> &'static str {
        match self {
            Self::Object => "CryptoObject",
            Self::Instance => "CryptoInstance",
            Self::Material => "CryptoMaterial",
        }
    }
}

/// Names and their shares of the pixels.
#[derive(Clone, Debug, PartialEq)]
pub struct Matte {
    /// What is told apart.
    pub kind: MatteKind,
    /// Numbers by name, of all names of the scene.
    pub names: BTreeMap<String, u32>,
    /// For each pixel, number and samples, in no order.
    pub shares: Vec<Vec<(u32, u32)>>,
}

impl Matte {
    /// Of a scene with these names, without pixels.
    #[must_use]
    pub fn new<'a>(kind: MatteKind, names: impl IntoIterator<Item = &'a str>) -> Self {
        let names = names.into_iter().map(|name| (name.to_owned(), id_of(name))).collect();
        Self { kind, names, shares: Vec::new() }
    }

    /// The shares of a pixel, largest first, then by number.
    #[must_use]
    pub fn ranked(shares: &[(u32, u32)]) -> Vec<(u32, u32)> {
        let mut shares = shares.to_vec();
        shares.sort_by_key(|(id, n)| (std::cmp::Reverse(*n), *id));
        shares
    }

    /// Most names in a pixel.
    #[must_use]
    pub fn most(&self) -> usize {
        self.shares.iter().map(Vec::len).max().unwrap_or(0)
    }

    /// Adds the samples of other pixels to the same places.
    pub fn add(&mut self, other: &Self) {
        for (shares, more) in self.shares.iter_mut().zip(&other.shares) {
            for (id, n) in more {
                count(shares, *id, *n);
            }
        }
        self.names.extend(other.names.iter().map(|(name, id)| (name.clone(), *id)));
    }
}

/// `n` more samples of `id`.
pub(crate) fn count(shares: &mut Vec<(u32, u32)>, id: u32, n: u32) {
    match shares.iter_mut().find(|(known, _)| *known == id) {
        Some((_, samples)) => *samples += n,
        None => shares.push((id, n)),
    }
}
