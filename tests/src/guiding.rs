//! Recorded paths → a path guide: for cells of space and material, a histogram of directions worth sampling.
//!
//! It says what a guide would give a step, and never traces one.

use std::collections::BTreeMap;

use runtime::check::{Sample, Step};
use runtime::convergence::luminance;

/// Edges of cells, as shares of what the middle 96 % of all vertices span.
const EDGES: [f64; 3] = [1.0 / 64.0, 1.0 / 24.0, 1.0 / 8.0];
/// A cell with fewer samples than this is not trusted; the next larger one is asked.
const TRUSTED: usize = 512;
/// Bins of a direction: cosine to the world's y axis, and angle around it. All have the same solid angle.
const BINS: [usize; 2] = [8, 16];
/// Shares of directions that the material may keep; each cell takes the best.
const SHARES: [f64; 4] = [1.0, 0.75, 0.5, 0.25];

/// A direction that a material or medium chose by a density, and what came of it.
#[derive(Clone, Copy, Debug)]
pub struct Vertex {
    point: [f64; 3],
    /// Material there; `None`: in a medium.
    material: Option<u32>,
    bin: usize,
    /// Per steradian.
    pdf: f64,
    /// Luminance that came back along it, times cosine and scattering function, over `pdf`.
    gain: f64,
}

/// Luminance that each step adds to the path, and the material of the vertex where it starts.
pub fn events(sample: &Sample) -> impl Iterator<Item = (&Step, f64, Option<u32>)> {
    let (mut before, mut here, mut next) = (0.0, None, None);
    sample.steps.iter().map(move |step| {
        let after = luminance(step.radiance);
        let added = after - before;
        before = after;
        if !step.shadow {
            here = next;
            next = step.material;
        }
        (step, added, here)
    })
}

/// The vertices of a path.
#[must_use]
pub fn vertices(sample: &Sample) -> Vec<Vertex> {
    let total = luminance(sample.finite());
    let (mut before, mut weight) = (0.0, 1.0);
    let mut found = Vec::new();
    for (step, added, material) in events(sample) {
        if step.pdf > 0.0 && total.is_finite() && weight > 0.0 {
            let gain = (total - before).max(0.0) / weight;
            let bin = bin(step.dir);
            found.push(Vertex { point: step.origin, material, bin, pdf: step.pdf, gain });
        }
        if !step.shadow {
            weight = luminance(step.throughput);
        }
        before += added;
    }
    found
}

fn bin([x, y, z]: [f64; 3]) -> usize {
    let around = z.atan2(x) / std::f64::consts::TAU + 0.5;
    let row = crate::statistics::index(f64::midpoint(y, 1.0), BINS[0]);
    row * BINS[1] + crate::statistics::index(around, BINS[1])
}

/// A level, a place in its grid, and a material.
type Key = (usize, [i64; 3], Option<u32>);

/// Where to send directions, learned.
pub struct Guide {
    /// Metres.
    span: f64,
    cells: BTreeMap<Key, Cell>,
}

/// Directions of a cell.
struct Cell {
    /// Share of the material.
    share: f64,
    /// Density of the guide in each bin, per steradian.
    density: Vec<f64>,
}

impl Guide {
    /// Learns from the vertices of all paths.
    #[must_use]
    pub fn learn(pixels: Vec<Vec<Vertex>>) -> Self {
        let vertices: Vec<Vertex> = pixels.into_iter().flatten().collect();
        let mut guide = Self { span: span(&vertices), cells: BTreeMap::new() };
        for level in 0..EDGES.len() {
            let mut groups: BTreeMap<Key, Vec<Vertex>> = BTreeMap::new();
            for vertex in &vertices {
                groups
                    .entry(guide.key(level, vertex.point, vertex.material))
                    .or_default()
                    .push(*vertex);
            }
            groups.retain(|_, group| group.len() >= TRUSTED);
            guide.cells.extend(groups.iter().map(|(key, group)| (*key, Cell::learn(group))));
        }
        guide
    }

    #[expect(clippy::cast_possible_truncation, reason = "a cell is wanted, and a cast saturates")]
    fn key(&self, level: usize, point: [f64; 3], material: Option<u32>) -> Key {
        (level, point.map(|x| (x / (self.span * EDGES[level])).floor() as i64), material)
    }

    /// Density that the step had over that which the guide would give it.
    #[must_use]
    pub fn ratio(&self, step: &Step, material: Option<u32>) -> f64 {
        let mut keys = (0..EDGES.len()).map(|level| self.key(level, step.origin, material));
        let cell = keys.find_map(|key| self.cells.get(&key));
        cell.map_or(1.0, |cell| ratio(cell.share, cell.density[bin(step.dir)], step.pdf))
    }
}

/// Greatest extent of the middle 96 % of all vertices, metres.
fn span(vertices: &[Vertex]) -> f64 {
    let extent = |axis: usize| {
        let mut at: Vec<f64> = vertices.iter().map(|v| v.point[axis]).collect();
        at.sort_by(f64::total_cmp);
        let cut = at.len() / 50;
        at.get(at.len().saturating_sub(1 + cut)).map_or(0.0, |high| high - at[cut])
    };
    (0..3).map(extent).fold(0.0, f64::max)
}

fn ratio(share: f64, density: f64, pdf: f64) -> f64 {
    1.0 / (share + (1.0 - share) * density / pdf)
}

impl Cell {
    /// The density of least variance goes with the root of the mean square of what comes back (Rath et al. 2020,
    /// "Variance-Aware Path Guiding"); one half of the samples makes it, the other chooses the share.
    fn learn(group: &[Vertex]) -> Self {
        let [rows, columns] = BINS;
        let mut squares = vec![0.0; rows * columns];
        for vertex in group.iter().step_by(2) {
            squares[vertex.bin] += vertex.pdf * vertex.gain * vertex.gain;
        }
        let sum: f64 = squares.iter().map(|x| x.sqrt()).sum();
        let per_bin = (rows * columns) as f64 / (4.0 * std::f64::consts::PI);
        let density: Vec<f64> = squares.iter().map(|x| x.sqrt() / sum * per_bin).collect();
        let moment = |share: f64| -> f64 {
            let other = group.iter().skip(1).step_by(2);
            other.map(|v| v.gain * v.gain * ratio(share, density[v.bin], v.pdf)).sum()
        };
        let better = |a: f64, b: f64| if moment(b) < moment(a) { b } else { a };
        // Nothing came back: the material alone.
        let share = if sum > 0.0 { SHARES.into_iter().reduce(better).unwrap_or(1.0) } else { 1.0 };
        Self { share, density: if sum > 0.0 { density } else { vec![0.0; rows * columns] } }
    }
}
