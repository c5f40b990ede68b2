//! What lies and grows on the ground: rocks at the rim of the pond, pebbles, grass, petals that have
//! fallen on land and water, petals in the air, lily pads.

use super::kit::{Mesh, Place, V3, add, ball, cross, normalize, scale};
use super::land::{
    POND, STAIRS_BOTTOM, STAIRS_HALF_WIDTH, STAIRS_TOP, TERRACE, height, normal, shore_distance,
};
use super::noise::{Rng, noise};
use super::tree::card;
use super::{bridge, stairs};

/// The rim of the pond in a direction from its middle, `out` metres outside of the water line.
fn rim(angle: f64, out: f64) -> [f64; 2] {
    let (c, s) = (libm::cos(angle), libm::sin(angle));
    let wet = |r: f64| shore_distance(POND[0] + r * c, POND[1] + r * s) < out;
    // Out in steps to the first land, then halved.
    let mut far = 1.0;
    while wet(far) && far < 30.0 {
        far += 0.25;
    }
    let mut near = far - 0.25;
    for _ in 0..30 {
        let r = 0.5 * (near + far);
        if wet(r) { near = r } else { far = r }
    }
    [POND[0] + near * c, POND[1] + near * s]
}

/// Whether a point is under paving, stairs, gate or the ends of the bridge.
fn built(x: f64, z: f64) -> bool {
    libm::fabs(x) < STAIRS_HALF_WIDTH + 0.5 && z < STAIRS_BOTTOM + 3.3
}

/// Rocks along the rim, and some in the garden.
pub(super) fn rocks(count: usize) -> Mesh {
    let mut mesh = Mesh::default();
    let mut rng = Rng::new(31);
    for k in 0..count {
        let around = std::f64::consts::TAU * (k as f64 + 0.8 * rng.unit()) / count as f64;
        // Every fourth on the bank in front.
        let a = if k % 4 == 0 { rng.range(0.5, 1.75) } else { around };
        let [x, z] = rim(a, rng.range(-0.25, 0.25));
        let size = 0.16 + 0.42 * libm::pow(rng.unit(), 2.2);
        if libm::fabs(x) < 2.0 && z < 6.0 && size > 0.3 || z > 14.6 && libm::fabs(x + 3.4) < 3.2 {
            continue;
        }
        let seed = 100 + k as u64;
        let stone = ball(if size > 0.5 { 4 } else { 3 }, |d| {
            1.0 + 0.28 * noise(scale(d, 1.6), seed)
                + 0.07 * noise(scale(d, 5.0), seed)
                + 0.02 * noise(scale(d, 13.0), seed)
        });
        let up = add([0.0, 1.0, 0.0], scale(rng.direction(), 0.25));
        let place =
            Place::upright([x, height(x, z).max(-0.25) + 0.12 * size, z], up, rng.direction());
        mesh.append(
            &stone,
            &place.stretched([size, size * rng.range(0.5, 0.8), size * rng.range(0.7, 1.0)]),
        );
    }
    mesh
}

/// Pebbles on the beach of the pond.
pub(super) fn pebbles(count: usize) -> Mesh {
    let mut mesh = Mesh::default();
    let mut rng = Rng::new(37);
    let shapes: Vec<Mesh> =
        (0..6).map(|k| ball(0, |d| 1.0 + 0.2 * noise(scale(d, 1.5), k))).collect();
    for _ in 0..count {
        let [x, z] = rim(rng.range(0.0, std::f64::consts::TAU), 0.25 + 0.55 * rng.bell());
        let size = 0.015 + 0.04 * libm::pow(rng.unit(), 3.0);
        let place =
            Place::upright([x, height(x, z) + 0.3 * size, z], normal(x, z), rng.direction());
        mesh.append(&shapes[rng.below(6)], &place.stretched([size, 0.55 * size, 0.8 * size]));
    }
    mesh
}

/// Blades of grass; `dry` picks other places, colours and lengths.
pub(super) fn grass(count: usize, dry: bool) -> Mesh {
    let mut mesh = Mesh::default();
    let mut rng = Rng::new(if dry { 43 } else { 41 });
    while mesh.triangles() < 5 * count {
        // Nearer to the pond denser, most of all on the bank in front.
        let front = rng.unit() < 0.3;
        let x = if front { -0.9 + 2.8 * rng.bell() } else { 20.4 * rng.bell() - 1.0 };
        let z = if front { 12.8 + 2.6 * rng.bell() } else { 3.0 + 19.5 * rng.bell() };
        let d = shore_distance(x, z);
        let patch = noise([0.5 * x, 0.0, 0.5 * z], 51) + 0.5 * noise([1.7 * x, 0.0, 1.7 * z], 52);
        let wanted = if dry { -patch } else { patch } + if front { 0.6 } else { 0.0 };
        if built(x, z) || d < -0.2 || !(-24.0..17.6).contains(&z) || wanted < rng.range(-0.9, 0.5) {
            continue;
        }
        let tall = if dry { rng.range(0.12, 0.34) } else { rng.range(0.07, 0.2) }
            * (1.0 + 0.7 * patch.max(0.0));
        for _ in 0..5 {
            let (dx, dz) = (0.09 * rng.bell(), 0.09 * rng.bell());
            let foot = [x + dx, height(x + dx, z + dz) - 0.01, z + dz];
            blade(
                &mut mesh,
                foot,
                tall * rng.range(0.6, 1.2),
                0.006 + 0.004 * rng.unit(),
                &mut rng,
            );
        }
    }
    mesh
}

