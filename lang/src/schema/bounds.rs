//! A range of numbers with a dimension, and how a message names it.

use crate::units::{self, Dim};

/// A range of numbers with a dimension; values in SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// Dimension of the value.
    pub dim: Dim,
    /// The unit to suggest when one is missing; empty for plain numbers.
    pub unit: &'static str,
    /// Smallest value.
    pub min: f64,
    /// `min` itself is outside.
    pub above_min: bool,
    /// Largest value; infinite where only the size limit of the language holds.
    pub max: f64,
}

impl Bounds {
    pub(crate) const fn new(dim: Dim, unit: &'static str, min: f64, max: f64) -> Self {
        Self { dim, unit, min, above_min: false, max }
    }

    pub(crate) const fn number(min: f64, max: f64) -> Self {
        Self::new(Dim::NONE, "", min, max)
    }

    pub(crate) const fn above(dim: Dim, unit: &'static str, min: f64) -> Self {
        Self { dim, unit, min, above_min: true, max: f64::INFINITY }
    }

    /// Lies inside.
    #[must_use]
    pub fn contains(&self, value: f64) -> bool {
        let low = if self.above_min { value > self.min } else { value >= self.min };
        low && value <= self.max
    }

    /// Runs from 0 to 1, so that its values may be percent.
    #[must_use]
    #[expect(clippy::float_cmp, reason = "the table says exactly 1")]
    pub fn is_share(&self) -> bool {
        self.max == 1.0
    }

    /// In words for a message: `between 0 and 1`, `at least 1`, `above 0m`.
    #[must_use]
    pub fn described(&self) -> String {
        let show = |value: f64| self.show(value);
        let low = if self.above_min { "above" } else { "at least" };
        match (self.min == f64::NEG_INFINITY, self.max == f64::INFINITY) {
            (true, true) => "any value".to_owned(),
            (true, false) => format!("at most {}", show(self.max)),
            (false, true) => format!("{low} {}", show(self.min)),
            (false, false) if self.above_min => {
                format!("above {} and at most {}", show(self.min), show(self.max))
            }
            (false, false) => format!("between {} and {}", show(self.min), show(self.max)),
        }
    }

    /// Prints a value in the unit of this field where that is exact.
    #[must_use]
    pub fn show(&self, value: f64) -> String {
        let unit = units::find(self.unit);
        unit.and_then(|unit| units::show_in(value, unit))
            .unwrap_or_else(|| units::show(value, self.dim))
    }
}
