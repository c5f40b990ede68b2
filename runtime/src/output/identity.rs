//! What parts of one picture share, and whether a file is all that a run would make.

use super::picture::{Picture, clamp_text};
use crate::job::Job;
use crate::region::Rect;
use crate::scene::Scene;

/// What parts of one picture share, and what a run that goes on shares with the one before.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Identity {
    /// Hexadecimal name of what is rendered.
    pub render_id: String,
    /// Whole image in pixels.
    pub image_size: [u32; 2],
    /// The part of it that is rendered.
    pub crop: Rect,
    /// Seed of the image.
    pub seed: u32,
    /// Estimator switch of the kernel.
    pub estimator: u32,
    /// What indirect light was clamped to, `off` if it was not.
    pub clamp_indirect: String,
    /// Precision of the kernel: `f32` or `f64`.
    pub precision: String,
}

impl Identity {
    /// Of the picture that `job` makes of `scene`.
    #[must_use]
    pub fn of(scene: &Scene, job: &Job) -> Self {
        Self {
            render_id: scene.render_id(),
            image_size: job.image_size,
            crop: job.crop,
            seed: job.seed,
            estimator: job.estimator,
            clamp_indirect: clamp_text(job.clamp_indirect),
            precision: job.precision.name().to_owned(),
        }
    }

    /// Of a picture, with or without its pixels.
    pub(super) fn of_picture(picture: &Picture) -> Self {
        Self {
            render_id: picture.meta.render_id.clone(),
            image_size: picture.film.image_size,
            crop: picture.film.region,
            seed: picture.meta.seed,
            estimator: picture.meta.estimator,
            clamp_indirect: clamp_text(picture.meta.clamp_indirect),
            precision: picture.meta.precision.clone(),
        }
    }

    /// Name and value of everything, as people read it.
    pub(crate) fn rows(&self) -> [(&'static str, String); 7] {
        let [w, h] = self.image_size;
        [
            ("render_id", self.render_id.clone()),
            ("size", format!("{w}x{h}")),
            ("crop", self.crop.to_string()),
            ("seed", self.seed.to_string()),
            ("estimator", self.estimator.to_string()),
            ("clamp_indirect", self.clamp_indirect.clone()),
            ("precision", self.precision.clone()),
        ]
    }
}

/// Whether `picture` is all that `job` makes of `scene`.
#[must_use]
pub fn is_whole(picture: &Picture, scene: &Scene, job: &Job) -> bool {
    let layers = picture.layers.as_ref().map(|layers| &layers.wanted);
    let wanted = (!job.wanted.is_empty()).then_some(&job.wanted);
    picture.meta.complete
        && picture.meta.coarse_block.is_none()
        && picture.film.is_even()
        && picture.film.replicates() == 1
        && picture.film.ranges == [job.samples]
        && layers == wanted
        && Identity::of_picture(picture) == Identity::of(scene, job)
}
