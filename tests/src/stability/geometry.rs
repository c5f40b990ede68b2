//! Rays against triangles and spheres that hardly are any.

use std::f64::consts::TAU;

use glam::DVec3;
use pack::abi::{NONE, Sphere, Triangle};

use super::{Case, Row};
use crate::kernel::Bench;
use crate::picture::Estimate;
use crate::statistics::stream::Stream;

/// The cases of this file.
pub const CASES: &[Case] = &[
    Case {
        id: "X01",
        input: "needle triangle, 1 by 1e-7",
        must: "hits along it are its share of the area, 4 se; normals finite, length 1 ± 1e-6",
        measure: needle,
    },
    Case {
        id: "X02",
        input: "triangle without area: three equal corners, or three in a line",
        must: "never hit, exact (for what the importer does with it see the last rows)",
        measure: no_area,
    },
    Case {
        id: "X10",
        input: "ray exactly on a shared edge or a vertex, or along an axis",
        must: "one hit; 0 failures in 1e6",
        measure: edges,
    },
    Case {
        id: "X11",
        input: "ray in the plane of a triangle",
        must: "no hit, no NaN, exact",
        measure: in_plane,
    },
    Case {
        id: "X12",
        input: "ray at cosine 1e-6 to a plane of 1e3 units",
        must: "distance within 1e-3 of itself, or a miss; 0 hits on itself",
        measure: grazing,
    },
    Case {
        id: "X13",
        input: "sphere of radius 1e-3 at 1e3; of radius 1e5 seen from 1 above",
        must: "less than 0.2 % judged wrongly; distance within 1e-2 of itself",
        measure: far_spheres,
    },
];

fn triangle(corners: [DVec3; 3], ids: [u32; 3]) -> Triangle {
    let [v0, v1, v2] = corners.map(|p| p.as_vec3().into());
    Triangle { v0, id0: ids[0], v1, id1: ids[1], v2, id2: ids[2] }
}

twins! {
    /// Share of the points of the needle's bounds that are in it, then the largest error of a normal's length.
    fn needles(n: u32) -> (Estimate, f64) {
        let corners = [DVec3::ZERO, DVec3::X, DVec3::new(0.5, 1e-7, 0.0)];
        let bench = Bench::new().triangles(&[triangle(corners, [0, 1, 2])]);
        let mut kernel = open(&bench);
        let mut stream = Stream::new(101, 0);
        let mut hits = 0;
        for _ in 0..n {
            let at = DVec3::new(stream.unit(), 1e-7 * stream.unit(), 1.0);
            hits += u32::from(kernel.trace(ray(v3(at), v3(DVec3::NEG_Z))).prim != NONE);
        }
        let (mut worst, share) = (0.0_f64, f64::from(hits) / f64::from(n));
        for _ in 0..10_000 {
            let (p, d) = (stream.direction(), stream.direction());
            let side = d.any_orthonormal_vector();
            let bench = Bench::new().triangles(&[triangle([p, p + d, p + d * 0.5 + side * 1e-7], [0, 1, 2])]);
            let mut kernel = open(&bench);
            let tri = kernel.load_triangle(0);
            let normal = kernel.triangle_normal(tri);
            let off = (wide(normal).length() - 1.0).abs();
            worst = worst.max(if off.is_nan() { f64::INFINITY } else { off });
        }
        (Estimate { mean: share, error: (0.25 / f64::from(n)).sqrt() }, worst)
    }
}

fn needle() -> Vec<Row> {
    let [(a, na), (b, nb)] = both!(needles(100_000));
    vec![
        Row::mean("share of its bounds", 0.5, 0.0, [a, b]),
        Row::below("1 - length of the normal, 10 000 places", 1e-6, [na, nb]),
    ]
}

twins! {
    /// Rays towards triangles without area that hit them or are NaN.
    fn flat_hits(n: u32) -> u64 {
        let mut stream = Stream::new(103, 0);
        let mut hits = 0;
        for i in 0..n {
            let (p, d) = (stream.direction(), stream.direction());
            // Powers of two: the corners are in a line after rounding, too.
            let p = p.as_vec3().as_dvec3();
            let d = (d * 8.0).round() / 16.0;
            let corners = if i % 2 == 0 { [p; 3] } else { [p, p + d, p + d * 2.0] };
            let corners = corners.map(|c| (c * 1024.0).round() / 1024.0);
            let bench = Bench::new().triangles(&[triangle(corners, [0, 1, 2])]);
            let mut kernel = open(&bench);
            let from = stream.direction() * 3.0;
            let target = corners[0].lerp(corners[2], stream.unit());
            let dir = (target - from.as_vec3().as_dvec3()).normalize();
            let hit = kernel.trace(ray(v3(from), v3(dir)));
            hits += u64::from(hit.prim != NONE || hit.t.is_nan());
        }
        hits
    }
}

