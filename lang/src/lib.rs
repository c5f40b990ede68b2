//! The `.rts` language: text becomes a checked `Scene`, or diagnostics that say why not.

mod check;
pub mod diagnostic;
mod eval;
mod explain;
pub mod format;
mod lex;
#[warn(clippy::wildcard_enum_match_arm)]
pub mod material;
#[warn(clippy::wildcard_enum_match_arm)]
mod medium;
pub mod parse;
mod reference;
mod resolve;
#[warn(clippy::wildcard_enum_match_arm)]
mod resolved;
#[warn(clippy::wildcard_enum_match_arm)]
pub mod scene;
#[warn(clippy::wildcard_enum_match_arm)]
pub mod schema;
#[warn(clippy::wildcard_enum_match_arm)]
mod shape;
#[warn(clippy::wildcard_enum_match_arm)]
mod sky;
pub mod source;
mod split;
pub mod stack;
mod standard;
pub mod suggest;
pub mod syntax;
mod texture;
pub mod units;

pub use check::{Analysis, Options, ParamInfo, analyze};
pub use explain::{codes, explain, explained_names};
pub use reference::reference_markdown;
pub use resolved::resolved;
pub use standard::text as standard_module;
