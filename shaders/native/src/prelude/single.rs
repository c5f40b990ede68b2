//! The scalar rules in f32.

#![allow(
    clippy::pedantic,
    clippy::all,
    dead_code,
    unreachable_pub,
    reason = "the text of a generated module"
)]

pub type Real = f32;
#[path = "scalar.rs"]
pub mod rules;
