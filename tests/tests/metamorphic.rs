//! Scenes that differ and must give the same picture, or one of known ratio: no true value is needed.
//!
//! Where only exact operations differ (powers of two, shifts that `f64` holds) pictures are compared bit
//! for bit; where other random numbers, other trees or other rounding come in, by a z-test. The exact
//! relations change the checked `lang::scene::Scene`, so that the whole compiler takes part, for the scene
//! with every feature and for some that have what it lacks. `streams.rs` and `contract.rs` hold two more
//! relations: features that are off, and kernels that are specialised.

#[path = "metamorphic/compare.rs"]
mod compare;
#[path = "metamorphic/emission.rs"]
mod emission;
#[path = "metamorphic/frame.rs"]
mod frame;
#[path = "metamorphic/lights.rs"]
mod lights;
#[path = "metamorphic/meshes.rs"]
mod meshes;
#[path = "metamorphic/mixes.rs"]
mod mixes;
#[path = "metamorphic/projections.rs"]
mod projections;
#[path = "metamorphic/tiles.rs"]
mod tiles;

/// The case with every feature, and those that have another sky, an atmosphere that scatters, a sea, media
/// inside each other, or lights of which the first has none.
const RICH: &[&str] = &[
    "all",
    "tree of lights of every kind and the sky",
    "smoke",
    "sea",
    "media inside each other",
    "moving light with a picture and holes",
];
