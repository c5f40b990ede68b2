//! Light linking: which things a light lights.

use std::collections::BTreeSet;

use super::common::Name;

/// The instances that a light lights, or those that it does not.
#[derive(Clone, Debug, PartialEq)]
pub enum LightLinks {
    /// These and nothing else.
    Only(Vec<Name>),
    /// Everything but these.
    Except(Vec<Name>),
}

impl LightLinks {
    /// The names, as the light gives them.
    #[must_use]
    pub fn names(&self) -> &[Name] {
        match self {
            Self::Only(names) | Self::Except(names) => names,
        }
    }

    /// Whether an instance of this name is lit.
    #[must_use]
    pub fn light(&self, instance: &str) -> bool {
        self.names().iter().any(|name| name.covers(instance)) != self.lights_the_rest()
    }

    /// Whether what no light can name is lit: the air, and other lights.
    #[must_use]
    pub fn lights_the_rest(&self) -> bool {
        matches!(self, Self::Except(_))
    }
}

/// What tells lists of names apart that are not the same to a light.
type Key<'a> = (bool, BTreeSet<&'a str>);

impl LightLinks {
    fn key(&self) -> Key<'_> {
        let names = self.names().iter().map(|name| name.text.as_str());
        (self.lights_the_rest(), names.collect())
    }

    /// Whether another light with `other` lights the same things.
    #[must_use]
    pub fn is_same(&self, other: &Self) -> bool {
        self.key() == other.key()
    }

    /// Those of `all` that differ, in their order.
    #[must_use]
    pub fn sets<'a>(all: impl Iterator<Item = &'a Self>) -> Vec<&'a Self> {
        let mut known = BTreeSet::new();
        all.filter(|links| known.insert(links.key())).collect()
    }
}
