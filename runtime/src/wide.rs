//! Which wide kernel renders a tile or traces lone rays: the one with most lanes that the processor has the
//! instructions for.

use crate::kernel::f32::{Hit, Kernel, Ray};
use glam::UVec4;
use kernel_avx2::Instructions as Avx2;
use kernel_avx512::Instructions as Avx512;

/// A kernel for several pixels at a time.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Wide {
    /// Sixteen.
    Avx512(Avx512),
    /// Eight.
    Avx2(Avx2),
}

impl Wide {
    /// The widest that this processor can run, of no more than `most` lanes.
    pub(crate) fn of_processor(most: u32) -> Option<Self> {
        let sixteen = || Avx512::try_new().filter(|_| most >= 16).map(Self::Avx512);
        let eight = || Avx2::try_new().filter(|_| most >= 8).map(Self::Avx2);
        sixteen().or_else(eight)
    }

    /// How many pixels it renders at a time.
    pub(crate) fn lanes(self) -> u32 {
        match self {
            Self::Avx512(_) => 16,
            Self::Avx2(_) => 8,
        }
    }

    /// Renders the tile of the frame of `scalar` to `film`, two words a pixel. Whether it came to the end of it.
    pub(crate) fn render<'a>(
        self,
        scalar: Kernel<'a>,
        film: &'a mut [UVec4],
        size: [u32; 2],
        is_over: &dyn Fn() -> bool,
    ) -> bool {
        match self {
            Self::Avx512(there) => {
                use kernel_avx512::render::{Tile, render};
                render(there, Tile { scalar, film, size }, is_over)
            }
            Self::Avx2(there) => {
                use kernel_avx2::render::{Tile, render};
                render(there, Tile { scalar, film, size }, is_over)
            }
        }
    }

    /// What `rays` hit, each walked by itself.
    pub(crate) fn trace(self, scalar: &mut Kernel<'_>, rays: &[Ray]) -> Vec<Hit> {
        let mut hits = Vec::with_capacity(rays.len());
        match self {
            Self::Avx512(there) => kernel_avx512::lone::trace_all(there, scalar, rays, &mut hits),
            Self::Avx2(there) => kernel_avx2::lone::trace_all(there, scalar, rays, &mut hits),
        }
        hits
    }
}
