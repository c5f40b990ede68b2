//! Work items → buffers and commands: a slot for each tile that is under way, a submission for several.
//!
//! It knows nothing of runs or of time.

use super::device::Device;
use super::error::GpuError;
use super::stopwatch::Stopwatch;
use crate::region::{Rect, SampleRange};
use crate::schedule::WorkItem;
use crate::setup::Setup;
use pack::abi::{FilmPixel, Frame};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use wgpu::{
    BindGroup, BindGroupDescriptor, BindGroupEntry, BindingResource, Buffer, BufferBinding,
    BufferDescriptor, BufferUsages, CommandEncoder, CommandEncoderDescriptor,
    ComputePassDescriptor, MapMode, SubmissionIndex,
};

/// Side of the kernel's workgroup in pixels.
const WORKGROUP: u32 = 8;
const PIXEL: u64 = size_of::<FilmPixel>() as u64;

/// Buffers of one tile: its uniform, its film, and where the film is read back.
pub(super) struct Slot {
    pub(super) item: WorkItem,
    capacity: u64,
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
    /// A slot for a tile of `pixels`.
    pub(super) fn take(&mut self, device: &Device, pixels: u64) -> Slot {
        match self.free.pop() {
            Some(slot) if slot.capacity >= pixels => slot,
            // Too small: it is dropped, the new one has room to grow.
            _ => Slot::new(device, pixels.next_power_of_two()),
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
        let bytes = capacity * PIXEL;
        let uniform = buffer(
            "frame",
            size_of::<Frame>() as u64,
            BufferUsages::UNIFORM | BufferUsages::COPY_DST,
        );
        let film = buffer("film", bytes, BufferUsages::STORAGE | BufferUsages::COPY_SRC);
        let readback = buffer("readback", bytes, BufferUsages::MAP_READ | BufferUsages::COPY_DST);
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
        Self { item, capacity, uniform, film, readback, bindings, mapped }
    }

    fn bytes(&self) -> u64 {
        self.item.tile.pixels() * PIXEL
    }

    fn prepare(&mut self, device: &Device, setup: &Setup<'_>, item: WorkItem) {
        self.item = item;
        let frame = setup.frame(&item);
        device.queue.write_buffer(&self.uniform, 0, bytemuck::bytes_of(&frame));
    }

    fn copy(&self, encoder: &mut CommandEncoder) {
        encoder.copy_buffer_to_buffer(&self.film, 0, &self.readback, 0, Some(self.bytes()));
    }

    fn map(&self) {
        let mapped = Arc::clone(&self.mapped);
        mapped.store(false, Ordering::Release);
        self.readback.slice(..self.bytes()).map_async(MapMode::Read, move |result| {
            mapped.store(result.is_ok(), Ordering::Release);
        });
    }

    /// Submits one sample of the image's first workgroup, outside of any run.
    pub(super) fn submit_trial(&mut self, device: &Device, setup: &Setup<'_>) -> SubmissionIndex {
        let [w, h] = setup.image_size();
        let tile = Rect { x: 0, y: 0, w: w.min(WORKGROUP), h: h.min(WORKGROUP) };
        let samples = SampleRange { start: 0, end: 1 };
        submit(
            device,
            setup,
            std::slice::from_mut(self),
            &[WorkItem { tile, samples, replicate: 0, probe: true }],
            None,
        )
    }

    /// Hands the finished pixels to `f`. A pixel that traced no ray was not rendered.
    pub(super) fn read<T>(
        &mut self,
        device: &Device,
        f: impl FnOnce(&[FilmPixel]) -> T,
    ) -> Result<T, GpuError> {
        if !self.mapped.load(Ordering::Acquire) {
            device.fault()?;
            return Err(GpuError::Lost("the film cannot be read back".to_owned()));
        }
        let view = self.readback.slice(..self.bytes()).get_mapped_range();
        let result = match &view {
            Ok(view) => {
                let pixels: &[FilmPixel] = bytemuck::cast_slice(view);
                if pixels.iter().any(|pixel| pixel.rays == 0) {
                    Err(GpuError::Wrong("pixels without a single ray".to_owned()))
                } else {
                    Ok(f(pixels))
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
