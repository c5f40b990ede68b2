//! Single rays at moving meshes and balls.

#![expect(clippy::cast_possible_truncation, reason = "rounded to the precision of the kernel")]

use std::f64::consts::PI;
use std::fmt::Write as _;

use glam::{DVec3, Vec3};
use runtime::kernel::f32 as single;
use tests::kernel::{Bench, ray};
use tests::scene;
use tests::statistics::stream::Stream;

use crate::{LAMP, front, moving};

/// 242 corners at distances of 0.3 ..= 1.7 m, closed, seen as a star from the middle; triangles.
fn star(stream: &mut Stream) -> (Vec<DVec3>, Vec<[usize; 3]>) {
    let (rings, sectors) = (15, 16);
    let mut points = vec![DVec3::Z, DVec3::NEG_Z];
    for i in 1..=rings {
        for j in 0..sectors {
            let theta = PI * f64::from(i) / f64::from(rings + 1);
            let phi = 2.0 * PI * f64::from(j) / f64::from(sectors);
            points.push(DVec3::new(theta.sin() * phi.cos(), theta.sin() * phi.sin(), theta.cos()));
        }
    }
    let points = points.into_iter().map(|p| p * stream.between(0.3, 1.7)).collect();
    let (rings, sectors) = (15_usize, 16_usize);
    let at = |i: usize, j: usize| 2 + i * sectors + j % sectors;
    let mut faces = Vec::new();
    for j in 0..sectors {
        faces.push([0, at(0, j), at(0, j + 1)]);
        faces.push([at(rings - 1, j), 1, at(rings - 1, j + 1)]);
        for i in 0..rings - 1 {
            faces.push([at(i, j), at(i + 1, j), at(i + 1, j + 1)]);
            faces.push([at(i, j), at(i + 1, j + 1), at(i, j + 1)]);
        }
    }
    (points, faces)
}

/// The star as a mesh that moves by `travel` metres, compiled.
fn moving_star(
    points: &[DVec3],
    faces: &[[usize; 3]],
    travel: DVec3,
) -> compiler::pipeline::Compiled {
    let mut obj = String::new();
    for p in points {
        let _ = writeln!(obj, "v {} {} {}", p.x, p.y, p.z);
    }
    for [a, b, c] in faces {
        let _ = writeln!(obj, "f {} {} {}", a + 1, b + 1, c + 1);
    }
    let dir = tempfile::tempdir().expect("a temporary directory can be made");
    std::fs::write(dir.path().join("star.obj"), obj).expect("a mesh can be written");
    let place = moving("at", DVec3::ZERO, travel);
    let text = format!(
        "{LAMP}asset star = obj(\"star.obj\", unit: m, up: +y)
instance it {{ shape = star, material = lamp, {place} }}\n{}",
        front([16, 16], 5.0)
    );
    scene::compile_in(dir.path(), &text)
}

#[test]
fn a_moving_mesh_has_no_cracks() {
    let mut stream = Stream::new(41, 7);
    let (points, faces) = star(&mut stream);
    for travel in [DVec3::new(3.0, -2.0, 0.5), DVec3::new(0.0, 2e4, 0.0)] {
        let compiled = moving_star(&points, &faces, travel);
        let lowered = &compiled.lowered;
        let bench = Bench::new().shapes(lowered);
        let mut kernel = bench.single();
        let motion = Vec3::from(lowered.objects[0].motion);
        let corner = |i: usize, k: usize| {
            let t = &lowered.triangles[i];
            Vec3::from([t.v0, t.v1, t.v2][k % 3]).as_dvec3()
        };
        let n = lowered.triangles.len();
        let (render, center) = (&lowered.render, DVec3::from(lowered.render.center()));
        let middle = -center * render.scale();
        for k in 0..20_000 {
            let time = stream.between(0.0, 1.0) as f32;
            let shift = motion * time;
            let i = stream.index(n);
            let (a, b) = (corner(i, 0), corner(i, 1));
            // At edges, some of them at vertices.
            let along = if k % 5 == 0 { 0.0 } else { stream.between(0.0, 1.0) };
            let origin = middle.as_vec3() + shift;
            let target = a + (b - a) * along + shift.as_dvec3();
            let dir = (target - origin.as_dvec3()).normalize().as_vec3();
            let hit = kernel.trace(single::Ray { time, ..ray(origin, dir) });
            assert_ne!(hit.prim, single::NONE, "{travel}: a crack at {time}");
            let shear = kernel.triangle_shear(dir);
            let hits = (0..u32::try_from(n).expect("few")).filter(|i| {
                let triangle = kernel.load_triangle(*i);
                let start = kernel.dispatch_triangle_origin(*i, triangle.id0, origin, time);
                kernel.triangle_intersect(triangle, start, shear).x > 0.0
            });
            assert_eq!(hits.count(), 1, "{travel}: not one hit at {time}");
        }
    }
}

#[test]
fn fast_things_are_hit_wherever_they_are() {
    let mut stream = Stream::new(43, 1);
    let mut text = LAMP.to_owned();
    let mut place = || {
        let mut point = || stream.direction() * stream.between(0.0, 5.0);
        moving("at", point(), point() * 10.0)
    };
    for i in 0..60 {
        let shape = if i % 2 == 0 { "sphere(radius: 1mm)" } else { "box(size: (2, 2, 2)mm)" };
        let _ = writeln!(text, "instance i{i} {{ shape = {shape}, material = lamp, {} }}", place());
    }
    text += &front([16, 16], 5.0);
    let compiled = scene::compile(&text);
    let lowered = &compiled.lowered;
    assert!(!lowered.wide_nodes.is_empty());
    let bench = Bench::new().shapes(lowered);
    let mut kernel = bench.single();
    let of_ball = |s: &pack::abi::Sphere| (Vec3::from(s.center), s.object & !pack::abi::MOVES);
    let mut targets: Vec<(Vec3, u32)> = lowered.spheres.iter().map(of_ball).collect();
    // The middle of a box, of whose 12 triangles each has its share: a point on a face could be grazed.
    let mut middles = std::collections::BTreeMap::new();
    for (t, shade) in lowered.triangles.iter().zip(&lowered.shades) {
        let sum = Vec3::from(t.v0) + Vec3::from(t.v1) + Vec3::from(t.v2);
        *middles.entry(shade.object).or_insert(Vec3::ZERO) += sum / 36.0;
    }
    targets.extend(middles.into_iter().map(|(object, middle)| (middle, object)));
    for _ in 0..50_000 {
        let (point, object) = targets[stream.index(targets.len())];
        let time = stream.between(0.0, 1.0) as f32;
        let target = point + Vec3::from(lowered.objects[object as usize].motion) * time;
        let origin = stream.direction().as_vec3() * stream.between(0.0, 1.5) as f32;
        let way = target - origin;
        let hit = kernel.trace(single::Ray { time, ..ray(origin, way.normalize()) });
        assert!(
            hit.prim != single::NONE && hit.t <= way.length() * 1.001,
            "{target} at {time}: {hit:?}, {object}, {}",
            way.length()
        );
    }
}
