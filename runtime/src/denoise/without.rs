//! What stands for Open Image Denoise in an `rtr` that was built without it.

use std::ffi::CStr;
use std::path::Path;
use thiserror::Error;

/// As if there were something to cancel.
pub(super) type IsCancelled<'a> = &'a (dyn Fn() -> bool + Sync);

/// It is not there.
#[derive(Debug, Error)]
pub enum OidnError {
    /// Nor is it meant to be.
    #[error("this rtr was built without --denoise: build it with the feature `denoise`")]
    LeftOut,
    /// What nobody says.
    #[error("interrupted")]
    Cancelled,
}

/// The library, which nobody has.
#[derive(Debug)]
pub(super) enum Oidn {}

/// A device of it.
pub(super) enum Device {}

impl Oidn {
    pub(super) fn open(_named: Option<&Path>) -> Result<Self, OidnError> {
        Err(OidnError::LeftOut)
    }

    pub(super) fn version(&self) -> &str {
        match *self {}
    }

    pub(super) fn device(
        &self,
        _threads: Option<usize>,
        _is_cancelled: IsCancelled<'_>,
    ) -> Result<Device, OidnError> {
        match *self {}
    }
}

impl Device {
    pub(super) fn prefilter(
        &self,
        _name: &CStr,
        _pixels: &mut [[f32; 3]],
        _size: [usize; 2],
    ) -> Result<(), OidnError> {
        match *self {}
    }

    pub(super) fn filter(
        &self,
        _pixels: &mut [[f32; 3]],
        _guides: &mut [(&CStr, Vec<[f32; 3]>)],
        _size: [usize; 2],
    ) -> Result<(), OidnError> {
        match *self {}
    }
}
