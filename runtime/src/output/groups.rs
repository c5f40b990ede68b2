//! Light groups ⇄ channels of an EXR: `ViewLayer.Combined_key.R`, as Blender has them, or `lights.key.R`.
//!
//! The channels of all groups add up to those of the picture exactly, in `f32` and in any order. What that rounds off
//! is computed here, from the sums; it is never part of them.

use super::channel::{Channel, Source, channel, channel_name, plane, residual_name, round};
use super::survey::Survey;
use crate::film::Film;
use crate::layers::{Group, LayerNames, Layers, shares};
use pack::manifest::REST;

const COLOURS: [&str; 3] = ["R", "G", "B"];
const GROUPS: &str = "light_groups";

fn plain(group: &str, colour: &str) -> String {
    format!("lights.{group}.{colour}")
}

fn name(names: LayerNames, group: &str, colour: &str) -> String {
    let plain = plain(group, colour);
    channel_name(names, &format!("Combined_{group}"), (colour, plain.as_str()))
}

/// The channels of all light groups of `film`; `residual`: with what was rounded off. [`REST`] is there only if it has
/// any light.
pub(super) fn channels(
    layers: &Layers,
    residual: bool,
    film: &Film,
    survey: &Survey,
) -> Vec<Channel> {
    let groups: Vec<&Group> =
        layers.lights.iter().filter(|group| group.name != REST || survey.has_rest()).collect();
    // A scene without light: black, by some name.
    let groups = if groups.is_empty() { layers.lights.iter().collect() } else { groups };
    let mut channels = Vec::new();
    for (c, colour) in COLOURS.into_iter().enumerate() {
        let (shares, rests) = planes(&groups, c, film);
        for (group, (shares, rests)) in groups.iter().zip(shares.into_iter().zip(rests)) {
            channels.push(channel(&name(layers.wanted.names, &group.name, colour), shares));
            if residual {
                channels.push(channel(&residual_name(&plain(&group.name, colour)), rests));
            }
        }
    }
    channels
}

/// Channel `c` of each group, and what rounding took from it.
fn planes(groups: &[&Group], c: usize, film: &Film) -> (Vec<Vec<f32>>, Vec<Vec<f32>>) {
    let empty = || vec![Vec::with_capacity(film.sums.len()); groups.len()];
    let (mut planes, mut rests) = (empty(), empty());
    let mut means = vec![0.0; groups.len()];
    for (i, n) in film.counts.iter().enumerate() {
        for (mean, group) in means.iter_mut().zip(groups) {
            *mean = group.sums.get(i).map_or(0.0, |sum| sum[c % 3] / f64::from((*n).max(1)));
        }
        let shares = shares(&means, round(film.mean(i)[c % 3]));
        for (g, (share, mean)) in shares.into_iter().zip(&means).enumerate() {
            planes[g].push(share);
            rests[g].push(round(mean - f64::from(share)));
        }
    }
    (planes, rests)
}

/// The attribute that names them.
pub(super) fn attribute(layers: &Layers) -> Option<(String, String)> {
    let names: Vec<&str> = layers.lights.iter().map(|group| group.name.as_str()).collect();
    (!names.is_empty()).then(|| (GROUPS.to_owned(), names.join(",")))
}

/// The light groups of a file, without their pixels.
pub(super) fn head(source: &dyn Source) -> Result<Vec<Group>, String> {
    let text = source.text(GROUPS).ok_or("attribute `light_groups` is missing")?;
    let names = text.split(',').filter(|name| !name.is_empty());
    Ok(names.map(|name| Group { name: name.to_owned(), sums: Vec::new() }).collect())
}

/// A light group with the `n` pixels of `source`.
pub(super) fn pixels(
    source: &dyn Source,
    layers: &Layers,
    group: &str,
    n: usize,
) -> Result<Group, String> {
    let mut sums = vec![[0.0; 3]; n];
    for (c, colour) in COLOURS.into_iter().enumerate() {
        let name = name(layers.wanted.names, group, colour);
        if group == REST && source.floats(&name).is_none() {
            continue;
        }
        let means = plane(source, &name, n)?;
        let rests = source.floats(&residual_name(&plain(group, colour)));
        for (i, (sum, mean)) in sums.iter_mut().zip(means).enumerate() {
            let rest = rests.and_then(|rests| rests.get(i)).copied().unwrap_or(0.0);
            sum[c] = (f64::from(*mean) + f64::from(rest)) * f64::from(layers.samples);
        }
    }
    Ok(Group { name: group.to_owned(), sums })
}
