//! Adapter + scene → a device that has rendered one workgroup.
//!
//! Drivers compile at the first dispatch, and one that renders nothing at all is found before it is trusted with a
//! picture.

use super::adapter::Adapter;
use super::device::{Device, Module};
use super::error::GpuError;
use super::record::{Entry, Written};
use super::slot::{Slots, WORKGROUP, submit};
use crate::region::{Rect, SampleRange};
use crate::schedule::WorkItem;
use crate::setup::Setup;
use pack::abi::{AovSample, FilmPixel};
use std::time::Instant;

/// As [`Device::open`], and renders 8 × 8 pixels once.
pub(super) fn open(
    adapter: &Adapter,
    setup: &Setup<'_>,
    (module, entry): (Module, Entry),
    timed: bool,
) -> Result<Device, GpuError> {
    let mut device = Device::open(adapter, setup, (module, entry), timed)?;
    let began = Instant::now();
    match entry {
        Entry::Render => run::<FilmPixel>(&device, setup)?,
        Entry::Aov => run::<AovSample>(&device, setup)?,
    }
    device.built += began.elapsed();
    Ok(device)
}

/// One sample of the image's first workgroup, outside of any run.
fn run<R: Written>(device: &Device, setup: &Setup<'_>) -> Result<(), GpuError> {
    let [w, h] = setup.image_size();
    let tile = Rect { x: 0, y: 0, w: w.min(WORKGROUP), h: h.min(WORKGROUP) };
    let samples = SampleRange { start: 0, end: 1 };
    let item = WorkItem { tile, samples, replicate: 0, probe: true };
    let mut slot = Slots::default().take(device, device.entry.bytes(&item));
    let index = submit(device, setup, std::slice::from_mut(&mut slot), &[item], None);
    device.wait(index)?;
    device.fault()?;
    slot.read(device, |_: &[R]| ())
}
