//! What to render, in one value: size, crop, samples, seed, limits.

use crate::convergence::Measure;
use crate::kernel::walk::Width;
use crate::layers::Wanted;
use crate::region::{Rect, SampleRange};
use crate::replicate::REPLICATES_U32;
use crate::scene::Scene;
#[cfg(target_arch = "x86_64")]
use crate::wide::Wide;
use pack::abi::Camera;
use std::time::Duration;
use thiserror::Error;

/// Largest side of an image in pixels.
pub const MAX_SIDE: u32 = 1 << 16;
/// Most pixels of a film: 2^28 take 11 GB while rendering, see `film_bytes`.
pub const MAX_PIXELS: u64 = 1 << 28;

/// How the CPU kernel works in `f32`: no bit of a picture depends on it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CpuWay {
    /// Wide nodes are walked by hand-written code, otherwise by what was generated from the WGSL.
    pub by_hand: bool,
    /// No more pixels than this are rendered at a time: as many as the processor can, sixteen or eight, else one.
    pub lanes: u32,
}

impl CpuWay {
    /// How many pixels this processor can render at a time.
    #[must_use]
    pub fn most_lanes() -> u32 {
        #[cfg(target_arch = "x86_64")]
        return Wide::of_processor(u32::MAX).map_or(1, Wide::lanes);
        #[cfg(not(target_arch = "x86_64"))]
        return 1;
    }

    /// How many children the nodes have that are walked by hand.
    pub(crate) fn width(self) -> Width {
        if self.lanes < 16 { Width::Eight } else { Width::of_processor() }
    }
}

impl Default for CpuWay {
    fn default() -> Self {
        Self { by_hand: true, lanes: u32::MAX }
    }
}

/// The type that stands for WGSL's `f32`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Precision {
    /// As on a GPU.
    #[default]
    F32,
    /// The twin that shows where rounding matters; on the CPU only.
    F64,
}

impl Precision {
    /// `f32` or `f64`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::F32 => "f32",
            Self::F64 => "f64",
        }
    }
}

/// One run.
#[derive(Clone, Debug, PartialEq)]
pub struct Job {
    /// Whole image in pixels. Another aspect than the scene's keeps the horizontal field of view.
    pub image_size: [u32; 2],
    /// Instead of the pack's camera, for an image of the scene's aspect. What surrounds it, media above all, is still
    /// what surrounds the pack's.
    pub camera: Option<Camera>,
    /// The part of the image to render; inside the image.
    pub crop: Rect,
    /// Sample indices.
    pub samples: SampleRange,
    /// Seed of the image.
    pub seed: u32,
    /// Estimator switch of the kernel: 0 MIS (balance), 1 light samples only, 2 BSDF samples only,
    /// 3 MIS (power 2).
    pub estimator: u32,
    /// Largest channel that the indirect light of a sample may have, in the units of the picture; more is scaled
    /// down to it. `None`: it is left as it is.
    pub clamp_indirect: Option<f32>,
    /// Precision of the CPU kernel; GPUs know `F32` only.
    pub precision: Precision,
    /// How the CPU kernel works in `f32`.
    pub way: CpuWay,
    /// When to stop, counted from the first sample.
    pub time_limit: Option<Duration>,
    /// Threads of the CPU kernel; `None`: one for each logical CPU.
    pub threads: Option<usize>,
    /// Stop at the first sample that is not finite.
    pub strict: bool,
    /// Wanted duration of one GPU submission.
    pub submission: Duration,
    /// Whether submissions are timed by the timestamps of a GPU that has them, not by the wall clock.
    pub timestamps: bool,
    /// Whether the error is measured: then the picture is the mean of `convergence::REPLICATES`
    /// pictures, and `samples` are those of each.
    pub measure: Option<Measure>,
    /// What the picture holds beside radiance.
    pub wanted: Wanted,
}

/// A job that cannot be run.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum JobError {
    /// Size out of range.
    #[error("an image of {}x{} pixels: each side must be 1 to {MAX_SIDE}, all pixels at most {MAX_PIXELS}", size[0], size[1])]
    Size {
        /// What was asked for.
        size: [u32; 2],
    },
    /// Crop not inside the image.
    #[error("crop {crop} is empty or leaves the image of {}x{} pixels", size[0], size[1])]
    Crop {
        /// What was asked for.
        crop: Rect,
        /// The image.
        size: [u32; 2],
    },
    /// Another picture than that of the reference.
    #[error("the reference shows {}x{} pixels (crop {}), the picture {}x{} (crop {})", reference.0[0], reference.0[1], reference.1, picture.0[0], picture.0[1], picture.1)]
    Reference {
        /// Size and crop of the reference.
        reference: ([u32; 2], Rect),
        /// Size and crop of the picture.
        picture: ([u32; 2], Rect),
    },
    /// The f64 kernel exists on the CPU only.
    #[error("the f64 kernel runs on the CPU only")]
    Precision,
}

impl Job {
    /// The run that the scene asks for.
    #[must_use]
    pub fn of_scene(scene: &Scene) -> Self {
        let settings = scene.settings();
        Self {
            image_size: settings.image_size,
            camera: None,
            crop: Rect::whole(settings.image_size),
            samples: SampleRange { start: 0, end: settings.samples.max(1) },
            seed: settings.seed,
            estimator: 0,
            clamp_indirect: None,
            precision: Precision::F32,
            way: CpuWay::default(),
            time_limit: None,
            threads: None,
            strict: false,
            submission: Duration::from_millis(100),
            timestamps: true,
            measure: None,
            wanted: Wanted::default(),
        }
    }

    /// Samples of every pixel that are wanted.
    #[must_use]
    pub fn spp(&self) -> u32 {
        self.samples.count().saturating_mul(if self.measure.is_some() { REPLICATES_U32 } else { 1 })
    }

    /// Another image size; the crop becomes the whole image.
    pub fn resize(&mut self, size: [u32; 2]) {
        self.image_size = size;
        self.crop = Rect::whole(size);
    }

    /// Whether the run is possible.
    pub fn check(&self) -> Result<(), JobError> {
        let size = self.image_size;
        let pixels = Rect::whole(size).pixels();
        if size.iter().any(|side| !(1..=MAX_SIDE).contains(side)) || pixels > MAX_PIXELS {
            return Err(JobError::Size { size });
        }
        if !self.crop.fits(size) {
            return Err(JobError::Crop { crop: self.crop, size });
        }
        let reference = self.measure.as_ref().and_then(|measure| measure.reference.as_ref());
        if let Some(reference) = reference.filter(|r| !r.shows(size, self.crop)) {
            return Err(JobError::Reference {
                reference: (reference.image_size, reference.region),
                picture: (size, self.crop),
            });
        }
        Ok(())
    }
}
