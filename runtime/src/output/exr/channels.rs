//! Rows of a picture ⇄ the channels of its file.

use super::header::Fields;
use super::names::{COUNTS, DENOISER, RESIDUALS, VARIANCE};
use crate::film::Film;
use crate::layers::LayerNames;
use crate::output::channel::{Source, channel, combined, noisy, round};
use crate::output::picture::Picture;
use crate::output::planes::{self, COLOURS};
use crate::output::survey::Survey;
use ::exr::meta::header::Header;
use ::exr::prelude::{AnyChannel, AnyChannels, FlatSamples};

/// The channels of some rows of a picture of which all is known that `survey` says, in the order of files; `residual`
/// as for `encode`.
pub(super) fn of(rows: &Picture, survey: &Survey, residual: bool) -> AnyChannels<FlatSamples> {
    let film = &rows.film;
    let means = film.means();
    let layers = rows.layers.as_ref();
    let style = layers.map_or(LayerNames::Plain, |layers| layers.wanted.names);
    let named = |name: fn(LayerNames, &str) -> String, values: &[[f64; 3]]| {
        let names = COLOURS.map(|component| name(style, component));
        names.into_iter().zip(colours(values, round)).map(|(n, p)| channel(&n, p))
    };
    let mut channels: Vec<_> = named(combined, &rows.shown()).collect();
    if rows.denoised.is_some() {
        channels.extend(named(noisy, &means));
    }
    if residual {
        let rest = colours(&means, |x| {
            let rest = round(x - f64::from(round(x)));
            if rest.is_finite() { rest } else { 0.0 }
        });
        channels.extend(RESIDUALS.iter().zip(rest).map(|(n, p)| channel(n, p)));
    }
    if survey.has_variance() {
        channels.push(channel(VARIANCE, film.variance.iter().map(|v| round(*v)).collect()));
    }
    if let Some(layers) = layers {
        channels.extend(planes::channels(layers, residual, film, survey));
    }
    if !survey.is_even() || layers.is_some_and(planes::counts_samples) {
        channels.push(AnyChannel::new(COUNTS, FlatSamples::U32(film.counts.clone())));
    }
    AnyChannels::sort(channels.into_iter().collect())
}

fn colours(means: &[[f64; 3]], f: impl Fn(f64) -> f32) -> [Vec<f32>; 3] {
    [0, 1, 2].map(|c| means.iter().map(|rgb| f(rgb[c])).collect())
}

/// Channels of some rows of a file, in the order of its header, and the header's texts.
pub(super) struct Rows<'a> {
    pub(super) header: &'a Header,
    pub(super) planes: Vec<FlatSamples>,
}

impl Rows<'_> {
    fn find(&self, name: &str) -> Option<&FlatSamples> {
        let list = &self.header.channels.list;
        self.planes.get(list.iter().position(|channel| channel.name.eq(name))?)
    }
}

impl Source for Rows<'_> {
    fn floats(&self, channel: &str) -> Option<&[f32]> {
        match self.find(channel) {
            Some(FlatSamples::F32(values)) => Some(values),
            _ => None,
        }
    }

    fn text(&self, attribute: &str) -> Option<String> {
        Fields { header: self.header }.text(attribute).ok()
    }
}

/// The rows of a picture with this head, whose film has the pixels that are there; of what is denoised, the noisy
/// picture.
pub(super) fn parse(head: &Picture, film: Film, rows: &Rows<'_>) -> Result<Picture, String> {
    let film = parse_film(film, rows)?;
    let layers = head.layers.as_ref();
    let layers = layers.map(|layers| planes::pixels(layers, rows, film.sums.len())).transpose()?;
    Ok(Picture { layers, ..Picture::new(film, head.meta.clone()) })
}

fn parse_film(mut film: Film, rows: &Rows<'_>) -> Result<Film, String> {
    let style = planes::names_of(rows).unwrap_or(LayerNames::Plain);
    let name = if rows.text(DENOISER).is_some() { noisy } else { combined };
    if let Some(variance) = rows.floats(VARIANCE) {
        film.variance = variance.iter().map(|v| f64::from(*v)).collect();
    }
    let replicates = film.replicates();
    match rows.find(COUNTS) {
        Some(FlatSamples::U32(counts)) => film.counts.clone_from(counts),
        Some(_) => return Err(format!("channel `{COUNTS}` is not of whole numbers")),
        None => {
            let count: u32 = film.ranges.iter().map(|range| range.count()).sum();
            film.counts.fill(count.saturating_mul(replicates));
        }
    }
    for (c, (colour, residual)) in COLOURS.iter().zip(RESIDUALS).enumerate() {
        let colour = name(style, colour);
        let Some(means) = rows.floats(&colour) else {
            return Err(format!("channel `{colour}` of 32-bit floats is missing"));
        };
        for (sum, mean) in film.sums.iter_mut().zip(means) {
            sum[c] = f64::from(*mean);
        }
        for (sum, rest) in film.sums.iter_mut().zip(rows.floats(residual).unwrap_or_default()) {
            sum[c] += f64::from(*rest);
        }
    }
    for (sum, count) in film.sums.iter_mut().zip(&film.counts) {
        *sum = sum.map(|mean| mean * f64::from(*count));
    }
    Ok(film)
}