/// Irises at the water's edge: long stiff leaves in tufts.
pub(super) fn irises(tufts: usize) -> Mesh {
    let mut mesh = Mesh::default();
    let mut rng = Rng::new(47);
    for _ in 0..tufts {
        let [x, z] = rim(rng.range(0.0, std::f64::consts::TAU), rng.range(-0.45, 0.05));
        if libm::fabs(x) < 2.2 || z > 14.0 {
            continue;
        }
        for _ in 0..14 {
            let foot = [x + 0.16 * rng.bell(), height(x, z) - 0.02, z + 0.16 * rng.bell()];
            blade(&mut mesh, foot, rng.range(0.45, 0.95), rng.range(0.012, 0.02), &mut rng);
        }
    }
    mesh
}

/// One blade of five triangles, bent by its weight; v along it.
fn blade(mesh: &mut Mesh, foot: V3, tall: f64, half: f64, rng: &mut Rng) {
    let a = rng.range(0.0, std::f64::consts::TAU);
    let (out, side) = ([libm::cos(a), 0.0, libm::sin(a)], [-libm::sin(a), 0.0, libm::cos(a)]);
    let bend = rng.range(0.1, 0.6) * tall;
    let at = |t: f64| {
        add(
            foot,
            add(scale(out, bend * t * t), [0.0, tall * (t - 0.25 * t * t * bend / tall), 0.0]),
        )
    };
    let face = |t: f64| normalize(cross(side, add(scale(out, 2.0 * bend * t), [0.0, tall, 0.0])));
    let mut ids = Vec::with_capacity(7);
    for (t, w) in [(0.0, 1.0), (0.4, 0.9), (0.75, 0.55)] {
        for s in [-1.0, 1.0] {
            ids.push(mesh.vertex(
                add(at(t), scale(side, s * w * half)),
                face(t),
                [0.5 + 0.5 * s, 1.0 - t],
            ));
        }
    }
    ids.push(mesh.vertex(at(1.0), face(1.0), [0.5, 0.0]));
    mesh.0.indices.extend([0, 1, 2, 1, 3, 2, 2, 3, 4, 3, 5, 4, 4, 5, 6].map(|k: usize| ids[k]));
}

/// The highest thing at a point that petals can lie on, and its normal.
fn rest(x: f64, z: f64) -> (f64, V3) {
    let up = [0.0, 1.0, 0.0];
    let from_bridge = z - bridge_middle();
    if libm::fabs(x) < 1.1 && libm::fabs(from_bridge) < bridge::HALF_LENGTH {
        return (bridge::deck(from_bridge) + 0.012, up);
    }
    if libm::fabs(x) < STAIRS_HALF_WIDTH && z < STAIRS_BOTTOM + 3.1 {
        return (if z < STAIRS_TOP { TERRACE + 0.02 } else { stairs::tread(z) } + 0.014, up);
    }
    (height(x, z) + 0.02, normal(x, z))
}

/// Where the bridge's middle is, along z; `shrine.rts` says the same.
pub(super) fn bridge_middle() -> f64 {
    6.6
}

/// Petals on stairs, paving, bridge and grass.
pub(super) fn fallen(count: usize) -> Mesh {
    let mut mesh = Mesh::default();
    let mut rng = Rng::new(53);
    while mesh.triangles() < 2 * count {
        let walk = rng.unit() < 0.5;
        let x = if walk { 2.4 * rng.range(-1.0, 1.0) } else { 13.0 * rng.bell() - 1.0 };
        let z = if walk { rng.range(-17.0, 13.0) } else { rng.range(-13.0, 17.0) };
        let on_bridge =
            libm::fabs(x) < 1.1 && libm::fabs(z - bridge_middle()) < bridge::HALF_LENGTH;
        if shore_distance(x, z) < 0.05 && !on_bridge {
            continue;
        }
        // Petals gather in drifts.
        if noise([0.9 * x, 3.0, 0.9 * z], 57) < rng.range(-0.9, 0.6) {
            continue;
        }
        let (y, n) = rest(x, z);
        let up = normalize(add(n, scale(rng.direction(), 0.3)));
        card(&mut mesh, [x, y, z], up, rng.range(0.016, 0.026), &mut rng);
    }
    mesh
}

