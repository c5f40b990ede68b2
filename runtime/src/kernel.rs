//! The kernel as Rust: what was generated from the full WGSL, in two precisions, and the tree that CPUs walk.

pub use kernel_f32::kernel as f32;
pub use kernel_f32::walk;
pub use kernel_f64::kernel as f64;
