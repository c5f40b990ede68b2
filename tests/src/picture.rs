//! Pack → film → numbers.

use pack::{Checked, Pack};
use runtime::{Control, DeviceChoice, Film, Job, Outcome, Scene, render};

/// Renders with the CPU kernel; `set` changes the job that the scene asks for.
///
/// # Panics
/// When the run fails: tests are to fail there.
#[must_use]
pub fn cpu(pack: Pack<Checked>, set: impl FnOnce(&mut Job)) -> Outcome {
    on(&DeviceChoice::Cpu, pack, set)
}

/// Renders on a device.
///
/// # Panics
/// When the run fails: tests are to fail there.
#[must_use]
pub fn on(device: &DeviceChoice, pack: Pack<Checked>, set: impl FnOnce(&mut Job)) -> Outcome {
    let scene = Scene::new(pack);
    // However few blocks the picture has.
    scene.prepare();
    let mut job = Job::of_scene(&scene);
    set(&mut job);
    match render(&scene, &job, device, &Control::default()) {
        Ok(outcome) => outcome,
        Err(error) => panic!("{error}"),
    }
}

/// A mean over pixels and its standard error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// The mean.
    pub mean: f64,
    /// Its standard error.
    pub error: f64,
}

impl Estimate {
    /// Mean of independent values, with the error that their spread shows: pixels that look at the same
    /// point, or pictures of several seeds. Never the samples of one pixel, which Sobol's sampler makes
    /// depend on each other; pixels and seeds are scrambled independently.
    #[must_use]
    pub fn of(values: &[f64]) -> Self {
        let n = values.len() as f64;
        let mean = values.iter().sum::<f64>() / n;
        let square = values.iter().map(|v| (v - mean) * (v - mean)).sum::<f64>();
        Self { mean, error: (square / (n * (n - 1.0).max(1.0))).sqrt() }
    }

    /// How many standard errors the mean is from `truth`; 0 where both are exact and equal.
    #[must_use]
    pub fn z(&self, truth: f64) -> f64 {
        let off = self.mean - truth;
        if off == 0.0 { 0.0 } else { off / self.error }
    }
}

/// Mean of one channel of each pixel, in image order.
#[must_use]
pub fn channel(film: &Film, channel: usize) -> Vec<f64> {
    let means = film.means();
    means.iter().map(|rgb| rgb[channel]).collect()
}
