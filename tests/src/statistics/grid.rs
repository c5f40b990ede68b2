//! Directions → cells, and densities → what each cell expects.
//!
//! The cells are rings around an axis, cut into sectors. Both are stretched by a sine hyperbolicus: even
//! within `scale`, logarithmic beyond, so that a lobe a thousandth of a radian wide and its tail over the
//! whole sphere are resolved by the same few hundred cells.

use std::f64::consts::{FRAC_PI_2, PI};

use glam::DVec3;

use crate::statistics::index;

/// A stretch of [0, 1] onto [0, `reach`].
#[derive(Clone, Copy, Debug)]
struct Stretch {
    reach: f64,
    scale: f64,
    full: f64,
}

impl Stretch {
    fn new(reach: f64, scale: f64) -> Self {
        Self { reach, scale, full: (reach / scale).asinh() }
    }

    /// Value at `t` and its derivative.
    fn at(&self, t: f64) -> (f64, f64) {
        let x = t * self.full;
        (self.scale * x.sinh(), self.scale * self.full * x.cosh())
    }

    fn inverse(&self, x: f64) -> f64 {
        (x / self.scale).asinh() / self.full
    }
}

/// Shape of a [`Grid`].
#[derive(Clone, Copy, Debug)]
pub struct Shape {
    /// Largest angle from the axis, radians.
    pub reach: f64,
    /// Angle from the axis within which rings are even, radians.
    pub ring_scale: f64,
    /// Angle from the plane of `side` within which sectors are even, radians.
    pub sector_scale: f64,
    /// Number of rings.
    pub n_rings: usize,
    /// Number of sectors in each quadrant.
    pub n_sectors: usize,
}

impl Shape {
    /// 30 rings of 16 sectors over the whole sphere.
    pub const SPHERE: Self =
        Self { reach: PI, ring_scale: PI, sector_scale: FRAC_PI_2, n_rings: 30, n_sectors: 4 };
    /// 20 rings of 16 sectors over half of it.
    pub const HEMISPHERE: Self = Self { reach: FRAC_PI_2, n_rings: 20, ..Self::SPHERE };
}

/// Most times that a patch at the horizon is halved: slivers 2^-10 of a patch high are seen.
const CUTS: usize = 5;

/// Part of a cell, in the unit interval of rings and that of the sectors of its quadrant.
#[derive(Clone, Copy, Debug)]
struct Patch {
    quadrant: usize,
    /// Its middle.
    ring: f64,
    sector: f64,
    /// Half of its sides.
    half: [f64; 2],
}

impl Patch {
    fn quarters(self) -> [Self; 4] {
        let half = self.half.map(|h| h * 0.5);
        [(-1.0, -1.0), (-1.0, 1.0), (1.0, -1.0), (1.0, 1.0)].map(|(r, s)| Self {
            ring: self.ring + r * half[0],
            sector: self.sector + s * half[1],
            half,
            ..self
        })
    }
}

/// Cells of directions.
#[derive(Clone, Copy, Debug)]
pub struct Grid {
    axis: DVec3,
    side: DVec3,
    across: DVec3,
    rings: Stretch,
    sectors: Stretch,
    shape: Shape,
}

impl Grid {
    /// Cells around the unit vector `axis`; the quadrants begin at the plane of `axis` and `side`.
    #[must_use]
    pub fn new(axis: DVec3, side: DVec3, shape: Shape) -> Self {
        let across = axis.cross(side);
        let across = if across.length() < 1e-6 { axis.any_orthonormal_vector() } else { across };
        let across = across.normalize();
        Self {
            axis,
            side: across.cross(axis),
            across,
            rings: Stretch::new(shape.reach, shape.ring_scale),
            sectors: Stretch::new(FRAC_PI_2, shape.sector_scale),
            shape,
        }
    }

    /// Number of cells.
    #[must_use]
    pub fn cells(&self) -> usize {
        self.shape.n_rings * self.shape.n_sectors * 4
    }