/// Petals that float on the pond, in rafts.
pub(super) fn floating(count: usize) -> Mesh {
    let mut mesh = Mesh::default();
    let mut rng = Rng::new(59);
    while mesh.triangles() < 2 * count {
        let (x, z) = (POND[0] + 12.5 * rng.range(-1.0, 1.0), POND[1] + 6.4 * rng.range(-1.0, 1.0));
        let raft = noise([0.35 * x, 7.0, 0.7 * z], 61) + 0.5 * noise([1.3 * x, 7.0, 2.0 * z], 62);
        let d = shore_distance(x, z);
        let wanted = raft + 0.5 * libm::exp(0.8 * d);
        if d > -0.1 || wanted < rng.range(0.45, 0.85) {
            continue;
        }
        let up = normalize([0.04 * rng.bell(), 1.0, 0.04 * rng.bell()]);
        card(&mut mesh, [x, 0.006, z], up, rng.range(0.018, 0.028), &mut rng);
    }
    mesh
}

/// Petals in the air before the stairs, drifting down from the left.
pub(super) fn air(count: usize) -> Mesh {
    let mut mesh = Mesh::default();
    let mut rng = Rng::new(67);
    while mesh.triangles() < 2 * count {
        let p = [rng.range(-9.0, 9.0), rng.range(0.15, 7.5), rng.range(-12.0, 11.0)];
        let gust = noise([0.5 * p[0] + 0.4 * p[1], 0.5 * p[1], 0.4 * p[2]], 68);
        if gust > rng.range(-0.3, 0.6) {
            let up = rng.direction();
            card(&mut mesh, p, up, rng.range(0.014, 0.024), &mut rng);
        }
    }
    mesh
}

/// Lily pads: notched discs that lie on the water, uv 0..1.
pub(super) fn lilies(count: usize) -> Mesh {
    let mut mesh = Mesh::default();
    let mut rng = Rng::new(73);
    let mut n = 0;
    while n < count {
        let (x, z) = (POND[0] + 12.0 * rng.bell(), POND[1] + 6.2 * rng.bell());
        let patch = noise([0.35 * x + 3.0, 1.0, 0.35 * z], 74);
        if shore_distance(x, z) > -0.5
            || patch < 0.22
            || libm::fabs(x) < 1.5
            || (z > 11.5 && x > -7.0)
        {
            continue;
        }
        n += 1;
        let (r, turn) = (rng.range(0.08, 0.19), rng.range(0.0, std::f64::consts::TAU));
        let y = 0.004 + 0.004 * rng.unit();
        let steps = 28;
        let ring = |k: i32, s: f64| {
            let a = turn + 0.12 + (std::f64::consts::TAU - 0.24) * f64::from(k) / f64::from(steps);
            [s * libm::cos(a), s * libm::sin(a)]
        };
        for k in 0..steps {
            let corner = |mesh: &mut Mesh, [a, b]: [f64; 2], lift: f64| {
                mesh.vertex(
                    [x + r * a, y + lift, z + r * b],
                    [0.0, 1.0, 0.0],
                    [0.5 + 0.5 * a, 0.5 + 0.5 * b],
                )
            };
            let edge = |k: i32| 0.006 * libm::sin(1.3 * f64::from(k) + turn) + 0.006;
            let ids = [
                corner(&mut mesh, [0.0, 0.0], 0.0),
                corner(&mut mesh, ring(k + 1, 1.0), edge(k + 1)),
                corner(&mut mesh, ring(k, 1.0), edge(k)),
            ];
            mesh.0.indices.extend(ids);
        }
    }
    mesh
}

/// Wooded ridges far away: strips of land, one behind the other.
pub(super) fn ridges() -> Mesh {
    let mut mesh = Mesh::default();
    for (k, (z, tall)) in [(-135.0, 16.0), (-210.0, 33.0), (-330.0, 62.0)].into_iter().enumerate() {
        let seed = 80 + k as u64;
        let wide = -1.5 * z;
        mesh.grid([220, 3], [220.0, 3.0], |u, v| {
            let x = wide * (2.0 * u - 1.0);
            let s = x / -z;
            let crest = 0.55
                + 0.55 * noise([2.2 * s, 0.0, 1.0], seed)
                + 0.16 * noise([9.0 * s, 0.0, 2.0], seed);
            let trees = 0.035 * noise([90.0 * s, 0.0, 3.0], seed)
                + 0.02 * noise([210.0 * s, 0.0, 3.0], seed);
            [x, (tall * (crest + trees).max(0.12) + 8.0) * v - 8.0, z - 14.0 * v]
        });
    }
    mesh
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn petals_float_on_the_water_and_not_beside_it() {
        let mesh = floating(200);
        assert_eq!(mesh.triangles(), 400);
        for p in &mesh.0.positions {
            assert!(shore_distance(f64::from(p[0]), f64::from(p[2])) < 0.05);
            assert!((-0.01..0.02).contains(&p[1]));
        }
    }

    #[test]
    fn grass_does_not_grow_on_stairs_or_in_the_pond() {
        for p in grass(300, false).0.positions {
            let (x, z) = (f64::from(p[0]), f64::from(p[2]));
            assert!(shore_distance(x, z) > -0.3 && !(x.abs() < 1.9 && z < 2.0), "{p:?}");
        }
    }

    #[test]
    fn the_rim_is_where_the_water_ends() {
        let [x, z] = rim(2.0, 0.0);
        assert!(shore_distance(x, z).abs() < 1e-6);
    }
}
