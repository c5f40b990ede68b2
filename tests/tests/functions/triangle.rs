//! Rays against triangles and boxes: no cracks, no double hits.

use glam::{DVec3, Vec3};
use pack::abi::Triangle;
use runtime::kernel::f32 as single;
use tests::kernel::{Bench, ray, ray_double, skip};
use tests::statistics::stream::Stream;

use crate::Worst;

/// A mesh with welded ids.
struct Mesh {
    points: Vec<Vec3>,
    faces: Vec<[usize; 3]>,
    triangles: Vec<single::Triangle>,
}

impl Mesh {
    /// Ids are a shuffle of the indices, as welding gives no order.
    fn new(points: Vec<Vec3>, faces: Vec<[usize; 3]>, stream: &mut Stream) -> Self {
        let mut ids: Vec<u32> = (0..points.len() as u32).collect();
        for i in (1..ids.len()).rev() {
            ids.swap(i, stream.index(i + 1));
        }
        let triangle = |f: &[usize; 3]| single::Triangle {
            v0: points[f[0]],
            id0: ids[f[0]],
            v1: points[f[1]],
            id1: ids[f[1]],
            v2: points[f[2]],
            id2: ids[f[2]],
        };
        let triangles = faces.iter().map(triangle).collect();
        Self { points, faces, triangles }
    }

    /// How many triangles a ray hits in front of it.
    fn hits(&self, kernel: &mut single::Kernel<'_>, origin: Vec3, dir: Vec3) -> usize {
        let shear = kernel.triangle_shear(dir);
        let hit = |t: &&single::Triangle| kernel.triangle_intersect(**t, origin, shear).x > 0.0;
        self.triangles.iter().filter(hit).count()
    }
}

/// A unit direction from `origin` to `target`, rounded once.
fn towards(origin: Vec3, target: DVec3) -> Vec3 {
    (target - origin.as_dvec3()).normalize().as_vec3()
}

/// Six triangles around one vertex at `center`, size about 1, in any orientation, a little bent.
fn fan(center: DVec3, stream: &mut Stream) -> Mesh {
    let n = stream.direction();
    let (x, y) = n.any_orthonormal_pair();
    let mut points = vec![center.as_vec3()];
    for i in 0..6 {
        let angle = (f64::from(i) + stream.between(-0.3, 0.3)) * std::f64::consts::TAU / 6.0;
        let r = stream.between(0.6, 1.4);
        let rim = x * (r * angle.cos()) + y * (r * angle.sin()) + n * stream.between(-0.05, 0.05);
        points.push((center + rim).as_vec3());
    }
    let faces = (0..6).map(|i| [0, 1 + i, 1 + (i + 1) % 6]);
    let turn = stream.index(3);
    let faces = faces.map(|f| [f[turn], f[(turn + 1) % 3], f[(turn + 2) % 3]]).collect();
    Mesh::new(points, faces, stream)
}

/// An eye from which the fan is seen from its front or back, not edge-on.
fn eye(mesh: &Mesh, distance: f64, stream: &mut Stream) -> Vec3 {
    let p = |i: usize| mesh.points[i].as_dvec3();
    let n = (p(1) - p(3)).cross(p(5) - p(3)).normalize();
    loop {
        let d = stream.direction();
        if d.dot(n).abs() > 0.4 {
            return (p(0) + d * distance).as_vec3();
        }
    }
}

#[test]
fn a_fan_has_no_cracks_and_no_double_hits() {
    let bench = Bench::new();
    let mut kernel = bench.single();
    for distance in [1.0, 1e2, 1e4] {
        let mut stream = Stream::new(23, distance as u64);
        let (mut misses, mut doubles, mut rays) = (0, 0, 0);
        for _ in 0..600 {
            let mesh = fan(stream.direction() * stream.between(0.0, 3.0), &mut stream);
            let origin = eye(&mesh, distance, &mut stream);
            for k in 0..700 {
                let (a, b) = (mesh.points[0].as_dvec3(), mesh.points[1 + k % 6].as_dvec3());
                // A tenth at the vertex, the rest along the spokes.
                let along = if k < 70 { 0.0 } else { stream.between(0.0, 0.9) };
                let hits = mesh.hits(&mut kernel, origin, towards(origin, a + (b - a) * along));
                misses += usize::from(hits == 0);
                doubles += usize::from(hits > 1);
                rays += 1;
            }
        }
        assert_eq!((misses, doubles), (0, 0), "cracks and doubles of {rays} at {distance}");
    }
}

