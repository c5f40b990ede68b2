//! The text of `mod wgsl` in every generated module: WGSL's rules for scalars, where Rust's own
//! operators differ. It is real Rust, compiled here for its tests with either `Real`.

#[cfg(test)]
mod double;
#[cfg(test)]
mod single;
#[cfg(test)]
mod tests;

/// The rules, without the header that speaks of this crate.
pub(crate) fn text() -> &'static str {
    let text = include_str!("prelude/scalar.rs");
    text.find("use super::Real;").map_or(text, |start| &text[start..])
}
