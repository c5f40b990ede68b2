//! The full kernel in single precision: the same bits as a GPU that rounds as IEEE 754 says.
//!
//! The build script links every WGSL module and translates the text to [`kernel`]. Its `trace` is [`walk`]'s, through a
//! tree made for CPUs; what was generated for it is `generated_trace`. Renders nothing by itself: `runtime` does.

pub mod kernel;
pub mod walk;
