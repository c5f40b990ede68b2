//! Memory that is asked for and may be refused: zeros, or [`NoMemory`].

use thiserror::Error;

/// The system gives no memory.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[error("cannot allocate {} of memory: render less with --crop or --size", amount(*bytes))]
pub struct NoMemory {
    /// Bytes that were asked for.
    pub bytes: u64,
}

/// `n` zeros, whose memory is not touched before it is used.
pub(crate) fn zeros<T: bytemuck::Zeroable>(n: u64) -> Result<Vec<T>, NoMemory> {
    let error = NoMemory { bytes: n.saturating_mul(size_of::<T>() as u64) };
    let n = usize::try_from(n).map_err(|_| error)?;
    bytemuck::try_zeroed_vec(n).map_err(|()| error)
}

/// As it stands in a message.
pub(crate) fn amount(bytes: u64) -> String {
    if bytes < 1_000_000_000 {
        return format!("{} MB", bytes / 1_000_000);
    }
    format!("{:.1} GB", bytes as f64 / 1e9)
}
