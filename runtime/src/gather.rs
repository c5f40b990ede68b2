//! Scene + job + film → the layers of the samples that the film has, with the CPU kernel.
//!
//! A pass of its own, after the picture: rows of pixels on every core, batches in ascending order. Whatever device made
//! the picture, the layers are those of the CPU, which has the same samples bit for bit. It does not know files.

use crate::cpu;
use crate::film::Film;
use crate::job::Job;
use crate::layers::{Layer, Layers, Matte, MatteKind, Nearest, Wanted, count};
use crate::lights::{self, LightGroups, Row};
use crate::region::{Rect, SampleRange};
use crate::scene::Scene;
use crate::schedule::WorkItem;
use crate::setup::Setup;
use crate::signals::Signals;
use pack::Manifest;
use pack::abi::{AovSample, CameraKind, NONE};
use rayon::prelude::*;
use std::collections::BTreeMap;
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
pub(crate) fn gather(
    scene: &Scene,
    job: &Job,
    film: &mut Film,
    signals: &Signals,
) -> Result<Layers, GatherError> {
    let setup = scene.setup(job);
    let pool = cpu::pool(&setup, job)?;
    let gatherer = Gatherer::new(scene, &setup, job, film);
    let work = || {
        setup.tree();
        let rows = film.region.y..film.region.y + film.region.h;
        rows.into_par_iter().map(|y| gatherer.row(y, signals)).collect::<Option<Vec<_>>>()
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

/// What a sample says of its names.
#[derive(Clone, Copy, Default)]
struct Names {
    /// Numbers from 1, by `MatteKind`.
    numbers: [u32; 3],
    /// Of Cryptomatte.
    ids: [u32; 3],
}

struct Gatherer<'a> {
    setup: &'a Setup<'a>,
    job: &'a Job,
    wanted: &'a Wanted,
    lights: LightGroups<'a>,
    region: Rect,
    /// Samples that the film has of each pixel, their ranges, and how often it has those with other seeds.
    counts: &'a [u32],
    ranges: &'a [SampleRange],
    replicates: u32,
    /// Whether samples that see the sky count as covered: it is a part of the picture.
    opaque: bool,
    /// Metres of a normalised unit, and the world's centre.
    space: (f64, [f64; 3]),
    camera: pack::abi::Camera,
    /// Objects and instances by `AovSample::object`, materials by `AovSample::material`.
    things: Vec<[(u32, u32); 2]>,
    materials: Vec<(u32, u32)>,
    mattes: Vec<Matte>,
}

impl<'a> Gatherer<'a> {
    fn new(scene: &'a Scene, setup: &'a Setup<'a>, job: &'a Job, film: &'a Film) -> Self {
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

    /// The layers of row `y`, and the sums of the sky that it shows; `None` once the user has interrupted.
    fn row(&self, y: u32, signals: &Signals) -> Option<(Layers, Vec<[f64; 3]>)> {
        let Rect { w, .. } = self.region;
        let (mut layers, mut backdrop) = self.empty(w as usize);
        let batches = (0..self.replicates)
            .flat_map(|replicate| self.ranges.iter().map(move |range| (replicate, range)));
        for (replicate, samples) in
            batches.flat_map(|(replicate, range)| range.batches().map(move |b| (replicate, b)))
        {
            if signals.is_cancelled() {
                return None;
            }
            layers.samples += samples.count();
            if self.wanted.has_aovs() {
                self.aovs(&mut layers, &mut backdrop, (y, replicate, samples));
            }
            if !layers.lights.is_empty() {
                let tile = Rect { y, h: 1, ..self.region };
                let counts = self.counts_of(y);
                let (setup, job) = (self.setup, self.job);
                let row = Row { setup, job, tile, replicate, samples, counts };
                lights::add(&self.lights, &row, &mut layers.lights);
            }
        }
        Some((layers, backdrop))
    }

    /// Samples that the film has of the pixels of row `y`.
    fn counts_of(&self, y: u32) -> &[u32] {
        let w = self.region.w as usize;
        self.counts.chunks(w.max(1)).nth((y - self.region.y) as usize).unwrap_or_default()
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
            let of_pixels = found.chunks_exact(samples.count() as usize);
            for (i, of_pixel) in (at as usize..).zip(of_pixels) {
                for sample in of_pixel {
                    self.take(layers, backdrop, i, sample);
                }
            }
        }
    }

    /// Layers of so many pixels without samples, and without the names of mattes, which may be many.
    fn empty(&self, n: usize) -> (Layers, Vec<[f64; 3]>) {
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

    /// Adds a sample to pixel `i`.
    fn take(&self, layers: &mut Layers, backdrop: &mut [[f64; 3]], i: usize, sample: &AovSample) {
        let sums = [
            (layers.albedo.get_mut(i), sample.albedo),
            (layers.normal.get_mut(i), sample.normal),
            (backdrop.get_mut(i), sample.backdrop),
        ];
        for (sum, add) in sums {
            let Some(sum) = sum.filter(|_| add.iter().all(|x| x.is_finite())) else { continue };
            for (sum, add) in sum.iter_mut().zip(add) {
                *sum += f64::from(add);
            }
        }
        if let Some(covered) = layers.covered.get_mut(i) {
            *covered += u32::from(sample.alpha > 0.0 || self.opaque);
        }
        if sample.material == NONE {
            return;
        }
        let names = self.names_of(sample);
        if let Some(nearest) = layers.nearest.get_mut(i) {
            nearest.take(&self.nearest(sample, &names));
        }
        for (matte, id) in layers.mattes.iter_mut().zip(names.ids) {
            if let Some(shares) = matte.shares.get_mut(i) {
                count(shares, id, 1);
            }
        }
    }

    fn names_of(&self, sample: &AovSample) -> Names {
        let at = |index: u32| usize::try_from(index).unwrap_or(usize::MAX);
        let [object, instance] = self.things.get(at(sample.object)).copied().unwrap_or_default();
        let material = self.materials.get(at(sample.material)).copied().unwrap_or_default();
        let both = [object, instance, material];
        Names { numbers: both.map(|(number, _)| number), ids: both.map(|(_, id)| id) }
    }

    fn nearest(&self, sample: &AovSample, names: &Names) -> Nearest {
        let (metres, center) = self.space;
        let from = |a: [f32; 3], b: [f32; 3]| {
            [0, 1, 2].map(|axis| f64::from(a[axis]) - f64::from(b[axis]))
        };
        let away = from(sample.position, self.camera.origin);
        let depth: f64 = if self.camera.kind == CameraKind::Panoramic as u32 {
            away.iter().map(|a| a * a).sum::<f64>().sqrt()
        } else {
            away.iter().zip(self.camera.forward).map(|(a, axis)| a * f64::from(axis)).sum()
        };
        let [x, y, z] = sample.position.map(f64::from);
        let position =
            [x * metres + center[0], y * metres + center[1], z * metres + center[2]].map(single);
        Nearest { depth: single(depth * metres), position, uv: sample.uv, numbers: names.numbers }
    }

    /// The rows below each other.
    fn joined(&self, rows: Vec<(Layers, Vec<[f64; 3]>)>) -> (Layers, Vec<[f64; 3]>) {
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

#[expect(clippy::cast_possible_truncation, reason = "rounding is the purpose")]
fn single(x: f64) -> f32 {
    x as f32
}

/// What names the scene has: number and id of the object and of the instance of each thing, of each material, and the
/// mattes without pixels.
#[expect(clippy::type_complexity, reason = "three tables that are taken apart at once")]
fn names(manifest: &Manifest) -> (Vec<[(u32, u32); 2]>, Vec<(u32, u32)>, Vec<Matte>) {
    // In the order in which the compiler numbers things.
    let all = manifest.instances.iter().chain(&manifest.lights);
    let instances: Vec<&str> = all.map(|named| named.name.as_str()).collect();
    let objects: Vec<&str> = instances.iter().map(|name| object_of(name)).collect();
    let materials: Vec<&str> = manifest.materials.iter().map(|named| named.name.as_str()).collect();
    let [of_objects, of_instances, of_materials] =
        [&objects, &instances, &materials].map(|names| numbered(names));
    let things = of_objects.into_iter().zip(of_instances).map(|(o, i)| [o, i]).collect();
    let names = [objects, instances, materials];
    let mattes = MatteKind::ALL.into_iter().zip(names).map(|(kind, n)| Matte::new(kind, n));
    (things, of_materials, mattes.collect())
}

/// `petals` of `petals[3]`: all copies that one declaration makes.
fn object_of(instance: &str) -> &str {
    instance.split('[').next().unwrap_or(instance)
}

/// For each name the number of its first place, from 1, and its id.
fn numbered(names: &[&str]) -> Vec<(u32, u32)> {
    let mut first = BTreeMap::new();
    for (name, number) in names.iter().zip(1_u32..) {
        first.entry(*name).or_insert(number);
    }
    let of = |name: &&str| (first.get(name).copied().unwrap_or(0), crate::layers::id_of(name));
    names.iter().map(of).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn copies_of_an_instance_are_one_object() {
        assert_eq!((object_of("petals[3]"), object_of("floor")), ("petals", "floor"));
        let found = numbered(&["floor", "petals", "petals"]);
        assert_eq!(found.iter().map(|row| row.0).collect::<Vec<_>>(), [1, 2, 2]);
    }
}
