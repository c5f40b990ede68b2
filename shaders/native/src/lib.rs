//! A WGSL compute kernel → the text of a Rust module that computes the same, on the CPU.
//!
//! naga parses and validates; this crate walks naga's IR once and writes one Rust method for every
//! WGSL function. The walk is the same for both precisions: the f64 twin differs from the f32 kernel
//! in its type aliases, its literals, and where 32-bit words become floats.
//!
//! The promise is *faithful or refused*: a construct is either translated with WGSL's meaning or is
//! an error that names it and its line and column. Nothing is approximated in silence.
//!
//! # The generated module
//! Text for `include!` inside a module of its own; it needs `glam` and nothing else. It holds
//! - `Bindings`, one slice or reference for every global resource, named as in WGSL;
//! - `Kernel`, the resources and the `var<private>` variables;
//! - one public method of `Kernel` for every WGSL function, entry points included;
//! - one struct for every WGSL struct, one constant for every module-scope `const`.
//!
//! The module that includes it should allow `dead_code`, `unused`, `non_snake_case`,
//! `non_camel_case_types`, `non_upper_case_globals`, `missing_docs`, `unreachable_pub`,
//! `clippy::all` and `clippy::pedantic`: its names and its shape are WGSL's.
//!
//! An entry point resets the private variables first, so one `Kernel` serves many invocations.
//!
//! # Where WGSL leaves a choice
//! - A read outside an array gives its last element (of an empty array zero); a write is dropped.
//! - `min` and `max` compare once: of a NaN on the left they give NaN, of one on the right the other.
//! - Sums of products (`dot`, matrices) have one written order; nothing is fused.
//! - An `override` takes its default; without one it is refused.
//! - A resource shorter than its fixed-size array reads as zeros.
//! - In the f64 twin floats inside structs of a resource are f64, so the caller widens them; plain
//!   arrays of floats stay f32, and words of `u32` stay words.
//!
//! # Bits
//! Each operation and built-in of IEEE arithmetic was compared on 16 384 random operands with
//! Mesa 22.3's llvmpipe and has its bits. Not so `sin`, `exp`, `log`, `pow` and their kin, `acos`
//! and theirs, `determinant` of four columns, and NaN, which every driver rounds as it likes.
//!
//! Nor can bits agree where a driver rewrites what stands in the WGSL. Mesa does: `x * c1 * c2` and
//! `x + c1 + c2` (constants are folded first), `(a * b) * c1`, `(a + b) + c1`, `a*b + a*c`, `(a + b) - a`, `1 - (1 - a)`,
//! `sqrt(a) * sqrt(a)`, `1 / (1 / a)`, `a * 0.0`, `a - a`, and `a != a`, which is false to it even
//! for NaN. A kernel that wants the same bits everywhere does not write these.
//!
//! This crate knows nothing of the scene, of the pack, or of what the kernel computes.

mod builtins;
mod constants;
mod context;
mod conversions;
mod decimals;
mod error;
mod expressions;
mod functions;
mod matrices;
mod module;
mod names;
mod operators;
mod options;
mod places;
mod prelude;
mod resources;
mod statements;
mod text;
mod types;
mod wide;

pub use error::NativeError;
pub use options::{ByHand, Lanes, Precision, Seam};

use naga::valid::{Capabilities, ValidationFlags, Validator};

/// Translates a WGSL text, all of it.
pub fn generate(source: &str, precision: Precision) -> Result<String, NativeError> {
    generate_with(source, precision, ByHand::default())
}

/// Translates a WGSL text, but for what is done by hand.
pub fn generate_with(
    source: &str,
    precision: Precision,
    by_hand: ByHand<'_>,
) -> Result<String, NativeError> {
    let module =
        naga::front::wgsl::parse_str(source).map_err(|error| NativeError::parse(&error, source))?;
    let info = Validator::new(ValidationFlags::all(), Capabilities::all())
        .validate(&module)
        .map_err(|error| NativeError::invalid(&error, source))?;
    context::Context::new(&module, &info, source, precision, by_hand)?.write()
}

/// Translates what the entry points of a WGSL text call into a module that computes as many invocations at once as there
/// are `lanes`, but for what is done by hand; `scalar` is the path of the module that [`generate_with`] makes of the same
/// text in `f32`, as seen from the new one.
pub fn generate_wide(
    source: &str,
    scalar: &str,
    lanes: Lanes,
    by_hand: ByHand<'_>,
) -> Result<String, NativeError> {
    let module =
        naga::front::wgsl::parse_str(source).map_err(|error| NativeError::parse(&error, source))?;
    let info = Validator::new(ValidationFlags::all(), Capabilities::all())
        .validate(&module)
        .map_err(|error| NativeError::invalid(&error, source))?;
    context::Context::new(&module, &info, source, Precision::F32, by_hand)?
        .write_wide(scalar, lanes)
}
