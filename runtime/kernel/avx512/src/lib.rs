//! The full kernel in single precision for sixteen invocations at once, with AVX-512: the bits of `kernel_f32`, lane by lane.
//!
//! The build script links every WGSL module and translates the text to [`kernel`]; [`render`] runs it over the pixels of
//! a tile. What is written by hand lies in `runtime/kernel/wide/`, for any number of lanes. Empty on architectures other
//! than x86-64.
#![cfg(target_arch = "x86_64")]

use kernel_target::avx512 as target;
/// The proof that the processor has the instructions.
pub use pulp::x86::V4 as Instructions;

#[path = "../../wide/kernel.rs"]
pub mod kernel;
#[path = "../../wide/lone.rs"]
pub mod lone;
#[path = "../../wide/packet.rs"]
mod packet;
#[path = "../../wide/packet_triangle.rs"]
mod packet_triangle;
#[path = "../../wide/pixels.rs"]
mod pixels;
#[path = "../../wide/rays.rs"]
mod rays;
#[path = "../../wide/render.rs"]
pub mod render;
