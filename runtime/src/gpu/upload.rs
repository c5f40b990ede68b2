//! Sections → device buffers, byte for byte, in pieces that keep staging memory small.

use super::GpuError;
use std::time::Duration;
use wgpu::{Buffer, BufferDescriptor, BufferUsages, Device, PollType, Queue};

/// Bytes of one piece.
const PIECE: usize = 32 << 20;
/// Pieces on their way at once.
const IN_FLIGHT: usize = 2;

/// A buffer with these bytes; their length is a multiple of 16. The caller watches for errors.
pub(super) fn upload(
    device: &Device,
    queue: &Queue,
    label: &str,
    bytes: &[u8],
) -> Result<Buffer, GpuError> {
    let buffer = device.create_buffer(&BufferDescriptor {
        label: Some(label),
        size: bytes.len() as u64,
        usage: BufferUsages::STORAGE | BufferUsages::COPY_DST,
        mapped_at_creation: false,
    });
    let mut sent = Vec::new();
    let mut offset = 0;
    for piece in bytes.chunks(PIECE) {
        // Each write takes staging memory of its own until its submission is done.
        queue.write_buffer(&buffer, offset, piece);
        sent.push(queue.submit([]));
        offset += piece.len() as u64;
        if sent.len() > IN_FLIGHT {
            wait(device, sent.remove(0))?;
        }
    }
    Ok(buffer)
}

/// Waits for a submission; a device that needs a minute is lost.
pub(super) fn wait(device: &Device, index: wgpu::SubmissionIndex) -> Result<(), GpuError> {
    let timeout = Some(Duration::from_mins(1));
    match device.poll(PollType::Wait { submission_index: Some(index), timeout }) {
        Ok(_) => Ok(()),
        Err(error) => Err(GpuError::Lost(error.to_string())),
    }
}
