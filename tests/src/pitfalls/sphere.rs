//! Rays against small and far, and against huge and near spheres.

#![expect(
    clippy::cast_possible_truncation,
    reason = "the naive form and the kernel compute in f32"
)]

use glam::{DVec3, Vec3};
use runtime::kernel::f32 as single;

use super::{Row, Topic, row, share};
use crate::kernel::Bench;
use crate::statistics::stream::Stream;

/// The naive nearer root of the quadratic.
#[must_use]
pub fn naive(center: Vec3, radius: f32, origin: Vec3, dir: Vec3) -> Option<f32> {
    let f = origin - center;
    let a = dir.dot(dir);
    let b = dir.dot(f);
    let c = f.dot(f) - radius * radius;
    let d = b * b - a * c;
    if d < 0.0 {
        return None;
    }
    let t = (-b - d.sqrt()) / a;
    let t = if t > 0.0 { t } else { (-b + d.sqrt()) / a };
    (t > 0.0).then_some(t)
}

/// In double precision, for the same single-precision numbers; and how far the ray passes the centre, in
/// radii.
fn truth(center: Vec3, radius: f32, origin: Vec3, dir: Vec3) -> (Option<f64>, f64) {
    let (f, d) = (origin.as_dvec3() - center.as_dvec3(), dir.as_dvec3().normalize());
    let (r, b) = (f64::from(radius), -f.dot(d));
    let passes = f.cross(d).length();
    let t = b - ((r - passes) * (r + passes)).max(0.0).sqrt();
    ((passes < r && t > 0.0).then_some(t), passes / r)
}

/// Rays from `ratio` radii away that are told hit for miss or miss for hit: by the naive form, by the kernel; and
/// how far off the surface their worst hit is, in radii.
#[must_use]
pub fn far(ratio: f64, n: usize) -> ([usize; 2], [f64; 2]) {
    let bench = Bench::new();
    let mut kernel = bench.single();
    let mut stream = Stream::new(167, ratio as u64);
    let (mut wrong, mut off) = ([0; 2], [0.0_f64; 2]);
    for _ in 0..n {
        let radius = 1.0_f32 / ratio as f32;
        let center = (stream.direction() * stream.between(0.0, 0.1)).as_vec3();
        let way = stream.direction();
        let origin = (center.as_dvec3() + way).as_vec3();
        let side = way.cross(stream.direction()).normalize();
        let aim = center.as_dvec3() + side * (f64::from(radius) * stream.between(0.0, 1.5));
        let dir = (aim - origin.as_dvec3()).normalize().as_vec3();
        let (t, passes) = truth(center, radius, origin, dir);
        let sphere = single::Sphere { center, radius, ..single::Sphere::ZERO };
        let hit = kernel.sphere_intersect(sphere, origin, dir, false).x;
        let found = [naive(center, radius, origin, dir), (hit > 0.0).then_some(hit)];
        for k in 0..2 {
            wrong[k] += usize::from(found[k].is_some() != t.is_some());
            if let (Some(t), Some(found), true) = (t, found[k], passes < 0.9) {
                off[k] = off[k].max((f64::from(found) - t).abs() / f64::from(radius));
            }
        }
    }
    (wrong, off)
}

/// Largest relative error of the distance to the ground from an eye 1 above it: a sphere of `radius` by the
/// naive form, the same by the kernel, and a flat triangle by the kernel that reaches as far as the sphere's horizon.
#[must_use]
pub fn ground(radius: f64, n: usize) -> [f64; 3] {
    let bench = Bench::new();
    let mut kernel = bench.single();
    let mut stream = Stream::new(173, 0);
    let r = radius as f32;
    let center = Vec3::new(0.0, 0.0, -r);
    let sphere = single::Sphere { center, radius: r, ..single::Sphere::ZERO };
    let horizon = (2.0 * radius).sqrt() as f32;
    let v = |x: f32, y: f32| Vec3::new(x * horizon, y * horizon, 0.0);
    let (v0, v1, v2) = (v(-1.0, -1.0), v(3.0, -1.0), v(-1.0, 3.0));
    let flat = single::Triangle { v0, id0: 0, v1, id1: 1, v2, id2: 2 };
    let mut worst = [0.0_f64; 3];
    for _ in 0..n {
        let phi = stream.between(0.0, std::f64::consts::TAU);
        let down = stream.between(0.1, 1.0);
        let side = (1.0 - down * down).sqrt();
        let dir = DVec3::new(side * phi.cos(), side * phi.sin(), -down).normalize().as_vec3();
        let origin = Vec3::Z;
        let curved = truth(center, r, origin, dir).0.unwrap_or(f64::INFINITY);
        let level = 1.0 / -f64::from(dir.z);
        let shear = kernel.triangle_shear(dir);
        let found = [
            naive(center, r, origin, dir).unwrap_or(0.0),
            kernel.sphere_intersect(sphere, origin, dir, false).x,
            kernel.triangle_intersect(flat, origin, shear).x,
        ];
        for ((worst, found), t) in worst.iter_mut().zip(found).zip([curved, curved, level]) {
            *worst = worst.max((f64::from(found) / t - 1.0).abs());
        }
    }
    worst
}

fn rows() -> Vec<Row> {
    let n = 200_000;
    let mut rows = Vec::new();
    for ratio in [1e3, 1e4, 1e5] {
        let (wrong, off) = far(ratio, n);
        let show = |k: usize| format!("{}, {:.0e}", share(wrong[k], n), off[k]);
        let item = format!(
            "sphere {ratio:.0e} radii away: wrong hit or miss, worst distance off in radii"
        );
        rows.push(row(item, show(0), show(1)));
    }
    let [naive, ours, flat] = ground(1e5, 200_000);
    rows.push(row(
        "ground of radius 1e5, 1 below the eye: worst relative error of the distance",
        format!("{naive:.1e}"),
        format!("sphere {ours:.1e}, rectangle {flat:.1e}"),
    ));
    rows
}

/// Measures the topic.
#[must_use]
pub fn topic() -> Topic {
    Topic {
        title: "Spheres that are far or huge",
        places: &["shaders/wgsl/shape/sphere.wgsl", "shaders/wgsl/shape/triangle.wgsl"],
        rows: rows(),
        fact: "b² - ac cancels for a sphere a thousand radii away; the discriminant from the \
            distance at which the ray passes the centre does not. A ground should be a rectangle: \
            the distance to a huge sphere is lost in the input. (Haines, Günther & Akenine-Möller \
            2019, *Precision Improvements for Ray/Sphere Intersection*.)",
    }
}
