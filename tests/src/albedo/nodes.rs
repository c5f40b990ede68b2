//! The nodes of each table → its words.

use std::f64::consts::FRAC_PI_2;

use glam::{DVec2, DVec3};
use pack::abi::AlbedoTable;
use rayon::prelude::*;
use runtime::kernel::f64::{GlossAlbedo, Kernel};

use super::facets::{self, Points, direction};
use super::forward;
use super::sheen::Fibres;
use crate::kernel::Lobe;

/// Fine enough for 1e-4.
const ROUND: Points = [512, 48];
const LONG: Points = [256, 96];
/// Cosines of a mean.
const COSINES: usize = 48;

/// Every table, in the order of [`AlbedoTable::ALL`].
#[must_use]
pub fn tables() -> Vec<[f32; 4]> {
    AlbedoTable::ALL.into_iter().flat_map(table).collect()
}

/// The words of one table.
#[must_use]
pub fn table(of: AlbedoTable) -> Vec<[f32; 4]> {
    let words: Vec<[f64; 4]> = match of {
        AlbedoTable::Gloss => gloss(),
        AlbedoTable::Brushed => brushed(),
        AlbedoTable::Glass => glass(),
        AlbedoTable::Leaf => leaf(),
        AlbedoTable::BrushedGloss => brushed_gloss(),
        AlbedoTable::Sheen => sheen(),
    };
    assert_eq!(words.len(), of.words(), "{of:?}");
    #[expect(clippy::cast_possible_truncation, reason = "rounded once")]
    words.into_iter().map(|word| word.map(|value| value as f32)).collect()
}

/// Node `i` of `n` on an axis from 0 to 1.
fn node(i: usize, n: usize) -> f64 {
    i as f64 / (n - 1) as f64
}

/// The width of perceptual `roughness`, as kernels bound it.
fn width(roughness: f64) -> f64 {
    (roughness * roughness).max(1e-3)
}

/// The mean of `f` over the cosine of a hemisphere, weighted by it.
fn mean(f: impl Fn(f64) -> f64 + Sync) -> f64 {
    over_cosines().map(|c| cosine_weight(c) * f(c)).sum()
}

/// Squares of midpoints of 0 ..= 1.
fn over_cosines() -> impl Iterator<Item = f64> + Clone {
    (0..COSINES).map(|k| ((k as f64 + 0.5) / COSINES as f64).powi(2))
}

/// What each of them counts in a mean.
fn cosine_weight(c: f64) -> f64 {
    4.0 * c * c.sqrt() / COSINES as f64
}

/// The values at the corners of the cells between nodes, `columns` nodes in a row.
fn corners(nodes: &[f64], columns: usize) -> Vec<[f64; 4]> {
    let rows = nodes.len() / columns;
    let cells = (0..rows - 1).flat_map(|j| (0..columns - 1).map(move |i| j * columns + i));
    cells.map(|k| [nodes[k], nodes[k + 1], nodes[k + columns], nodes[k + columns + 1]]).collect()
}

/// D, and what is lost under a coat.
fn gloss() -> Vec<[f64; 4]> {
    let n = 16;
    let at = |k: usize| {
        let (c, r) = (node(k % n, n).powi(2).max(1e-4), node(k / n, n).powi(2));
        (c, direction(c, 0.0), DVec2::splat(width(r)))
    };
    let all: Vec<[f64; 2]> = (0..n * n)
        .into_par_iter()
        .map(|k| {
            let (c, o, alpha) = at(k);
            let shares = facets::reflected(o, alpha, ROUND);
            let d = shares.y / shares.x - (1.0 - c).powi(5);
            [d, facets::flattened(o, alpha, ROUND)]
        })
        .collect();
    let table = |k: usize| corners(&all.iter().map(|row| row[k]).collect::<Vec<_>>(), n);
    [table(0), table(1)].concat()
}

/// Brushed surfaces: D for seven effective widths, and its means.
fn brushed() -> Vec<[f64; 4]> {
    let rows: Vec<(Vec<[f64; 4]>, f64)> = (0..12 * 6)
        .into_par_iter()
        .map(|row| {
            let bench = Lobe::conductor(1.0, 0.0).bench();
            let (roughness, anisotropy) = (node(row / 6, 12), brushing(node(row % 6, 6)));
            brushed_row(&mut bench.double(), roughness, anisotropy)
        })
        .collect();
    let means: Vec<f64> = rows.iter().map(|row| row.1).collect();
    let words: Vec<[f64; 4]> = rows.into_iter().flat_map(|row| row.0).collect();
    [words, corners(&means, 6)].concat()
}

