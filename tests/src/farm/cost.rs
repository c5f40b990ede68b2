//! A scene → the cost of a sample in every tile of a large frame, and of the frame with its standard error.
//!
//! Two measurements. The pilot renders the frame small, tile by tile: it says how cost is spread over the frame, but at
//! another resolution and with few samples. Crops of the frame itself, with all samples, say how much that is: tiles are
//! sorted by their pilot cost into strata of equal size, crops are drawn at random from each, and the ratio of what they
//! cost to what the pilot says of their tiles scales the pilot. Costs are CPU seconds, user + system of this process, a
//! sample of a pixel.

use std::error::Error;

use cpu_time::ProcessTime;
use runtime::{Control, DeviceChoice, Job, Rect, SampleRange, Scene, render};

use crate::console;
use crate::picture::Estimate;
use crate::statistics::stream::Stream;

/// The frame in pixels, as the scene asks for.
pub const FRAME: [u32; 2] = [7680, 4320];
/// A tile of it.
pub const TILE: [u32; 2] = [240, 270];
/// Tiles in a row and in a column.
pub const GRID: [u32; 2] = [FRAME[0] / TILE[0], FRAME[1] / TILE[1]];
/// Pixels of a tile in the pilot, whose frame has as many tiles.
const PILOT_TILE: [u32; 2] = [16, 18];
/// Samples a pixel of the pilot: a batch.
const PILOT_SAMPLES: u32 = 16;
/// Samples of a tile in the pilot.
pub const PILOT: u32 = PILOT_TILE[0] * PILOT_TILE[1] * PILOT_SAMPLES;
/// A crop, of which a tile has a whole number: then each of its pixels is as likely as any. Two blocks of the CPU
/// kernel, for two threads.
const CROP: [u32; 2] = [60, 9];
/// Of equal size.
const STRATA: usize = 8;
const SEED: u64 = 7680;

/// CPU seconds of a sample.
pub struct Costs {
    /// Of each tile, row by row: by the pilot, scaled to the crops.
    pub tiles: Vec<f64>,
    /// Of the frame: the mean, with its standard error.
    pub frame: Estimate,
    /// What the crops cost over what the pilot says of their tiles, on average.
    pub ratio: f64,
    /// Crops that were rendered.
    pub n_crops: usize,
}

impl Costs {
    /// Measures with about `n_crops` crops, of `samples` samples.
    ///
    /// # Errors
    /// When the scene cannot be rendered.
    pub fn measure(scene: &Scene, n_crops: usize, samples: u32) -> Result<Self, Box<dyn Error>> {
        scene.prepare();
        let pilot = pilot(scene)?;
        let strata = strata(&pilot);
        let counts = allocate(&strata, &pilot, n_crops);
        let mut crops = Vec::new();
        for (h, (stratum, n)) in strata.iter().zip(&counts).enumerate() {
            let mut pairs = Vec::new();
            for (tile, crop) in draw(stratum, *n, &mut Stream::new(SEED, h as u64)) {
                pairs.push([pilot[tile], cost(scene, FRAME, crop, samples)?]);
            }
            console::progress(&format!("crops of stratum {} of {STRATA} are rendered", h + 1));
            crops.push(pairs);
        }
        let ratio = ratio(&crops);
        let mean = pilot.iter().sum::<f64>() / pilot.len() as f64;
        let frame = Estimate { mean: ratio.mean * mean, error: ratio.error * mean };
        let tiles = pilot.iter().map(|cost| cost * ratio.mean).collect();
        Ok(Self { tiles, frame, ratio: ratio.mean, n_crops: counts.iter().sum() })
    }

    /// CPU seconds that a sample of every pixel of `crop` takes.
    #[must_use]
    pub fn of_crop(&self, crop: Rect) -> f64 {
        let shares =
            self.tiles.iter().enumerate().map(|(k, cost)| overlap(tile(k), crop) as f64 * cost);
        shares.sum()
    }
}

/// The tile with this index, in the frame.
#[must_use]
pub fn tile(index: usize) -> Rect {
    let index = u32::try_from(index).unwrap_or(u32::MAX);
    let [column, row] = [index % GRID[0], index / GRID[0]];
    Rect { x: column * TILE[0], y: row * TILE[1], w: TILE[0], h: TILE[1] }
}

