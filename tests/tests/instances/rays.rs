//! Rays in scenes with instances, against every triangle of every instance, in double precision, and against the
//! offset with which rays leave surfaces.

#![expect(clippy::cast_possible_truncation, reason = "times of rays are rounded once")]

use std::collections::BTreeSet;
use std::fmt::Write as _;

use compiler::pipeline::Compiled;
use glam::{DMat3, DVec3, UVec2, Vec2, Vec3};
use pack::abi::{ChildRef, Instance, MOVES, NONE, TRI_SMOOTH};
use pack::bvh::InnerNode;
use runtime::kernel::f32 as single;
use tests::console;
use tests::kernel::{Bench, ray};
use tests::scene;
use tests::statistics::stream::Stream;

/// A closed bent tube, and a field of it: stretched, sheared by groups, mirrored, some of them moving.
fn field(n: usize, stream: &mut Stream) -> Compiled {
    let dir = tempfile::tempdir().expect("a temporary directory can be made");
    let (around, along) = (12, 18);
    let mut text = String::from("s off\n");
    for j in 0..along {
        let (sin, cos) = (std::f64::consts::TAU * f64::from(j) / f64::from(along)).sin_cos();
        for i in 0..around {
            let (s, c) = (std::f64::consts::TAU * f64::from(i) / f64::from(around)).sin_cos();
            let radius = 1.0 + (0.3 + 0.05 * cos) * c;
            let [x, y, z] = [radius * cos, 0.35 * s + 0.2 * (3.0 * sin).sin(), radius * sin];
            writeln!(text, "v {x} {y} {z}").expect("strings take all");
        }
    }
    for j in 0..along {
        for i in 0..around {
            let at = |i: i32, j: i32| (j % along) * around + i % around + 1;
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            writeln!(text, "f {a} {b} {c}\nf {a} {c} {d}").expect("strings take all");
        }
    }
    std::fs::write(dir.path().join("tube.obj"), text).expect("a mesh can be written");
    let mut text = String::from(
        "rts 1\nsky day: constant { color = linear(1) }\nmaterial clay: diffuse { color = linear(0.5) }\n\
         asset tube = obj(\"tube.obj\", unit: m, up: +y)\n\
         object wide { shape = tube, rotate = (0, 20, 50)deg, scale = (0.5, 1.4, 0.8) }\n\
         instance floor { shape = box(size: (30, 1, 30)m), material = clay, at = (0, -4, 0)m }\n",
    );
    for i in 0..n {
        let shape = if i % 3 == 0 { "wide" } else { "tube" };
        let mut number = |lo, hi| stream.between(lo, hi);
        let [x, y, z] = [number(-9.0, 9.0), number(-2.0, 6.0), number(-9.0, 9.0)];
        let [a, b, c] = [number(0.0, 360.0), number(0.0, 360.0), number(0.0, 360.0)];
        let [p, q, r] = [number(0.2, 1.5), number(0.2, 1.5), number(0.2, 1.5)];
        let sign = if i % 2 == 0 { "" } else { "-" };
        let way = if i % 5 == 0 { ", velocity = (40, 90, -30)m/s" } else { "" };
        writeln!(
            text,
            "instance t{i} {{ shape = {shape}, material = clay, at = ({x:.4}, {y:.4}, {z:.4})m, \
             rotate = ({a:.3}, {b:.3}, {c:.3})deg, scale = ({sign}{p:.4}, {q:.4}, {r:.4}){way} }}"
        )
        .expect("strings take all");
    }
    text += "camera eye: perspective { from = (0, 3, 20)m, to = (0, 0, 0)m, fov.vertical = 40deg, shutter = 0ms..20ms }
film f { size = (8, 8)px }
render main: path { camera = eye, film = f, samples = 1, depth = 3, seed = 1 }\n";
    scene::compile_in(dir.path(), &text)
}

/// Every triangle of the world by instance, or none, and index.
fn all(compiled: &Compiled) -> Vec<(u32, u32)> {
    let lowered = &compiled.lowered;
    let mut of_mesh = BTreeSet::new();
    let mut triangles = Vec::new();
    for (i, instance) in (0..).zip(&lowered.instances) {
        let mut stack = vec![instance.root];
        while let Some(word) = stack.pop() {
            match ChildRef::decode(word) {
                ChildRef::Inner(node) => match lowered.wide_nodes.get(node as usize) {
                    Some(wide) => stack.extend(InnerNode::children(wide)),
                    None => stack.extend(lowered.nodes[node as usize].children()),
                },
                ChildRef::Triangles { first, count } => {
                    triangles.extend((first..first + count).map(|prim| (i, prim)));
                    of_mesh.extend(first..first + count);
                }
                _ => panic!("a mesh has nodes and triangles"),
            }
        }
    }
    let n = u32::try_from(lowered.triangles.len()).expect("few triangles");
    triangles.extend((0..n).filter(|prim| !of_mesh.contains(prim)).map(|prim| (NONE, prim)));
    triangles
}

