//! The example scenes: one folder each, and generators for the meshes they use.

pub mod catalog;
pub mod console;
pub mod generate;
