//! Points of lights, and the choice of a light.

use glam::{DVec3, Vec3};
use pack::abi::{Light, LightKind};
use runtime::kernel::{f32 as single, f64 as double};
use tests::kernel::Bench;
use tests::statistics::stream::Stream;
use tests::statistics::{Counts, index};

use crate::{N, check, corners, key};

/// Radius over distance, and whether the light is straight along z: so that a direction resolves it.
const SPHERES: [(f64, bool); 7] = [
    (0.9995, false),
    (0.9, false),
    (0.5, false),
    (0.1, false),
    (1e-2, false),
    (1e-3, false),
    (1e-5, true),
];
/// Points from which flat lights are seen: near, far, grazing, from behind.
const EYES: [DVec3; 4] = [
    DVec3::new(0.1, 0.2, 0.3),
    DVec3::new(-3.0, 8.0, 20.0),
    DVec3::new(5.0, 0.5, 0.05),
    DVec3::new(0.7, 0.1, -2.0),
];
/// Numbers of lights in a table.
const TABLES: [usize; 4] = [2, 5, 64, 1000];

/// Widths of lights at infinity, degrees.
const DIAMETERS: [f64; 4] = [0.01, 0.53, 20.0, 90.0];

/// Chi-square tests here.
pub(crate) const CHECKS: usize = SPHERES.len() + DIAMETERS.len() + 2 * EYES.len() + TABLES.len();

/// Cells along each axis.
const SIDE: usize = 20;

fn single_light(light: &Light) -> single::Light {
    single::Light {
        origin: light.origin.into(),
        kind: light.kind,
        edge1: light.edge1.into(),
        area: light.area,
        edge2: light.edge2.into(),
        primitive: light.primitive,
        pmf: light.pmf,
        cdf: light.cdf,
        material: light.material,
        trail: light.trail,
    }
}

fn double_light(light: &Light) -> double::Light {
    let wide = |v: [f32; 3]| Vec3::from(v).as_dvec3();
    double::Light {
        origin: wide(light.origin),
        kind: light.kind,
        edge1: wide(light.edge1),
        area: f64::from(light.area),
        edge2: wide(light.edge2),
        primitive: light.primitive,
        pmf: f64::from(light.pmf),
        cdf: f64::from(light.cdf),
        material: light.material,
        trail: light.trail,
    }
}

fn sphere(center: DVec3, radius: f64) -> Light {
    Light {
        kind: LightKind::Sphere as u32,
        origin: center.as_vec3().into(),
        edge1: [radius as f32, 0.0, 0.0],
        ..Light::default()
    }
}

fn flat(kind: LightKind) -> Light {
    let (edge1, edge2) = (Vec3::new(1.0, 0.0, 0.0), Vec3::new(0.25, 0.75, 0.0));
    let area = edge1.cross(edge2).length();
    Light {
        kind: kind as u32,
        origin: [-0.25, -0.5, 0.0],
        edge1: edge1.into(),
        edge2: edge2.into(),
        area: if kind == LightKind::Triangle { 0.5 * area } else { area },
        ..Light::default()
    }
}

