//! Which lights cannot be seen from where paths of the camera come: a pass of its own, before the tree of lights is
//! made.
//!
//! A tree that knows distance, direction and power alone sends most samples to strong lights behind walls. So paths are
//! traced from the camera, and each light asks points of them whether it reaches one, in one straight line or over one
//! more surface. A light that never does keeps [`HIDDEN`] of its power in the tree, and what it gives off is not
//! touched: sampling stays unbiased, whatever the pass has missed. Lights that are seen once are not touched either.
//!
//! It is a pure function of the scene: numbers come from a hash of light and round, not from the seed of the picture,
//! so that pictures of one pack merge. Errs on the side of seen: all that is not opaque is open, and so is a light from
//! which a ray leaves a scene that paths leave too.

use std::f64::consts::PI;

use glam::DVec3;
use pack::abi::{self, LightKind, material_flag};
use rayon::prelude::*;

use super::camera;
use super::material::MaterialTable;
use super::occlusion::{Hit, Occluders};
use super::world::Sections;
use crate::stage::{Key, KeyOf, Stages};

/// Share of its power that a hidden light keeps in the tree.
pub(super) const HIDDEN: f64 = 1.0 / 128.0;
/// Share of all power that hidden lights must have: below it they take few samples.
const PAYS: f64 = 0.05;

/// Camera paths, and their segments at most.
const PATHS: u32 = 4096;
const SEGMENTS: u32 = 8;
/// Rounds of each light, of three rays or fewer: by its share of the power, within these limits.
const ROUNDS: f64 = 262_144.0;
const FEWEST: f64 = 32.0;
const MOST: f64 = 1024.0;
/// Points of which the nearest to a light is asked.
const CLOSEST_OF: u32 = 8;
/// Beyond every point of a scene of radius 1.
const FAR: f64 = 8.0;
/// Rays start this far off a surface, of a scene of radius 1.
const OFF: f64 = 1e-6;

/// A point of a path.
struct Point {
    p: DVec3,
    /// 0 where light may come from both sides.
    normal: DVec3,
}

/// Where paths of the camera come.
struct Paths {
    points: Vec<Point>,
    /// Some leave the scene.
    leaves: bool,
}

/// What the pass reads, beside the sections.
pub(super) struct Scene<'a> {
    pub(super) camera: &'a abi::Camera,
    pub(super) materials: &'a MaterialTable<'a>,
    pub(super) lights: &'a [abi::Light],
    /// Names all geometry.
    pub(super) world: Key,
    pub(super) stages: &'a Stages,
}

/// Of each light, whether it is hidden; empty where none is worth the name.
pub(super) fn lights(scene: &Scene<'_>, sections: &Sections) -> Vec<bool> {
    let records = scene.materials.records();
    let opaque = scene.materials.opaque();
    let mut key = KeyOf::stage("visibility of lights");
    key.key(scene.world).bytes(bytemuck::bytes_of(scene.camera));
    for (material, opaque) in records.iter().zip(&opaque) {
        key.number(*opaque).number(material.flags & material_flag::EMIT_BOTH_SIDES);
    }
    for light in scene.lights {
        key.bytes(bytemuck::bytes_of(&abi::Light { trail: 0, primitive: 0, ..*light }));
    }
    scene.stages.value(key.end(), || {
        let occluders = Occluders::new(sections, &opaque);
        let paths = paths(scene.camera, &occluders);
        let lights = scene.lights.par_iter().enumerate();
        let hidden: Vec<bool> = lights
            .map(|(i, light)| {
                let flags = records.get(light.material as usize).map_or(0, |m| m.flags);
                let both_sides = flags & material_flag::EMIT_BOTH_SIDES != 0;
                light.has_surface() && !seen(i as u32, light, both_sides, &paths, &occluders)
            })
            .collect();
        let power = |light: &abi::Light| f64::from(light.pmf);
        let all: f64 = scene.lights.iter().map(power).sum();
        let lost: f64 =
            scene.lights.iter().zip(&hidden).filter(|(_, h)| **h).map(|(l, _)| power(l)).sum();
        if lost > PAYS * all { hidden } else { Vec::new() }
    })
}

/// Independent numbers: pcg4d of Jarzynski & Olano 2020, as in `sampler/pcg.wgsl`.
struct Numbers([u32; 4]);

impl Numbers {
    fn of(light: u32, round: u32) -> Self {
        Self([light, round, 0, 0x6c69_6768])
    }

    fn words(&mut self) -> [u32; 4] {
        self.0[2] = self.0[2].wrapping_add(1);
        let [mut x, mut y, mut z, mut w] =
            self.0.map(|v| v.wrapping_mul(1_664_525).wrapping_add(1_013_904_223));
        for shift in [16, 32] {
            x = x.wrapping_add(y.wrapping_mul(w));
            y = y.wrapping_add(z.wrapping_mul(x));
            z = z.wrapping_add(x.wrapping_mul(y));
            w = w.wrapping_add(y.wrapping_mul(z));
            if shift == 16 {
                [x, y, z, w] = [x, y, z, w].map(|v| v ^ (v >> 16));
            }
        }
        [x, y, z, w]
    }

    /// Two numbers in 0 .. 1.
    fn pair(&mut self) -> [f64; 2] {
        let [x, y, ..] = self.words();
        [x, y].map(|v| f64::from(v) / 4_294_967_296.0)
    }

