//! Where the colours of triangles are in an image: blocks of 2 x 2 texels.

use super::check::single;

/// Where the colours of the triangles of a part are in its image: a block each, row by row from the top.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Paint {
    /// Blocks in a row.
    columns: u32,
    /// Rows of blocks.
    rows: u32,
}

impl Paint {
    /// For so many triangles, at least one.
    pub(super) fn of(n_triangles: usize) -> Option<Self> {
        let columns = u32::try_from(n_triangles.isqrt()).ok()?.max(1);
        let rows = u32::try_from(n_triangles.div_ceil(columns as usize)).ok()?;
        Some(Self { columns, rows })
    }

    /// Blocks in a row.
    pub(super) fn columns(self) -> usize {
        self.columns as usize
    }

    /// Pixels, width and height.
    pub(super) fn size(self) -> [u32; 2] {
        [2 * self.columns, 2 * self.rows]
    }

    /// How many pixels that is.
    pub(super) fn n_pixels(self) -> u64 {
        let [width, height] = self.size().map(u64::from);
        width * height
    }

    /// Texture coordinates of the corners of triangle `tri_idx`: the centres of three texels.
    #[must_use]
    pub fn uvs(self, tri_idx: usize) -> [[f32; 2]; 3] {
        let columns = self.columns as usize;
        let (x, y) = ((tri_idx % columns) as f64, (tri_idx / columns) as f64);
        let [width, height] = self.size().map(f64::from);
        let uv = |dx: f64, dy: f64| {
            let (u, v) = ((2.0 * x + dx + 0.5) / width, 1.0 - (2.0 * y + dy + 0.5) / height);
            single([u, v])
        };
        [uv(0.0, 0.0), uv(1.0, 0.0), uv(0.0, 1.0)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocks_do_not_overlap_and_lie_in_the_image() {
        for n in [1, 2, 3, 4, 5, 100, 101, 9999] {
            let paint = Paint::of(n).expect("few");
            let [width, height] = paint.size().map(f64::from);
            let mut seen = std::collections::BTreeSet::new();
            for tri_idx in 0..n {
                for [u, v] in paint.uvs(tri_idx) {
                    let x = f64::from(u) * width - 0.5;
                    let y = (1.0 - f64::from(v)) * height - 0.5;
                    assert!((x - x.round()).abs() < 1e-3 && (y - y.round()).abs() < 1e-3);
                    assert!(x > -0.5 && x < width - 0.5 && y > -0.5 && y < height - 0.5);
                    assert!(
                        seen.insert((x.round().to_bits(), y.round().to_bits())),
                        "{n} {tri_idx}"
                    );
                }
            }
        }
    }
}