/// The nearest hit of `ray` by trying all triangles with the kernel's own test in the kernel's own frames.
fn brute(kernel: &mut single::Kernel<'_>, triangles: &[(u32, u32)], ray: single::Ray) -> f32 {
    let mut best = single::RAY_FAR;
    let mut inner = (NONE, ray, kernel.triangle_shear(ray.dir));
    for &(instance, prim) in triangles {
        if instance != inner.0 {
            let seen = if instance == NONE { ray } else { kernel.instance_ray(instance, ray) };
            inner = (instance, seen, kernel.triangle_shear(seen.dir));
        }
        let tri = kernel.load_triangle(prim);
        let t = kernel.triangle_intersect(tri, inner.1.origin, inner.2).x;
        if t > 0.0 && t < best {
            best = t;
        }
    }
    best
}

#[test]
fn no_ray_misses_what_trying_everything_finds() {
    let mut stream = Stream::new(311, 0);
    let compiled = field(40, &mut stream);
    let (lowered, triangles) = (&compiled.lowered, all(&compiled));
    assert_eq!(lowered.counters.instances, 40);
    assert!(lowered.instances.iter().any(|i| i.object & MOVES != 0));
    let bench = Bench::new().shapes(lowered);
    let mut kernel = bench.single();
    let (mut met, mut in_instances) = (0, 0);
    let n = 100_000;
    for k in 0..n {
        let origin = (stream.direction() * stream.between(0.0, 1.2)).as_vec3();
        // Half of them at the box of some instance.
        let dir = if k % 2 == 0 {
            let instance = &lowered.instances[stream.index(40)];
            let target = vector(instance.center) + stream.direction() * 0.03;
            (target - origin.as_dvec3()).normalize().as_vec3()
        } else if k % 10 == 1 {
            // Along an axis.
            let mut dir = Vec3::ZERO;
            dir[stream.index(3)] = if stream.unit() < 0.5 { 1.0 } else { -1.0 };
            dir
        } else {
            stream.direction().as_vec3()
        };
        let ray = single::Ray { time: stream.between(0.0, 1.0) as f32, ..ray(origin, dir) };
        let hit = kernel.trace(ray);
        let t = brute(&mut kernel, &triangles, ray);
        let found = if hit.prim == NONE { single::RAY_FAR } else { hit.t };
        assert_eq!(
            found.to_bits(),
            t.to_bits(),
            "ray {k} from {origin} along {dir}: {hit:?}, but {t}"
        );
        met += usize::from(hit.prim != NONE);
        in_instances += usize::from(hit.instance != NONE);
    }
    console::line(&format!("{met} of {n} rays met something, {in_instances} of them instances"));
    assert!(met > n / 3 && in_instances > n / 5);
}

fn vector(v: [f32; 3]) -> DVec3 {
    DVec3::from(v.map(f64::from))
}

/// World from the frame of `instance`, in double precision.
fn matrix(i: &Instance) -> DMat3 {
    DMat3::from_cols(vector(i.col_x), vector(i.col_y), vector(i.col_z))
}

