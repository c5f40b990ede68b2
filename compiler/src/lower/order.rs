//! Primitives in leaf order, each knowing its light.
//!
//! A triangle that was split is there once for each of its pieces, with everything it has: whichever
//! of them a ray meets, the answer is the same.

use pack::abi::{self, LightKind, NONE};
use rayon::prelude::*;

use super::geometry::Placement;
use super::light::Geometry;
use crate::bvh::Joined;
use crate::weld::Welded;

/// Triangles in the normalised frame, in order of declaration.
pub(super) struct Declared {
    pub(super) corners: Vec<[[f32; 3]; 3]>,
    pub(super) welded: Welded,
}

/// Primitives as the pack stores them.
pub(super) struct Ordered {
    pub(super) triangles: Vec<abi::Triangle>,
    pub(super) shades: Vec<abi::TriShade>,
    pub(super) colors: Vec<abi::VertexColors>,
    pub(super) spheres: Vec<abi::Sphere>,
    /// Of emitters that are lights, their records without how they are chosen.
    pub(super) lights: Vec<abi::Light>,
    /// Where each triangle went; the first of several places.
    pub(super) triangle_at: Vec<u32>,
}

/// Renumbers everything to the leaf order of `joined`, shading data out of `placement`; `ids`: the light of each
/// emitter, or `NONE`.
pub(super) fn order(
    placement: &mut Placement,
    ids: &[u32],
    declared: Declared,
    joined: &Joined,
) -> Ordered {
    let Declared { corners, welded } = declared;
    let triangle = |&i: &u32| {
        let [v0, v1, v2] = corners[i as usize];
        let [id0, id1, id2] = welded.ids[i as usize];
        abi::Triangle { v0, id0, v1, id1, v2, id2 }
    };
    let sphere = |&i: &u32| {
        let (center, radius) = placement.spheres[i as usize];
        let material = placement.sphere_materials[i as usize];
        let object = placement.sphere_objects[i as usize];
        abi::Sphere { center, radius, material, light: NONE, object, _pad0: 0 }
    };
    let triangles = joined.triangle_order.par_iter().map(triangle).collect();
    let spheres = joined.sphere_order.iter().map(sphere).collect();
    // They are as large as the pack: not all at once.
    drop((corners, welded));
    let shades = std::mem::take(&mut placement.shades);
    let colors = std::mem::take(&mut placement.colors);
    let color = |i: &u32| colors.get(*i as usize).copied();
    let n_triangles = shades.len();
    let mut ordered = Ordered {
        triangles,
        shades: joined.triangle_order.par_iter().map(|i| shades[*i as usize]).collect(),
        colors: joined.triangle_order.iter().filter_map(color).collect(),
        spheres,
        lights: Vec::new(),
        triangle_at: Vec::new(),
    };
    drop((shades, colors));
    ordered.connect_lights(placement, n_triangles, ids, joined);
    ordered
}

impl Ordered {
    fn connect_lights(
        &mut self,
        placement: &Placement,
        n_triangles: usize,
        ids: &[u32],
        joined: &Joined,
    ) {
        let triangle_at = first_places(&joined.triangle_order, n_triangles);
        let sphere_at = first_places(&joined.sphere_order, placement.spheres.len());
        let mut light_of = vec![NONE; n_triangles];
        let mut lights = Vec::new();
        for (emitter, &id) in placement.emitters.iter().zip(ids).filter(|(_, id)| **id != NONE) {
            let geometry = Geometry {
                triangles: &self.triangles,
                triangle_at: &triangle_at,
                spheres: &self.spheres,
                sphere_at: &sphere_at,
            };
            lights.push(geometry.light(emitter));
            for primitive in emitter.primitive..emitter.primitive + emitter.count {
                if emitter.kind == LightKind::Sphere {
                    self.spheres[sphere_at[primitive as usize] as usize].light = id;
                } else {
                    light_of[primitive as usize] = id;
                }
            }
        }
        let shades = self.shades.par_iter_mut().zip(&joined.triangle_order);
        shades.for_each(|(shade, &primitive)| shade.light = light_of[primitive as usize]);
        (self.lights, self.triangle_at) = (lights, triangle_at);
    }
}

/// Where each of `n` primitives went; the first of several places.
fn first_places(order: &[u32], n: usize) -> Vec<u32> {
    let mut at = vec![NONE; n];
    for (new, &old) in (0..).zip(order) {
        let place = &mut at[old as usize];
        *place = new.min(*place);
    }
    at
}
