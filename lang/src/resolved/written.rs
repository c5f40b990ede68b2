//! Numbers and lengths as they would be written in a declaration.

use crate::units::{self, Dim};

/// Name of a type, and the fields of a declaration as they would be written.
pub(crate) type Declared = (&'static str, Vec<(&'static str, String)>);

/// A plain number.
pub(crate) fn number(value: f64) -> String {
    units::show_number(value)
}

/// A length.
pub(crate) fn length(metres: f64) -> String {
    units::show(metres, Dim::LENGTH)
}

/// Three numbers and their unit.
pub(crate) fn vector([x, y, z]: [f64; 3], unit: &str) -> String {
    format!("({}, {}, {}){unit}", number(x), number(y), number(z))
}
