//! Work items → submissions → pixels: several tiles at once, each with a film of its own.
//!
//! Two or three submissions are under way, so that the device never waits for us; each holds up to
//! four tiles that share no writable buffer, so that their tails overlap. Tiles are deposited as
//! their submission ends; what a lost device did not finish goes back to the run.

use super::GpuError;
use super::device::Device;
use super::pace::{Busy, MAX_TILES, Pace};
use super::stopwatch::Stopwatch;
use super::upload::wait;
use crate::region::{Rect, SampleRange};
use crate::run::Run;
use crate::scene::Setup;
use crate::schedule::{Claim, WorkItem};
use pack::abi::{FilmPixel, Frame};
use std::collections::VecDeque;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;
use wgpu::{
    BindGroup, BindGroupDescriptor, BindGroupEntry, BindingResource, Buffer, BufferBinding,
    BufferDescriptor, BufferUsages, CommandEncoder, CommandEncoderDescriptor,
    ComputePassDescriptor, MapMode, SubmissionIndex,
};

/// Submissions under way at once.
const IN_FLIGHT: usize = 3;
/// Side of the kernel's workgroup in pixels.
const WORKGROUP: u32 = 8;
const PIXEL: u64 = size_of::<FilmPixel>() as u64;

/// Buffers of one tile: its uniform, its film, and where the film is read back.
pub(super) struct Slot {
    item: WorkItem,
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
    free: Vec<Slot>,
    watches: Vec<Stopwatch>,
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
    pub(super) fn read(
        &mut self,
        device: &Device,
        f: impl FnOnce(&[FilmPixel]),
    ) -> Result<(), GpuError> {
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
                    f(pixels);
                    Ok(())
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
fn submit(
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

/// A submission under way.
struct Submission {
    index: SubmissionIndex,
    slots: Vec<Slot>,
    watch: Option<Stopwatch>,
    submitted: Instant,
}

impl Device {
    /// Renders until the run has nothing left. On an error every item that was not deposited has
    /// been given back.
    pub(super) fn render(
        &mut self,
        setup: &Setup<'_>,
        run: &Run<'_>,
        pace: &mut Pace,
    ) -> Result<(), GpuError> {
        let mut under_way = VecDeque::new();
        let result = self.render_loop(setup, run, pace, &mut under_way);
        for submission in &under_way {
            for slot in &submission.slots {
                run.give_back(slot.item);
            }
        }
        result
    }

    fn render_loop(
        &mut self,
        setup: &Setup<'_>,
        run: &Run<'_>,
        pace: &mut Pace,
        under_way: &mut VecDeque<Submission>,
    ) -> Result<(), GpuError> {
        let mut free = Slots::default();
        let mut busy = Busy::new(Instant::now());
        let mut n_tiles = 0;
        loop {
            if run.control().loses_device_after(n_tiles) {
                self.gpu.destroy();
            }
            while under_way.len() < IN_FLIGHT {
                let items = claim(run, pace);
                if items.is_empty() {
                    break;
                }
                n_tiles += items.len() as u64;
                under_way.push_back(self.start(setup, &mut free, &items));
            }
            // With nothing under way there is nothing to wait for: the run is over.
            if under_way.is_empty() {
                if let Some(text) = busy.text(Instant::now()) {
                    run.note(&text);
                }
                return Ok(());
            }
            self.collect(run, pace, under_way, &mut free, &mut busy)?;
        }
    }

    fn start(&self, setup: &Setup<'_>, free: &mut Slots, items: &[WorkItem]) -> Submission {
        let mut slots: Vec<Slot> =
            items.iter().map(|item| free.take(self, item.tile.pixels())).collect();
        let new = || Stopwatch::new(&self.gpu, self.queue.get_timestamp_period());
        let watch = free.watches.pop().or_else(new);
        let submitted = Instant::now();
        let index = submit(self, setup, &mut slots, items, watch.as_ref());
        Submission { index, slots, watch, submitted }
    }

    /// Waits for the oldest submission and deposits its tiles. It stays in `under_way`, with the
    /// tiles that are not deposited, when that fails.
    fn collect(
        &self,
        run: &Run<'_>,
        pace: &mut Pace,
        under_way: &mut VecDeque<Submission>,
        free: &mut Slots,
        busy: &mut Busy,
    ) -> Result<(), GpuError> {
        let Some(oldest) = under_way.front_mut() else { return Ok(()) };
        let waited = wait(&self.gpu, oldest.index.clone());
        self.fault()?;
        waited?;
        let own = oldest.watch.as_ref().and_then(Stopwatch::read);
        run.timed(own);
        let time = busy.ended(oldest.submitted, Instant::now(), own);
        pace.measured(oldest.slots.iter().map(|slot| slot.item.cost()).sum(), time);
        free.watches.extend(oldest.watch.take());
        while let Some(slot) = oldest.slots.last_mut() {
            let item = slot.item;
            slot.read(self, |pixels| run.deposit(&item, pixels))?;
            free.free.extend(oldest.slots.pop());
        }
        under_way.pop_front();
        Ok(())
    }
}

/// Items for one submission; empty when there are none now.
fn claim(run: &Run<'_>, pace: &Pace) -> Vec<WorkItem> {
    let mut items: Vec<WorkItem> = Vec::with_capacity(MAX_TILES);
    let (mut n, mut pixels) = pace.tiles(pack::abi::BATCH);
    loop {
        match run.claim(pixels) {
            Claim::Work(item) | Claim::FirstOf(item) => {
                if items.is_empty() {
                    (n, pixels) = pace.tiles(item.samples.count());
                }
                items.push(item);
                if items.len() >= n {
                    return items;
                }
            }
            Claim::Wait | Claim::Done => return items,
        }
    }
}
