//! The modules that come with the language: `import "std:materials" { glass }`.
//!
//! Turns the name after `std:` into a text that is compiled into the program. A module is ordinary
//! `.rts`; what it declares belongs to the edition and never changes within it.

/// Name after `std:` and text, sorted by name.
const MODULES: &[(&str, &str)] = &[("materials", include_str!("standard/materials.rts"))];

/// The text of the module `std:name`, if the language has it.
#[must_use]
pub fn text(name: &str) -> Option<&'static str> {
    MODULES.iter().find(|(known, _)| *known == name).map(|(_, text)| *text)
}

/// Every name.
pub(crate) fn names() -> impl Iterator<Item = &'static str> {
    MODULES.iter().map(|(name, _)| *name)
}

/// Every module as `std:name` and its text, for the reference.
pub(crate) fn modules() -> impl Iterator<Item = (String, &'static str)> {
    MODULES.iter().map(|(name, text)| (format!("std:{name}"), *text))
}