/// What B over 1 - M of a brushed lobe, and what it loses under a coat, are more than those of a round one, as
/// `brushed_gloss.wgsl` and `brushed_coat.wgsl` read them from the tables of those, and how much more their means are.
fn brushed_gloss() -> Vec<[f64; 4]> {
    let rows: Vec<[(Vec<[f64; 4]>, f64); 2]> = (0..12 * 6)
        .into_par_iter()
        .map(|row| {
            let bench = Lobe::principled(1.0, 0.0).bench();
            let (roughness, anisotropy) = (node(row / 6, 12), brushing(node(row % 6, 6)));
            brushed_gloss_row(&mut bench.double(), roughness, anisotropy)
        })
        .collect();
    let table = |k: usize| {
        let means: Vec<f64> = rows.iter().map(|row| row[k].1).collect();
        let words: Vec<[f64; 4]> = rows.iter().flat_map(|row| row[k].0.clone()).collect();
        [words, corners(&means, 6)].concat()
    };
    [table(0), table(1)].concat()
}

/// The words of both tables, and their means.
fn brushed_gloss_row(
    kernel: &mut Kernel<'_>,
    roughness: f64,
    anisotropy: f64,
) -> [(Vec<[f64; 4]>, f64); 2] {
    let alpha = kernel.ggx_anisotropic_alpha(roughness, anisotropy);
    let round = kernel.gloss_albedo_at(roughness, width(roughness), true);
    let mut words = [Vec::new(), Vec::new()];
    for k in 0..16 {
        let c = node(k, 16).powi(2).max(1e-4);
        let both = [0, 1, 2, 3, 4, 5, 6].map(|width| {
            let o = direction(c, effective(alpha, node(width, 7)));
            let shares = facets::reflected(o, alpha, LONG);
            let row = kernel.brushed_gloss_row(alpha, DVec3::new(o.x * alpha.x, o.y * alpha.y, c));
            let along = GlossAlbedo { row, ..round };
            let schlick =
                shares.y / shares.x - (1.0 - c).powi(5) - kernel.gloss_albedo_rise(row, c);
            let lost = facets::flattened(o, alpha, LONG);
            [schlick, lost - kernel.gloss_albedo_flattened(along, c)]
        });
        for (k, words) in words.iter_mut().enumerate() {
            let r = both.map(|both| both[k]);
            words.extend([[r[0], r[1], r[2], r[3]], [r[3], r[4], r[5], r[6]]]);
        }
    }
    let [schlick, lost] = words;
    let mean = around(|o| facets::reflected(o, alpha, LONG).y);
    let lost_mean = brushed_lost(kernel, roughness, alpha, round);
    [(schlick, mean - round.mean_schlick), (lost, lost_mean)]
}

/// The mean that makes `under_coat_missing` right under a smooth coat, less that of a round lobe.
fn brushed_lost(kernel: &mut Kernel<'_>, roughness: f64, alpha: DVec2, round: GlossAlbedo) -> f64 {
    let missing = |o: DVec3| 1.0 - facets::reflected(o, alpha, LONG).x;
    let through = |o: DVec3| 0.96 - 0.96 * (1.0 - o.z).powi(5);
    let all = around(|o| through(o) * missing(o) + facets::flattened(o, alpha, LONG));
    let brushed = GlossAlbedo { mean_missing: around(missing), ..round };
    let rest = kernel.under_coat_missing(DVec2::new(1.0, 0.0), brushed, roughness, 0.0);
    all - rest - kernel.gloss_albedo_mean_flattened(roughness)
}

/// The mean of `f` over the hemisphere of a brushed surface, weighted by the cosine.
fn around(f: impl Fn(DVec3) -> f64 + Sync) -> f64 {
    let turns = 12;
    mean(|c| {
        let at = |k: usize| direction(c, (k as f64 + 0.5) / turns as f64 * FRAC_PI_2);
        (0..turns).map(|k| f(at(k))).sum::<f64>() / turns as f64
    })
}

/// The anisotropy at `x` of its axis.
fn brushing(x: f64) -> f64 {
    (1.0 - 10_f64.powf(-x)) / 0.9
}

fn brushed_row(kernel: &mut Kernel<'_>, roughness: f64, anisotropy: f64) -> (Vec<[f64; 4]>, f64) {
    let alpha = kernel.ggx_anisotropic_alpha(roughness, anisotropy);
    let fit = kernel.ggx_albedo_at(alpha.x * alpha.y);
    let missing = |o: DVec3| 1.0 - facets::reflected(o, alpha, LONG).x;
    let mean = around(missing);
    let mut words = Vec::new();
    for k in 0..16 {
        let d = [0, 1, 2, 3, 4, 5, 6].map(|width| {
            let o = direction(node(k, 16).powi(2), effective(alpha, node(width, 7)));
            let scaled = DVec3::new(o.x * alpha.x, o.y * alpha.y, o.z);
            missing(o) - kernel.ggx_albedo_missing(fit, scaled)
        });
        words.extend([[d[0], d[1], d[2], d[3]], [d[3], d[4], d[5], d[6]]]);
    }
    (words, mean - fit.mean)
}

