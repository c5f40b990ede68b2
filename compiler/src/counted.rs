//! Counts as messages have them: `1 light`, `2 lights`.

use std::fmt::Display;

/// So many of what is called `one` alone and `several` otherwise.
pub(crate) fn counted<N: Copy + Display + PartialEq + From<u8>>(
    n: N,
    one: &str,
    several: &str,
) -> String {
    let name = if n == N::from(1) { one } else { several };
    format!("{n} {name}")
}
