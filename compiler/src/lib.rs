//! The compiler: a text scene becomes a render pack.
//!
//! Turns a checked `Scene` and the files it names into flat arrays, a BVH and a linked kernel. It
//! keeps two promises: the same inputs give the same bytes, and what a scene does not need is not
//! in its pack. It does not know wgpu.

mod atmosphere;
pub mod bvh;
pub mod cache;
pub mod cli;
mod counted;
pub mod depfile;
pub mod import;
pub mod input;
pub mod kept;
// A kind that a match forgets is an error, not what the last arm says.
#[warn(clippy::wildcard_enum_match_arm)]
pub mod lower;
pub mod normalize;
#[warn(clippy::wildcard_enum_match_arm)]
pub mod pipeline;
pub mod reads;
pub mod report;
pub mod stage;
pub mod weld;