    /// Uniform on the unit sphere.
    fn direction(&mut self) -> DVec3 {
        let [u, v] = self.pair();
        let z = 1.0 - 2.0 * u;
        let s = (1.0 - z * z).max(0.0).sqrt();
        DVec3::new(s * libm::cos(2.0 * PI * v), s * libm::sin(2.0 * PI * v), z)
    }

    /// By the cosine with the unit vector `normal`; a unit vector.
    fn scattered(&mut self, normal: DVec3) -> DVec3 {
        (normal + self.direction()).try_normalize().unwrap_or(normal)
    }
}

/// Traces paths that every surface scatters alike.
fn paths(camera: &abi::Camera, occluders: &Occluders<'_>) -> Paths {
    let traced: Vec<(Vec<Point>, bool)> = (0..PATHS)
        .into_par_iter()
        .map(|path| {
            let mut numbers = Numbers::of(u32::MAX, path);
            let [mut p, mut dir] = camera::ray(camera, numbers.pair().map(|u| 2.0 * u - 1.0));
            let mut points = Vec::new();
            for _ in 0..SEGMENTS {
                let Some(hit) = occluders.nearest(p, dir, [OFF, FAR]) else {
                    return (points, true);
                };
                p += dir * hit.t;
                points.push(Point { p, normal: facing(&hit) });
                // What is not opaque scatters to both sides, and often straight on.
                let [through, side] = numbers.pair();
                if hit.opaque || through < 0.25 {
                    let back = !hit.opaque && side < 0.5;
                    dir = numbers.scattered(if back { -hit.normal } else { hit.normal });
                }
            }
            (points, false)
        })
        .collect();
    let leaves = traced.iter().any(|(_, leaves)| *leaves);
    Paths { points: traced.into_iter().flat_map(|(points, _)| points).collect(), leaves }
}

/// The side from which light comes to what is opaque.
fn facing(hit: &Hit) -> DVec3 {
    if hit.opaque { hit.normal } else { DVec3::ZERO }
}

/// Whether light `i` reaches a path in any of its rounds.
fn seen(
    i: u32,
    light: &abi::Light,
    both_sides: bool,
    paths: &Paths,
    occluders: &Occluders<'_>,
) -> bool {
    let rounds = (ROUNDS * f64::from(light.pmf)).clamp(FEWEST, MOST) as u32;
    paths.points.is_empty()
        || (0..rounds).any(|round| {
            let mut numbers = Numbers::of(i, round);
            let from = emitter_point(light, both_sides, &mut numbers);
            let near = round % 2 == 1;
            let to = paths.point(from.p, near, &mut numbers);
            reaches(&from, to, occluders) || {
                let dir = numbers.scattered(from.normal);
                reaches_over(&from, dir, paths, occluders, &mut numbers)
            }
        })
}

impl Paths {
    /// A point of a path: any, or the closest to `p` of some.
    fn point(&self, p: DVec3, near: bool, numbers: &mut Numbers) -> &Point {
        let n = if near { CLOSEST_OF } else { 1 };
        let any = |numbers: &mut Numbers| {
            let at = numbers.pair()[0] * self.points.len() as f64;
            &self.points[(at as usize).min(self.points.len() - 1)]
        };
        let first = any(numbers);
        (1..n).fold(first, |best, _| {
            let other = any(numbers);
            let closer = (other.p - p).length_squared() < (best.p - p).length_squared();
            if closer { other } else { best }
        })
    }
}

/// A point that emits, uniform on the light, and the normal of the side to which it does.
fn emitter_point(light: &abi::Light, both_sides: bool, numbers: &mut Numbers) -> Point {
    let of = |v: [f32; 3]| DVec3::from(v.map(f64::from));
    if light.kind == LightKind::Sphere as u32 {
        let normal = numbers.direction();
        return Point { p: of(light.origin) + normal * f64::from(light.edge1[0]), normal };
    }
    let [mut u, mut v] = numbers.pair();
    if light.kind == LightKind::Triangle as u32 && u + v > 1.0 {
        (u, v) = (1.0 - u, 1.0 - v);
    }
    let (e1, e2) = (of(light.edge1), of(light.edge2));
    let normal = e1.cross(e2).try_normalize().unwrap_or(DVec3::Y);
    let turned = both_sides && numbers.pair()[0] < 0.5;
    Point { p: of(light.origin) + e1 * u + e2 * v, normal: if turned { -normal } else { normal } }
}

/// Whether light goes from one point to the other.
fn reaches(from: &Point, to: &Point, occluders: &Occluders<'_>) -> bool {
    let way = to.p - from.p;
    let two_sided = |point: &Point| point.normal == DVec3::ZERO;
    (two_sided(from) || from.normal.dot(way) > 0.0)
        && (two_sided(to) || to.normal.dot(way) < 0.0)
        && occluders.sees(from.p + from.normal * OFF, to.p + to.normal * OFF)
}

/// Whether light that leaves along `dir` comes to a path from the next surface, or leaves the scene as paths do.
fn reaches_over(
    from: &Point,
    dir: DVec3,
    paths: &Paths,
    occluders: &Occluders<'_>,
    numbers: &mut Numbers,
) -> bool {
    let mut p = from.p;
    for _ in 0..SEGMENTS {
        let Some(hit) = occluders.nearest(p, dir, [OFF, FAR]) else { return paths.leaves };
        p += dir * hit.t;
        let point = Point { p, normal: facing(&hit) };
        if reaches(&point, paths.point(p, true, numbers), occluders) {
            return true;
        }
        if hit.opaque {
            return false;
        }
    }
    false
}
