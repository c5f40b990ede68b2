//! The full kernel in single precision for eight invocations at once: the bits of `kernel_f32`, lane by lane.
//!
//! The build script links every WGSL module and translates the text to [`kernel`]; [`render`] runs it over the pixels of
//! a tile. Empty where processors have no AVX2.
#![cfg(target_arch = "x86_64")]

pub mod kernel;
mod packet;
mod packet_triangle;
mod rays;
pub mod render;