#[test]
fn sphere_lights_fill_their_cone() {
    let bench = Bench::new();
    let (mut single, mut double) = (bench.single(), bench.double());
    for (i, (ratio, straight)) in SPHERES.into_iter().enumerate() {
        let way = if straight { DVec3::Z } else { DVec3::new(0.6, -0.64, -0.48) * 1.5 };
        let light = sphere(way, ratio * way.length());
        let (flat_light, truth) = (single_light(&light), double_light(&light));
        let axis = truth.origin.normalize();
        let side = axis.any_orthonormal_vector();
        let s2 = truth.edge1.x.powi(2) / truth.origin.length_squared();
        let cone = s2 / (1.0 + (1.0 - s2).sqrt());
        let solid = 2.0 * std::f64::consts::PI * cone;
        let pdf = double.sphere_light_pdf(truth, DVec3::ZERO);
        assert!((pdf * solid - 1.0).abs() < 1e-6, "{ratio}: integrates to {}", pdf * solid);
        let mut counts = Counts::new(vec![pdf * solid * (N / SIDE / SIDE) as f64; SIDE * SIDE]);
        for k in 0..N {
            let u = single.sample_2d(key(1000 + i, k), single::PURPOSE_LIGHT_POINT);
            let to = single.dispatch_light_sample(flat_light, Vec3::ZERO, u);
            let wi = to.wi.as_dvec3().normalize();
            let height = (wi - axis).length_squared() * 0.5 / cone;
            assert!(height < 1.0 + 1e-2_f64.min(1e-6 / ratio) + 1e-5, "{ratio}: {height}");
            let turn = wi.dot(side.cross(axis)).atan2(wi.dot(side)) / std::f64::consts::TAU + 0.5;
            counts.add(cell(height, turn));
            // The distance leads to the light's surface.
            let off = (wi * f64::from(to.t) - truth.origin).length() / truth.edge1.x - 1.0;
            assert!(off.abs() < 1e-6 + 5e-7 / ratio, "{ratio}: {off} radii off the surface");
            assert!((f64::from(to.pdf) / pdf - 1.0).abs() < 1e-4, "{ratio}: {} {pdf}", to.pdf);
        }
        check(&format!("sphere light, radius / distance {ratio}"), &counts);
    }
}

#[test]
fn directional_lights_fill_their_cone() {
    let bench = Bench::new();
    let (mut single, mut double) = (bench.single(), bench.double());
    for (i, degrees) in DIAMETERS.into_iter().enumerate() {
        let half = 0.5 * degrees.to_radians();
        let rim = 2.0 * (0.5 * half).sin().powi(2);
        let axis = DVec3::new(0.6, -0.64, -0.48);
        let light = Light {
            kind: LightKind::Directional as u32,
            origin: axis.as_vec3().into(),
            edge1: [1.0, 2.0, 3.0],
            edge2: [rim as f32, 0.0, 0.0],
            ..Light::default()
        };
        let (flat_light, truth) = (single_light(&light), double_light(&light));
        let axis = truth.origin.normalize();
        let side = axis.any_orthonormal_vector();
        let pdf = double.directional_light_pdf(truth);
        let solid = 2.0 * std::f64::consts::PI * rim;
        assert!((pdf * solid - 1.0).abs() < 1e-6, "{degrees}: integrates to {}", pdf * solid);
        let mut counts = Counts::new(vec![(N / SIDE / SIDE) as f64; SIDE * SIDE]);
        for k in 0..N {
            let u = single.sample_2d(key(1400 + i, k), single::PURPOSE_LIGHT_POINT);
            let to = single.dispatch_light_sample(flat_light, Vec3::ZERO, u);
            let wi = to.wi.as_dvec3().normalize();
            let height = (wi - axis).length_squared() * 0.5 / rim;
            // What is sampled is seen, but for the last bits at the rim.
            let seen = single.directional_light_radiance(flat_light, to.wi);
            let slack = 1e-6 / half;
            assert!(height < 1.0 + slack, "{degrees}: {height}");
            assert!(
                seen == Vec3::new(1.0, 2.0, 3.0) || height > 1.0 - slack,
                "{degrees}: {height}"
            );
            let turn = wi.dot(side.cross(axis)).atan2(wi.dot(side)) / std::f64::consts::TAU + 0.5;
            counts.add(cell(height, turn));
            assert!((f64::from(to.pdf) / pdf - 1.0).abs() < 1e-5, "{degrees}: {} {pdf}", to.pdf);
        }
        check(&format!("directional light, {degrees} deg wide"), &counts);
        let outside = (axis * (1.01 * half).cos() + side * (1.01 * half).sin()).as_vec3();
        assert_eq!(single.directional_light_radiance(flat_light, outside), Vec3::ZERO);
    }
}

