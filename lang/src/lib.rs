//! The `.rts` language: text becomes a checked `Scene`, or diagnostics that say why not.

pub mod diagnostic;
pub mod parse;
pub mod scene;
pub mod source;
pub mod suggest;
pub mod syntax;
