//! Whether it is learned which lights can be seen, by the pass of `hidden`.

use std::fmt;
use std::str::FromStr;

use thiserror::Error;

/// Whether the pass is made: what `rtc --visibility` takes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Visibility {
    /// Where lights are chosen by a tree.
    #[default]
    Auto,
    /// All lights count as seen.
    Never,
}

/// What is no way to learn visibility.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[error("expected `auto` or `never`, found `{0}`")]
pub struct UnknownVisibility(String);

impl fmt::Display for Visibility {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(match self {
            Self::Auto => "auto",
            Self::Never => "never",
        })
    }
}

impl FromStr for Visibility {
    type Err = UnknownVisibility;

    fn from_str(name: &str) -> Result<Self, UnknownVisibility> {
        let found = [Self::Auto, Self::Never].into_iter().find(|how| how.to_string() == name);
        found.ok_or_else(|| UnknownVisibility(name.to_owned()))
    }
}