    /// Cell of the unit vector `d`, if it is within reach (a ten-thousandth more for rounding).
    #[must_use]
    pub fn cell(&self, d: DVec3) -> Option<usize> {
        let (x, y, z) = (d.dot(self.side), d.dot(self.across), d.dot(self.axis));
        let theta = x.hypot(y).atan2(z);
        if theta > self.rings.reach * 1.0001 {
            return None;
        }
        let ring = index(self.rings.inverse(theta), self.shape.n_rings);
        let sector = index(self.sectors.inverse(y.abs().atan2(x.abs())), self.shape.n_sectors);
        let quadrant = usize::from(x < 0.0) + 2 * usize::from(y < 0.0);
        Some((ring * self.shape.n_sectors + sector) * 4 + quadrant)
    }

    /// Integral of `f` over each cell by steradian, `fine` × `fine` midpoints a cell.
    pub fn integrate(&self, fine: usize, f: impl FnMut(DVec3) -> f64) -> Vec<f64> {
        // Every direction is above a plane without a normal.
        self.integrate_above(fine, DVec3::ZERO, f)
    }

    /// As [`Grid::integrate`], over the directions above the plane with unit normal `up` only. Where the
    /// plane cuts, shares are exact to first order, so cells at the horizon are as good as the others. `f`
    /// is asked above the plane only.
    pub fn integrate_above(&self, fine: usize, up: DVec3, f: impl FnMut(DVec3) -> f64) -> Vec<f64> {
        self.integrate_cut(fine, up, 0, f)
    }

    /// As [`Grid::integrate_above`], to count samples by: patches that the plane may cut are halved up to
    /// `CUTS` times, so that a cell that reaches above the plane by a hair expects its hair.
    pub fn expect_above(&self, fine: usize, up: DVec3, f: impl FnMut(DVec3) -> f64) -> Vec<f64> {
        self.integrate_cut(fine, up, CUTS, f)
    }

    fn integrate_cut(
        &self,
        fine: usize,
        up: DVec3,
        cuts: usize,
        mut f: impl FnMut(DVec3) -> f64,
    ) -> Vec<f64> {
        let mut sums = vec![0.0; self.cells()];
        let (n, m) = (self.shape.n_rings * fine, self.shape.n_sectors * fine);
        for i in 0..n {
            for j in 0..m {
                for quadrant in 0..4 {
                    let patch = Patch {
                        quadrant,
                        ring: (i as f64 + 0.5) / n as f64,
                        sector: (j as f64 + 0.5) / m as f64,
                        half: [0.5 / n as f64, 0.5 / m as f64],
                    };
                    let cell = (i / fine * self.shape.n_sectors + j / fine) * 4 + quadrant;
                    sums[cell] += self.above(patch, up, cuts, &mut f);
                }
            }
        }
        sums
    }

    /// Integral of `f` over the part of `patch` above the plane of `up`, cut at most `cuts` times.
    fn above(&self, patch: Patch, up: DVec3, cuts: usize, f: &mut impl FnMut(DVec3) -> f64) -> f64 {
        let (theta, d_theta) = self.rings.at(patch.ring);
        let (phi, d_phi) = self.sectors.at(patch.sector);
        let (sin, cos) = theta.sin_cos();
        let (x, y) = self.quadrant(patch.quadrant);
        let out = x * phi.cos() + y * phi.sin();
        let d = out * sin + self.axis * cos;
        // Half of the patch's sides, radians, and as measured along `up`.
        let (high, wide) = (d_theta * patch.half[0], d_phi * patch.half[1]);
        let a = (out * cos - self.axis * sin).dot(up).abs() * high;
        let b = (y * phi.cos() - x * phi.sin()).dot(up).abs() * sin * wide;
        let height = d.dot(up);
        // A great circle leaves its tangent by half the square of the angle; as much again for the stretch.
        if cuts > 0 && up != DVec3::ZERO && height.abs() < a + b + (high + wide).powi(2) {
            return patch
                .quarters()
                .map(|quarter| self.above(quarter, up, cuts - 1, f))
                .iter()
                .sum();
        }
        let share = if up == DVec3::ZERO { 1.0 } else { share_above(height, a, b) };
        if share == 0.0 {
            return 0.0;
        }
        let lift = ((a + b) * 0.25 - height).max(0.0);
        let d = if share < 1.0 { (d + up * lift).normalize() } else { d };
        share * f(d) * sin * 4.0 * high * wide
    }

