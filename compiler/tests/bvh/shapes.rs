//! Triangles that break tree builders, and some that do not.

use compiler::bvh::Fragment;

/// Three corners.
pub(crate) type Tri = [[f32; 3]; 3];

/// A small generator of numbers in [0, 1): PCG-XSH-RR, O'Neill 2014.
pub(crate) struct Rng(u64);

impl Rng {
    pub(crate) fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1)
    }

    pub(crate) fn next(&mut self) -> u32 {
        let old = self.0;
        self.0 =
            old.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let shifted = u32::try_from(((old >> 18) ^ old) >> 27 & 0xffff_ffff).unwrap();
        shifted.rotate_right(u32::try_from(old >> 59).unwrap())
    }

    pub(crate) fn unit(&mut self) -> f32 {
        (self.next() >> 8) as f32 / 16_777_216.0
    }

    pub(crate) fn range(&mut self, lo: f32, hi: f32) -> f32 {
        lo + (hi - lo) * self.unit()
    }

    pub(crate) fn point(&mut self, size: f32) -> [f32; 3] {
        [0; 3].map(|_| self.range(-size, size))
    }
}

/// Names of all degenerate kinds.
pub(crate) const KINDS: [&str; 12] = [
    "same", "point", "nested", "geom", "flat", "line", "far", "nan", "fan", "slivers", "soup",
    "long",
];

/// `n` triangles of a kind.
pub(crate) fn degenerate(kind: &str, n: u32) -> Vec<Tri> {
    let mut rng = Rng::new(7);
    (0..n).map(|i| triangle(kind, i, n, &mut rng)).collect()
}

fn triangle(kind: &str, i: u32, n: u32, rng: &mut Rng) -> Tri {
    let f = i as f32 / n as f32;
    match kind {
        "same" => [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
        "point" => [[1.0, 2.0, 3.0]; 3],
        "nested" => {
            let s = 1.000_02_f32.powf(i as f32);
            [[-s, -s, 0.0], [s, -s, 0.001 * s], [0.0, s, -0.001 * s]]
        }
        // Sizes and places over 2^120.
        "geom" => {
            let s = (-60.0 + 120.0 * f).exp2();
            [[s, s, s], [s * 1.01, s, s], [s, s * 1.01, s * 1.01]]
        }
        "flat" => {
            let (x, z) = (rng.range(0.0, 100.0), rng.range(0.0, 100.0));
            [[x, 0.0, z], [x + 0.1, 0.0, z], [x, 0.0, z + 0.1]]
        }
        "line" => {
            let x = rng.range(0.0, 1000.0);
            [[x, 0.0, 0.0], [x + 0.01, 0.0, 0.0], [x + 0.02, 0.0, 0.0]]
        }
        "far" => {
            let p = [0; 3].map(|_| rng.range(0.0, 8.0));
            let x = 1e7 + p[0];
            [[x, p[1], p[2]], [x + 1.0, p[1], p[2]], [x, p[1] + 0.1, p[2]]]
        }
        "nan" => {
            let [x, y, z] = [0; 3].map(|_| rng.range(0.0, 100.0));
            let mut t = [[x, y, z], [x + 1.0, y, z], [x, y + 1.0, z]];
            match i % 1000 {
                0 => t[1][0] = f32::NAN,
                1 => t[2][1] = f32::INFINITY,
                _ => {}
            }
            t
        }
        "fan" => {
            let at = |i: u32| {
                let angle = i as f32 / n as f32 * std::f32::consts::TAU;
                [100.0 * angle.cos(), 0.0, 100.0 * angle.sin()]
            };
            [[0.0; 3], at(i), at(i + 1)]
        }
        "slivers" => {
            let p = [0; 3].map(|_| rng.range(0.0, 1.0));
            [p, [0; 3].map(|_| rng.range(0.0, 1000.0)), [p[0] + 1e-4, p[1], p[2]]]
        }
        // Long and thin, in all directions, among many small ones: what spatial splits are for.
        "long" => {
            let p = rng.point(1.0);
            let d = rng.point(if i.is_multiple_of(8) { 0.6 } else { 0.005 });
            let end = [0, 1, 2].map(|k| p[k] + d[k]);
            [p, end, [end[0] + 0.003, end[1], end[2] - 0.002]]
        }
        "soup" => {
            let p = rng.point(1.0);
            [p, p.map(|x| x + rng.range(-0.05, 0.05)), p.map(|x| x + rng.range(-0.05, 0.05))]
        }
        _ => panic!("no such kind: {kind}"),
    }
}

/// A closed surface: a sphere of `2 * n * n` triangles that share vertices bit for bit, some of them
/// on the coordinate planes.
pub(crate) fn ball(n: u32, radius: f32) -> Vec<Tri> {
    let at = |i: u32, j: u32| {
        let (theta, phi) = (j as f32 / n as f32, (i % n) as f32 / n as f32);
        let (theta, phi) = (theta * std::f32::consts::PI, phi * std::f32::consts::TAU);
        let ring = if j == 0 || j == n { 0.0 } else { theta.sin() };
        [radius * ring * phi.cos(), radius * theta.cos(), radius * ring * phi.sin()]
    };
    let quad = |i, j| {
        let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
        [[a, b, c], [a, c, d]]
    };
    (0..n).flat_map(|i| (0..n).flat_map(move |j| quad(i, j))).collect()
}

/// An axis-parallel grid of `2 * n * n` triangles at z = `z`, from 0 to 1.
pub(crate) fn grid(n: u32, z: f32) -> Vec<Tri> {
    let at = |i: u32, j: u32| [i as f32 / n as f32, j as f32 / n as f32, z];
    let quad = |i, j| {
        let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
        [[a, b, c], [a, c, d]]
    };
    (0..n).flat_map(|i| (0..n).flat_map(move |j| quad(i, j))).collect()
}

/// The boxes of triangles.
pub(crate) fn fragments(triangles: &[Tri]) -> Vec<Fragment> {
    (0..).zip(triangles).map(|(i, t)| Fragment::of_triangle(t, i)).collect()
}
