//! Where the samples of a pixel are, for each filter.

use std::f64::consts::TAU;

use glam::{DVec2, UVec2};
use pack::abi::{Camera, FilterKind};
use tests::kernel::Bench;
use tests::statistics::{Counts, index};

use crate::{N, check, key};

/// Chi-square tests here.
pub(crate) const CHECKS: usize = 4;

const SIDE: usize = 20;
const WIDTH: f32 = 2.5;

/// Share of the filter below and beside an offset from the pixel's middle, in halves of the width, as two numbers that
/// are uniform in 0 .. 1 if the offset is distributed as the filter says.
fn shares(kind: FilterKind, at: DVec2) -> [f64; 2] {
    let tent =
        |x: f64| if x < 0.0 { 0.5 * (1.0 + x).powi(2) } else { 1.0 - 0.5 * (1.0 - x).powi(2) };
    let window = |x: f64| {
        let t = 0.5 * (x + 1.0);
        let a = [-0.48829, 0.14128, -0.01168];
        let wave = |k: u8| TAU * f64::from(k + 1);
        let waves = [0, 1, 2].map(|k| a[usize::from(k)] / wave(k) * (wave(k) * t).sin());
        t + waves.iter().sum::<f64>() / 0.35875
    };
    match kind {
        FilterKind::Pixel | FilterKind::Box => [at.x, at.y].map(|x| 0.5 * (x + 1.0)),
        FilterKind::Tent => [at.x, at.y].map(tent),
        FilterKind::BlackmanHarris => [at.x, at.y].map(window),
        // Within a circle of three standard deviations.
        FilterKind::Gaussian => {
            let inside = |r2: f64| 1.0 - (-4.5 * r2).exp();
            [inside(at.length_squared()) / inside(1.0), at.y.atan2(at.x) / TAU + 0.5]
        }
    }
}

#[test]
fn samples_are_spread_as_the_filter_says() {
    let pixel = UVec2::new(5, 9);
    let kinds =
        [FilterKind::Box, FilterKind::Tent, FilterKind::Gaussian, FilterKind::BlackmanHarris];
    for (i, kind) in kinds.into_iter().enumerate() {
        let mut bench = Bench::new();
        bench.frame.pixel_filter = kind as u32;
        bench.frame.filter_width = WIDTH;
        let bench = bench.camera(Camera::default(), [64, 48]);
        let mut kernel = bench.single();
        let mut counts = Counts::uniform(SIDE * SIDE, N);
        for k in 0..N {
            let at = kernel.dispatch_film(key(2300 + i, k), pixel);
            let off = (at.as_dvec2() - DVec2::new(5.5, 9.5)) / f64::from(0.5 * WIDTH);
            assert!(off.abs().max_element() <= 1.0 + 1e-6, "{kind:?}: {at}");
            let [x, y] = shares(kind, off);
            counts.add(index(x, SIDE) * SIDE + index(y, SIDE));
        }
        check(&format!("{kind:?} filter"), &counts);
    }
}

/// The extreme numbers give offsets within the filter.
#[test]
fn filters_end_where_they_should() {
    let bench = Bench::new().camera(Camera::default(), [64, 48]);
    let mut kernel = bench.single();
    for u in crate::corners() {
        let all = [
            kernel.box_offset(u, WIDTH),
            kernel.tent_offset(u, WIDTH),
            kernel.gaussian_offset(u, WIDTH),
            kernel.blackman_harris_offset(u, WIDTH),
        ];
        for at in all {
            assert!(at.is_finite() && at.abs().max_element() <= 0.5 * WIDTH + 1e-6, "{u}: {at}");
        }
    }
}
