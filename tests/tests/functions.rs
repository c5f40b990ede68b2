//! Every function of the kernel that has a truth outside of it: in single precision within the bounds that
//! its comment promises, in double precision tighter.

#![expect(
    clippy::cast_possible_truncation,
    clippy::float_cmp,
    reason = "inputs are rounded to the kernel's precision on purpose, and some answers are exact"
)]

#[path = "functions/math.rs"]
mod math;
#[path = "functions/noise.rs"]
mod noise;
#[path = "functions/offset.rs"]
mod offset;
#[path = "functions/optics.rs"]
mod optics;
#[path = "functions/sphere.rs"]
mod sphere;
#[path = "functions/triangle.rs"]
mod triangle;
#[path = "functions/water.rs"]
mod water;

/// The largest of some errors, and where it was.
#[derive(Clone, Copy, Debug, Default)]
struct Worst {
    error: f64,
    at: f64,
}

impl Worst {
    fn add(&mut self, error: f64, at: f64) {
        // A NaN is worse than any number.
        if error.is_nan() || error > self.error {
            *self = Self { error: if error.is_nan() { f64::INFINITY } else { error }, at };
        }
    }

    fn check(self, name: &str, bound: f64) {
        assert!(
            self.error <= bound,
            "{name}: {:.2e} at {}, bound {bound:.1e}",
            self.error,
            self.at
        );
    }
}
