//! Every sampler against its density: chi-square with a million samples, densities that integrate to one,
//! the same density from both sides, and no surprise at the corners of the unit square.
//!
//! All chi-square tests of this file together fail with chance 1e-3 if nothing is wrong (Šidák); seeds are
//! fixed, so a run that passed passes again.

#![expect(
    clippy::cast_possible_truncation,
    clippy::float_cmp,
    reason = "inputs are rounded to the kernel's precision on purpose, and some answers are exact"
)]

#[path = "samplers/bsdf.rs"]
mod bsdf;
#[path = "samplers/camera.rs"]
mod camera;
#[path = "samplers/filter.rs"]
mod filter;
#[path = "samplers/light.rs"]
mod light;
#[path = "samplers/light_tree.rs"]
mod light_tree;
#[path = "samplers/matte.rs"]
mod matte;
#[path = "samplers/media.rs"]
mod media;
#[path = "samplers/sheet.rs"]
mod sheet;
#[path = "samplers/sky.rs"]
mod sky;
#[path = "samplers/sobol.rs"]
mod sobol;
#[path = "samplers/sobol_light.rs"]
mod sobol_light;
#[path = "samplers/specular.rs"]
mod specular;
#[path = "samplers/uniform.rs"]
mod uniform;

use tests::statistics::{Counts, level};

/// Samples of one chi-square test.
const N: usize = 1_000_000;
/// Seed of every stream of this file.
const SEED: u32 = 20_260;
/// Chi-square tests in this file.
const CHECKS: usize = bsdf::CHECKS
    + camera::CHECKS
    + filter::CHECKS
    + light::CHECKS
    + matte::CHECKS
    + media::CHECKS
    + sheet::CHECKS
    + specular::CHECKS
    + light_tree::CHECKS
    + sky::CHECKS
    + uniform::CHECKS;

/// Fails where the counts are too far from what was expected; names the case.
fn check(name: &str, counts: &Counts) {
    let p = counts.p_value();
    let (cell, observed, expected) = counts.worst();
    assert!(
        p > level(CHECKS),
        "{name}: chi-square p = {p:.2e}; worst is cell {cell}, {observed} instead of {expected:.1}"
    );
}

/// Sample number `i` of test `test`: its own pixel, so that no two tests share numbers.
fn key(test: usize, i: usize) -> runtime::kernel::f32::SampleKey {
    let word = |x: usize| u32::try_from(x).expect("tests are few and samples fit 32 bits");
    runtime::kernel::f32::SampleKey { pixel: word(test), sample: word(i), bounce: 0, seed: SEED }
}

/// The coordinates at which samplers break.
fn corners() -> impl Iterator<Item = glam::Vec2> {
    let tiny = 2.0_f32.powi(-24);
    let edge = [0.0, tiny, 0.5, 1.0 - tiny];
    edge.into_iter().flat_map(move |x| edge.into_iter().map(move |y| glam::Vec2::new(x, y)))
}
