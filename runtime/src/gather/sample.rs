//! A sample → what it adds to the layers of its pixel.

use super::gatherer::Gatherer;
use crate::layers::{Layers, Nearest, count};
use pack::abi::{AovSample, CameraKind, NONE};

/// What a sample says of its names.
#[derive(Clone, Copy, Default)]
struct Names {
    /// Numbers from 1, by `MatteKind`.
    numbers: [u32; 3],
    /// Of Cryptomatte.
    ids: [u32; 3],
}

impl Gatherer<'_> {
    /// Adds `n` samples each of the pixels from `first` on.
    pub(super) fn take_all(
        &self,
        layers: &mut Layers,
        backdrop: &mut [[f64; 3]],
        (first, n): (u32, u32),
        found: &[AovSample],
    ) {
        for (i, of_pixel) in (first as usize..).zip(found.chunks_exact(n.max(1) as usize)) {
            for sample in of_pixel {
                self.take(layers, backdrop, i, sample);
            }
        }
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
}

#[expect(clippy::cast_possible_truncation, reason = "rounding is the purpose")]
fn single(x: f64) -> f32 {
    x as f32
}
