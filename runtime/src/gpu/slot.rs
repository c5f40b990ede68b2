//! Work items → buffers and commands: a slot for each tile that is under way, a submission for several.
//!
//! It knows nothing of runs or of time.

use super::device::Device;
use super::error::GpuError;
use super::record::Written;
use super::stopwatch::Stopwatch;
use crate::region::{Rect, SampleRange};
use crate::schedule::WorkItem;
use crate::setup::Setup;
use pack::abi::Frame;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use wgpu::{
    BindGroup, BindGroupDescriptor, BindGroupEntry, BindingResource, Buffer, BufferBinding,
    BufferDescriptor, BufferUsages, CommandEncoder, CommandEncoderDescriptor,
    ComputePassDescriptor, MapMode, SubmissionIndex,
};

/// Side of the kernel's workgroup in pixels.
pub(super) const WORKGROUP: u32 = 8;

/// Buffers of one tile: its uniform, its film, and where the film is read back.
pub(super) struct Slot {
    pub(super) item: WorkItem,
    /// Bytes that the film has room for, and those of the item.
    capacity: u64,
    bytes: u64,
    uniform: Buffer,
    film: Buffer,
    readback: Buffer,
    bindings: BindGroup,
    mapped: Arc<AtomicBool>,
}

/// Slots and stopwatches that wait to be used again.
#[derive(Default)]
pub(super) struct Slots {
    pub(super) free: Vec<Slot>,
    pub(super) watches: Vec<Stopwatch>,
}

impl Slots {
    /// A slot for a tile of which the kernel writes so many bytes.
    pub(super) fn take(&mut self, device: &Device, bytes: u64) -> Slot {
        match self.free.pop() {
            Some(slot) if slot.capacity >= bytes => slot,
            // Too small: it is dropped, the new one has room to grow.
            _ => Slot::new(device, bytes.next_power_of_two()),
        }
    }
}

impl Slot {
    fn new(device: &Device, capacity: u64) -> Self {
        let buffer = |label, size, usage| {
            let label = Some(label);
            device.gpu.create_buffer(&BufferDescriptor {
                label,
                size,
                usage,
                mapped_at_creation: false,
            })
        };
        let uniform = buffer(
            "frame",
            size_of::<Frame>() as u64,
            BufferUsages::UNIFORM | BufferUsages::COPY_DST,
        );
        let film = buffer("film", capacity, BufferUsages::STORAGE | BufferUsages::COPY_SRC);
        let readback =
            buffer("readback", capacity, BufferUsages::MAP_READ | BufferUsages::COPY_DST);
        let part = |buffer, offset, size| {
            let size = wgpu::BufferSize::new(size);
            BindingResource::Buffer(BufferBinding { buffer, offset, size })
        };
        let mut entries = vec![
            BindGroupEntry { binding: 0, resource: uniform.as_entire_binding() },
            BindGroupEntry { binding: 1, resource: film.as_entire_binding() },
        ];
        entries.extend(device.windows.iter().map(|window| BindGroupEntry {
            binding: window.binding,
            resource: part(&window.buffer, window.offset, window.size),
        }));
        let bindings = device.gpu.create_bind_group(&BindGroupDescriptor {
            label: Some("tile"),
            layout: &device.layout,
            entries: &entries,
        });
        let nothing = SampleRange { start: 0, end: 1 };
        let tile = Rect { x: 0, y: 0, w: 1, h: 1 };
        let item = WorkItem { tile, samples: nothing, replicate: 0, probe: true };
        let mapped = Arc::new(AtomicBool::new(false));
        Self { item, capacity, bytes: 0, uniform, film, readback, bindings, mapped }
    }

    fn prepare(&mut self, device: &Device, setup: &Setup<'_>, item: WorkItem) {
        self.item = item;
        self.bytes = device.entry.bytes(&item);
        let frame = setup.frame(&item);
        device.queue.write_buffer(&self.uniform, 0, bytemuck::bytes_of(&frame));
    }

    fn copy(&self, encoder: &mut CommandEncoder) {
        encoder.copy_buffer_to_buffer(&self.film, 0, &self.readback, 0, Some(self.bytes));
    }

    fn map(&self) {
        let mapped = Arc::clone(&self.mapped);
        mapped.store(false, Ordering::Release);
        self.readback.slice(..self.bytes).map_async(MapMode::Read, move |result| {
            mapped.store(result.is_ok(), Ordering::Release);
        });
    }

    /// Hands the finished records to `f`. One that traced no ray was not rendered.
    pub(super) fn read<R: Written, T>(
        &mut self,
        device: &Device,
        f: impl FnOnce(&[R]) -> T,
    ) -> Result<T, GpuError> {
        if !self.mapped.load(Ordering::Acquire) {
            device.fault()?;
            return Err(GpuError::Lost("the film cannot be read back".to_owned()));
        }
        let view = self.readback.slice(..self.bytes).get_mapped_range();
        let result = match &view {
            Ok(view) => {
                let records: &[R] = bytemuck::cast_slice(view);
                if records.iter().any(|record| record.rays() == 0) {
                    Err(GpuError::Wrong("pixels without a single ray".to_owned()))
                } else {
                    Ok(f(records))
                }
            }
            Err(error) => Err(GpuError::Api(error.to_string())),
        };
        drop(view);
        self.readback.unmap();
        result
    }
}

/// One submission: every item in its slot, in one pass, then read back.
pub(super) fn submit(
    device: &Device,
    setup: &Setup<'_>,
    slots: &mut [Slot],
    items: &[WorkItem],
    watch: Option<&Stopwatch>,
) -> SubmissionIndex {
    let descriptor = CommandEncoderDescriptor { label: Some("tiles") };
    let mut encoder = device.gpu.create_command_encoder(&descriptor);
    for (slot, item) in slots.iter_mut().zip(items) {
        slot.prepare(device, setup, *item);
    }
    let mut pass = encoder.begin_compute_pass(&ComputePassDescriptor {
        label: Some("tiles"),
        timestamp_writes: watch.map(Stopwatch::writes),
    });
    pass.set_pipeline(&device.pipeline);
    for (slot, item) in slots.iter().zip(items) {
        pass.set_bind_group(0, &slot.bindings, &[]);
        let groups = [item.tile.w, item.tile.h].map(|side| side.div_ceil(WORKGROUP));
        pass.dispatch_workgroups(groups[0], groups[1], 1);
    }
    drop(pass);
    for slot in slots.iter() {
        slot.copy(&mut encoder);
    }
    if let Some(watch) = watch {
        watch.resolve(&mut encoder);
    }
    let index = device.queue.submit([encoder.finish()]);
    slots.iter().for_each(Slot::map);
    if let Some(watch) = watch {
        watch.map();
    }
    index
}
