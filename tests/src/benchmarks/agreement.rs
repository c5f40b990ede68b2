//! Whether GPUs render the pictures of the CPU kernel: the same samples on both, example by example.
//!
//! The rounding of a GPU is its driver's: now and then a path takes another turn, and its pixel differs by as
//! much as two samples do. Such differences have no direction. The mean of the picture has to agree within the
//! standard error that the spread of the differences gives.

use std::error::Error;
use std::fmt::Write as _;

use pack::Pack;
use runtime::{Control, DeviceChoice, Film, Job, SampleRange, Scene, render};
use scenes::catalog::EXAMPLES;

use super::Outcome;
use super::packs::Packs;
use crate::scene::{bytes, example};

/// Pixels of the longer side, and samples.
const SIDE: u32 = 480;
const SAMPLES: u32 = 64;

/// What the difference of two films comes to.
struct Difference {
    /// Pixels with the same bits, in percent.
    same: f64,
    /// Difference of the means and its standard error, in percent of the mean.
    mean: [f64; 2],
    /// Root mean square of the differences, in percent of the mean.
    rms: f64,
}

/// Examples with reduced assets by adapters.
pub(super) fn table(_: &mut Packs, text: &mut String) -> Outcome {
    let _ = writeln!(
        text,
        "\n## GPUs against the CPU kernel: {SAMPLES} samples a pixel, the same on both\n\n\
        Examples with reduced assets, {SIDE} pixels wide. Same: pixels with the same bits. Mean: difference of the \
        means of the pictures, in percent, with the standard error that the spread of the differences gives; \
        z: their ratio. A GPU rounds as its driver likes, so that some paths take another turn; the means agree \
        where |z| is below 3.\n\n\
        | scene | device | same % | rms % | mean % | z | rays of the CPU | rays of the GPU, more |\n\
        |---|---|---|---|---|---|---|---|"
    );
    let mut adapters = runtime::gpu::adapters();
    adapters.retain(|adapter| !adapter.is_software());
    for found in EXAMPLES {
        let scene = Scene::new(Pack::from_bytes(bytes(&example(found, &[])))?);
        let (reference, _) = film(&scene, &DeviceChoice::Cpu)?;
        for adapter in &adapters {
            let choice = DeviceChoice::Named(adapter.name().to_owned());
            let (other, device) = film(&scene, &choice)?;
            let found_difference = difference(&other, &reference);
            let Difference { same, mean: [mean, error], rms } = found_difference;
            let (rays, others) = (reference.counters.rays, other.counters.rays);
            let _ = writeln!(
                text,
                "| `{}` | {device} | {same:.1} | {rms:.2} | {mean:+.5} ± {error:.5} | {:+.1} | {rays} | {:+} |",
                found.name,
                mean / error.max(f64::MIN_POSITIVE),
                others.cast_signed() - rays.cast_signed(),
            );
        }
    }
    if adapters.is_empty() {
        text.push_str("\nNo GPU was found.\n");
    }
    Ok(())
}

fn film(scene: &Scene, device: &DeviceChoice) -> Result<(Film, String), Box<dyn Error>> {
    let mut job = Job::of_scene(scene);
    let [w, h] = job.image_size;
    job.resize([SIDE, SIDE * h / w]);
    job.samples = SampleRange { start: 0, end: SAMPLES };
    let outcome = render(scene, &job, device, &Control::default())?;
    let device = outcome.picture.meta.device.clone();
    Ok((outcome.picture.film, device))
}

/// Of `film` from `reference`, over all pixels and the mean of the channels.
fn difference(film: &Film, reference: &Film) -> Difference {
    let grey = |rgb: &[f64; 3]| rgb.iter().sum::<f64>() / 3.0;
    let (ours, theirs) = (film.means(), reference.means());
    let n = ours.len() as f64;
    let mean = theirs.iter().map(grey).sum::<f64>() / n;
    let differences: Vec<f64> =
        ours.iter().zip(&theirs).map(|(a, b)| (grey(a) - grey(b)) / mean * 100.0).collect();
    let off = differences.iter().sum::<f64>() / n;
    let square = differences.iter().map(|d| d * d).sum::<f64>() / n;
    let bits = |rgb: &[f64; 3]| rgb.map(f64::to_bits);
    let same = ours.iter().zip(&theirs).filter(|(a, b)| bits(a) == bits(b)).count();
    let error = ((square - off * off).max(0.0) / n).sqrt();
    Difference { same: same as f64 / n * 100.0, mean: [off, error], rms: square.sqrt() }
}
