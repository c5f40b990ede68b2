//! Scene + job + film → the layers of the samples that the film has.
//!
//! A pass of its own, after the picture, batches in ascending order. AOVs come from the CPU, rows of pixels on every core,
//! or from the GPU that made the picture, so that both show the same points; light groups come from the CPU. It does not
//! know files.

#[cfg(feature = "gpu")]
mod by_gpu;
mod gatherer;
mod names;
mod sample;

pub(crate) use self::gatherer::Pass;
use self::gatherer::{Gatherer, Row};
use crate::cpu;
use crate::film::Film;
use crate::layers::Layers;
use crate::lights;
use crate::region::{Rect, SampleRange};
use crate::schedule::WorkItem;
use crate::signals::Signals;
use rayon::prelude::*;
use std::panic::{AssertUnwindSafe, catch_unwind};
use thiserror::Error;

/// Pixels that are asked for at once; their samples stay in the caches.
const PIXELS: u32 = 32;

/// There are no layers.
#[derive(Debug, Error)]
pub(crate) enum GatherError {
    /// The user interrupted.
    #[error("interrupted")]
    Cancelled,
    /// No threads, or a tree that is too deep.
    #[error(transparent)]
    Cpu(#[from] cpu::CpuError),
    /// A bug.
    #[error("bug in rtr: {0}")]
    Bug(String),
}

/// The layers that the job wants, of every pixel of the film. Where the picture is to be transparent, the film loses the
/// sky that the camera sees.
pub(crate) fn gather(pass: &Pass<'_>, film: &mut Film) -> Result<Layers, GatherError> {
    let Pass { scene, job, signals, .. } = *pass;
    let setup = scene.setup(job);
    let pool = cpu::pool(&setup, job)?;
    let gatherer = Gatherer::new(scene, &setup, job, film);
    let work = || {
        let (mut rows, aovs) = gatherer.begin(pass);
        setup.tree();
        let add = |(y, row): (u32, &mut Row)| gatherer.add(y, row, aovs, signals);
        let done = (film.region.y..).zip(&mut rows).collect::<Vec<_>>();
        done.into_par_iter().map(add).collect::<Option<()>>().map(|()| rows)
    };
    let rows = catch_unwind(AssertUnwindSafe(|| pool.install(work)))
        .map_err(|panic| GatherError::Bug(cpu::panic_text(panic.as_ref())))?;
    let rows = rows.ok_or(GatherError::Cancelled)?;
    let (layers, backdrop) = gatherer.joined(rows);
    if job.wanted.transparent {
        remove(film, &layers, &backdrop);
    }
    Ok(layers)
}

/// Takes the sky out of the film. Nothing is left of a pixel that shows nothing else.
fn remove(film: &mut Film, layers: &Layers, backdrop: &[[f64; 3]]) {
    for (i, (sum, backdrop)) in film.sums.iter_mut().zip(backdrop).enumerate() {
        let empty = layers.covered.get(i) == Some(&0);
        for (sum, backdrop) in sum.iter_mut().zip(backdrop) {
            *sum = if empty { 0.0 } else { (*sum - backdrop).max(0.0) };
        }
    }
}

impl Gatherer<'_> {
    /// Rows with what the GPU has found, if it has, and whether AOVs are still to be found.
    #[cfg(feature = "gpu")]
    fn begin(&self, pass: &Pass<'_>) -> (Vec<Row>, bool) {
        by_gpu::rows(self, pass)
            .map_or_else(|| (self.rows(), self.wanted.has_aovs()), |rows| (rows, false))
    }

    #[cfg(not(feature = "gpu"))]
    fn begin(&self, _: &Pass<'_>) -> (Vec<Row>, bool) {
        (self.rows(), self.wanted.has_aovs())
    }

    /// Adds what the CPU finds in row `y`, AOVs if it is to; `None` once the user has interrupted.
    fn add(
        &self,
        y: u32,
        (layers, backdrop): &mut Row,
        aovs: bool,
        signals: &Signals,
    ) -> Option<()> {
        for (replicate, samples) in self.batches() {
            if signals.is_cancelled() {
                return None;
            }
            layers.samples += samples.count();
            if aovs {
                self.aovs(layers, backdrop, (y, replicate, samples));
            }
            if !layers.lights.is_empty() {
                let tile = Rect { y, h: 1, ..self.region };
                let counts = self.counts_of(y);
                let (setup, job) = (self.setup, self.job);
                let row = lights::Row { setup, job, tile, replicate, samples, counts };
                lights::add(&self.lights, &row, &mut layers.lights);
            }
        }
        Some(())
    }

    /// Adds the AOVs of a batch of row `y`.
    fn aovs(
        &self,
        layers: &mut Layers,
        backdrop: &mut [[f64; 3]],
        (y, replicate, samples): (u32, u32, SampleRange),
    ) {
        let Rect { x, w, .. } = self.region;
        for at in (0..w).step_by(PIXELS as usize) {
            let tile = Rect { x: x + at, y, w: PIXELS.min(w - at), h: 1 };
            let item = WorkItem { tile, samples, replicate, probe: false };
            let found = cpu::aovs(self.setup, &item);
            self.take_all(layers, backdrop, (at, samples.count()), &found);
        }
    }
}
