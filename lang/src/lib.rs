//! The `.rts` language: text becomes a checked `Scene`, or diagnostics that say why not.

mod check;
pub mod diagnostic;
mod eval;
pub mod format;
mod lex;
pub mod parse;
mod resolve;
pub mod scene;
pub mod schema;
pub mod source;
mod split;
pub mod suggest;
pub mod syntax;
pub mod units;

pub use check::{Analysis, Options, ParamInfo, analyze};
