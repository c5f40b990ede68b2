//! Sections → device buffers, byte for byte, through a ring of staging buffers.
//!
//! Three mapped buffers are filled from the pack and copied by the device in turn: while one is
//! filled the others are on their way, and a pack of many gigabytes takes no more staging memory
//! than the ring. The caller watches for errors of the API.

use super::error::GpuError;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;
use wgpu::{
    Buffer, BufferDescriptor, BufferUsages, CommandEncoderDescriptor, Device, MapMode, PollType,
    Queue, SubmissionIndex,
};

/// Bytes of one staging buffer.
const PIECE: usize = 32 << 20;
/// Staging buffers.
const STAGES: usize = 3;

/// Uploads to one device.
pub(super) struct Uploader<'a> {
    device: &'a Device,
    queue: &'a Queue,
    piece: usize,
    usage: BufferUsages,
    stages: Vec<Stage>,
    /// The one that is used next.
    next: usize,
}

/// One staging buffer.
struct Stage {
    buffer: Buffer,
    /// The copy out of it that is under way.
    sent: Option<SubmissionIndex>,
    mapped: Arc<AtomicBool>,
}

impl<'a> Uploader<'a> {
    /// For sections of at most `largest` bytes.
    pub(super) fn new(device: &'a Device, queue: &'a Queue, largest: usize) -> Self {
        let usage = BufferUsages::STORAGE | BufferUsages::COPY_DST;
        Self::with(device, queue, largest.clamp(16, PIECE), usage)
    }

    /// With staging buffers of `piece` bytes, a multiple of 16; `usage` of what is made.
    fn with(device: &'a Device, queue: &'a Queue, piece: usize, usage: BufferUsages) -> Self {
        Self { device, queue, piece, usage, stages: Vec::new(), next: 0 }
    }

    /// A buffer with these bytes; their length is a multiple of 16.
    pub(super) fn upload(&mut self, label: &str, bytes: &[u8]) -> Result<Buffer, GpuError> {
        let buffer = self.device.create_buffer(&BufferDescriptor {
            label: Some(label),
            size: bytes.len() as u64,
            usage: self.usage,
            mapped_at_creation: false,
        });
        let mut offset = 0;
        for piece in bytes.chunks(self.piece) {
            self.send(&buffer, offset, piece)?;
            offset += piece.len() as u64;
        }
        Ok(buffer)
    }

    fn send(&mut self, to: &Buffer, offset: u64, piece: &[u8]) -> Result<(), GpuError> {
        if self.next == self.stages.len() {
            self.stages.push(Stage::new(self.device, self.piece as u64));
        }
        let stage = &mut self.stages[self.next];
        self.next = (self.next + 1) % STAGES;
        stage.fill(self.device, piece)?;
        let mut encoder =
            self.device.create_command_encoder(&CommandEncoderDescriptor { label: Some("upload") });
        encoder.copy_buffer_to_buffer(&stage.buffer, 0, to, offset, Some(piece.len() as u64));
        stage.sent = Some(self.queue.submit([encoder.finish()]));
        stage.map_again();
        Ok(())
    }
}

impl Stage {
    fn new(device: &Device, size: u64) -> Self {
        let buffer = device.create_buffer(&BufferDescriptor {
            label: Some("staging"),
            size,
            usage: BufferUsages::MAP_WRITE | BufferUsages::COPY_SRC,
            mapped_at_creation: true,
        });
        Self { buffer, sent: None, mapped: Arc::new(AtomicBool::new(true)) }
    }

    /// Waits until the device has taken what is in it, then fills it.
    fn fill(&mut self, device: &Device, bytes: &[u8]) -> Result<(), GpuError> {
        if let Some(index) = self.sent.take() {
            wait(device, index)?;
        }
        if !self.mapped.load(Ordering::Acquire) {
            return Err(GpuError::Lost("a staging buffer cannot be mapped".to_owned()));
        }
        let range = self.buffer.get_mapped_range_mut(..bytes.len() as u64);
        let mut view = range.map_err(|error| GpuError::Memory(error.to_string()))?;
        view.copy_from_slice(bytes);
        drop(view);
        self.buffer.unmap();
        Ok(())
    }

    fn map_again(&self) {
        let mapped = Arc::clone(&self.mapped);
        mapped.store(false, Ordering::Release);
        self.buffer.slice(..).map_async(MapMode::Write, move |result| {
            mapped.store(result.is_ok(), Ordering::Release);
        });
    }
}

/// Waits for a submission; a device that needs a minute is lost.
pub(super) fn wait(device: &Device, index: SubmissionIndex) -> Result<(), GpuError> {
    wait_at_most(device, index, Duration::from_mins(1))
}

/// As `wait`, with another limit.
pub(super) fn wait_at_most(
    device: &Device,
    index: SubmissionIndex,
    limit: Duration,
) -> Result<(), GpuError> {
    match device.poll(PollType::Wait { submission_index: Some(index), timeout: Some(limit) }) {
        Ok(_) => Ok(()),
        Err(error) => Err(GpuError::Lost(error.to_string())),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gpu::adapters;
    use wgpu::DeviceDescriptor;

    /// Bytes that are the same nowhere.
    fn noise(n: usize) -> Vec<u8> {
        let word = |i: u32| i.wrapping_mul(0x9e37_79b9).to_le_bytes();
        (0..u32::MAX).flat_map(word).take(n).collect()
    }

    fn read(device: &Device, queue: &Queue, from: &Buffer) -> Vec<u8> {
        let usage = BufferUsages::MAP_READ | BufferUsages::COPY_DST;
        let size = from.size();
        let descriptor = BufferDescriptor { label: None, size, usage, mapped_at_creation: false };
        let to = device.create_buffer(&descriptor);
        let mut encoder = device.create_command_encoder(&CommandEncoderDescriptor::default());
        encoder.copy_buffer_to_buffer(from, 0, &to, 0, Some(size));
        let index = queue.submit([encoder.finish()]);
        to.slice(..).map_async(MapMode::Read, |result| result.unwrap());
        wait(device, index).unwrap();
        to.get_mapped_range(..).unwrap().to_vec()
    }

    #[test]
    #[expect(clippy::print_stderr, reason = "a skipped test says so")]
    fn what_goes_round_the_ring_arrives_byte_for_byte() {
        let Some(adapter) = adapters().into_iter().next() else {
            eprintln!("skipped: no adapter");
            return;
        };
        let request = adapter.adapter.request_device(&DeviceDescriptor {
            required_limits: adapter.adapter.limits(),
            ..DeviceDescriptor::default()
        });
        let (device, queue) = pollster::block_on(request).unwrap();
        // The ring goes round several times, and the last piece is shorter than the others.
        let usage = BufferUsages::COPY_SRC | BufferUsages::COPY_DST;
        let mut ring = Uploader::with(&device, &queue, 4096, usage);
        for n in [16, 4096, 4112, 40_000, 3 * 4096] {
            let bytes = noise(n);
            let buffer = ring.upload("test", &bytes).unwrap();
            assert!(read(&device, &queue, &buffer) == bytes, "{n} bytes");
            assert!(ring.stages.len() <= STAGES);
        }
    }
}
