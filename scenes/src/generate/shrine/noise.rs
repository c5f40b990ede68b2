//! Numbers that look random and are the same everywhere: a generator, and noise over space.

use super::kit::V3;

/// A stream of numbers (splitmix64, Steele et al. 2014).
#[derive(Clone, Debug)]
pub(super) struct Rng(u64);

impl Rng {
    /// The stream that belongs to `seed`.
    pub(super) fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ 0x5851_f42d_4c95_7f2d)
    }

    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        mix(self.0)
    }

    /// Evenly spread in 0..1.
    pub(super) fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Evenly spread between two bounds.
    pub(super) fn range(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// -1..1, more often near 0.
    pub(super) fn bell(&mut self) -> f64 {
        (self.unit() + self.unit() + self.unit()) * (2.0 / 3.0) - 1.0
    }

    /// One of `0..n`.
    pub(super) fn below(&mut self, n: usize) -> usize {
        ((self.unit() * n as f64) as usize).min(n - 1)
    }

    /// A point on the unit sphere.
    pub(super) fn direction(&mut self) -> V3 {
        let y = self.range(-1.0, 1.0);
        let a = self.range(0.0, std::f64::consts::TAU);
        let r = libm::sqrt(1.0 - y * y);
        [r * libm::cos(a), y, r * libm::sin(a)]
    }
}

fn mix(x: u64) -> u64 {
    let x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^ (x >> 31)
}

/// 0..1, belongs to a point of a lattice.
fn lattice(x: i64, y: i64, z: i64, seed: u64) -> f64 {
    let key = (x as u64)
        .wrapping_mul(0x8da6_b343)
        .wrapping_add((y as u64).wrapping_mul(0xd816_3841))
        .wrapping_add((z as u64).wrapping_mul(0xcb1a_b31f))
        .wrapping_add(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15));
    (mix(key) >> 11) as f64 / (1_u64 << 53) as f64
}

fn fade(t: f64) -> f64 {
    t * t * (3.0 - 2.0 * t)
}

fn lerp(a: f64, b: f64, t: f64) -> f64 {
    a + (b - a) * t
}

/// Smooth noise in space, -1..1, features about 1 across.
pub(super) fn noise(p: V3, seed: u64) -> f64 {
    let cell = p.map(libm::floor);
    let [x, y, z] = cell.map(|c| c as i64);
    let [u, v, w] = [0, 1, 2].map(|k| fade(p[k] - cell[k]));
    let at = |i, j, k| lattice(x + i, y + j, z + k, seed);
    let along_x = |j, k| lerp(at(0, j, k), at(1, j, k), u);
    let plane = |k| lerp(along_x(0, k), along_x(1, k), v);
    2.0 * lerp(plane(0), plane(1), w) - 1.0
}

/// Four octaves of `noise`, about -1..1.
pub(super) fn fbm(p: V3, seed: u64) -> f64 {
    let octave = |k: u64, f: f64| noise(p.map(|x| x * f), seed + k) / f;
    (octave(0, 1.0) + octave(1, 2.0) + octave(2, 4.0) + octave(3, 8.0)) / 1.6
}

/// Noise on the unit square that repeats, 0..1; `freq` cells along u and v.
pub(super) fn tile(u: f64, v: f64, freq: [i64; 2], seed: u64) -> f64 {
    let (x, y) = (u * freq[0] as f64, v * freq[1] as f64);
    let (cx, cy) = (libm::floor(x), libm::floor(y));
    let (s, t) = (fade(x - cx), fade(y - cy));
    let at = |i: i64, j: i64| {
        lattice((cx as i64 + i).rem_euclid(freq[0]), (cy as i64 + j).rem_euclid(freq[1]), 0, seed)
    };
    lerp(lerp(at(0, 0), at(1, 0), s), lerp(at(0, 1), at(1, 1), s), t)
}

/// Four octaves of `tile`, 0..1.
pub(super) fn tile_fbm(u: f64, v: f64, freq: [i64; 2], seed: u64) -> f64 {
    (0..4_u32)
        .map(|k| tile(u, v, freq.map(|f| f << k), seed + u64::from(k)) / f64::from(1 << k))
        .sum::<f64>()
        / 1.875
}

/// Distance to the nearest of scattered points, in cells, and a number of that point; repeats.
pub(super) fn cells(u: f64, v: f64, freq: i64, seed: u64) -> (f64, f64) {
    let (x, y) = (u * freq as f64, v * freq as f64);
    let (cx, cy) = (libm::floor(x) as i64, libm::floor(y) as i64);
    let mut best = (9.0, 0.0);
    for (i, j) in (-1..=1).flat_map(|i| (-1..=1).map(move |j| (i, j))) {
        let (a, b) = ((cx + i).rem_euclid(freq), (cy + j).rem_euclid(freq));
        let px = (cx + i) as f64 + 0.15 + 0.7 * lattice(a, b, 1, seed);
        let py = (cy + j) as f64 + 0.15 + 0.7 * lattice(a, b, 2, seed);
        let d = libm::hypot(px - x, py - y);
        if d < best.0 {
            best = (d, lattice(a, b, 3, seed));
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tiles_repeat_and_stay_in_range() {
        for k in 0..200 {
            let v = f64::from(k) / 200.0;
            assert!((tile_fbm(0.0, v, [4, 3], 1) - tile_fbm(1.0, v, [4, 3], 1)).abs() < 1e-9);
            assert!((0.0..=1.0).contains(&tile_fbm(0.37, v, [4, 3], 1)));
            assert!((cells(0.0, v, 5, 1).0 - cells(1.0, v, 5, 1).0).abs() < 1e-9);
        }
    }

    #[test]
    fn a_seed_names_a_stream() {
        let (mut a, mut b, mut c) = (Rng::new(1), Rng::new(1), Rng::new(2));
        let (x, y, z) = (a.unit(), b.unit(), c.unit());
        assert!(x.to_bits() == y.to_bits() && x.to_bits() != z.to_bits());
        assert!((0.0..1.0).contains(&x));
    }
}