fn no_area() -> Vec<Row> {
    let bare = Row::never("hits, if such triangles got into a tree", 100_000, both!(flat_hits(100_000))).known(
        "three corners in a line get an area when their sheared coordinates are rounded; the importer leaves such \
         triangles out, so the kernel never sees one",
    );
    let mut rows = vec![bare];
    rows.extend(super::import::no_area());
    rows
}

/// The faces of an octahedron around 0, with the ids of its corners.
fn octahedron(points: [DVec3; 6]) -> Vec<Triangle> {
    (0..8_u32)
        .map(|bits| {
            let id = |axis: u32| axis + 3 * ((bits >> axis) & 1);
            let ids = [id(0), id(1), id(2)];
            triangle(ids.map(|i| points[i as usize]), ids)
        })
        .collect()
}

twins! {
    /// Rays from within an octahedron at its edges and corners that hit not exactly one face.
    fn edge_errors(n: u32) -> u64 {
        let mut stream = Stream::new(107, 0);
        let axes = [DVec3::X, DVec3::Y, DVec3::Z, DVec3::NEG_X, DVec3::NEG_Y, DVec3::NEG_Z];
        let mut wrong = 0;
        let mut bent = 0;
        while bent < n {
            // Every tenth has its corners on the axes, and rays along them.
            let straight = bent / 1000 % 10 == 0;
            let points = axes.map(|a| {
                let bend = if straight { DVec3::ZERO } else { stream.direction() * 0.3 };
                (a * stream.between(0.5, 1.5) + bend).as_vec3().as_dvec3()
            });
            let faces = octahedron(points);
            let bench = Bench::new().triangles(&faces);
            let mut kernel = open(&bench);
            let tris: Vec<_> = (0..8).map(|i| kernel.load_triangle(i)).collect();
            for i in 0..1000 {
                let (a, b) = (stream.index(3), stream.index(3));
                let (p, q) = (points[a], points[3 + b]);
                let target = if i % 4 == 0 || a == b { p } else { p.lerp(q, stream.unit()) };
                let shear = kernel.triangle_shear(v3(target.normalize()));
                let hit = |t: &&k::Triangle| kernel.triangle_intersect(**t, V3::ZERO, shear).x > 0.0;
                wrong += u64::from(tris.iter().filter(hit).count() != 1);
            }
            bent += 1000;
        }
        wrong
    }
}

fn edges() -> Vec<Row> {
    vec![Row::never("rays without exactly one hit", 1_000_000, both!(edge_errors(1_000_000)))]
}

twins! {
    /// Rays in planes of triangles that hit or are NaN: planes that numbers hold exactly.
    fn plane_errors(oblique: bool, n: u32) -> [u64; 2] {
        let mut stream = Stream::new(109, 0);
        let (mut hits, mut nan) = (0, 0);
        let straight = [[DVec3::X, DVec3::Y], [DVec3::Y, DVec3::Z], [DVec3::Z, DVec3::X]];
        let slanted = [DVec3::new(1.0, -1.0, 0.0), DVec3::new(0.0, 1.0, -1.0)];
        for i in 0..n {
            let [x, y] = if oblique { slanted } else { straight[i as usize % 3] };
            let mut grid = |half: f64| (stream.between(-half, half) * 64.0).round() / 64.0;
            let mut point = || x * grid(2.0) + y * grid(2.0);
            let corners = [point(), point(), point()];
            let (from, dir) = (point() * 4.0, point());
            if dir == DVec3::ZERO {
                continue;
            }
            let bench = Bench::new().triangles(&[triangle(corners, [0, 1, 2])]);
            let mut kernel = open(&bench);
            // Not unit, but exactly in the plane; the test of triangles does not ask for more.
            let hit = kernel.trace(ray(v3(from), v3(dir)));
            hits += u64::from(hit.prim != NONE);
            nan += u64::from(hit.t.is_nan());
        }
        [hits, nan]
    }
}

const WHY_OBLIQUE: &str = "the shear divides by the largest component of the direction, and what is rounded there gives \
    the edge-on triangle an area; the hit is a point of it, at its own distance";

fn in_plane() -> Vec<Row> {
    let mut rows = Vec::new();
    for (name, oblique) in [("plane of two axes", false), ("oblique plane", true)] {
        let [a, b] = both!(plane_errors(oblique, 100_000));
        let hits = Row::never(format!("{name}: hits"), 100_000, [a[0], b[0]]);
        rows.push(if oblique { hits.known(WHY_OBLIQUE) } else { hits });
        rows.push(Row::never(format!("{name}: NaN"), 100_000, [a[1], b[1]]));
    }
    rows
}

