//! A scene that is hard on trees: 1.5 million triangles from 1 cm to 4 km, long thin ones through one
//! another, in metres. Every number comes from one generator, so the scene is the same on every machine.

use glam::Vec3;

pub(crate) use crate::shapes::{Rng, Tri};

/// Triangles of the terrain, the petals, the beams and columns, the spheres.
pub(crate) const PARTS: [(&str, usize); 4] = [
    ("terrain", 768_800),
    ("petals", 240_000),
    ("beams and columns", 204_000),
    ("spheres", 294_912),
];
/// Triangles of the ground, 400 m to 4 km.
pub(crate) const GROUND: usize = 40;

/// Where a camera is and what it looks at, metres.
pub(crate) type View = [[f32; 3]; 2];

/// What the scene is seen from.
pub(crate) const VIEWS: [View; 4] = [
    [[-80.0, 18.0, -80.0], [0.0, 3.0, 0.0]],
    [[10.0, 6.0, -30.0], [0.0, 4.0, 20.0]],
    [[60.0, 25.0, 70.0], [-20.0, 0.0, 0.0]],
    [[0.0, 60.0, 0.0], [5.0, 0.0, 5.0]],
];

const TAU: f32 = std::f32::consts::TAU;

impl Rng {
    /// A unit vector.
    fn direction(&mut self) -> Vec3 {
        let (y, phi) = (self.range(-1.0, 1.0), self.unit() * TAU);
        let r = (1.0 - y * y).max(0.0).sqrt();
        Vec3::new(r * libm::cosf(phi), y, r * libm::sinf(phi))
    }

    /// `10^x` for x in [0, 1).
    fn decade(&mut self) -> f32 {
        libm::powf(10.0, self.unit())
    }
}

/// Two unit vectors at right angles to `n` and to each other.
pub(crate) fn basis(n: Vec3) -> [Vec3; 2] {
    let other = if n.x.abs() < 0.8 { Vec3::X } else { Vec3::Y };
    let u = n.cross(other).normalize();
    [u, n.cross(u)]
}

fn height(x: f32, z: f32) -> f32 {
    let wave = |a: f32, b: f32| libm::sinf(a) * libm::sinf(b);
    6.0 * wave(x * 0.031, z * 0.027 + 0.25 * TAU)
        + 2.0 * libm::sinf(x * 0.13 + z * 0.07)
        + 0.5 * wave(x * 0.61, z * 0.53)
        + 0.1 * wave(x * 2.9, z * 3.1)
}

/// The whole scene in random order, with the ground's giant triangles or without.
pub(crate) fn scene(with_ground: bool) -> Vec<Tri> {
    let mut rng = Rng::new(12_345);
    let mut list = Vec::new();
    terrain(&mut list);
    petals(&mut list, &mut rng);
    beams(&mut list, &mut rng);
    columns(&mut list, &mut rng);
    spheres(&mut list, &mut rng);
    assert_eq!(list.len(), PARTS.iter().map(|(_, n)| n).sum::<usize>());
    if with_ground {
        ground(&mut list);
    }
    for i in (1..list.len()).rev() {
        let j = (u64::from(rng.next()) * (i as u64 + 1)) >> 32;
        list.swap(i, usize::try_from(j).expect("at most i"));
    }
    list
}

fn quad(list: &mut Vec<Tri>, [a, b, c, d]: [Vec3; 4]) {
    list.push([a, b, c].map(|p: Vec3| p.to_array()));
    list.push([a, c, d].map(|p: Vec3| p.to_array()));
}

fn terrain(list: &mut Vec<Tri>) {
    let at = |i: u16, j: u16| {
        let [x, z] = [i, j].map(|k| 200.0 * f32::from(k) / 620.0 - 100.0);
        Vec3::new(x, height(x, z), z)
    };
    for (i, j) in (0..620).flat_map(|i| (0..620).map(move |j| (i, j))) {
        quad(list, [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]);
    }
}

fn place(rng: &mut Rng, above: [f32; 2]) -> Vec3 {
    let (x, z) = (rng.range(-95.0, 95.0), rng.range(-95.0, 95.0));
    Vec3::new(x, height(x, z) + rng.range(above[0], above[1]), z)
}

