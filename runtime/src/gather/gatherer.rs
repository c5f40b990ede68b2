//! Scene + job + film → what is known of a pass, and its rows before there are samples.

use super::names::names;
use crate::film::Film;
use crate::job::Job;
use crate::layers::{Layer, Layers, Matte, Nearest, Wanted};
use crate::lights::LightGroups;
use crate::region::{Rect, SampleRange};
use crate::scene::Scene;
use crate::setup::Setup;
use crate::signals::Signals;
use std::collections::BTreeMap;

/// What layers are made of, and on what.
pub(crate) struct Pass<'a> {
    pub(crate) scene: &'a Scene,
    pub(crate) job: &'a Job,
    pub(crate) signals: &'a Signals,
    /// The GPU that made the picture.
    #[cfg(feature = "gpu")]
    pub(crate) adapter: Option<&'a crate::gpu::Adapter>,
}

/// The layers of a row of pixels, and the sums of the sky that it shows.
pub(super) type Row = (Layers, Vec<[f64; 3]>);

/// One pass.
pub(super) struct Gatherer<'a> {
    pub(super) setup: &'a Setup<'a>,
    pub(super) job: &'a Job,
    pub(super) wanted: &'a Wanted,
    pub(super) lights: LightGroups<'a>,
    pub(super) region: Rect,
    /// Samples that the film has of each pixel, their ranges, and how often it has those with other seeds.
    pub(super) counts: &'a [u32],
    pub(super) ranges: &'a [SampleRange],
    pub(super) replicates: u32,
    /// Whether samples that see the sky count as covered: it is a part of the picture.
    pub(super) opaque: bool,
    /// Metres of a normalised unit, and the world's centre.
    pub(super) space: (f64, [f64; 3]),
    pub(super) camera: pack::abi::Camera,
    /// Objects and instances by `AovSample::object`, materials by `AovSample::material`.
    pub(super) things: Vec<[(u32, u32); 2]>,
    pub(super) materials: Vec<(u32, u32)>,
    pub(super) mattes: Vec<Matte>,
}

impl<'a> Gatherer<'a> {
    pub(super) fn new(
        scene: &'a Scene,
        setup: &'a Setup<'a>,
        job: &'a Job,
        film: &'a Film,
    ) -> Self {
        let manifest = scene.pack().manifest().unwrap_or_default();
        let (things, materials, mattes) = names(&manifest);
        let settings = scene.settings();
        Self {
            setup,
            job,
            wanted: &job.wanted,
            lights: LightGroups::of(scene),
            region: film.region,
            counts: &film.counts,
            ranges: &film.ranges,
            replicates: film.replicates(),
            opaque: scene.pack().sky().is_some() && !job.wanted.transparent,
            space: (1.0 / settings.scale(), settings.center()),
            camera: job.camera.unwrap_or(*scene.pack().camera()),
            things,
            materials,
            mattes,
        }
    }

    /// Rows without samples.
    pub(super) fn rows(&self) -> Vec<Row> {
        (0..self.region.h).map(|_| self.empty(self.region.w as usize)).collect()
    }

    /// Batches of samples in the order in which they are added: replicate and samples.
    pub(super) fn batches(&self) -> impl Iterator<Item = (u32, SampleRange)> {
        let ranges = self.ranges;
        (0..self.replicates).flat_map(move |replicate| {
            ranges.iter().flat_map(|range| range.batches()).map(move |batch| (replicate, batch))
        })
    }

    /// Samples that the film has of the pixels of row `y`.
    pub(super) fn counts_of(&self, y: u32) -> &[u32] {
        let w = self.region.w as usize;
        self.counts.chunks(w.max(1)).nth((y - self.region.y) as usize).unwrap_or_default()
    }

    /// Layers of so many pixels without samples, and without the names of mattes, which may be many.
    pub(super) fn empty(&self, n: usize) -> Row {
        let has = |layer| self.wanted.layers.contains(&layer);
        let sums = |there: bool| if there { vec![[0.0; 3]; n] } else { Vec::new() };
        let nearest = self.wanted.layers.iter().any(|layer| layer.is_nearest());
        let crypto = if has(Layer::Crypto) { self.mattes.as_slice() } else { &[] };
        let matte = |matte: &Matte| Matte {
            kind: matte.kind,
            names: BTreeMap::new(),
            shares: vec![Vec::new(); n],
        };
        let layers = Layers {
            wanted: self.wanted.clone(),
            samples: 0,
            albedo: sums(has(Layer::Albedo)),
            normal: sums(has(Layer::Normal)),
            lights: if has(Layer::Lights) { self.lights.empty(n) } else { Vec::new() },
            covered: if has(Layer::Alpha) { vec![0; n] } else { Vec::new() },
            nearest: if nearest { vec![Nearest::NONE; n] } else { Vec::new() },
            mattes: crypto.iter().map(matte).collect(),
        };
        (layers, sums(self.wanted.transparent))
    }

    /// The rows below each other.
    pub(super) fn joined(&self, rows: Vec<Row>) -> Row {
        let (mut whole, mut backdrop) = self.empty(0);
        for (matte, own) in whole.mattes.iter_mut().zip(&self.mattes) {
            matte.names.clone_from(&own.names);
        }
        for (row, sky) in rows {
            whole.samples = row.samples;
            whole.albedo.extend(row.albedo);
            whole.normal.extend(row.normal);
            whole.covered.extend(row.covered);
            for (group, row) in whole.lights.iter_mut().zip(row.lights) {
                group.sums.extend(row.sums);
            }
            whole.nearest.extend(row.nearest);
            for (matte, row) in whole.mattes.iter_mut().zip(row.mattes) {
                matte.shares.extend(row.shares);
            }
            backdrop.extend(sky);
        }
        (whole, backdrop)
    }
}
