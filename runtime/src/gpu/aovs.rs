//! AOV kernel + tiles → what each of their samples shows beside radiance.
//!
//! Some tiles are under way while the caller takes those before them, in order. It knows nothing of layers.

use super::adapter::Adapter;
use super::device::{Device, Module};
use super::error::GpuError;
use super::record::{Entry, is_cut};
use super::slot::{Slot, Slots, submit};
use super::trial::open;
use crate::cpu;
use crate::job::Job;
use crate::region::{Rect, SampleRange};
use crate::scene::Scene;
use crate::schedule::WorkItem;
use crate::setup::Setup;
use crate::trust::{AOV, Trust, Wanted, judge, relink};
use pack::abi::AovSample;
use std::collections::VecDeque;

/// Tiles under way at once.
const IN_FLIGHT: usize = 2;

/// Samples of one tile: some 20 MB of records, and far less than the second that drivers give a dispatch.
const SAMPLES: u32 = 1 << 18;

/// The AOV kernel of the scene of `setup`, by the features of its own; `None` if that is not known, or if there is nothing
/// to hit. It runs without checks, and takes the size of its stack from the pack's kernel: see `judge`.
pub(crate) fn kernel(setup: &Setup<'_>) -> Option<String> {
    if !setup.has_geometry() || judge(setup) != Trust::Known {
        return None;
    }
    relink(setup, Wanted::of(setup).with_uv(), AOV)
}

/// The kernel that finds the layers of a scene on a GPU; `None` where the CPU does.
#[must_use]
pub fn layers_kernel(scene: &Scene) -> Option<String> {
    kernel(&scene.setup(&Job::of_scene(scene)))
}

/// Parts of a region of the image that a device takes at once, each as wide as the region if that is possible.
pub(crate) fn tiles(region: Rect, samples: SampleRange) -> impl Iterator<Item = Rect> {
    let most = (SAMPLES / samples.count().max(1)).max(1);
    let w = region.w.min(most).max(1);
    let h = (most / w).max(1);
    let Rect { x, y, w: width, h: height } = region;
    let rows = (0..height).step_by(h as usize);
    rows.flat_map(move |top| {
        let columns = (0..width).step_by(w as usize);
        columns.map(move |left| Rect {
            x: x + left,
            y: y + top,
            w: w.min(width - left),
            h: h.min(height - top),
        })
    })
}

/// Hands the samples of each item to `take`, pixel by pixel. `setup`: with the AOV kernel.
pub(crate) fn aovs(
    adapter: &Adapter,
    setup: &Setup<'_>,
    mut items: impl Iterator<Item = WorkItem>,
    mut take: impl FnMut(&WorkItem, &[AovSample]),
) -> Result<(), GpuError> {
    let device: Device = open(adapter, setup, (Module::Trusted, Entry::Aov), false)?;
    let mut free = Slots::default();
    let mut under_way: VecDeque<(_, Slot)> = VecDeque::new();
    loop {
        while under_way.len() < IN_FLIGHT {
            let Some(item) = items.next() else { break };
            let mut slot = free.take(&device, Entry::Aov.bytes(&item));
            let index = submit(&device, setup, std::slice::from_mut(&mut slot), &[item], None);
            under_way.push_back((index, slot));
        }
        let Some((index, mut slot)) = under_way.pop_front() else { return Ok(()) };
        let waited = device.wait(index);
        device.fault()?;
        waited?;
        let item = slot.item;
        slot.read(&device, |samples: &[AovSample]| {
            if is_cut(samples) {
                take(&item, &cpu::aovs(setup, &item));
            } else {
                take(&item, samples);
            }
        })?;
        free.free.push(slot);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tiles_cover_every_pixel_once() {
        for (w, h, n) in [(640, 360, 16), (1, 1, 1), (40_000, 2, 16), (33, 70, 1), (7, 0, 16)] {
            let region = Rect { x: 3, y: 5, w, h };
            let samples = SampleRange { start: 32, end: 32 + n };
            let all: Vec<Rect> = tiles(region, samples).collect();
            let pixels: u64 = all.iter().map(|tile| tile.pixels()).sum();
            assert_eq!(pixels, u64::from(w) * u64::from(h), "{w} x {h}");
            let inside =
                |t: &Rect| t.x >= 3 && t.y >= 5 && t.x + t.w <= 3 + w && t.y + t.h <= 5 + h;
            assert!(all.iter().all(|t| inside(t) && t.pixels() * u64::from(n) <= SAMPLES.into()));
            let mut corners: Vec<[u32; 2]> = all.iter().map(|tile| [tile.y, tile.x]).collect();
            corners.dedup();
            assert_eq!(corners.len(), all.len());
        }
    }
}
