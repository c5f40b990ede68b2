//! What can go wrong on a GPU.

use thiserror::Error;

/// What can go wrong on a GPU.
#[derive(Debug, Error)]
pub enum GpuError {
    /// The adapter gives no device.
    #[error("cannot open the adapter: {0}")]
    Device(String),
    /// The scene needs more than the adapter offers.
    #[error("the scene needs {needed} {what}, the adapter has {available}")]
    Limit {
        /// What there is too little of.
        what: &'static str,
        /// How much is needed.
        needed: u64,
        /// How much there is.
        available: u64,
    },
    /// Memory ran out.
    #[error("out of GPU memory: {0}")]
    Memory(String),
    /// The kernel does not compile on this device.
    #[error("the kernel does not compile on this device: {0}")]
    Kernel(String),
    /// The device is gone: a reset, a timeout, a driver update.
    #[error("the device was lost: {0}")]
    Lost(String),
    /// The device answered, but not with a picture.
    #[error("the device gives wrong results: {0}")]
    Wrong(String),
    /// Another refusal of the API; a bug of ours or of the driver.
    #[error("{0}")]
    Api(String),
}