    /// `side` and `across`, turned to the quadrant.
    fn quadrant(&self, quadrant: usize) -> (DVec3, DVec3) {
        let x = if quadrant & 1 == 0 { self.side } else { -self.side };
        let y = if quadrant & 2 == 0 { self.across } else { -self.across };
        (x, y)
    }
}

/// Share of the rectangle -1 ..= 1 squared where `height + a x + b y > 0`; `a`, `b` >= 0.
fn share_above(height: f64, a: f64, b: f64) -> f64 {
    let reach = a + b;
    if height >= reach {
        return 1.0;
    }
    if height <= -reach {
        return 0.0;
    }
    if height.abs() <= (a - b).abs() {
        return 0.5 + height / (2.0 * a.max(b));
    }
    let corner = (reach - height.abs()).powi(2) / (8.0 * a * b);
    if height < 0.0 { corner } else { 1.0 - corner }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::statistics::Counts;
    use crate::statistics::stream::Stream;

    fn narrow() -> Grid {
        let shape = Shape { ring_scale: 0.01, sector_scale: 0.1, ..Shape::SPHERE };
        Grid::new(DVec3::new(0.36, -0.48, 0.8), DVec3::X, shape)
    }

    #[test]
    fn cells_cover_the_sphere() {
        let area: f64 = narrow().integrate(16, |_| 1.0).iter().sum();
        assert!((area / (4.0 * PI) - 1.0).abs() < 1e-4, "{area}");
    }

    #[test]
    fn half_of_the_sphere_is_above_any_plane() {
        let grid = narrow();
        let mut stream = Stream::new(5, 0);
        for _ in 0..4 {
            let up = stream.direction();
            let mut lowest: f64 = 1.0;
            let area: f64 = grid
                .integrate_above(16, up, |d| {
                    lowest = lowest.min(d.dot(up));
                    d.dot(up)
                })
                .iter()
                .sum();
            assert!(lowest >= 0.0 && (area / PI - 1.0).abs() < 3e-4, "{up}: {area}, {lowest}");
        }
    }

    #[test]
    fn cells_that_hardly_reach_above_the_plane_expect_something() {
        let grid = narrow();
        let mut stream = Stream::new(11, 0);
        let mut missed = 0;
        for _ in 0..100 {
            // A plane that passes a hair below a corner of cells.
            let (theta, _) = grid.rings.at((1 + stream.index(29)) as f64 / 30.0);
            let (phi, _) = grid.sectors.at(stream.index(4) as f64 / 4.0);
            let out = grid.side * phi.cos() + grid.across * phi.sin();
            let corner = out * theta.sin() + grid.axis * theta.cos();
            let up = stream.direction().cross(corner).normalize() + corner * 1e-5;
            let near = (corner + stream.direction() * 2e-6).normalize();
            let cell = grid.cell(near).expect("the grid is the whole sphere");
            missed += usize::from(grid.integrate_above(16, up, |_| 1.0)[cell] == 0.0);
            assert!(grid.expect_above(16, up, |_| 1.0)[cell] > 0.0, "{near} above {up}");
        }
        assert!(missed > 0, "the cuts make no difference");
    }

    #[test]
    fn a_direction_is_in_the_cell_that_it_is_integrated_in() {
        let grid = narrow();
        let mut wrong = 0;
        let mut of_cell = Vec::new();
        grid.integrate(3, |d| {
            of_cell.push(grid.cell(d));
            0.0
        });
        // The order of visits is that of the loops.
        let (n, m) = (30 * 3, 4 * 3);
        for i in 0..n {
            for j in 0..m {
                for quadrant in 0..4 {
                    let cell = (i / 3 * 4 + j / 3) * 4 + quadrant;
                    wrong += usize::from(of_cell[(i * m + j) * 4 + quadrant] != Some(cell));
                }
            }
        }
        assert_eq!(wrong, 0);
    }

    #[test]
    fn uniform_directions_pass() {
        let (grid, n) = (narrow(), 100_000);
        let expected = grid.integrate(16, |_| f64::from(n) / (4.0 * PI));
        let mut counts = Counts::new(expected);
        let mut stream = Stream::new(3, 0);
        for _ in 0..n {
            counts.add(grid.cell(stream.direction()).expect("the grid is the whole sphere"));
        }
        assert!(counts.p_value() > 1e-3);
    }
}
