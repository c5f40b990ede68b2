//! Rays against spheres, small and far.

use glam::{DVec3, Vec3};
use runtime::kernel::f32 as single;
use tests::kernel::Bench;
use tests::statistics::stream::Stream;

use crate::Worst;

/// The truth for the numbers that the kernel gets: nearer distance, and how far the ray passes the centre.
fn truth(sphere: &single::Sphere, origin: Vec3, dir: Vec3) -> (Option<f64>, f64) {
    let f = origin.as_dvec3() - sphere.center.as_dvec3();
    let d = dir.as_dvec3().normalize();
    let b = -f.dot(d);
    // The distance of the centre by a cross product: no cancellation.
    let passes = f.cross(d).length();
    let r = f64::from(sphere.radius);
    let chord = (r - passes) * (r + passes);
    ((chord >= 0.0).then(|| b - chord.max(0.0).sqrt()), passes / r)
}

/// Distance over radius; share of wrong hits and misses allowed; error of the distance in radii allowed.
const CASES: [(f64, f64, f64); 5] =
    [(3.0, 1e-5, 1e-5), (1e2, 1e-5, 1e-4), (1e3, 1e-4, 1e-3), (1e4, 1e-3, 1e-2), (1e5, 1e-2, 1e-1)];

#[test]
fn far_spheres_are_hit_where_they_are() {
    let bench = Bench::new();
    let mut kernel = bench.single();
    for (ratio, wrong_share, distance_error) in CASES {
        let mut stream = Stream::new(61, ratio as u64);
        let n = 200_000;
        let (mut wrong, mut error) = (0, Worst::default());
        for _ in 0..n {
            let radius = stream.between(0.5, 2.0);
            let sphere = single::Sphere {
                center: (stream.direction() * stream.between(0.0, 2.0)).as_vec3(),
                radius: radius as f32,
                ..single::Sphere::ZERO
            };
            let way = stream.direction();
            let origin = (sphere.center.as_dvec3() + way * (ratio * radius)).as_vec3();
            let side = way.cross(stream.direction()).normalize();
            let aim = sphere.center.as_dvec3() + side * (radius * stream.between(0.0, 1.5));
            let dir = (aim - origin.as_dvec3()).normalize().as_vec3();
            let (t, passes) = truth(&sphere, origin, dir);
            let hit = kernel.sphere_intersect(sphere, origin, dir, false);
            wrong += usize::from((hit.x > 0.0) != t.is_some());
            if let (Some(t), true) = (t, hit.x > 0.0 && passes < 0.9) {
                error.add((f64::from(hit.x) - t).abs() / radius, passes);
                let n = kernel.sphere_normal(sphere, origin, dir, hit.x);
                assert!((n.length() - 1.0).abs() < 2e-7);
            }
        }
        let share = f64::from(u32::try_from(wrong).expect("few")) / f64::from(n);
        assert!(share <= wrong_share, "{wrong} of {n} wrong at {ratio} radii");
        error.check(&format!("distance at {ratio} radii, in radii"), distance_error);
    }
}

#[test]
fn rays_from_inside_hit_the_far_side() {
    let bench = Bench::new();
    let mut kernel = bench.single();
    let mut stream = Stream::new(67, 0);
    let mut worst = Worst::default();
    for _ in 0..100_000 {
        let sphere = single::Sphere { radius: 0.5, ..single::Sphere::ZERO };
        let origin = (stream.direction() * stream.between(0.0, 0.499)).as_vec3();
        let dir = stream.direction().as_vec3();
        let hit = kernel.sphere_intersect(sphere, origin, dir, false);
        assert!(hit.x < 0.0 && hit.y > 0.0, "{origin} {dir}: {hit}");
        let p = origin.as_dvec3() + dir.as_dvec3().normalize() * f64::from(hit.y);
        worst.add((p.length() / 0.5 - 1.0).abs(), p.z);
    }
    worst.check("far side", 2e-6);
}

#[test]
fn axis_parallel_and_tangent_rays() {
    let bench = Bench::new();
    let mut kernel = bench.single();
    let sphere = single::Sphere { radius: 0.5, ..single::Sphere::ZERO };
    for dir in [Vec3::X, Vec3::Y, Vec3::Z, Vec3::NEG_X, Vec3::NEG_Y, Vec3::NEG_Z] {
        let hit = kernel.sphere_intersect(sphere, dir * -2.0, dir, false);
        assert_eq!((hit.x, hit.y), (1.5, 2.5));
        let side = dir.any_orthonormal_vector();
        let away = kernel.sphere_intersect(sphere, dir * -2.0 + side * 0.75, dir, false);
        assert_eq!((away.x, away.y), (-1.0, -1.0));
        let tangent = kernel.sphere_intersect(sphere, dir * -2.0 + side * 0.5, dir, false);
        assert!(tangent.is_finite());
        // Where the ray touches it at its own origin there is no hit, and no division by zero.
        let touching = kernel.sphere_intersect(sphere, side * 0.5, dir, false);
        assert!(touching.is_finite() && touching.x <= 0.0);
    }
}

/// Latitude and longitude of an outward normal.
#[test]
fn texture_coordinates_of_a_sphere() {
    let bench = Bench::new();
    let mut kernel = bench.single();
    let mut stream = Stream::new(71, 0);
    let mut worst = Worst::default();
    for _ in 0..50_000 {
        let n = stream.direction();
        let uv = kernel.sphere_uv(n.as_vec3()).as_dvec2();
        let v = 0.5 + n.y.clamp(-1.0, 1.0).asin() / std::f64::consts::PI;
        worst.add((uv.y - v).abs(), n.y);
        let u = 0.5 + n.x.atan2(n.z) / std::f64::consts::TAU;
        // Longitude has no meaning at the poles.
        worst.add((uv.x - u).abs().min(1.0 - (uv.x - u).abs()) * n.x.hypot(n.z), n.y);
        assert!(uv.min_element() >= 0.0 && uv.max_element() <= 1.0, "{n}: {uv}");
    }
    worst.check("sphere_uv", 4e-7);
    assert_eq!(kernel.sphere_uv(Vec3::Y).y, 1.0);
    assert_eq!(kernel.sphere_uv(Vec3::NEG_Y).y, 0.0);
    assert_eq!(kernel.sphere_uv(DVec3::Z.as_vec3()), glam::Vec2::splat(0.5));
}
