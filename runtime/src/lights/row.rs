//! What is walked at once, and the light of one sample on its way into sums.

use crate::job::Job;
use crate::layers::Group;
use crate::region::{Rect, SampleRange};
use crate::setup::Setup;

/// Samples of a row of pixels.
pub(crate) struct Row<'a> {
    pub(crate) setup: &'a Setup<'a>,
    pub(crate) job: &'a Job,
    /// One pixel high.
    pub(crate) tile: Rect,
    pub(crate) replicate: u32,
    pub(crate) samples: SampleRange,
    /// Of each pixel, the samples that the film has; where it has none there is no light either.
    pub(crate) counts: &'a [u32],
}

/// The light of one sample, by group.
#[derive(Default)]
pub(super) struct Sample {
    pub(super) sums: Vec<[f64; 3]>,
    /// What of it is direct, as `indirect.wgsl` says.
    pub(super) direct: Vec<[f64; 3]>,
}

impl Sample {
    pub(super) fn begin(&mut self, groups: usize) {
        self.sums.clear();
        self.sums.resize(groups, [0.0; 3]);
    }

    pub(super) fn take(&mut self, group: usize, light: [f64; 3]) {
        if let Some(sum) = self.sums.get_mut(group) {
            for (sum, light) in sum.iter_mut().zip(light) {
                *sum += light;
            }
        }
    }

    /// Adds it to pixel `i`, its indirect light times `scale` if there is one.
    pub(super) fn put(&self, groups: &mut [Group], i: usize, scale: Option<f64>) {
        for (g, (group, own)) in groups.iter_mut().zip(&self.sums).enumerate() {
            let Some(sum) = group.sums.get_mut(i) else { continue };
            let direct = self.direct.get(g).copied().unwrap_or_default();
            for ((sum, own), direct) in sum.iter_mut().zip(own).zip(direct) {
                *sum += scale.map_or(*own, |scale| direct + (own - direct) * scale);
            }
        }
    }
}
