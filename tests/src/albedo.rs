//! The tables of directional albedo that compilers put into packs, by quadrature in double precision.
//!
//! What a value means stands where it is read, in `shaders/wgsl/bsdf/*_albedo.wgsl`. The nodes of the tables and the
//! quadratures are here; `cargo run --release -p tests --bin albedo -- --write` writes the file that the compiler holds.

pub mod facets;
mod forward;
mod nodes;
mod sheen;

pub use nodes::{table, tables};
