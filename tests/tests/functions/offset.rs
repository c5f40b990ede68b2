//! Rays that leave a surface: they do not hit what they start on, nor its neighbours.

use glam::{DVec3, Vec2, Vec3};
use pack::abi::NONE;
use pack::abi::{Sphere, Triangle};
use runtime::kernel::f32 as single;
use tests::kernel::Bench;
use tests::statistics::stream::Stream;

fn record(corners: [Vec3; 3], ids: [u32; 3]) -> Triangle {
    let [v0, v1, v2] = corners.map(Into::into);
    Triangle { v0, id0: ids[0], v1, id1: ids[1], v2, id2: ids[2] }
}

/// A direction on the side of `n`, its cosine even in the logarithm down to 1e-4.
fn leaving(n: DVec3, stream: &mut Stream) -> DVec3 {
    let cos = 10.0_f64.powf(stream.between(-4.0, 0.0));
    let side = n.cross(stream.direction()).normalize();
    (n * cos + side * (1.0 - cos * cos).sqrt()).normalize()
}

fn ray(origin: Vec3, dir: Vec3, skip: u32) -> single::Ray {
    single::Ray { skip: tests::kernel::skip(skip), ..tests::kernel::ray(origin, dir) }
}

/// Where the kernel starts a ray from `s` along `dir`.
fn start(kernel: &mut single::Kernel<'_>, s: &single::Surface, dir: Vec3) -> Vec3 {
    kernel.ray_offset_origin(s.p, s.ng * s.ray_offset, dir)
}

/// Without the skip of the source: the offset alone keeps off ordinary triangles of any size and place.
#[test]
fn a_triangle_is_not_hit_by_rays_that_leave_it() {
    let mut stream = Stream::new(73, 0);
    let (mut hits, mut skipped_hits, mut rays) = (0, 0, 0);
    for _ in 0..4000 {
        // Sizes down to 1e-4 of the distance from the origin.
        let size = 10.0_f64.powf(stream.between(-4.0, 0.0));
        let center = stream.direction() * stream.between(0.0, 1.0);
        let corners = loop {
            let corners = [0; 3].map(|_| stream.direction() * size);
            let area = (corners[1] - corners[0]).cross(corners[2] - corners[0]).length();
            if area > 0.3 * size * size {
                break corners.map(|c| (center + c).as_vec3());
            }
        };
        let bench = Bench::new().triangles(&[record(corners, [0, 1, 2])]);
        let mut kernel = bench.single();
        for _ in 0..30 {
            let (x, y) = (stream.unit24(), stream.unit24());
            let b = if x + y > 1.0 { Vec2::new(1.0 - x, 1.0 - y) } else { Vec2::new(x, y) };
            let (tri, shade) = (kernel.load_triangle(0), kernel.load_tri_shade(0));
            let s = kernel.triangle_flat_surface(tri, shade, b, stream.direction().as_vec3());
            let side = if stream.unit() < 0.5 { 1.0 } else { -1.0 };
            let dir = leaving(s.ng.as_dvec3() * side, &mut stream).as_vec3();
            let origin = start(&mut kernel, &s, dir);
            hits += usize::from(kernel.trace(ray(origin, dir, NONE)).prim != NONE);
            skipped_hits += usize::from(kernel.trace(ray(origin, dir, 0)).prim != NONE);
            rays += 1;
        }
    }
    assert_eq!(skipped_hits, 0, "of {rays}");
    assert_eq!(hits, 0, "of {rays} without skipping the source");
}

/// A triangle around `center` in the plane across `axis` through it, of about this size.
fn across(axis: usize, center: DVec3, size: f64, stream: &mut Stream) -> [Vec3; 3] {
    let turn = stream.between(0.0, std::f64::consts::TAU);
    [0.0, 1.0, 2.0].map(|third| {
        let (y, x) = (turn + third * std::f64::consts::TAU / 3.0).sin_cos();
        let mut corner = center;
        corner[(axis + 1) % 3] += x * size * stream.between(1.0, 3.0);
        corner[(axis + 2) % 3] += y * size * stream.between(1.0, 3.0);
        corner.as_vec3()
    })
}