twins! {
    /// Rays at cosine 1e-6: distances off by more than 1e-3 of themselves, hits of what the ray has left.
    fn grazes(n: u32) -> [u64; 2] {
        let s = 1e3;
        let corners = [DVec3::new(-s, 0.0, -s), DVec3::new(s, 0.0, -s), DVec3::new(0.0, 0.0, s)];
        let bench = Bench::new().triangles(&[triangle(corners, [0, 1, 2])]);
        let mut kernel = open(&bench);
        let mut stream = Stream::new(113, 0);
        let (mut off, mut again) = (0, 0);
        for _ in 0..n {
            let distance = stream.between(1.0, 900.0);
            let turn = TAU * stream.unit();
            let to = DVec3::new(stream.between(-100.0, 100.0), 0.0, stream.between(-300.0, 0.0));
            let dir = DVec3::new(turn.cos(), -1e-6, turn.sin()).as_vec3().as_dvec3();
            let from = (to - dir * distance).as_vec3().as_dvec3();
            let truth = from.y / -dir.y;
            let hit = kernel.trace(ray(v3(from), v3(dir)));
            if hit.prim == NONE {
                continue;
            }
            let error = (hit.t as f64 / truth - 1.0).abs();
            off += u64::from(error.is_nan() || error >= 1e-3);
            let s = kernel.dispatch_surface(hit, v3(from), v3(dir), 0.0);
            let up = v3(DVec3::new(dir.x, 1e-6, dir.z));
            let origin = kernel.ray_offset_origin(s.p, s.ng * s.ray_offset, up);
            again += u64::from(kernel.trace(ray(origin, up)).prim != NONE);
        }
        [off, again]
    }
}

fn grazing() -> Vec<Row> {
    let n = 100_000_u32;
    let [a, b] = both!(grazes(100_000));
    vec![
        Row::never("distances off by more than 1e-3", u64::from(n), [a[0], b[0]]),
        Row::never("reflected rays that hit it again", u64::from(n), [a[1], b[1]]),
    ]
}

twins! {
    /// Share of rays that are judged wrongly, and the largest relative error of the distance where both hit.
    fn sphere_errors(setting: Setting, n: u32) -> [f64; 2] {
        let Setting { radius, height, spread } = setting;
        let mut stream = Stream::new(127, 0);
        let center = DVec3::new(0.3, -0.5, 0.2) * height;
        let record = Sphere { center: center.as_vec3().into(), radius: radius as f32, ..Sphere::default() };
        let bench = Bench::new().spheres(&[record]);
        let mut kernel = open(&bench);
        let sphere = kernel.load_sphere(0);
        let (c, r) = (center.as_vec3().as_dvec3(), f64::from(radius as f32));
        let (mut wrong, mut worst) = (0, 0.0_f64);
        for _ in 0..n {
            let away = stream.direction();
            let from = (c + away * (r + height)).as_vec3().as_dvec3();
            let side = away.cross(stream.direction()).normalize();
            let target = c + side * (r * spread * stream.unit().sqrt());
            let dir = (target - from).normalize().as_vec3().as_dvec3();
            // In double precision from the same numbers; the direction is unit up to its rounding.
            let dir = dir.normalize();
            let f = from - c;
            let b = -f.dot(dir);
            let d = r * r - (f + dir * b).length_squared();
            let truth = if d < 0.0 { -1.0 } else { (f.length_squared() - r * r) / (b + d.sqrt()) };
            let found = f64::from(kernel.sphere_intersect(sphere, v3(from), v3(dir), false).x);
            wrong += u32::from((found > 0.0) != (truth > 0.0));
            if found > 0.0 && truth > 0.0 {
                worst = worst.max((found / truth - 1.0).abs());
            }
        }
        [f64::from(wrong) / f64::from(n), worst]
    }
}

/// A sphere seen from `height` above it, by rays that end on a disc of `spread` times its radius.
#[derive(Clone, Copy, Debug)]
struct Setting {
    radius: f64,
    height: f64,
    spread: f64,
}

const WHY_FAR: &str = "a sphere a millionth of its distance wide: the foot of the centre on the ray is known to 3 % of the \
    radius, because products of numbers of 1e3 are rounded to 3e-5";
const WHY_GROUND: &str =
    "the worst of 1e5 rays only: the square of 1e5 + 1 less that of 1e5 has four digits left";

fn far_spheres() -> Vec<Row> {
    let mut rows = Vec::new();
    for (name, setting) in [
        ("radius 1e-3 at 1e3", Setting { radius: 1e-3, height: 1e3, spread: 1.2 }),
        ("radius 1e5 from 1", Setting { radius: 1e5, height: 1.0, spread: 1.0 }),
    ] {
        let [a, b] = both!(sphere_errors(setting, 100_000));
        let share = Row::below(format!("{name}: share judged wrongly"), 2e-3, [a[0], b[0]]);
        let distance =
            Row::below(format!("{name}: relative error of distance"), 1e-2, [a[1], b[1]]);
        let far = setting.height > 1.0;
        rows.push(if far { share.known(WHY_FAR) } else { share });
        rows.push(if far { distance } else { distance.known(WHY_GROUND) });
    }
    rows
}
