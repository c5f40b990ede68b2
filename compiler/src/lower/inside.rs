//! Which things the camera is inside of, and which of them overlap without saying which counts.
//!
//! Looks at placed geometry, metres. It does not know whether meshes are closed: `closed` does.

use std::collections::BTreeMap;

use glam::DVec3;
use lang::diagnostic::{Code, Diagnostic};
use lang::scene::Scene;
use pack::abi::{self, NONE};
use serde::{Deserialize, Serialize};

use super::object::Thing;

/// Steepest way up that is unlikely to lie in a plane of the scene. Up, so that a camera below a sea
/// without a bottom is found to be in the water.
const UP: DVec3 = DVec3::new(0.012_3, 1.0, 0.023_1);

/// A thing whose material has an inside.
struct Solid {
    material: u32,
    lo: DVec3,
    hi: DVec3,
    /// Surfaces between the camera and the sky.
    crossings: u32,
    /// Distance to the first of them, in lengths of `UP`.
    nearest: f64,
}

impl Solid {
    fn new(material: u32) -> Self {
        let (lo, hi) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        Self { material, lo, hi, crossings: 0, nearest: f64::INFINITY }
    }

    fn cross(&mut self, t: f64) {
        self.crossings += 1;
        self.nearest = self.nearest.min(t);
    }

    fn grow(&mut self, p: DVec3) {
        self.lo = self.lo.min(p);
        self.hi = self.hi.max(p);
    }
}

/// A surface of a thing whose material has an inside, world frame, metres.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Boundary {
    /// Index into `Bodies::things`.
    object: u32,
    material: u32,
    form: Form,
}

#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
enum Form {
    Triangle([[f64; 3]; 3]),
    Sphere { center: [f64; 3], radius: f64 },
}

impl Boundary {
    pub(super) fn triangle(corners: &[DVec3; 3], material: u32, object: u32) -> Self {
        let form = Form::Triangle(corners.map(|p| p.to_array()));
        Self { object, material, form }
    }

    pub(super) fn sphere(center: DVec3, radius: f64, material: u32, object: u32) -> Self {
        let form = Form::Sphere { center: center.to_array(), radius };
        Self { object, material, form }
    }
}

/// Things of the scene whose materials have an inside, by their index in `Bodies::things`.
pub(super) struct Solids(BTreeMap<u32, Solid>);

impl Solids {
    /// The things with these surfaces, as seen from `eye`.
    pub(super) fn new(boundaries: &[Boundary], eye: DVec3) -> Self {
        let mut solids = BTreeMap::new();
        for Boundary { object, material, form } in boundaries {
            let solid = solids.entry(*object).or_insert_with(|| Solid::new(*material));
            let crossing = match form {
                Form::Triangle(corners) => {
                    let corners = corners.map(DVec3::from);
                    for p in corners {
                        solid.grow(p);
                    }
                    hit_triangle(&corners, eye)
                }
                Form::Sphere { center, radius } => {
                    let center = DVec3::from(*center);
                    solid.grow(center - *radius);
                    solid.grow(center + *radius);
                    leave_sphere(center, *radius, eye)
                }
            };
            if let Some(t) = crossing {
                solid.cross(t);
            }
        }
        Self(solids)
    }

    /// Materials inside of which the camera is, the one that counts first, then `NONE`. Warns where
    /// they are more than can be remembered.
    pub(super) fn around_camera(
        &self,
        scene: &Scene,
        materials: &[abi::Material],
        diagnostics: &mut Vec<Diagnostic>,
    ) -> [u32; 4] {
        let mut around: Vec<&Solid> =
            self.0.values().filter(|solid| solid.crossings % 2 == 1).collect();
        around.sort_by(|a, b| a.nearest.total_cmp(&b.nearest));
        let priority = |solid: &Solid| materials[solid.material as usize].priority;
        around.sort_by_key(|solid| std::cmp::Reverse(priority(solid)));
        if around.len() > 4 {
            let text = format!("the camera is inside of {} things at once", around.len());
            let warning = Diagnostic::warning(Code("W0527"), "deep_camera", text)
                .at(scene.camera.name.span, "only four are remembered");
            diagnostics.push(warning);
        }
        let mut inside = [NONE; 4];
        for (slot, solid) in inside.iter_mut().zip(around) {
            *slot = solid.material;
        }
        inside
    }