/// 242 vertices at radii 0.3 ..= 1.7 around the origin: closed, and seen as a star from the middle.
fn spiky(stream: &mut Stream) -> Mesh {
    let (rings, sectors) = (15, 16);
    let mut points = vec![DVec3::Z, DVec3::NEG_Z];
    for i in 0..rings {
        for j in 0..sectors {
            let theta = std::f64::consts::PI * (i + 1) as f64 / (rings + 1) as f64;
            let phi = std::f64::consts::TAU * j as f64 / sectors as f64;
            points.push(DVec3::new(theta.sin() * phi.cos(), theta.sin() * phi.sin(), theta.cos()));
        }
    }
    let points = points.into_iter().map(|p| (p * stream.between(0.3, 1.7)).as_vec3()).collect();
    let at = |i: usize, j: usize| 2 + i * sectors + j % sectors;
    let mut faces = Vec::new();
    for j in 0..sectors {
        faces.push([0, at(0, j), at(0, j + 1)]);
        faces.push([at(rings - 1, j), 1, at(rings - 1, j + 1)]);
        for i in 0..rings - 1 {
            faces.push([at(i, j), at(i + 1, j), at(i, j + 1)]);
            faces.push([at(i, j + 1), at(i + 1, j), at(i + 1, j + 1)]);
        }
    }
    Mesh::new(points, faces, stream)
}

/// A point on an edge, or a vertex, of `mesh`.
fn target(mesh: &Mesh, vertex: bool, stream: &mut Stream) -> DVec3 {
    let f = mesh.faces[stream.index(mesh.faces.len())];
    let turn = stream.index(3);
    let (a, b) = (mesh.points[f[turn]].as_dvec3(), mesh.points[f[(turn + 1) % 3]].as_dvec3());
    if vertex { a } else { a + (b - a) * stream.unit() }
}

#[test]
fn a_closed_mesh_is_hit_once_from_inside() {
    let bench = Bench::new();
    let mut kernel = bench.single();
    let mut stream = Stream::new(29, 0);
    let (mut rays, mut wrong) = (0, 0);
    for _ in 0..20 {
        let mesh = spiky(&mut stream);
        for k in 0..4000 {
            let dir = towards(Vec3::ZERO, target(&mesh, k % 4 == 0, &mut stream));
            wrong += usize::from(mesh.hits(&mut kernel, Vec3::ZERO, dir) != 1);
            rays += 1;
        }
    }
    assert_eq!(wrong, 0, "of {rays}");
}

/// Whoever looks from outside goes out as often as in.
#[test]
fn a_closed_mesh_is_hit_evenly_from_outside() {
    let bench = Bench::new();
    let mut kernel = bench.single();
    for distance in [3.0, 1e2, 1e4] {
        let mut stream = Stream::new(31, distance as u64);
        let mut odd = 0;
        for _ in 0..4 {
            let mesh = spiky(&mut stream);
            for k in 0..2500 {
                let origin = (stream.direction() * distance).as_vec3();
                let dir = towards(origin, target(&mesh, k % 4 == 0, &mut stream));
                odd += mesh.hits(&mut kernel, origin, dir) % 2;
            }
        }
        assert_eq!(odd, 0, "at distance {distance}");
    }
}

/// Rays along an axis through vertices and edges of a grid in the plane of the other two.
#[test]
fn axis_parallel_rays_hit_a_grid_once() {
    let bench = Bench::new();
    let mut kernel = bench.single();
    let mut stream = Stream::new(37, 0);
    let n = 8;
    for axis in 0..3 {
        let place = |x: f32, y: f32, z: f32| kernel_axes(axis, x, y, z);
        let points = (0..=n).flat_map(|i| (0..=n).map(move |j| (i, j)));
        let points = points.map(|(i, j)| place(i as f32, j as f32, 0.0)).collect();
        let mut faces = Vec::new();
        for i in 0..n {
            for j in 0..n {
                let a = i * (n + 1) + j;
                faces.push([a, a + n + 1, a + n + 2]);
                faces.push([a, a + n + 2, a + 1]);
            }
        }
        let mesh = Mesh::new(points, faces, &mut stream);
        // Every vertex and every middle of an edge inside the grid.
        for i in 1..2 * n {
            for j in 1..2 * n {
                for side in [-1.0, 1.0] {
                    let origin = place(i as f32 * 0.5, j as f32 * 0.5, 3.0 * side);
                    let hits = mesh.hits(&mut kernel, origin, place(0.0, 0.0, -side));
                    assert_eq!(hits, 1, "axis {axis}, {i} {j}, side {side}");
                }
            }
        }
    }
}

