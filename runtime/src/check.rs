//! A scene → where single and double precision part, and which samples do.
//!
//! The same samples are traced by the kernel in `f32` and by its twin in `f64`, path by path: random numbers
//! are the same, so whatever differs is rounding. It drives the kernel's own functions in the order of its
//! main loop and knows no materials or lights. It does not print.

mod heat;
mod path;
mod report;
mod verdict;

pub use self::heat::encode_heat;
pub(crate) use self::path::single::open;
pub use self::path::{Sample, Step};
pub use self::report::{PARTED, Pixel, Report};
pub use self::verdict::Verdict;

use crate::film::{BadSample, Counters};
use crate::job::Job;
use crate::kernel;
use crate::scene::Scene;
use crate::setup::Setup;
use pack::abi::Frame;
use rayon::prelude::*;
use thiserror::Error;

/// What cannot be checked.
#[derive(Debug, Error)]
pub enum CheckError {
    /// No threads.
    #[error("cannot start the threads of the CPU kernel: {0}")]
    Threads(#[from] rayon::ThreadPoolBuildError),
    /// The tree of the scene is too deep.
    #[error("the scene needs a traversal stack of {0} entries, the CPU kernel has {1}")]
    Stack(u32, u32),
}

/// Traces the samples of the job's whole image in both precisions.
///
/// # Errors
/// When the CPU kernel cannot run the scene.
pub fn compare(scene: &Scene, job: &Job) -> Result<Report, CheckError> {
    let setup = scene.setup(job);
    room(&setup)?;
    let pool = rayon::ThreadPoolBuilder::new().num_threads(job.threads.unwrap_or(0)).build()?;
    let frame = setup.frame_of(job);
    let [width, height] = job.image_size;
    let rows: Vec<Row> = pool.install(|| {
        (0..height).into_par_iter().map(|y| row(&setup, &frame, width, y, job)).collect()
    });
    let mut report = Report {
        size: job.image_size,
        samples: job.samples.count(),
        pixels: Vec::new(),
        means: [0.0; 2],
        counters: [Counters::default(); 2],
        parted: 0,
        bad: [[0; 2]; 2],
    };
    for row in rows {
        report.pixels.extend(row.pixels);
        report.parted += row.parted;
        for i in [0, 1] {
            report.counters[i].add(&row.counters[i]);
            for (sum, n) in report.bad[i].iter_mut().zip(row.bad[i]) {
                *sum += n;
            }
        }
    }
    relate(&mut report);
    Ok(report)
}

/// One sample in both precisions, with every ray; `f32` first.
///
/// # Errors
/// As [`compare`].
pub fn replay(scene: &Scene, job: &Job, at: BadSample) -> Result<[Sample; 2], CheckError> {
    let setup = scene.setup(job);
    room(&setup)?;
    let frame = setup.frame_of(job);
    let pixel = [at.x, at.y];
    let space = (scene.settings().scale(), scene.settings().center());
    let pair = [
        path::single::sample(
            &mut path::single::open(&setup, &frame),
            pixel,
            at.sample,
            job.seed,
            true,
        ),
        path::double::sample(
            &mut path::double::open(&setup, &frame),
            pixel,
            at.sample,
            job.seed,
            true,
        ),
    ];
    Ok(pair.map(|sample| sample.in_world(space)))
}

/// Traces the samples of the job's image in single precision and turns those of each pixel, with every ray,
/// into a `T`; pixels in reading order.
///
/// # Errors
/// As [`compare`].
pub fn paths<T: Send>(
    scene: &Scene,
    job: &Job,
    of_pixel: impl Fn(Vec<Sample>) -> T + Sync,
) -> Result<Vec<T>, CheckError> {
    let setup = scene.setup(job);
    room(&setup)?;
    let frame = setup.frame_of(job);
    let space = (scene.settings().scale(), scene.settings().center());
    let [width, height] = job.image_size;
    let row = |y| {
        let mut kernel = path::single::open(&setup, &frame);
        let mut pixel = |x| {
            let mut sample = |n| path::single::sample(&mut kernel, [x, y], n, job.seed, true);
            let samples = (job.samples.start..job.samples.end).map(&mut sample);
            of_pixel(samples.map(|sample| sample.in_world(space)).collect())
        };
        (0..width).map(&mut pixel).collect::<Vec<T>>()
    };
    Ok((0..height).into_par_iter().flat_map(row).collect())
}

/// Whether the CPU kernel has room for the scene's tree.
pub(crate) fn room(setup: &Setup<'_>) -> Result<(), CheckError> {
    let (need, available) = (setup.stack_need(), kernel::f32::STACK_SIZE);
    if need > available { Err(CheckError::Stack(need, available)) } else { Ok(()) }
}

/// A row of the image.
struct Row {
    pixels: Vec<Pixel>,
    counters: [Counters; 2],
    parted: u64,
    bad: [[u64; 2]; 2],
}

fn row(setup: &Setup<'_>, frame: &Frame, width: u32, y: u32, job: &Job) -> Row {
    let (mut single, mut double) =
        (path::single::open(setup, frame), path::double::open(setup, frame));
    let mut row =
        Row { pixels: Vec::new(), counters: [Counters::default(); 2], parted: 0, bad: [[0; 2]; 2] };
    for x in 0..width {
        let mut pixel = Pixel::default();
        for n in job.samples.start..job.samples.end {
            let pair = [
                path::single::sample(&mut single, [x, y], n, job.seed, false),
                path::double::sample(&mut double, [x, y], n, job.seed, false),
            ];
            row.count(&pair, BadSample { x, y, sample: n });
            let off = difference(pair[0].finite(), pair[1].finite());
            if off > pixel.worst.1 || n == job.samples.start {
                pixel.worst = (n, off);
            }
            pixel.parted += u32::from(pair[0].way != pair[1].way);
            for (mean, sample) in pixel.means.iter_mut().zip(&pair) {
                for (sum, value) in mean.iter_mut().zip(sample.finite()) {
                    *sum += value / f64::from(job.samples.count());
                }
            }
        }
        row.parted += u64::from(pixel.parted);
        row.pixels.push(pixel);
    }
    row
}

impl Row {
    fn count(&mut self, pair: &[Sample; 2], at: BadSample) {
        for (i, sample) in pair.iter().enumerate() {
            let bad = sample.radiance.iter().any(|x| !x.is_finite());
            let nan = sample.radiance.iter().any(|x| x.is_nan());
            self.bad[i][usize::from(!nan)] += u64::from(bad);
            self.counters[i].add(&Counters {
                rays: u64::from(sample.rays),
                bad: u64::from(bad),
                first_bad: bad.then_some(at),
                depth: sample.segments,
                overflows: u64::from(sample.stack_errors & 0xffff),
                leaks: u64::from(sample.stack_errors >> 16),
                removed: 0.0,
            });
        }
    }
}

fn difference(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|k| (a[k] - b[k]).abs()).fold(0.0, f64::max)
}

/// Means of the image, and differences relative to them.
fn relate(report: &mut Report) {
    let n = 3.0 * report.pixels.len().max(1) as f64;
    let mean = |i: usize| report.pixels.iter().flat_map(|p| p.means[i]).sum::<f64>() / n;
    report.means = [mean(0), mean(1)];
    let floor = 1e-3 * report.means[1];
    for pixel in &mut report.pixels {
        let [a, b] = pixel.means;
        let off = difference(a, b);
        let scale = a.into_iter().chain(b).fold(floor, f64::max);
        pixel.off = if off > 0.0 { off / scale } else { 0.0 };
    }
}