/// Pixels that both have.
fn overlap(a: Rect, b: Rect) -> u64 {
    let common = |a: u32, a_len: u32, b: u32, b_len: u32| {
        u64::from((a + a_len).min(b + b_len).saturating_sub(a.max(b)))
    };
    common(a.x, a.w, b.x, b.w) * common(a.y, a.h, b.y, b.h)
}

/// CPU seconds a sample of every tile, in a small picture of the frame.
fn pilot(scene: &Scene) -> Result<Vec<f64>, Box<dyn Error>> {
    let size = [GRID[0] * PILOT_TILE[0], GRID[1] * PILOT_TILE[1]];
    let mut costs = Vec::new();
    for row in 0..GRID[1] {
        for column in 0..GRID[0] {
            let [w, h] = PILOT_TILE;
            let crop = Rect { x: column * w, y: row * h, w, h };
            costs.push(cost(scene, size, crop, PILOT_SAMPLES)?);
        }
        let micros: Vec<String> = costs[costs.len() - GRID[0] as usize..]
            .iter()
            .map(|c| format!("{:.0}", 1e6 * c))
            .collect();
        console::progress(&format!(
            "pilot: row {} of {}: {} us",
            row + 1,
            GRID[1],
            micros.join(" ")
        ));
    }
    Ok(costs)
}

/// CPU seconds a sample of a part of a picture.
fn cost(
    scene: &Scene,
    image_size: [u32; 2],
    crop: Rect,
    samples: u32,
) -> Result<f64, Box<dyn Error>> {
    let samples = SampleRange { start: 0, end: samples };
    let job = Job { image_size, crop, samples, ..Job::of_scene(scene) };
    let start = ProcessTime::now();
    let outcome = render(scene, &job, &DeviceChoice::Cpu, &Control::default())?;
    let seconds = start.elapsed().as_secs_f64();
    Ok(seconds / outcome.film().total_samples() as f64)
}

/// Tiles by cost, in `STRATA` groups of equal size.
fn strata(costs: &[f64]) -> Vec<Vec<usize>> {
    let mut order: Vec<usize> = (0..costs.len()).collect();
    order.sort_by(|a, b| costs[*a].total_cmp(&costs[*b]));
    order.chunks(costs.len().div_ceil(STRATA)).map(<[usize]>::to_vec).collect()
}

/// How many crops each stratum gets, two at least. With spreads that grow as the cost does, the least error for the
/// time is had with counts as the roots of the costs: Cochran 1977, "Sampling Techniques", section 5.5.
fn allocate(strata: &[Vec<usize>], costs: &[f64], n: usize) -> Vec<usize> {
    let mean =
        |tiles: &Vec<usize>| tiles.iter().map(|k| costs[*k]).sum::<f64>() / tiles.len() as f64;
    let roots: Vec<f64> = strata.iter().map(|tiles| mean(tiles).sqrt()).collect();
    let sum: f64 = roots.iter().sum();
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at most `n`")]
    let count = |root: f64| ((n as f64 * root / sum).round() as usize).max(2);
    roots.into_iter().map(count).collect()
}

/// Some tiles of a stratum, none twice, and a crop of each.
fn draw(stratum: &[usize], n: usize, stream: &mut Stream) -> Vec<(usize, Rect)> {
    let mut rest = stratum.to_vec();
    let cells = [TILE[0] / CROP[0], TILE[1] / CROP[1]];
    let mut drawn = Vec::new();
    while drawn.len() < n && !rest.is_empty() {
        let index = rest.swap_remove(stream.index(rest.len()));
        let [column, row] = cells.map(|n| u32::try_from(stream.index(n as usize)).unwrap_or(0));
        let Rect { x, y, .. } = tile(index);
        let [w, h] = CROP;
        drawn.push((index, Rect { x: x + column * w, y: y + row * h, w, h }));
    }
    drawn
}

