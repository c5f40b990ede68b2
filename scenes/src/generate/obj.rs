//! A periodic grid of points becomes a Wavefront OBJ text.

use std::fmt::Write;

use super::vector::{V3, add, cross, normalize, sub};

/// A surface sampled on a grid that closes in both directions.
pub(super) struct Grid {
    along: usize,
    around: usize,
    points: Vec<V3>,
    normals: Vec<V3>,
}

impl Grid {
    /// Samples `surface(u, v)`, periodic in 0..1 both ways.
    pub(super) fn periodic(along: usize, around: usize, surface: fn(f64, f64) -> V3) -> Self {
        let at = |i: usize, j: usize| surface(i as f64 / along as f64, j as f64 / around as f64);
        let points =
            (0..along).flat_map(|i| (0..around).map(move |j| (i, j))).map(|(i, j)| at(i, j));
        let mut grid = Self { along, around, points: points.collect(), normals: Vec::new() };
        grid.normals = grid.smooth_normals();
        grid
    }

    /// Moves the grid so that its lowest point has y = 0.
    pub(super) fn rest_on_ground(&mut self) {
        let lowest = self.points.iter().map(|p| p[1]).fold(f64::INFINITY, f64::min);
        for point in &mut self.points {
            *point = add(*point, [0.0, -lowest, 0.0]);
        }
    }

    fn index(&self, i: usize, j: usize) -> usize {
        (i % self.along) * self.around + j % self.around
    }

    /// Unit normals from central differences, on the outside of the surface.
    fn smooth_normals(&self) -> Vec<V3> {
        let mut normals = Vec::with_capacity(self.points.len());
        for i in 0..self.along {
            for j in 0..self.around {
                let along = sub(
                    self.points[self.index(i + 1, j)],
                    self.points[self.index(i + self.along - 1, j)],
                );
                let around = sub(
                    self.points[self.index(i, j + 1)],
                    self.points[self.index(i, j + self.around - 1)],
                );
                normals.push(normalize(cross(around, along)));
            }
        }
        normals
    }
}

/// The grid as one OBJ object of quads, outside counter-clockwise.
pub(super) fn grid_obj(name: &str, grid: &Grid) -> Vec<u8> {
    let mut text = format!("# Generated: {} points, metres, +y up.\no {name}\n", grid.points.len());
    for p in &grid.points {
        let _ = writeln!(text, "v {:.6} {:.6} {:.6}", p[0], p[1], p[2]);
    }
    for n in &grid.normals {
        let _ = writeln!(text, "vn {:.4} {:.4} {:.4}", n[0], n[1], n[2]);
    }
    for i in 0..grid.along {
        for j in 0..grid.around {
            let corners = [(i, j), (i, j + 1), (i + 1, j + 1), (i + 1, j)];
            text.push('f');
            for (a, b) in corners {
                let index = grid.index(a, b) + 1;
                let _ = write!(text, " {index}//{index}");
            }
            text.push('\n');
        }
    }
    text.into_bytes()
}