/// Cell of two coordinates in 0 ..= 1.
fn cell(x: f64, y: f64) -> usize {
    index(x, SIDE) * SIDE + index(y, SIDE)
}

/// Where on the light a point is: even in area over the unit square.
fn even_coordinates(light: &double::Light, x: DVec3) -> (f64, f64) {
    let (e1, e2) = (light.edge1, light.edge2);
    let n = e1.cross(e2);
    let r = x - light.origin;
    let (b1, b2) = (r.cross(e2).dot(n) / n.dot(n), e1.cross(r).dot(n) / n.dot(n));
    if light.kind == LightKind::Triangle as u32 {
        let s = b1 + b2;
        (s * s, if s > 0.0 { b2 / s } else { 0.0 })
    } else {
        (b1, b2)
    }
}

/// The point at even coordinates.
fn point_at(light: &double::Light, x: f64, y: f64) -> DVec3 {
    if light.kind == LightKind::Triangle as u32 {
        let s = x.sqrt();
        return light.origin + light.edge1 * (s * (1.0 - y)) + light.edge2 * (s * y);
    }
    light.origin + light.edge1 * x + light.edge2 * y
}

/// The density per steradian, turned into one per area by the cosine and the distance, must be even.
fn check_flat(kind: LightKind, test: usize) {
    let bench = Bench::new();
    let (mut single, mut double) = (bench.single(), bench.double());
    let light = flat(kind);
    let (flat_light, truth) = (single_light(&light), double_light(&light));
    let full = truth.edge1.cross(truth.edge2);
    let area = full.length() * if kind == LightKind::Triangle { 0.5 } else { 1.0 };
    let normal = full.normalize();
    for (i, eye) in EYES.into_iter().enumerate() {
        let eye = eye.as_vec3().as_dvec3();
        let fine = 4 * SIDE;
        let mut expected = vec![0.0; SIDE * SIDE];
        for x in 0..fine {
            for y in 0..fine {
                let at = |k: usize| (k as f64 + 0.5) / fine as f64;
                let point = point_at(&truth, at(x), at(y));
                let v = point - eye;
                let cos_l = -normal.dot(v.normalize());
                let pdf = double.dispatch_light_pdf(truth, eye, point, cos_l);
                let share = pdf * cos_l.abs() / v.length_squared() * area / (fine * fine) as f64;
                expected[x / 4 * SIDE + y / 4] += share * N as f64;
            }
        }
        let sum: f64 = expected.iter().sum::<f64>() / N as f64;
        assert!((sum - 1.0).abs() < 1e-5, "{kind:?} from {eye}: integrates to {sum}");
        let mut counts = Counts::new(expected);
        for k in 0..N {
            let u = single.sample_2d(key(test + i, k), single::PURPOSE_LIGHT_POINT);
            let to = single.dispatch_light_sample(flat_light, eye.as_vec3(), u);
            let wi = to.wi.as_dvec3().normalize();
            let point = eye + wi * f64::from(to.t);
            let (x, y) = even_coordinates(&truth, point);
            counts.add(cell(x, y));
            let cos_l = -normal.dot(wi);
            assert_eq!(to.front, cos_l > 0.0);
            let pdf = double.dispatch_light_pdf(truth, eye, point, cos_l);
            // Grazing, the cosine's own rounding shows.
            let bound = 1e-5 + 1e-6 / cos_l.abs();
            assert!((f64::from(to.pdf) / pdf - 1.0).abs() < bound, "{kind:?}: {} {pdf}", to.pdf);
        }
        check(&format!("{kind:?} light from {eye}"), &counts);
    }
}

#[test]
fn rectangle_lights_are_sampled_evenly_by_area() {
    check_flat(LightKind::Rectangle, 1100);
}

#[test]
fn triangle_lights_are_sampled_evenly_by_area() {
    check_flat(LightKind::Triangle, 1200);
}

