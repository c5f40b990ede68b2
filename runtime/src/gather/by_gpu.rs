//! Batches of samples → the AOVs of all rows, by a GPU: the samples of the picture, in the order of the CPU.

use super::gatherer::{Gatherer, Pass, Row};
use crate::gpu::{self, Adapter, GpuError};
use crate::schedule::WorkItem;
use rayon::prelude::*;

/// The rows of the region with AOVs of every sample, or of fewer once the user has interrupted. `None`: the CPU is to
/// find them.
pub(super) fn rows(gatherer: &Gatherer<'_>, pass: &Pass<'_>) -> Option<Vec<Row>> {
    let adapter = pass.adapter?;
    if !gatherer.wanted.has_aovs() {
        return None;
    }
    let Some(kernel) = gpu::aov_kernel(gatherer.setup) else {
        pass.signals.note("the CPU makes the layers");
        return None;
    };
    let mut rows = gatherer.rows();
    let added = add(gatherer, pass, (adapter, &kernel), &mut rows);
    if let Err(error) = &added {
        pass.signals.note(&format!("{error}; the CPU makes the layers"));
    }
    added.ok().map(|()| rows)
}

fn add(
    gatherer: &Gatherer<'_>,
    pass: &Pass<'_>,
    (adapter, kernel): (&Adapter, &str),
    rows: &mut [Row],
) -> Result<(), GpuError> {
    let setup = pass.scene.setup(gatherer.job).with_kernel(kernel);
    let region = gatherer.region;
    let items = gatherer.batches().flat_map(|(replicate, samples)| {
        let item = move |tile| WorkItem { tile, samples, replicate, probe: false };
        gpu::aov_tiles(region, samples).map(item)
    });
    let items = items.take_while(|_| !pass.signals.is_cancelled());
    gpu::aovs(adapter, &setup, items, |item, found| {
        let (tile, n) = (item.tile, item.samples.count());
        let rows = rows.iter_mut().skip((tile.y - region.y) as usize).take(tile.h as usize);
        let of_rows = found.chunks_exact((tile.w * n) as usize);
        let pairs: Vec<_> = rows.zip(of_rows).collect();
        pairs.into_par_iter().for_each(|((layers, backdrop), found)| {
            gatherer.take_all(layers, backdrop, (tile.x - region.x, n), found);
        });
    })
}
