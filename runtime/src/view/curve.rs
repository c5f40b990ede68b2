//! Errors of a picture on its way → a curve of few points, for a plot whose axes are logarithmic.

use serde::Serialize;

/// Factor between the samples of two points that are kept.
const STEP: f64 = 1.1;

/// The error at some moment.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub(super) struct Point {
    /// Samples of every pixel.
    pub(super) samples: u32,
    /// Of rendering.
    pub(super) seconds: f64,
    /// Relative error of the picture.
    pub(super) error: f64,
}

/// Adds the newest point; the one before it goes if it is hardly more than the one before that.
pub(super) fn add(curve: &mut Vec<Point>, point: Point) {
    if let [.., before, last] = curve.as_slice()
        && f64::from(last.samples) < STEP * f64::from(before.samples)
    {
        curve.pop();
    }
    curve.push(point);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_run_has_a_short_curve_that_ends_at_its_last_point() {
        let mut curve = Vec::new();
        for samples in (4..=400_000).step_by(4) {
            add(&mut curve, Point { samples, seconds: 0.0, error: 1.0 });
        }
        assert_eq!((curve[0].samples, curve[1].samples), (4, 8));
        assert_eq!(curve.last().map(|point| point.samples), Some(400_000));
        assert!(curve.len() < 130, "{}", curve.len());
        assert!(curve.is_sorted_by_key(|point| point.samples));
    }
}