/// The azimuth at which the effective width is `x` of the way from the narrower to the wider, in the logarithm.
fn effective(alpha: DVec2, x: f64) -> f64 {
    let wide = alpha.y * (alpha.x / alpha.y).powf(x);
    let span = alpha.x * alpha.x - alpha.y * alpha.y;
    let along = if span > 1e-12 { (wide * wide - alpha.y * alpha.y) / span } else { 0.0 };
    along.clamp(0.0, 1.0).sqrt().acos()
}

/// D of both sides, and their means.
fn glass() -> Vec<[f64; 4]> {
    let rows: Vec<Vec<[f64; 4]>> = (0..12 * 16).into_par_iter().map(glass_row).collect();
    rows.concat()
}

/// The index at `z` of its axis.
fn index(z: f64) -> f64 {
    let root = 0.2204 + 0.7796 * z;
    let s = 0.5 * root * root;
    (1.0 + s) / (1.0 - s)
}

fn glass_row(row: usize) -> Vec<[f64; 4]> {
    let (ior, alpha) = (index(node(row / 16, 12)), width(node(row % 16, 16).powi(2)));
    let missing = |c: f64, eta: f64, points: Points| {
        let shares = facets::dielectric(direction(c, 0.0), alpha, eta, points);
        1.0 - shares.x - shares.y
    };
    let sides = [ior, 1.0 / ior];
    let metal = |c: f64| 1.0 - facets::reflected(direction(c, 0.0), DVec2::splat(alpha), ROUND).x;
    let means = sides.map(|eta| mean(|c| missing(c, eta, ROUND) - metal(c)));
    let cosines = (0..16).map(|i| node(i, 16).powi(2));
    let word = |c: f64| {
        let [a, b] = sides.map(|eta| missing(c, eta, ROUND) - metal(c));
        [a, b, means[0], means[1]]
    };
    cosines.map(word).collect()
}

/// L and its mean, forward and backward.
fn leaf() -> Vec<[f64; 4]> {
    let row = |j: usize| {
        let sign = if j < 16 { 1.0 } else { -1.0 };
        let g = sign * (1.0 - node(j % 16, 16).powi(3));
        let mean = mean(|c| forward::lost(c, g));
        (0..16).map(|i| [forward::lost(node(i, 16).powi(2), g), mean, 0.0, 0.0]).collect()
    };
    let rows: Vec<Vec<[f64; 4]>> = (0..32).into_par_iter().map(row).collect();
    rows.concat()
}

/// E, 1 / max(1, A), the means of E, E B, E M and F, and F.
fn sheen() -> Vec<[f64; 4]> {
    let axis = |n: usize| -> Vec<Fibres> {
        (0..n).into_par_iter().map(|k| Fibres::new(0.15 + 0.85 * node(k, n))).collect()
    };
    let fibres = axis(16);
    let table = |albedo: fn(&Fibres, f64) -> f64| {
        let at = |k: usize| albedo(&fibres[k / 32], node(k % 32, 32).powi(2).max(1e-4));
        corners(&(0..16 * 32).into_par_iter().map(at).collect::<Vec<_>>(), 32)
    };
    let means = fibres.par_iter().flat_map_iter(|fibres| {
        (0..16).map(move |k| sheen_means(fibres, DVec2::splat(width(node(k, 16).powi(2)))))
    });
    let flattened = axis(8).into_iter().flat_map(|fibres| {
        let at = |k: usize| {
            let o = direction(node(k % 16, 16).powi(2).max(1e-4), 0.0);
            let alpha = DVec2::splat(width(node(k / 16, 16).powi(2)));
            facets::flattened_under(|c| fibres.albedo_near(c), o, alpha, ROUND)
        };
        corners(&(0..16 * 16).into_par_iter().map(at).collect::<Vec<_>>(), 16)
    });
    [table(Fibres::albedo), table(Fibres::kept), means.collect(), flattened.collect()].concat()
}

/// The means of E, E B, E M and F over a round lobe.
fn sheen_means(fibres: &Fibres, alpha: DVec2) -> [f64; 4] {
    let mut sums = [0.0; 4];
    for c in over_cosines() {
        let o = direction(c, 0.0);
        let (e, lobe) = (fibres.albedo_near(c), facets::reflected(o, alpha, ROUND));
        let lost = facets::flattened_under(|c| fibres.albedo_near(c), o, alpha, ROUND);
        let values = [e, e * lobe.y, e * (1.0 - lobe.x), lost];
        sums.iter_mut().zip(values).for_each(|(sum, value)| *sum += cosine_weight(c) * value);
    }
    sums
}
