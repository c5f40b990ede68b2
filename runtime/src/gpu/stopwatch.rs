//! How long the device was busy with a submission: its own timestamps where it has them.
//!
//! Two timestamps are written around the pass and read back with the tiles. Without the feature, or
//! when the numbers make no sense, there is no answer, and the caller takes wall time.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;
use wgpu::{
    Buffer, BufferDescriptor, BufferUsages, CommandEncoder, ComputePassTimestampWrites, Device,
    Features, MapMode, QuerySet, QuerySetDescriptor, QueryType,
};

/// What the device must be opened with, if the adapter has it.
pub(super) const FEATURE: Features = Features::TIMESTAMP_QUERY;
/// Two timestamps.
const BYTES: u64 = 16;
/// A pass that took longer than this was not measured: counters wrap, and drivers err.
const LONGEST: Duration = Duration::from_mins(1);

/// Times one submission at a time.
pub(super) struct Stopwatch {
    queries: QuerySet,
    resolved: Buffer,
    readback: Buffer,
    mapped: Arc<AtomicBool>,
    /// Nanoseconds of a tick.
    period: f64,
}

impl Stopwatch {
    /// `None` on a device without timestamps.
    pub(super) fn new(device: &Device, period: f32) -> Option<Self> {
        if !device.features().contains(FEATURE) {
            return None;
        }
        let queries = device.create_query_set(&QuerySetDescriptor {
            label: Some("pass"),
            ty: QueryType::Timestamp,
            count: 2,
        });
        let buffer = |usage| {
            let label = Some("timestamps");
            device.create_buffer(&BufferDescriptor {
                label,
                size: BYTES,
                usage,
                mapped_at_creation: false,
            })
        };
        Some(Self {
            queries,
            resolved: buffer(BufferUsages::QUERY_RESOLVE | BufferUsages::COPY_SRC),
            readback: buffer(BufferUsages::MAP_READ | BufferUsages::COPY_DST),
            mapped: Arc::new(AtomicBool::new(false)),
            period: f64::from(period),
        })
    }

    /// For the descriptor of the pass.
    pub(super) fn writes(&self) -> ComputePassTimestampWrites<'_> {
        ComputePassTimestampWrites {
            query_set: &self.queries,
            beginning_of_pass_write_index: Some(0),
            end_of_pass_write_index: Some(1),
        }
    }

    /// After the pass, in the same submission.
    pub(super) fn resolve(&self, encoder: &mut CommandEncoder) {
        encoder.resolve_query_set(&self.queries, 0..2, &self.resolved, 0);
        encoder.copy_buffer_to_buffer(&self.resolved, 0, &self.readback, 0, Some(BYTES));
    }

    /// After the submission.
    pub(super) fn map(&self) {
        let mapped = Arc::clone(&self.mapped);
        mapped.store(false, Ordering::Release);
        self.readback.slice(..).map_async(MapMode::Read, move |result| {
            mapped.store(result.is_ok(), Ordering::Release);
        });
    }

    /// Once the submission has ended: how long its pass took.
    pub(super) fn read(&self) -> Option<Duration> {
        if !self.mapped.swap(false, Ordering::AcqRel) {
            return None;
        }
        let ticks = {
            let view = self.readback.slice(..).get_mapped_range().ok()?;
            let (words, _) = view.as_chunks::<8>();
            [u64::from_le_bytes(words[0]), u64::from_le_bytes(words[1])]
        };
        self.readback.unmap();
        between(ticks, self.period)
    }
}

/// The time between two timestamps; `None` when it cannot be one.
fn between([begin, end]: [u64; 2], period: f64) -> Option<Duration> {
    let ticks = end.checked_sub(begin).filter(|ticks| *ticks > 0 && begin > 0)?;
    let time = Duration::try_from_secs_f64(ticks as f64 * period * 1e-9).ok()?;
    (!time.is_zero() && time <= LONGEST).then_some(time)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn timestamps_become_times_and_nonsense_does_not() {
        let ms = |ms| Some(Duration::from_millis(ms));
        assert_eq!(between([1000, 2_001_000], 1.0), ms(2));
        assert_eq!(between([1000, 2_001_000], 0.5), ms(1));
        // Never written, the same, backwards, too long, no period.
        for ticks in [[0, 0], [0, 7], [7, 7], [9, 7], [1, u64::MAX]] {
            assert_eq!(between(ticks, 1.0), None, "{ticks:?}");
        }
        assert_eq!(between([1, 1_000_000], 0.0), None);
        assert_eq!(between([1, 1_000_000], f64::NAN), None);
    }
}
