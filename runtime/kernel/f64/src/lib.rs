//! The full kernel in double precision, which shows where rounding matters: the same decisions and random numbers as
//! in single precision.
//!
//! The build script links every WGSL module and translates the text. Renders nothing by itself: `runtime` does.

pub mod kernel;
