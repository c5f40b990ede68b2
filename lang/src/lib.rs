//! The `.rts` language: text becomes a checked `Scene`, or diagnostics that say why not.

pub mod scene;
pub mod source;