#[test]
fn lights_are_chosen_by_their_probability() {
    for (i, n) in TABLES.into_iter().enumerate() {
        let mut stream = Stream::new(5, n as u64);
        // Powers over five decades.
        let powers: Vec<f64> = (0..n).map(|_| 10.0_f64.powf(stream.between(-5.0, 0.0))).collect();
        let total: f64 = powers.iter().sum();
        let mut sum = 0.0;
        let mut lights: Vec<Light> = Vec::new();
        for power in &powers {
            sum += power;
            let (pmf, cdf) = ((power / total) as f32, (sum / total) as f32);
            lights.push(Light { pmf, cdf, ..Light::default() });
        }
        lights[n - 1].cdf = 1.0;
        let bench = Bench::new().lights(&lights);
        let mut kernel = bench.single();
        let expected = lights.iter().map(|light| f64::from(light.pmf) * N as f64);
        let mut counts = Counts::new(expected.collect());
        for k in 0..N {
            let u = kernel.sample_1d(key(1300 + i, k), single::PURPOSE_LIGHT_CHOICE);
            counts.add(kernel.choose_light(n as u32, u) as usize);
        }
        check(&format!("choice among {n} lights"), &counts);
        assert_eq!(kernel.choose_light(n as u32, 0.0), 0);
        assert_eq!(kernel.choose_light(n as u32, 1.0 - 2.0_f32.powi(-24)) as usize, n - 1);
    }
}

#[test]
fn the_only_light_is_always_chosen() {
    let bench = Bench::new().lights(&[Light { pmf: 1.0, cdf: 1.0, ..Light::default() }]);
    let mut kernel = bench.single();
    assert!(corners().all(|u| kernel.choose_light(1, u.x) == 0));
}

#[test]
fn the_corners_of_the_unit_square_give_points() {
    let bench = Bench::new();
    let mut kernel = bench.single();
    let center = DVec3::new(0.25, -0.5, 0.125);
    let lights = [
        flat(LightKind::Rectangle),
        flat(LightKind::Triangle),
        sphere(center, 0.5),
        sphere(center, 1e-6),
    ];
    let eyes = EYES.map(DVec3::as_vec3);
    // On the sphere, in it, on the plane of the flat lights, on their corner.
    let odd = [
        Vec3::new(0.25, -0.5, 0.625),
        center.as_vec3(),
        Vec3::X * 3.0,
        flat(LightKind::Triangle).origin.into(),
    ];
    for light in &lights {
        for p in eyes.into_iter().chain(odd) {
            for u in corners() {
                let to = kernel.dispatch_light_sample(single_light(light), p, u);
                let at = format!("{light:?} from {p} at {u}: {to:?}");
                assert!((to.wi.length() - 1.0).abs() < 1e-6, "{at}");
                assert!(to.pdf >= 0.0 && to.pdf.is_finite() && to.t >= 0.0, "{at}");
            }
        }
    }
}

/// A sphere light seen from inside or from its surface is not sampled, and has density 0 there too.
#[test]
fn both_sides_agree_where_a_sphere_light_is_not_sampled() {
    let bench = Bench::new();
    let mut kernel = bench.single();
    let light = single_light(&sphere(DVec3::ZERO, 0.5));
    for inside in [0.0, 0.3, 0.499_999_9, 0.5, 0.500_000_1] {
        let p = Vec3::new(0.0, 0.0, inside);
        let to = kernel.dispatch_light_sample(light, p, glam::Vec2::splat(0.5));
        assert_eq!(to.pdf, 0.0);
        assert_eq!(kernel.dispatch_light_pdf(light, p, Vec3::X, 1.0), 0.0);
    }
    let outside = Vec3::new(0.0, 0.0, 0.50001);
    let to = kernel.dispatch_light_sample(light, outside, glam::Vec2::splat(0.5));
    assert!(to.pdf > 0.0);
    assert_eq!(kernel.dispatch_light_pdf(light, outside, Vec3::X, 1.0), to.pdf);
}