/// A surface point in the world is where the map puts it, its normal stands on the triangle there, towards the side
/// that is the front in the file, and no ray that leaves it meets its own triangle, skipped or not, within the
/// size of its rounding.
#[test]
fn surfaces_of_instances_are_where_and_as_the_map_says() {
    let mut stream = Stream::new(317, 0);
    let compiled = field(60, &mut stream);
    let (lowered, triangles) = (&compiled.lowered, all(&compiled));
    let bench = Bench::new().shapes(lowered);
    let mut kernel = bench.single();
    let of_instances: Vec<_> = triangles.into_iter().filter(|t| t.0 != NONE).collect();
    let (mut far, mut own_hits, mut near) = (0.0_f64, 0, 0);
    let n = 40_000;
    for _ in 0..n {
        let (instance, prim) = of_instances[stream.index(of_instances.len())];
        let record = &lowered.instances[instance as usize];
        let (x, y) = (stream.unit24(), stream.unit24());
        let b = if x + y > 1.0 { Vec2::new(1.0 - x, 1.0 - y) } else { Vec2::new(x, y) };
        let time = stream.between(0.0, 1.0) as f32;
        let dir = stream.direction().as_vec3();
        let hit = single::Hit { t: 1.0, prim, b, instance };
        let s = kernel.instance_surface(hit, dir, time);
        // Where it is, in double precision.
        let t = &lowered.triangles[prim as usize];
        let [v0, v1, v2] = [t.v0, t.v1, t.v2].map(vector);
        let (bx, by) = (f64::from(b.x), f64::from(b.y));
        let q = v0 * (1.0 - bx - by) + v1 * bx + v2 * by;
        let object = &lowered.objects[(record.object & !MOVES) as usize];
        let m = matrix(record);
        let p = m * q + vector(record.center) + vector(object.motion) * f64::from(time);
        let normal = (m.inverse().transpose() * (v1 - v0).cross(v2 - v0)).normalize();
        assert!(s.ng.as_dvec3().dot(normal).abs() > 1.0 - 1e-6);
        assert_eq!(s.front, normal.dot(dir.as_dvec3()) <= 0.0);
        assert!(s.ng.dot(dir) <= 0.0);
        far = far.max((s.p.as_dvec3() - p).dot(normal).abs() / f64::from(s.ray_offset));
        // A ray that leaves, on either side, at any angle.
        let cos = 10.0_f64.powf(stream.between(-4.0, 0.0));
        let side = normal.cross(stream.direction()).normalize();
        let sign = if stream.unit() < 0.5 { 1.0 } else { -1.0 };
        let out = (normal * (sign * cos) + side * (1.0 - cos * cos).sqrt()).normalize().as_vec3();
        let origin = kernel.ray_offset_origin(s.p, s.ng * s.ray_offset, out);
        let leaving = single::Ray { time, ..ray(origin, out) };
        let inner = kernel.instance_ray(instance, leaving);
        let shear = kernel.triangle_shear(inner.dir);
        let tri = kernel.load_triangle(prim);
        own_hits += usize::from(kernel.triangle_intersect(tri, inner.origin, shear).x > 0.0);
        // With the skip nothing of the same surface is met at once.
        let again = kernel.trace(single::Ray { skip: UVec2::new(prim, instance), ..leaving });
        let close = again.prim != NONE && again.instance == instance && again.prim == prim;
        near += usize::from(close);
    }
    console::line(&format!(
        "{far:.3} of the offset off the surface; {own_hits} of {n} met their own triangle"
    ));
    assert!(far < 0.5, "points are {far} of the offset off their surface");
    assert_eq!((own_hits, near), (0, 0));
}

/// The same triangle of another instance is another triangle; the same one is skipped in every frame.
#[test]
fn what_is_skipped_is_a_triangle_of_one_instance() {
    let mut stream = Stream::new(331, 0);
    let compiled = field(8, &mut stream);
    let lowered = &compiled.lowered;
    let bench = Bench::new().shapes(lowered);
    let mut kernel = bench.single();
    let mut met = 0;
    for _ in 0..20_000 {
        let target = vector(lowered.instances[stream.index(8)].center) + stream.direction() * 0.05;
        let origin = stream.direction() * 1.1;
        let from = ray(origin.as_vec3(), (target - origin).normalize().as_vec3());
        let hit = kernel.trace(from);
        if hit.prim == NONE || hit.instance == NONE {
            continue;
        }
        met += 1;
        let same = kernel.trace(single::Ray { skip: UVec2::new(hit.prim, hit.instance), ..from });
        assert!(same.prim != hit.prim || same.instance != hit.instance);
        assert!(same.t > hit.t || same.prim == NONE);
        let other = (hit.instance + 1) % 8;
        let kept = kernel.trace(single::Ray { skip: UVec2::new(hit.prim, other), ..from });
        assert_eq!(
            (kept.prim, kept.instance, kept.t.to_bits()),
            (hit.prim, hit.instance, hit.t.to_bits())
        );
        let world = kernel.trace(single::Ray { skip: UVec2::new(hit.prim, NONE), ..from });
        assert_eq!((world.prim, world.instance), (hit.prim, hit.instance));
    }
    assert!(met > 1000, "{met}");
    let flat = lowered.shades.iter().filter(|shade| shade.object & !TRI_SMOOTH == 0).count();
    assert!(flat > 0, "there are triangles of the world, too");
}
