//! What a kernel writes: its entry point, its records, and how many of them a tile has.

use crate::schedule::WorkItem;
use crate::trust::{AOV, RENDER};
use pack::abi::{AovSample, FilmPixel};

/// Entry points of kernels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Entry {
    /// Sums of pixels.
    Render,
    /// What each sample shows beside radiance.
    Aov,
}

impl Entry {
    /// Its name in the kernel.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Render => RENDER,
            Self::Aov => AOV,
        }
    }

    /// Bytes that it writes of a tile.
    pub(super) fn bytes(self, item: &WorkItem) -> u64 {
        match self {
            Self::Render => item.tile.pixels() * size_of::<FilmPixel>() as u64,
            Self::Aov => item.cost() * size_of::<AovSample>() as u64,
        }
    }
}

/// A record that a kernel writes.
pub(super) trait Written: bytemuck::Pod {
    /// Rays of its paths: none if it was not rendered, [`FilmPixel::CUT`] if nothing of it is true.
    fn rays(&self) -> u32;
}

impl Written for FilmPixel {
    fn rays(&self) -> u32 {
        self.rays
    }
}

impl Written for AovSample {
    fn rays(&self) -> u32 {
        self.rays
    }
}

/// Whether the driver has cut loops short in one of them.
pub(super) fn is_cut(records: &[impl Written]) -> bool {
    records.iter().any(|record| record.rays() == FilmPixel::CUT)
}
