//! Everything that crosses crates: see `tests/tests`.
