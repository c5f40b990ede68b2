//! Parts of one picture → the picture: sums added in `f64`, ranges joined.

use super::picture::{Meta, Picture, clamp_text, ranges_text};
use crate::job::Job;
use crate::layers::Wanted;
use crate::region::{Rect, SampleRange, insert_range};
use crate::scene::Scene;
use thiserror::Error;

/// Why two files are not parts of one picture.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum MergeError {
    /// Nothing to merge.
    #[error("no pictures to merge")]
    Nothing,
    /// The pictures differ in something that parts of one picture share.
    #[error(
        "part {part}: {what} is {found}, but part 1 has {expected}; only parts of one picture can be merged"
    )]
    Differs {
        /// Number of the part, from 1.
        part: usize,
        /// What differs.
        what: &'static str,
        /// Its value in this part.
        found: String,
        /// Its value in the first part.
        expected: String,
    },
    /// The same samples twice.
    #[error("part {part}: samples {found} overlap {expected} of the parts before it")]
    Overlap {
        /// Number of the part, from 1.
        part: usize,
        /// Ranges of this part.
        found: String,
        /// Ranges of all parts before it.
        expected: String,
    },
    /// A picture whose error was measured.
    #[error(
        "part {part}: it is the mean of the replicates of a measured run, which cannot be merged"
    )]
    Replicates {
        /// Number of the part, from 1.
        part: usize,
    },
    /// A part whose pixels have different numbers of samples.
    #[error(
        "part {part}: its pixels have between {least} and {most} samples; a part must be evenly sampled"
    )]
    Uneven {
        /// Number of the part, from 1.
        part: usize,
        /// Fewest samples.
        least: u32,
        /// Most samples.
        most: u32,
    },
}

/// Adds the parts. They must be of the same pack, size, crop and seed, with disjoint sample ranges,
/// each evenly sampled. The sum is taken by ascending first sample, so the order of the arguments
/// does not matter. What was denoised of parts is no part of the whole.
pub fn merge(mut parts: Vec<Picture>) -> Result<Picture, MergeError> {
    check(&parts)?;
    parts.sort_by_key(|part| part.film.ranges.first().map(|range| range.start));
    let mut parts = parts.into_iter();
    let mut whole = parts.next().ok_or(MergeError::Nothing)?;
    whole.denoised = None;
    for part in parts {
        for (sum, more) in whole.film.sums.iter_mut().zip(&part.film.sums) {
            for (sum, more) in sum.iter_mut().zip(more) {
                *sum += more;
            }
        }
        for (count, more) in whole.film.counts.iter_mut().zip(&part.film.counts) {
            *count += more;
        }
        for range in part.film.ranges {
            insert_range(&mut whole.film.ranges, range);
        }
        whole.film.counters.add(&part.film.counters);
        if let (Some(layers), Some(more)) = (&mut whole.layers, &part.layers) {
            layers.add(more);
        }
        add_meta(&mut whole.meta, &part.meta);
    }
    Ok(whole)
}

fn add_meta(whole: &mut Meta, part: &Meta) {
    if !whole.device.split(" + ").any(|device| device == part.device) {
        whole.device = format!("{} + {}", whole.device, part.device);
    }
    whole.seconds += part.seconds;
    whole.complete &= part.complete;
}

fn check(parts: &[Picture]) -> Result<(), MergeError> {
    let first = parts.first().ok_or(MergeError::Nothing)?;
    let expected = Identity::of_picture(first);
    let mut ranges = Vec::new();
    for (part, picture) in (1..).zip(parts) {
        let found = Identity::of_picture(picture).rows();
        for ((what, expected), (_, found)) in expected.rows().into_iter().zip(found) {
            if found != expected {
                return Err(MergeError::Differs { part, what, found, expected });
            }
        }
        let (found, expected) = (layers_text(picture), layers_text(first));
        if found != expected {
            return Err(MergeError::Differs { part, what: "layers", found, expected });
        }
        if picture.film.replicates() > 1 {
            return Err(MergeError::Replicates { part });
        }
        let (least, most) = picture.film.samples();
        if least != most || most == 0 {
            return Err(MergeError::Uneven { part, least, most });
        }
        let before = ranges.clone();
        if !picture.film.ranges.iter().all(|range| insert_range(&mut ranges, *range)) {
            let found = ranges_text(&picture.film.ranges);
            return Err(MergeError::Overlap { part, found, expected: ranges_text(&before) });
        }
    }
    Ok(())
}

/// What a picture holds beside radiance, as people read it.
fn layers_text(picture: &Picture) -> String {
    let Some(layers) = &picture.layers else { return "none".to_owned() };
    let Wanted { transparent, names, .. } = &layers.wanted;
    let sky = if *transparent { ", transparent" } else { "" };
    let groups: Vec<&str> = layers.lights.iter().map(|group| group.name.as_str()).collect();
    let groups =
        if groups.is_empty() { String::new() } else { format!(", groups {}", groups.join(" ")) };
    format!("{} ({}{sky}{groups})", layers.wanted.text(), names.name())
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

/// Samples of `whole` that none of these ranges has, in order. The ranges are sorted and disjoint.
#[must_use]
pub fn missing(ranges: &[SampleRange], whole: SampleRange) -> Vec<SampleRange> {
    let mut gaps = Vec::new();
    let mut next = whole.start;
    for range in ranges {
        gaps.extend(SampleRange::new(next, range.start.min(whole.end)));
        next = next.max(range.end);
    }
    gaps.extend(SampleRange::new(next, whole.end));
    gaps
}

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

    fn of_picture(picture: &Picture) -> Self {
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