/// 240 clusters of 500 quads of 2 to 20 cm.
fn petals(list: &mut Vec<Tri>, rng: &mut Rng) {
    for _ in 0..240 {
        let center = place(rng, [0.3, 6.0]);
        let radius = rng.range(0.3, 2.0);
        for _ in 0..500 {
            let p = center + rng.direction() * (radius * libm::cbrtf(rng.unit()));
            let [u, v] = basis(rng.direction());
            let size = 0.01 * rng.decade();
            let (u, v) = (u * size, v * (size * rng.range(0.3, 1.0)));
            quad(list, [p - u - v, p + u - v, p + u + v, p - u + v]);
        }
    }
}

/// 5000 beams, 3 to 39 m long, 3 to 30 cm thick.
fn beams(list: &mut Vec<Tri>, rng: &mut Rng) {
    for k in 0..5000_u16 {
        let p = place(rng, [0.5, 14.0]);
        let along = if k % 2 == 1 {
            rng.direction()
        } else {
            let angle = f32::from(k) * 0.7;
            Vec3::new(libm::cosf(angle), rng.range(-0.025, 0.025), libm::sinf(angle)).normalize()
        };
        let [u, v] = basis(along);
        let (length, thickness) = (1.5 * libm::powf(13.0, rng.unit()), 0.015 * rng.decade());
        let sign = |bit: usize| if bit == 0 { -1.0 } else { 1.0 };
        let corner = |i: usize| {
            p + along * (length * sign(i & 1))
                + u * (thickness * sign(i & 2))
                + v * (thickness * sign(i & 4))
        };
        let faces =
            [[0, 1, 3, 2], [4, 5, 7, 6], [0, 1, 5, 4], [2, 3, 7, 6], [0, 2, 6, 4], [1, 3, 7, 5]];
        for face in faces {
            quad(list, face.map(corner));
        }
    }
}

/// 3000 leaning columns of 24 sides.
fn columns(list: &mut Vec<Tri>, rng: &mut Rng) {
    for _ in 0..3000 {
        let foot = place(rng, [-0.2, -0.2]);
        let (radius, high) = (rng.range(0.1, 0.5), rng.range(3.0, 15.0));
        let up = Vec3::new(rng.range(-0.1, 0.1), 1.0, rng.range(-0.1, 0.1)) * high;
        let side = |k: u8| {
            let angle = TAU * f32::from(k) / 24.0;
            foot + Vec3::new(radius * libm::cosf(angle), 0.0, radius * libm::sinf(angle))
        };
        (0..24).for_each(|k| {
            quad(list, [side(k), side(k + 1), side(k + 1) + up, side(k) + up]);
        });
    }
}

/// 12 spheres of 128 x 96 quads.
fn spheres(list: &mut Vec<Tri>, rng: &mut Rng) {
    for _ in 0..12 {
        let (x, z, radius) = (rng.range(-60.0, 60.0), rng.range(-60.0, 60.0), rng.range(1.0, 5.0));
        let center = Vec3::new(x, height(x, z) + 0.6 * radius, z);
        let at = |i: u8, j: u8| {
            let (theta, phi) = (0.5 * TAU * f32::from(j) / 96.0, TAU * f32::from(i) / 128.0);
            let ring = libm::sinf(theta);
            let out = Vec3::new(ring * libm::cosf(phi), libm::cosf(theta), ring * libm::sinf(phi));
            center + out * radius
        };
        for (i, j) in (0..128).flat_map(|i| (0..96).map(move |j| (i, j))) {
            quad(list, [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]);
        }
    }
}

/// 20 tilted quads, the largest of 4 km.
fn ground(list: &mut Vec<Tri>) {
    for k in 0..20_u8 {
        let k = f32::from(k);
        let s = 200.0 * libm::powf(10.0, k / 19.0);
        let (y, tilt) = (-9.0 - 0.05 * k, 0.001 * s);
        let at = |x: f32, y: f32, z: f32| Vec3::new(x, y, z);
        quad(list, [at(-s, y, -s), at(s, y + tilt, -s), at(s, y, s), at(-s, y - tilt, s)]);
    }
}