/// (x, y, z) with the axes turned round.
fn kernel_axes(axis: usize, x: f32, y: f32, z: f32) -> Vec3 {
    match axis {
        0 => Vec3::new(z, x, y),
        1 => Vec3::new(y, z, x),
        _ => Vec3::new(x, y, z),
    }
}

#[test]
fn a_ray_in_the_plane_of_a_triangle_misses_it() {
    let bench = Bench::new();
    let mut kernel = bench.single();
    let mut stream = Stream::new(41, 0);
    let corners = [(0.0, 0.0), (1.0, 0.125), (0.25, 0.75)];
    for axis in 0..3 {
        for _ in 0..20_000 {
            let points = corners.map(|(x, y)| kernel_axes(axis, x, y, 0.5)).to_vec();
            let mesh = Mesh::new(points, vec![[0, 1, 2]], &mut stream);
            let phi = stream.between(0.0, std::f64::consts::TAU);
            let origin = kernel_axes(axis, -3.0 * phi.cos() as f32, -3.0 * phi.sin() as f32, 0.5);
            let aim = kernel_axes(axis, 0.4, 0.3, 0.5);
            let dir = (aim - origin).normalize();
            assert_eq!(mesh.hits(&mut kernel, origin, dir), 0);
        }
    }
    // The plane x = y, with directions whose first two components are the same.
    for i in 0..1000 {
        let t = i as f32 / 1000.0;
        let points = vec![Vec3::ZERO, Vec3::new(1.0, 1.0, 0.25), Vec3::new(0.5, 0.5, 1.0)];
        let mesh = Mesh::new(points, vec![[0, 1, 2]], &mut stream);
        let origin = Vec3::new(-2.0, -2.0, t);
        let dir = (Vec3::new(0.5, 0.5, 0.4) - origin).normalize();
        assert_eq!(dir.x, dir.y);
        assert_eq!(mesh.hits(&mut kernel, origin, dir), 0);
    }
}

#[test]
fn triangles_without_area_are_never_hit() {
    let bench = Bench::new();
    let mut kernel = bench.single();
    let mut stream = Stream::new(43, 0);
    let p = Vec3::new(0.3, -0.7, 0.2);
    let shapes = [
        ([p, p, p], [0, 0, 0]),
        ([p, p * 2.0, p], [0, 1, 0]),
        ([Vec3::ZERO, Vec3::X, Vec3::X * 2.0], [0, 1, 2]),
    ];
    for ([v0, v1, v2], [id0, id1, id2]) in shapes {
        let tri = single::Triangle { v0, id0, v1, id1, v2, id2 };
        for _ in 0..20_000 {
            let origin = (stream.direction() * 2.0).as_vec3();
            let aim = v0 + (v1 - v0) * stream.unit24();
            let shear = kernel.triangle_shear((aim - origin).normalize());
            let hit = kernel.triangle_intersect(tri, origin, shear);
            // Collinear corners may be seen as a sliver by rounding; a hit is finite then.
            assert!(hit.is_finite() && (hit.x <= 0.0 || id0 != id2), "{hit}");
        }
    }
}

/// Distance and barycentric weights against the plane of the triangle in double precision.
#[test]
fn hits_are_where_the_plane_is() {
    let bench = Bench::new();
    let mut kernel = bench.single();
    let mut stream = Stream::new(47, 0);
    let (mut distance, mut weights) = (Worst::default(), Worst::default());
    for _ in 0..100_000 {
        let corners = [0; 3].map(|_| stream.direction() * stream.between(0.1, 1.0));
        let [v0, v1, v2] = corners.map(DVec3::as_vec3);
        let tri = single::Triangle { v0, id0: 5, v1, id1: 3, v2, id2: 9 };
        let n = (v1 - v0).as_dvec3().cross((v2 - v0).as_dvec3());
        let origin = (stream.direction() * 3.0).as_vec3();
        let (b1, b2) = (stream.unit() * 0.5, stream.unit() * 0.5);
        let aim = v0.as_dvec3() * (1.0 - b1 - b2) + v1.as_dvec3() * b1 + v2.as_dvec3() * b2;
        let dir = towards(origin, aim);
        let d = dir.as_dvec3();
        // Thin or edge-on triangles have a condition number of their own.
        if n.length() < 0.1 || d.dot(n).abs() < 0.1 * n.length() {
            continue;
        }
        let t = (v0.as_dvec3() - origin.as_dvec3()).dot(n) / d.dot(n);
        let shear = kernel.triangle_shear(dir);
        let hit = kernel.triangle_intersect(tri, origin, shear);
        assert!(hit.x > 0.0, "the ray was aimed at {b1} {b2}");
        distance.add((f64::from(hit.x) / t - 1.0).abs(), t);
        weights.add((f64::from(hit.y) - b1).abs().max((f64::from(hit.z) - b2).abs()), b1);
    }
    distance.check("distance", 2e-5);
    weights.check("weights", 1e-4);
}

