//! Adapter + scene → a device that has rendered one workgroup.
//!
//! Drivers compile at the first dispatch, and one that renders nothing at all is found before it is trusted with a
//! picture.

use super::adapter::Adapter;
use super::device::{Device, Module};
use super::error::GpuError;
use super::slot::{Slot, Slots};
use crate::setup::Setup;
use std::time::Instant;

/// As [`Device::open`], and renders 8 × 8 pixels once.
pub(super) fn open(
    adapter: &Adapter,
    setup: &Setup<'_>,
    module: Module,
    timed: bool,
) -> Result<Device, GpuError> {
    let mut device = Device::open(adapter, setup, module, timed)?;
    let began = Instant::now();
    let mut slots = Slots::default();
    let mut slot: Slot = slots.take(&device, 64);
    let index = slot.submit_trial(&device, setup);
    device.wait(index)?;
    device.fault()?;
    slot.read(&device, |_| ())?;
    device.built += began.elapsed();
    Ok(device)
}