/// Planes across an axis, the other side of a slab a few ulp thick, and copies of the one that the ray leaves,
/// turned over and larger: the copies are not met, the other side is, and at its distance.
#[test]
fn planes_across_an_axis_are_left_and_met_however_near_they_are() {
    let mut stream = Stream::new(97, 0);
    let (mut copies, mut missed, mut early, mut rays) = (0, 0, 0, 0);
    for turn in 0..6000 {
        let axis = turn % 3;
        let size = 10.0_f64.powf(stream.between(-4.0, -1.0));
        let place =
            10.0_f64.powf(stream.between(-8.0, -0.3)) * if turn % 2 == 0 { 1.0 } else { -1.0 };
        let mut center = stream.direction() * stream.between(0.0, 0.7);
        center[axis] = if turn % 7 == 0 { 0.0 } else { f64::from(place as f32) };
        let source = across(axis, center, size, &mut stream);
        let over = [source[0], source[2], source[1]];
        let large = across(axis, center, size * 5.0, &mut stream);
        // From four ulp on.
        let thin = 10.0_f64.powf(stream.between(-6.3, 0.0));
        let lid = center[axis] * (1.0 - thin) - if center[axis] == 0.0 { thin * 1e-9 } else { 0.0 };
        let mut below = center;
        below[axis] = f64::from(lid as f32);
        let floor = across(axis, below, 1e6, &mut stream);
        let triangles = [(source, 0), (over, 0), (large, 3), (floor, 6)]
            .map(|(corners, id)| record(corners, [id, id + 1, id + 2]));
        let bench = Bench::new().triangles(&triangles);
        let mut kernel = bench.single();
        let mut inwards = DVec3::ZERO;
        inwards[axis] = below[axis] - center[axis];
        let inwards = inwards.normalize();
        for _ in 0..20 {
            let (x, y) = (stream.unit24(), stream.unit24());
            let b = if x + y > 1.0 { Vec2::new(1.0 - x, 1.0 - y) } else { Vec2::new(x, y) };
            let (tri, shade) = (kernel.load_triangle(0), kernel.load_tri_shade(0));
            let s = kernel.triangle_flat_surface(tri, shade, b, stream.direction().as_vec3());
            let out = leaving(-inwards, &mut stream).as_vec3();
            let origin = start(&mut kernel, &s, out);
            copies += usize::from(kernel.trace(ray(origin, out, NONE)).prim != NONE);
            let dir = leaving(inwards, &mut stream).as_vec3();
            let origin = start(&mut kernel, &s, dir);
            let hit = kernel.trace(ray(origin, dir, NONE));
            missed += usize::from(hit.prim != 3);
            let truth = (below[axis] - f64::from(origin[axis])) / f64::from(dir[axis]);
            early += usize::from((f64::from(hit.t) / truth - 1.0).abs() > 1e-6);
            rays += 1;
        }
    }
    assert_eq!((copies, missed, early), (0, 0, 0), "of {rays}");
}

/// A triangle across an axis and one that falls away from it at their common edge, by any angle: rays that leave the
/// one, half of them from next to that edge, do not meet the other.
#[test]
fn planes_across_an_axis_do_not_meet_what_falls_away_at_their_edges() {
    let mut stream = Stream::new(101, 0);
    let (mut hits, mut rays) = (0, 0);
    for turn in 0..10_000 {
        let axis = turn % 3;
        let size = 10.0_f64.powf(stream.between(-4.0, -1.0));
        let center = stream.direction() * stream.between(0.0, 0.7);
        let flat = across(axis, center, size, &mut stream);
        let [a, b, c] = flat.map(Vec3::as_dvec3);
        let out = (b - a).cross(c - a).normalize();
        let beyond = (b + c - a) - out * (size * 10.0_f64.powf(stream.between(-7.0, 1.0)));
        let triangles =
            [record(flat, [0, 1, 2]), record([flat[2], flat[1], beyond.as_vec3()], [2, 1, 3])];
        let bench = Bench::new().triangles(&triangles);
        let mut kernel = bench.single();
        for _ in 0..40 {
            // Next to the edge between b and c: the first weight is nearly nothing.
            let first = if stream.unit() < 0.5 { 1e-6 } else { stream.unit24() };
            let second = (1.0 - first) * stream.unit24();
            let (tri, shade) = (kernel.load_triangle(0), kernel.load_tri_shade(0));
            let s = kernel.triangle_flat_surface(
                tri,
                shade,
                Vec2::new(1.0 - first - second, second),
                -out.as_vec3(),
            );
            let dir = leaving(out, &mut stream).as_vec3();
            let origin = start(&mut kernel, &s, dir);
            hits += usize::from(kernel.trace(ray(origin, dir, 0)).prim != NONE);
            rays += 1;
        }
    }
    assert_eq!(hits, 0, "of {rays}");
}

/// The faces of an octahedron around `center`: convex, so a ray that leaves it hits nothing.
fn octahedron(center: DVec3, size: f64) -> Vec<Triangle> {
    let axes = [DVec3::X, DVec3::Y, DVec3::Z, DVec3::NEG_X, DVec3::NEG_Y, DVec3::NEG_Z];
    let points = axes.map(|a| (center + a * size).as_vec3());
    let mut faces = Vec::new();
    for bits in 0..8_u32 {
        let id = |axis: u32| axis + 3 * ((bits >> axis) & 1);
        let mut ids = [id(0), id(1), id(2)];
        if bits.count_ones() % 2 == 1 {
            ids.swap(1, 2);
        }
        faces.push(record(ids.map(|i| points[i as usize]), ids));
    }
    faces
}