/// A camera ray almost in a plane of 1e3 units: where it hits, the distance is right to a thousandth.
#[test]
fn grazing_hits_are_right_or_none() {
    let bench = Bench::new();
    let mut kernel = bench.single();
    let mut stream = Stream::new(53, 0);
    let corners = [(-500.0, -500.0), (1500.0, -500.0), (-500.0, 1500.0)];
    let [v0, v1, v2] = corners.map(|(x, y)| Vec3::new(x, y, 0.0));
    let tri = single::Triangle { v0, id0: 0, v1, id1: 1, v2, id2: 2 };
    for _ in 0..100_000 {
        let cos = 10.0_f64.powf(stream.between(-6.0, -1.0));
        let height = 400.0 * cos;
        let origin = Vec3::new(-300.0, -200.0, height as f32);
        let phi = stream.between(0.0, 1.5);
        let dir = DVec3::new(phi.cos(), phi.sin(), -cos).normalize().as_vec3();
        let truth = f64::from(origin.z) / -f64::from(dir.z);
        let shear = kernel.triangle_shear(dir);
        let hit = kernel.triangle_intersect(tri, origin, shear);
        let off = (f64::from(hit.x) / truth - 1.0).abs();
        assert!(hit.x < 0.0 || off < 1e-3, "cosine {cos}: {} instead of {truth}", hit.x);
    }
}

/// Hits of both precisions agree on which triangle of a record is hit where.
#[test]
fn records_reach_the_kernel_as_written() {
    let tri = Triangle {
        v0: [0.0, 0.0, 0.5],
        id0: 2,
        v1: [1.0, 0.0, 0.5],
        id1: 0,
        v2: [0.0, 1.0, 0.5],
        id2: 1,
    };
    let bench = Bench::new().triangles(&[tri]);
    let (mut single, mut double) = (bench.single(), bench.double());
    let ray = ray(Vec3::new(0.25, 0.25, 2.0), Vec3::NEG_Z);
    let hit = single.trace(ray);
    assert_eq!((hit.prim, hit.t, hit.b), (0, 1.5, glam::Vec2::splat(0.25)));
    assert_eq!(single.trace(single::Ray { skip: skip(0), ..ray }).prim, single::NONE);
    assert_eq!(single.trace(single::Ray { t_max: 1.4999, ..ray }).prim, single::NONE);
    let hit = double.trace(ray_double(DVec3::new(0.25, 0.25, 2.0), DVec3::NEG_Z));
    assert_eq!((hit.prim, hit.t), (0, 1.5));
}

/// A ray that passes through a point of a box is not told that it misses: inside, on a face, edge or corner.
#[test]
fn boxes_hold_every_ray_through_them() {
    let bench = Bench::new();
    let mut kernel = bench.single();
    let mut stream = Stream::new(59, 0);
    for k in 0..200_000 {
        let lo = stream.direction() * stream.between(0.0, 1.0);
        // Some boxes are flat.
        let size =
            [0; 3].map(|_| if stream.unit() < 0.2 { 0.0 } else { stream.between(1e-4, 1.0) });
        let (lo, hi) = (lo.as_vec3(), (lo + DVec3::from(size)).as_vec3());
        let inner = [0; 3].map(|_| stream.unit().mul_add(1.4, -0.2).clamp(0.0, 1.0) as f32);
        let aim = lo + (hi - lo) * Vec3::from(inner);
        let mut origin = (stream.direction() * stream.between(0.0, 5.0)).as_vec3();
        if k % 5 == 0 {
            origin.x = aim.x; // A direction with a component of 0.
        }
        let d = aim.as_dvec3() - origin.as_dvec3();
        let (t, dir) = (d.length(), d.normalize().as_vec3());
        let inverse = kernel.box_inverse(dir);
        assert!(inverse.is_finite());
        // Room for the rounding of `dir`, which moves the ray by 1e-7 of its length.
        let room = Vec3::splat(2.5e-7 * t as f32 + 1e-7);
        let enter =
            kernel.box_enter(lo - room, hi + room, origin, inverse, 0.0, t as f32 * 1.00001);
        assert!(enter <= t as f32 * 1.00001, "{lo} {hi} from {origin} to {aim}: {enter} of {t}");
    }
}