/// The combined ratio of pairs x, y from strata of equal size, the mean of y over that of x, with its standard error:
/// Cochran 1977, "Sampling Techniques", section 6.11. A crop is so small a part of a stratum that no correction for
/// finite populations is due.
fn ratio(strata: &[Vec<[f64; 2]>]) -> Estimate {
    let mean = |k: usize| strata.iter().map(|pairs| of(pairs, |pair| pair[k]).mean).sum::<f64>();
    let ratio = mean(1) / mean(0);
    let residuals = strata.iter().map(|pairs| of(pairs, |pair| pair[1] - ratio * pair[0]).error);
    Estimate {
        mean: ratio,
        error: residuals.map(|error| error * error).sum::<f64>().sqrt() / mean(0),
    }
}

fn of(pairs: &[[f64; 2]], value: impl Fn(&[f64; 2]) -> f64) -> Estimate {
    Estimate::of(&pairs.iter().map(value).collect::<Vec<f64>>())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tiles_cover_the_frame_once() {
        let n = (GRID[0] * GRID[1]) as usize;
        let frame = Rect::whole(FRAME);
        let area: u64 = (0..n).map(|k| overlap(tile(k), frame)).sum();
        assert_eq!(area, frame.pixels());
        let crop = Rect { x: 100, y: 200, w: 480, h: 270 };
        let area: u64 = (0..n).map(|k| overlap(tile(k), crop)).sum();
        assert_eq!(area, crop.pixels());
        assert_eq!([TILE[0] % CROP[0], TILE[1] % CROP[1]], [0, 0]);
    }

    #[test]
    fn strata_hold_every_tile_once_and_cheap_ones_first() {
        let mut stream = Stream::new(3, 0);
        let costs: Vec<f64> = (0..512).map(|_| stream.unit()).collect();
        let strata = strata(&costs);
        assert!(strata.len() == STRATA && strata.iter().all(|stratum| stratum.len() == 64));
        let most = |k: usize| strata[k].iter().map(|t| costs[*t]).fold(0.0, f64::max);
        let least = |k: usize| strata[k].iter().map(|t| costs[*t]).fold(1.0, f64::min);
        assert!((1..STRATA).all(|k| most(k - 1) <= least(k)));
        let mut all = strata.concat();
        all.sort_unstable();
        assert!(all.into_iter().eq(0..512));
    }

    #[test]
    fn crops_are_inside_of_their_tiles_and_of_different_ones() {
        let stratum: Vec<usize> = (100..164).collect();
        let drawn = draw(&stratum, 64, &mut Stream::new(5, 0));
        let mut tiles: Vec<usize> = drawn.iter().map(|(tile, _)| *tile).collect();
        tiles.sort_unstable();
        assert_eq!(tiles, stratum);
        assert!(drawn.iter().all(|(k, crop)| overlap(tile(*k), *crop) == crop.pixels()));
    }

    #[test]
    fn dear_strata_get_more_crops_and_none_fewer_than_two() {
        let costs: Vec<f64> = (0..512).map(|k| f64::from(k).powi(2)).collect();
        let counts = allocate(&strata(&costs), &costs, 64);
        assert!(counts.is_sorted() && counts[0] == 2 && counts[7] >= 13, "{counts:?}");
        let sum: usize = counts.iter().sum();
        assert!(sum.abs_diff(64) <= 4, "{counts:?}");
    }

    /// The ratio is that of the population, and the error is what ratios of many draws show.
    #[test]
    fn the_error_of_the_ratio_is_the_spread_of_ratios() {
        let mut stream = Stream::new(9, 1);
        let mut once = || {
            let mut pair = |h: usize| {
                let x = (h + 1) as f64 * stream.between(0.5, 1.5);
                [x, 2.0 * x + stream.between(-1.0, 1.0)]
            };
            ratio(&std::array::from_fn::<_, STRATA, _>(|h| (0..8).map(|_| pair(h)).collect()))
        };
        let draws: Vec<Estimate> = (0..2000).map(|_| once()).collect();
        let ratios: Vec<f64> = draws.iter().map(|draw| draw.mean).collect();
        let of_ratios = Estimate::of(&ratios);
        assert!(of_ratios.z(2.0).abs() < 4.0, "{of_ratios:?}");
        let spread = of_ratios.error * (ratios.len() as f64).sqrt();
        let said = (draws.iter().map(|draw| draw.error.powi(2)).sum::<f64>() / 2000.0).sqrt();
        assert!((said / spread - 1.0).abs() < 0.1, "{said} {spread}");
    }
}
