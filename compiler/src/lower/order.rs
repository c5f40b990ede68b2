//! Primitives in leaf order, lights numbered, each primitive knowing its light.
//!
//! A triangle that was split is there once for each of its pieces, with everything it has: whichever
//! of them a ray meets, the answer is the same.

use pack::abi::{self, LightKind, NONE};

use super::geometry::Placement;
use super::light::{self, Geometry};
use super::lowered::Counters;
use crate::bvh::Joined;
use crate::weld::Welded;

/// Primitives in the normalised frame, in order of declaration.
pub(super) struct Declared {
    pub(super) corners: Vec<[[f32; 3]; 3]>,
    pub(super) welded: Welded,
    pub(super) balls: Vec<([f32; 3], f32)>,
}

/// Primitives as the pack stores them.
pub(super) struct Ordered {
    pub(super) triangles: Vec<abi::Triangle>,
    pub(super) shades: Vec<abi::TriShade>,
    pub(super) spheres: Vec<abi::Sphere>,
    pub(super) lights: Vec<abi::Light>,
    /// Of each emitter, whether it is a light.
    pub(super) selected: Vec<bool>,
    /// Where each triangle went; the first of several places.
    pub(super) triangle_at: Vec<u32>,
}

/// Renumbers everything to the leaf order of `joined`, shading data out of `placement`; `powers`: those of the
/// emitters.
pub(super) fn order(
    placement: &mut Placement,
    powers: &[f64],
    declared: Declared,
    joined: &Joined,
) -> Ordered {
    let Declared { corners, welded, balls } = declared;
    let triangle = |&i: &u32| {
        let [v0, v1, v2] = corners[i as usize];
        let [id0, id1, id2] = welded.ids[i as usize];
        abi::Triangle { v0, id0, v1, id1, v2, id2 }
    };
    let sphere = |&i: &u32| {
        let (center, radius) = balls[i as usize];
        let material = placement.sphere_materials[i as usize];
        let object = placement.sphere_objects[i as usize];
        abi::Sphere { center, radius, material, light: NONE, object, _pad0: 0 }
    };
    let triangles = joined.triangle_order.iter().map(triangle).collect();
    let spheres = joined.sphere_order.iter().map(sphere).collect();
    // They are as large as the pack: not all at once.
    drop((corners, welded));
    let shades = std::mem::take(&mut placement.shades);
    let n_triangles = shades.len();
    let mut ordered = Ordered {
        triangles,
        shades: joined.triangle_order.iter().map(|i| shades[*i as usize]).collect(),
        spheres,
        lights: Vec::new(),
        selected: Vec::new(),
        triangle_at: Vec::new(),
    };
    drop(shades);
    ordered.connect_lights(placement, n_triangles, powers, joined);
    ordered
}

impl Ordered {
    /// Notes how many there are of everything.
    pub(super) fn count(&self, counters: &mut Counters) {
        counters.references = self.triangles.len() as u64;
        counters.spheres = self.spheres.len() as u64;
        counters.lights = self.lights.len() as u64;
    }

    fn connect_lights(
        &mut self,
        placement: &Placement,
        n_triangles: usize,
        powers: &[f64],
        joined: &Joined,
    ) {
        let triangle_at = first_places(&joined.triangle_order, n_triangles);
        let sphere_at = first_places(&joined.sphere_order, placement.spheres.len());
        let geometry = Geometry {
            triangles: &self.triangles,
            triangle_at: &triangle_at,
            spheres: &self.spheres,
            sphere_at: &sphere_at,
        };
        let (lights, ids) = light::table(&placement.emitters, powers, &geometry);
        self.lights = lights;
        self.selected = ids.iter().map(|id| *id != NONE).collect();
        let mut light_of = vec![NONE; n_triangles];
        for (emitter, id) in placement.emitters.iter().zip(ids) {
            for primitive in emitter.primitive..emitter.primitive + emitter.count {
                if emitter.kind == LightKind::Sphere {
                    self.spheres[sphere_at[primitive as usize] as usize].light = id;
                } else {
                    light_of[primitive as usize] = id;
                }
            }
        }
        for (shade, &primitive) in self.shades.iter_mut().zip(&joined.triangle_order) {
            shade.light = light_of[primitive as usize];
        }
        self.triangle_at = triangle_at;
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
