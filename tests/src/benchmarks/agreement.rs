//! Whether GPUs render the pictures of the CPU kernel: the same samples on both, example by example and feature by
//! feature.
//!
//! The rounding of a GPU is its driver's: now and then a path takes another turn, and its pixel differs by as
//! much as two samples do. Such differences have no direction. The mean of the picture has to agree within the
//! standard error that the spread of the differences gives.

use std::error::Error;
use std::fmt::{Display, Write as _};

use pack::Pack;
use rayon::prelude::*;
use runtime::{Control, DeviceChoice, Film, Job, SampleRange, Scene, render};
use scenes::catalog::EXAMPLES;

use super::Outcome;
use super::packs::Packs;
use crate::features::{CASES, Case, case_pack};
use crate::scene::{bytes, example};

/// Pixels of the longer side, and samples.
const EXAMPLE: [u32; 2] = [480, 64];
/// Those of a picture of one feature.
const FEATURE: [u32; 2] = [160, 16];
/// Up to which difference of the means, in percent, rounding explains a difference that is no chance.
const ROUNDING: f64 = 0.001;

/// What the difference of two films comes to.
struct Difference {
    /// Pixels with the same bits, in percent.
    same: f64,
    /// Difference of the means and its standard error, in percent of the mean.
    mean: [f64; 2],
    /// Root mean square of the differences, in percent of the mean.
    rms: f64,
}

impl Difference {
    /// The difference of the means in standard errors.
    fn z(&self) -> f64 {
        let [mean, error] = self.mean;
        mean / error.max(f64::MIN_POSITIVE)
    }

    fn agrees(&self) -> bool {
        self.z().abs() < 3.0 || self.mean[0].abs() <= ROUNDING
    }
}

/// What stands below a table without rows.
const NONE: &str = "\nNo GPU was found.\n";

/// Examples with reduced assets by adapters.
pub(super) fn table(_: &mut Packs, text: &mut String) -> Outcome {
    let [side, samples] = EXAMPLE;
    let _ = writeln!(
        text,
        "\n## GPUs against the CPU kernel: {samples} samples a pixel, the same on both\n\n\
        Examples with reduced assets, {side} pixels wide. Same: pixels with the same bits. Mean: difference of the \
        means of the pictures, in percent, with the standard error that the spread of the differences gives; \
        z: their ratio. A GPU rounds as its driver likes, so that some paths take another turn; the means agree \
        where |z| is below 3.\n\n\
        | scene | device | same % | rms % | mean % | z | rays of the CPU | rays of the GPU, more |\n\
        |---|---|---|---|---|---|---|---|"
    );
    let gpus = gpus();
    for found in EXAMPLES {
        let scene = Scene::new(Pack::from_bytes(bytes(&example(found, &[])))?);
        let (reference, _) = film(&scene, &DeviceChoice::Cpu, EXAMPLE)?;
        for gpu in &gpus {
            let (other, device) = film(&scene, gpu, EXAMPLE)?;
            let difference = difference(&other, &reference);
            let Difference { same, mean: [mean, error], rms } = difference;
            let (rays, others) = (reference.counters.rays, other.counters.rays);
            let _ = writeln!(
                text,
                "| `{}` | {device} | {same:.1} | {rms:.2} | {mean:+.5} ± {error:.5} | {:+.1} | {rays} | {:+} |",
                found.name,
                difference.z(),
                others.cast_signed() - rays.cast_signed(),
            );
        }
    }
    if gpus.is_empty() {
        text.push_str(NONE);
    }
    Ok(())
}

/// The small scenes about one feature each, by adapters: how many agree, and those that do not.
pub(super) fn features(_: &mut Packs, text: &mut String) -> Outcome {
    let [side, samples] = FEATURE;
    let _ = writeln!(
        text,
        "\n## Every feature on GPUs and on the CPU: {side} pixels wide, {samples} samples a pixel\n\n\
        The small scenes of `tests/src/features.rs`, each about one feature of the kernel, and one with all of them, \
        compared as above. Means agree where |z| is below 3, or where they differ by at most {ROUNDING} %, which is \
        rounding.\n\n\
        | device | scenes | agree | median same % | largest rms % | largest mean % of those that agree |\n\
        |---|---|---|---|---|---|"
    );
    let gpus = gpus();
    for gpu in &gpus {
        // In parallel: what takes time is the driver, which compiles a kernel for each.
        let found: Vec<_> = CASES.par_iter().map(|case| feature(case, gpu)).collect();
        let failed: Vec<&String> = found.iter().filter_map(|found| found.as_ref().err()).collect();
        if failed.len() == CASES.len() {
            return Err(format!("{gpu:?} renders none of them: {}", failed[0]).into());
        }
        summary(gpu, &found.iter().flatten().collect::<Vec<_>>(), text);
        for line in failed {
            let _ = writeln!(text, "\n{line}");
        }
    }
    if gpus.is_empty() {
        text.push_str(NONE);
    }
    Ok(())
}

fn feature(case: &Case, gpu: &DeviceChoice) -> Result<(&'static str, Difference), String> {
    let told = |error: &dyn Display| format!("{} does not render: {error}.", case.name);
    let scene = Scene::new(case_pack(case));
    let (reference, _) = film(&scene, &DeviceChoice::Cpu, FEATURE).map_err(|error| told(&error))?;
    let (other, _) = film(&scene, gpu, FEATURE).map_err(|error| told(&error))?;
    Ok((case.name, difference(&other, &reference)))
}

/// The row of one adapter and a line for each scene that does not agree.
fn summary(gpu: &DeviceChoice, found: &[&(&str, Difference)], text: &mut String) {
    let device = match gpu {
        DeviceChoice::Named(name) => name.as_str(),
        _ => "GPU",
    };
    let (agree, others): (Vec<_>, Vec<_>) =
        found.iter().copied().partition(|(_, found)| found.agrees());
    let largest = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, f64::max);
    let _ = writeln!(
        text,
        "| {device} | {} | {} | {:.1} | {:.2} | {:.5} |",
        found.len(),
        agree.len(),
        super::median(found.iter().map(|(_, found)| found.same)),
        largest(&mut found.iter().map(|(_, found)| found.rms)),
        largest(&mut agree.iter().map(|(_, found)| found.mean[0].abs())),
    );
    for (name, found) in others {
        let [mean, error] = found.mean;
        let _ = writeln!(text, "\n{name}: {mean:+.5} ± {error:.5} %, z = {:+.1}.", found.z());
    }
}

fn gpus() -> Vec<DeviceChoice> {
    let mut adapters = runtime::gpu::adapters();
    adapters.retain(|adapter| !adapter.is_software());
    adapters.iter().map(|adapter| DeviceChoice::Named(adapter.name().to_owned())).collect()
}

fn film(
    scene: &Scene,
    device: &DeviceChoice,
    [side, samples]: [u32; 2],
) -> Result<(Film, String), Box<dyn Error>> {
    let mut job = Job::of_scene(scene);
    let [w, h] = job.image_size;
    job.resize([side, side * h / w]);
    job.samples = SampleRange { start: 0, end: samples };
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
