//! WGSL modules and a [`FeatureSet`] become one linked, validated kernel text.
//!
//! The path tracer exists once, as the modules under `wgsl/`. [`link`] pastes the ones that a scene
//! needs behind generated text (constants, bindings, records and their loaders, dispatch), drops
//! every declaration that `render` does not reach, and remembers where each byte came from.
//! [`validate`] runs naga over the result and translates its errors back to our files;
//! [`check_layouts`] compares the structs in it with the Rust records of `pack::abi`.
//!
//! # Bits
//! The same WGSL also becomes the CPU kernel, and both give the same bits wherever the driver computes
//! what is written. WGSL lets a driver reorder products and sums, and Mesa does; so the modules keep
//! to forms that it leaves alone: a constant goes onto one factor and not onto a product,
//! `(a * C) * b`, and onto one term and not onto a sum, `(a + C) + b`. The tests refuse the others.
//!
//! It does not know the scene language, wgpu, or what is in a pack besides its records.

// A kind that a match forgets is an error, not what the last arm says.
#![warn(clippy::wildcard_enum_match_arm)]

mod declaration;
mod error;
mod features;
mod generate;
mod layout;
mod link;
mod modules;
mod validate;

pub use error::{Location, ShaderError};
pub use features::{Binding, FeatureSet, NodeLayout, PORTABLE_STORAGE, Windows};
pub use generate::{WINDOW_WORDS, generated_texts, record_texts, root_module};
pub use layout::{LayoutError, abi_module, check_layouts};
pub use link::{AOV, LIGHTS, Linked, Root, link, link_modules, link_with};
pub use modules::module_texts;
#[cfg(feature = "spirv")]
pub use validate::spirv_words;
pub use validate::validate;
