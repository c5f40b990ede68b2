//! All pixels of a picture → what the header of its file says of them, and which channels it has.

use super::picture::Picture;
use crate::film::Film;
use crate::replicate::luminance;
use pack::manifest::REST;

/// What is known of the pixels before they are written. It is taken from the whole picture, or row by row.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Survey {
    /// Fewest and most samples that any pixel has; `None` before the first.
    samples: Option<(u32, u32)>,
    /// Sum of the luminance of all samples.
    luminance: f64,
    /// Most names in a pixel, of each matte.
    names: Vec<usize>,
    /// Whether the light that belongs to no group is anywhere.
    has_rest: bool,
    /// Whether pixels have a variance.
    has_variance: bool,
}

impl Survey {
    /// Of a whole picture.
    pub(super) fn of(picture: &Picture) -> Self {
        let mut survey = Self::default();
        survey.add(picture);
        survey
    }

    /// Of a picture of so many samples a pixel, of whose pixels nothing else is asked (`is_needed`).
    pub(super) fn even(samples: u32, has_variance: bool) -> Self {
        Self { samples: Some((samples, samples)), has_variance, ..Self::default() }
    }

    /// Whether the file of a picture with this head says more of its pixels than how many samples they have.
    pub(super) fn is_needed(head: &Picture) -> bool {
        let layers = head.layers.as_ref();
        head.meta.clamp_indirect.is_some()
            || layers.is_some_and(|layers| !(layers.mattes.is_empty() && layers.lights.is_empty()))
    }

    /// Takes more rows; rows must come in order.
    pub(super) fn add(&mut self, rows: &Picture) {
        let film = &rows.film;
        if !film.counts.is_empty() {
            let (least, most) = film.samples();
            let known = self.samples.unwrap_or((least, most));
            self.samples = Some((known.0.min(least), known.1.max(most)));
        }
        self.luminance = film.sums.iter().fold(self.luminance, |sum, rgb| sum + luminance(*rgb));
        self.has_variance |= !film.variance.is_empty();
        let Some(layers) = &rows.layers else { return };
        self.names.resize(layers.mattes.len(), 0);
        for (most, matte) in self.names.iter_mut().zip(&layers.mattes) {
            *most = matte.most().max(*most);
        }
        self.has_rest |= layers.lights.iter().any(|group| group.name == REST && !group.is_black());
    }

    /// Most samples of a pixel.
    pub(super) fn most_samples(&self) -> u32 {
        self.samples.map_or(0, |(_, most)| most)
    }

    /// Whether every pixel has the same number of samples.
    pub(super) fn is_even(&self) -> bool {
        self.samples.is_none_or(|(least, most)| least == most)
    }

    /// Most names in a pixel of a matte.
    pub(super) fn names(&self, matte: usize) -> usize {
        self.names.get(matte).copied().unwrap_or(0)
    }

    /// Whether the light that belongs to no group has channels of its own.
    pub(super) fn has_rest(&self) -> bool {
        self.has_rest
    }

    /// Whether there is a channel of variances.
    pub(super) fn has_variance(&self) -> bool {
        self.has_variance
    }

    /// Share of the light that clamping took away.
    pub(super) fn removed(&self, film: &Film) -> f64 {
        film.removed_of(self.luminance)
    }
}
