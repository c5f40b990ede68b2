//! Radiance by direction becomes the table by which the kernel samples the sky as a light.
//!
//! Directions are cut into cells: rows of equal polar angle, columns of equal azimuth, as the rows and
//! columns of a lat-long image. A row is chosen by its share of all light, then a column by its share of the
//! row; inside a cell directions are uniform by solid angle. As with the choice of a light, every share is a
//! whole multiple of 2^-24, so the density that the estimator divides by is exactly the frequency with which
//! the kernel chooses (Pharr, Jakob & Humphreys 2023, "Physically Based Rendering", 12.5.2, with cells that
//! are uniform by solid angle instead of by angle).
//!
//! A cell's weight is the mean of what the kernel interpolates, so the density is positive wherever radiance
//! is. It does not know images or gradients.

use std::f64::consts::{PI, TAU};

use rayon::prelude::*;

use super::light::{STEPS, shares};

/// Most cells of a table: 32 MiB, one quarter of the smallest binding.
const MAX_CELLS: usize = 1 << 23;

/// Luminance by direction, averaged over cells.
pub(super) struct Cells {
    pub(super) columns: usize,
    pub(super) rows: usize,
    /// Mean luminance over each cell, row by row from the top.
    pub(super) means: Vec<f64>,
}

/// What the kernel samples by.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct SkyTable {
    pub(super) columns: u32,
    pub(super) rows: u32,
    /// For each row the sum of shares up to and including it; the cosines of the polar angle at the upper edge
    /// of the first row and at the lower edge of each; for each row and column the sum of shares in the row.
    pub(super) values: Vec<f32>,
    /// Integral of luminance over all directions.
    pub(super) flux: f64,
}

/// Cosine of the polar angle at the upper edge of row `row`.
fn edge(row: usize, rows: usize) -> f64 {
    // The ends are exact, and both halves are the same.
    match (2 * row).cmp(&rows) {
        std::cmp::Ordering::Less => libm::cos(PI * row as f64 / rows as f64),
        std::cmp::Ordering::Equal => 0.0,
        std::cmp::Ordering::Greater => -libm::cos(PI * (rows - row) as f64 / rows as f64),
    }
}

impl Cells {
    /// Fewer cells, so that they fit: as many neighbours are merged along both axes as the sides allow.
    fn reduced(self) -> Self {
        let fits = |f: &usize| {
            self.columns.is_multiple_of(*f)
                && self.rows.is_multiple_of(*f)
                && (self.columns / f) * (self.rows / f) <= MAX_CELLS
        };
        match (1..=self.rows).find(fits) {
            Some(1) => self,
            Some(factor) => self.merged([factor, factor]),
            None => self.merged([self.columns, self.rows]),
        }
    }

    /// Cells of `across` times `down` old ones.
    fn merged(&self, [across, down]: [usize; 2]) -> Self {
        let (columns, rows) = (self.columns / across, self.rows / down);
        let mean = |cell: usize| {
            let (row, column) = (cell / columns * down, cell % columns * across);
            let (mut sum, mut area) = (0.0, 0.0);
            for i in row..row + down {
                let height = edge(i, self.rows) - edge(i + 1, self.rows);
                let means = &self.means[i * self.columns + column..][..across];
                sum += height * means.iter().sum::<f64>();
                area += height * across as f64;
            }
            sum / area
        };
        let means = (0..rows * columns).into_par_iter().map(mean).collect();
        Self { columns, rows, means }
    }
}

/// The table; `None` for a sky that is dark everywhere.
pub(super) fn sky_table(cells: Cells) -> Option<SkyTable> {
    let cells = cells.reduced();
    let (columns, rows) = (cells.columns, cells.rows);
    let by_row: Vec<(f64, Vec<f32>)> = cells
        .means
        .par_chunks(columns)
        .enumerate()
        .map(|(row, means)| {
            let height = edge(row, rows) - edge(row + 1, rows);
            let flux = means.iter().sum::<f64>() * height * TAU / columns as f64;
            (flux, cumulative(means))
        })
        .collect();
    let fluxes: Vec<f64> = by_row.iter().map(|(flux, _)| *flux).collect();
    let flux: f64 = fluxes.iter().sum();
    if !(flux > 0.0 && flux.is_finite()) {
        return None;
    }
    let mut values = cumulative(&fluxes);
    values.extend((0..=rows).map(|row| edge(row, rows) as f32));
    values.extend(by_row.iter().flat_map(|(_, row)| row));
    Some(SkyTable { columns: columns as u32, rows: rows as u32, values, flux })
}

/// Sums of the shares up to and including each; all 1 where nothing has a weight.
fn cumulative(weights: &[f64]) -> Vec<f32> {
    let mut sum = 0;
    let shares = shares(weights);
    let dark = shares.iter().all(Option::is_none);
    let step = |share: Option<u64>| {
        sum += share.unwrap_or(0);
        if dark { 1.0 } else { (sum as f64 / STEPS as f64) as f32 }
    };
    shares.into_iter().map(step).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_even_sky_is_sampled_evenly() {
        let table = sky_table(Cells { columns: 8, rows: 4, means: vec![2.0; 32] }).expect("light");
        assert!((table.flux - 8.0 * PI).abs() < 1e-12);
        assert_eq!(table.values.len(), 4 + 5 + 32);
        for row in 0..4 {
            let expected = (1.0 - edge(row + 1, 4)) / 2.0;
            assert!((f64::from(table.values[row]) - expected).abs() < 1e-6);
        }
        assert_eq!(table.values[4..9], [1.0, edge(1, 4) as f32, 0.0, -edge(1, 4) as f32, -1.0]);
        assert_eq!(table.values[9..17], [1, 2, 3, 4, 5, 6, 7, 8].map(|k| k as f32 / 8.0));
    }

    #[test]
    fn dark_rows_and_cells_have_no_share_and_faint_ones_have() {
        let means = [0.0, 0.0, 0.0, 0.0, 1e-12, 0.0, 1.0, 0.0];
        let table = sky_table(Cells { columns: 4, rows: 2, means: means.into() }).expect("light");
        assert_eq!(table.values[..2], [0.0, 1.0]);
        assert_eq!(table.values[5..9], [1.0; 4]);
        let step = 2.0_f32.powi(-24);
        assert_eq!(table.values[9..], [step, step, 1.0, 1.0]);
        assert_eq!(sky_table(Cells { columns: 2, rows: 1, means: vec![0.0; 2] }), None);
    }

    #[test]
    fn large_images_are_merged_to_what_fits() {
        let cells = Cells { columns: 8192, rows: 2048, means: vec![1.0; 1 << 24] };
        let merged = cells.reduced();
        assert_eq!((merged.columns, merged.rows), (4096, 1024));
        assert!(merged.means.iter().all(|mean| (mean - 1.0).abs() < 1e-12));
        // Primes cannot be merged evenly.
        let odd = Cells { columns: 8_388_617, rows: 2, means: vec![1.0; 16_777_234] }.reduced();
        assert_eq!((odd.columns, odd.rows), (1, 1));
    }
}
