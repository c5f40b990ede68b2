//! How bright an `emissive` material is.

use super::param::{Change, Param, Reader, Shown};
use crate::schema::Field;
use crate::units::{self, Dim};

/// A factor on its colour.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Brightness {
    /// Radiance, W/(m2 sr) up to the scene's own scale.
    Strength(f64),
    /// Of all that is made of the material together, W.
    Power(f64),
}

impl Brightness {
    /// The number that it is.
    #[must_use]
    pub fn value(self) -> f64 {
        match self {
            Self::Strength(value) | Self::Power(value) => value,
        }
    }
}

impl Param for Brightness {
    fn read(from: &Reader<'_>, names: &[&'static str]) -> Option<Self> {
        match from.fields.number(names[1]) {
            Some(power) => Some(Self::Power(power)),
            None => from.fields.number(names[0]).map(Self::Strength),
        }
    }

    fn show(&self, fields: &[Field], shown: &mut Shown<'_>) {
        match *self {
            Self::Strength(value) => shown.push(&fields[0], units::show_number(value)),
            Self::Power(value) => shown.push(&fields[1], units::show(value, Dim::POWER)),
        }
    }

    fn numbers_mut(&mut self, fields: &[Field], change: &mut Change<'_>) {
        match self {
            Self::Strength(value) => change(&fields[0], std::slice::from_mut(value)),
            Self::Power(value) => change(&fields[1], std::slice::from_mut(value)),
        }
    }
}