#[test]
fn a_convex_solid_does_not_shadow_itself() {
    let mut stream = Stream::new(79, 0);
    let (mut hits, mut rays) = (0, 0);
    for _ in 0..500 {
        let size = 10.0_f64.powf(stream.between(-4.0, 0.0));
        let faces = octahedron(stream.direction() * stream.between(0.0, 1.0), size);
        let bench = Bench::new().triangles(&faces);
        let mut kernel = bench.single();
        for _ in 0..200 {
            let face = stream.index(8) as u32;
            // Half of the points are next to an edge.
            let x = if stream.unit() < 0.5 { 1e-6 } else { stream.unit24() };
            let b = Vec2::new(x, (1.0 - x) * stream.unit24());
            let (tri, shade) = (kernel.load_triangle(face), kernel.load_tri_shade(face));
            let out = kernel.triangle_normal(tri);
            let s = kernel.triangle_flat_surface(tri, shade, b, -out);
            assert!(s.front, "faces look outwards");
            let dir = leaving(out.as_dvec3(), &mut stream).as_vec3();
            let origin = start(&mut kernel, &s, dir);
            hits += usize::from(kernel.trace(ray(origin, dir, face)).prim != NONE);
            rays += 1;
        }
    }
    assert_eq!(hits, 0, "of {rays}");
}

/// Distance of the far end of a chord in double precision.
fn far_end(origin: Vec3, dir: Vec3, center: Vec3, radius: f32) -> f64 {
    let (f, d) = (origin.as_dvec3() - center.as_dvec3(), dir.as_dvec3().normalize());
    let b = -f.dot(d);
    b + (f64::from(radius).powi(2) - f.cross(d).length_squared()).sqrt()
}

/// Out of a sphere nothing is hit; into it the other end of the chord.
#[test]
fn a_sphere_is_left_outwards_and_crossed_inwards() {
    let mut stream = Stream::new(83, 0);
    let (mut outwards, mut missed, mut rays) = (0, 0, 0);
    for _ in 0..2000 {
        let radius = 10.0_f64.powf(stream.between(-3.0, 0.0));
        let center = (stream.direction() * stream.between(0.0, 1.0)).as_vec3();
        let sphere = Sphere {
            center: center.into(),
            radius: radius as f32,
            light: NONE,
            ..Sphere::default()
        };
        let bench = Bench::new().spheres(&[sphere]);
        let mut kernel = bench.single();
        for _ in 0..50 {
            let from = (center.as_dvec3() + stream.direction() * (3.0 * radius)).as_vec3();
            let aim = (center - from).normalize();
            let hit = kernel.trace(ray(from, aim, NONE));
            assert_eq!(hit.prim, single::PRIM_SPHERE);
            let sphere = kernel.load_sphere(0);
            let s = kernel.sphere_surface(sphere, from, aim, hit.t);
            let off = (s.p.as_dvec3() - center.as_dvec3()).length() / radius - 1.0;
            assert!(off.abs() < 1e-6 + 1e-7 / radius, "{off} radii off the surface");
            let out = leaving(s.ng.as_dvec3(), &mut stream).as_vec3();
            let origin = start(&mut kernel, &s, out);
            let skip = single::PRIM_SPHERE;
            outwards += usize::from(kernel.trace(ray(origin, out, skip)).prim != NONE);
            let inner = leaving(-s.ng.as_dvec3(), &mut stream);
            let cos = -inner.dot(s.ng.as_dvec3());
            let origin = start(&mut kernel, &s, inner.as_vec3());
            let hit = kernel.trace(ray(origin, inner.as_vec3(), skip));
            if cos > 1e-2 && radius > 1e-2 {
                let truth = far_end(origin, inner.as_vec3(), center, sphere.radius);
                let off = (f64::from(hit.t) - truth).abs();
                missed += usize::from(hit.prim == NONE || off > 1e-6 / cos + 1e-5 * truth);
            }
            rays += 1;
        }
    }
    assert_eq!((outwards, missed), (0, 0), "self hits and lost chords of {rays}");
}

/// Normals are turned to the ray; `front` says which side it was.
#[test]
fn surfaces_face_the_ray() {
    let corners = [Vec3::ZERO, Vec3::X, Vec3::Y];
    let bench = Bench::new().triangles(&[record(corners, [0, 1, 2])]);
    let mut kernel = bench.single();
    let mut stream = Stream::new(89, 0);
    for _ in 0..20_000 {
        let dir = stream.direction().as_vec3();
        let (tri, shade) = (kernel.load_triangle(0), kernel.load_tri_shade(0));
        let s = kernel.triangle_flat_surface(tri, shade, Vec2::splat(0.3), dir);
        assert_eq!(s.front, dir.z <= 0.0);
        assert!(s.ng.dot(dir) <= 0.0 && s.ns == s.ng);
        // A shading normal of any direction is made one that the ray sees from outside.
        let n = stream.direction().as_vec3();
        let ns = kernel.surface_shading_normal(s.ng, n, dir);
        assert!((ns.length() - 1.0).abs() < 1e-6);
        assert!(ns.dot(s.ng) >= 0.0 && ns.dot(-dir) > -1e-7, "{dir} {n}: {ns}");
    }
}