    /// Warns of things of different materials and equal priority that may overlap: what is there
    /// would depend on the side from which light comes.
    pub(super) fn warn_of_overlaps(
        &self,
        things: &[Thing],
        materials: &[abi::Material],
        scene: &Scene,
        diagnostics: &mut Vec<Diagnostic>,
    ) {
        const MOST: usize = 8; // warnings; more of them help nobody
        let mut order: Vec<(&u32, &Solid)> = self.0.iter().collect();
        order.sort_by(|a, b| a.1.lo.x.total_cmp(&b.1.lo.x));
        let mut found = 0;
        for (i, (index, a)) in order.iter().enumerate() {
            for (other, b) in order[i + 1..].iter().take_while(|(_, b)| b.lo.x < a.hi.x) {
                let priority = |solid: &Solid| materials[solid.material as usize].priority;
                let equal = a.material != b.material && priority(a) == priority(b);
                let meet = a.lo.cmplt(b.hi).all() && b.lo.cmplt(a.hi).all();
                let within =
                    |x: &Solid, y: &Solid| x.lo.cmpge(y.lo).all() && x.hi.cmple(y.hi).all();
                if equal && meet && !within(a, b) && !within(b, a) && found < MOST {
                    found += 1;
                    let name = |i: u32| things[i as usize].name.as_str();
                    diagnostics.push(overlap(name(**index), name(**other), scene));
                }
            }
        }
    }
}

fn overlap(a: &str, b: &str, scene: &Scene) -> Diagnostic {
    let text = format!("`{a}` and `{b}` may overlap, and their materials have the same priority");
    let at = scene.instances.iter().find(|instance| instance.name.text == *a);
    let at = at.map_or(scene.render.name.span, |instance| instance.name.span);
    Diagnostic::warning(Code("W0526"), "equal_priority", text)
        .at(at, "which of them is there where both are?")
        .with_help("give the one that displaces the other a greater `priority`")
}

/// Distance from `eye` along `UP` to a triangle, in lengths of `UP`.
/// Moller & Trumbore 1997, in `f64`.
pub(super) fn hit_triangle([a, b, c]: &[DVec3; 3], eye: DVec3) -> Option<f64> {
    let (edge1, edge2) = (*b - *a, *c - *a);
    let p = UP.cross(edge2);
    let det = edge1.dot(p);
    if det == 0.0 {
        return None;
    }
    let s = eye - *a;
    let u = s.dot(p) / det;
    let q = s.cross(edge1);
    let v = UP.dot(q) / det;
    let t = edge2.dot(q) / det;
    (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0).then_some(t)
}

/// Distance from `eye` in a sphere along `UP` to its surface; `None` outside.
fn leave_sphere(center: DVec3, radius: f64, eye: DVec3) -> Option<f64> {
    let f = eye - center;
    let c = f.length_squared() - radius * radius;
    if c >= 0.0 {
        return None;
    }
    let (a, b) = (UP.length_squared(), f.dot(UP));
    Some((-b + (b * b - a * c).sqrt()) / a)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_in_a_sphere_see_one_surface() {
        let inside = leave_sphere(DVec3::new(1.0, 2.0, 3.0), 0.5, DVec3::new(1.0, 2.3, 3.0));
        assert!((inside.expect("inside") - 0.2).abs() < 0.01);
        assert_eq!(leave_sphere(DVec3::ZERO, 0.5, DVec3::new(0.0, 0.6, 0.0)), None);
    }

    #[test]
    fn triangles_above_are_hit_and_others_are_not() {
        let above =
            [DVec3::new(-1.0, 2.0, -1.0), DVec3::new(1.0, 2.0, -1.0), DVec3::new(0.0, 2.0, 2.0)];
        assert!((hit_triangle(&above, DVec3::ZERO).expect("above") - 2.0).abs() < 1e-12);
        assert_eq!(hit_triangle(&above, DVec3::new(0.0, 3.0, 0.0)), None);
        assert_eq!(hit_triangle(&above, DVec3::new(9.0, 0.0, 0.0)), None);
    }
}
