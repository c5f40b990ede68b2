//! The `.rts` language: text becomes a checked `Scene`, or diagnostics that say why not.

pub mod diagnostic;
mod lex;
pub mod parse;
pub mod scene;
pub mod source;
mod split;
pub mod suggest;
pub mod syntax;
