//! Warnings about what a picture will not show: nothing in the image, a camera or a light inside of an opaque thing.
//!
//! A thing counts as opaque and closed only where that is certain, and one that holds both the camera and a light is a
//! room. It looks at files only where a box says that it must.

use glam::DVec3;
use lang::diagnostic::{Code, Diagnostic};
use lang::scene::{Camera, Parts, Projection, Scene, Shape};
use lang::units;
use pack::abi::NONE;

use super::bounds::{self, Bounds};
use super::closed;
use super::files::Files;
use super::geometry::body::{Bodies, Body, Face, Form};
use super::inside::hit_triangle;
use super::material::MaterialTable;
use crate::import::{ImportError, Part};
use crate::stage::{KeyOf, Stages};

/// Warnings of one kind; more of them help nobody.
const MOST: usize = 8;
/// Pairs of lights and things that are looked at: some hundredths of a second of them.
const MOST_PAIRS: usize = 10_000_000;

/// What is looked at.
pub(super) struct Look<'a> {
    pub(super) scene: &'a Scene,
    pub(super) bodies: &'a Bodies,
    pub(super) materials: &'a MaterialTable<'a>,
    pub(super) stages: &'a Stages,
}

/// A thing and its box.
struct Boxed<'a> {
    body: &'a Body,
    bounds: Bounds,
    /// It gives light.
    glows: bool,
    /// Everything it is made of stops light, and gives none.
    opaque: bool,
}

/// Warns of what is not going to be seen.
///
/// # Errors
/// When a mesh cannot be loaded that must be looked at.
pub(super) fn check(look: &Look<'_>, diagnostics: &mut Vec<Diagnostic>) -> Result<(), ImportError> {
    // A camera that moves sees many places.
    if !look.scene.camera.keys.is_empty() {
        return Ok(());
    }
    let things = boxed(look);
    // Light in the air is seen wherever its lamp is.
    let is_clear = look.scene.render.atmosphere.is_none();
    if is_clear && look.bodies.things.iter().all(|thing| !thing.moves()) {
        diagnostics.extend(empty_frame(look.scene, &things));
    }
    let eye = DVec3::from(look.scene.camera.from);
    // Parallel rays start in a plane, of which most may be outside.
    let parallel = matches!(look.scene.camera.projection, Projection::Orthographic { .. });
    let mut rooms = Vec::new();
    for (i, thing) in things.iter().enumerate().filter(|_| !parallel) {
        if thing.opaque && thing.bounds.has(eye) && look.encloses(thing, eye)? {
            rooms.push(i);
        }
    }
    for room in &rooms {
        let lit = things.iter().filter(|thing| thing.glows);
        let mut lamps = lit.filter(|lamp| things[*room].bounds.contains(&lamp.bounds));
        if lamps.next().is_none() {
            diagnostics.extend(look.camera_inside(&things[*room]));
            break;
        }
    }
    look.lights_inside(&things, &rooms, diagnostics)
}

/// Every thing that has an extent.
fn boxed<'a>(look: &Look<'a>) -> Vec<Boxed<'a>> {
    let opaque = look.materials.opaque();
    let stops = |material: u32| opaque.get(material as usize).copied().unwrap_or(false);
    let glows = |material: u32| look.materials.looks(material).glows;
    let instances = &look.scene.instances;
    let of = |(index, body): (usize, &'a Body)| {
        let bounds = match (instances.get(index), &body.form) {
            (_, Form::Nothing) => None,
            (_, Form::Sphere(ball)) => Bounds::of_sphere(ball.center.into(), ball.radius),
            (Some(instance), _) => {
                Bounds::of(bounds::corners(instance, look.materials.files.assets()))
            }
            (None, _) => None,
        }?;
        let materials = materials(look.bodies, body);
        let glows = materials.iter().any(|material| glows(*material));
        let opaque = !glows && materials.iter().all(|material| stops(*material));
        Some(Boxed { body, bounds, glows, opaque })
    };
    look.bodies.list.iter().enumerate().filter_map(of).collect()
}

/// What a thing is made of.
fn materials(bodies: &Bodies, body: &Body) -> Vec<u32> {
    match &body.form {
        Form::Nothing => Vec::new(),
        Form::Sphere(ball) => vec![ball.material],
        Form::Mesh(mesh) => mesh.parts.iter().map(|part| part.1).collect(),
        Form::Stored(index, NONE) => {
            bodies.meshes.get(*index).map_or_else(Vec::new, |mesh| mesh.materials.clone())
        }
        Form::Faces(_, material) | Form::Stored(_, material) => vec![*material],
    }
}

/// A warning if there are things, and the camera sees none of their boxes.
fn empty_frame(scene: &Scene, things: &[Boxed<'_>]) -> Option<Diagnostic> {
    let camera = &scene.camera;
    if things.is_empty() || things.iter().any(|thing| may_see(camera, &thing.bounds)) {
        return None;
    }
    let text = format!("nothing is in the image of `{}`", camera.name.text);
    let warning = Diagnostic::warning(Code("W0716"), "empty_frame", text)
        .at(camera.name.span, "sees no instance and no light, only the sky");
    Some(with_fit(warning, scene, things))
}

/// False if every corner of a box is behind the camera, or all are beyond one edge of the image. A panorama may see all.
fn may_see(camera: &Camera, bounds: &Bounds) -> bool {
    let from = DVec3::from(camera.from);
    let (Some(forward), up) = ((DVec3::from(camera.to) - from).try_normalize(), camera.up) else {
        return true;
    };
    let Some(right) = forward.cross(DVec3::from(up)).try_normalize() else { return true };
    let up = right.cross(forward);
    // Normals of the planes that bound what the camera sees, inwards, and how far each is behind `from`.
    let sides = match &camera.projection {
        Projection::Perspective(lens) => {
            let tangents = [lens.fov_horizontal, lens.fov_vertical];
            let [x, y] = tangents.map(|angle| libm::tan(0.5 * angle));
            // Through a lens a little more is seen than through its middle.
            let margin = lens.radius * (1.0 + x.max(y));
            [forward, forward * x - right, forward * x + right, forward * y - up, forward * y + up]
                .map(|side| (side, margin * side.length()))
        }
        Projection::Orthographic { size, .. } => {
            let [x, y] = size.unwrap_or([f64::INFINITY; 2]).map(|side| 0.5 * side);
            [(forward, 0.0), (-right, x), (right, x), (-up, y), (up, y)]
        }
        Projection::Panoramic { .. } => return true,
    };
    sides.iter().all(|(side, behind)| {
        bounds.corners().iter().any(|corner| side.dot(DVec3::from(*corner) - from) >= -behind)
    })
}

/// Proposes to frame the first mesh, or else sphere, or else anything.
fn with_fit(warning: Diagnostic, scene: &Scene, things: &[Boxed<'_>]) -> Diagnostic {
    let weight = |thing: &&Boxed<'_>| match &thing.body.form {
        Form::Mesh(_) | Form::Stored(..) => 2,
        Form::Sphere(_) => 1,
        Form::Nothing | Form::Faces(..) => 0,
    };
    let named = things.iter().rev().filter(|thing| typed_name(scene, thing).is_some());
    help_to_fit(warning, named.max_by_key(weight).and_then(|thing| typed_name(scene, thing)))
}

/// The name by which a camera of the root file frames an instance, if it can.
fn typed_name<'a>(scene: &'a Scene, thing: &Boxed<'_>) -> Option<&'a str> {
    let name = &scene.instances.get(thing.body.object as usize)?.name;
    // Of `a[3].lid` it is `a`; names of other files have a prefix, and may be private.
    let here = name.span.file == scene.render.name.span.file;
    name.text.split(['[', '.']).next().filter(|_| here)
}

fn help_to_fit(warning: Diagnostic, name: Option<&str>) -> Diagnostic {
    match name {
        Some(name) => warning.with_help(format!("write `fit = {name}` in the camera")),
        None => warning.with_help("`rtc show --bounds` prints where everything is"),
    }
}

impl Look<'_> {
    /// Whether a thing is closed and `p` in it.
    fn encloses(&self, thing: &Boxed<'_>, p: DVec3) -> Result<bool, ImportError> {
        let body = thing.body;
        if self.bodies.things[body.object as usize].moves() {
            return Ok(false);
        }
        let odd = |n: usize| n % 2 == 1;
        Ok(match &body.form {
            Form::Nothing => false,
            Form::Sphere(ball) => (p - ball.center).length() < ball.radius,
            Form::Faces(faces, _) => {
                let triangles = faces.iter().flat_map(Face::triangles);
                let hits = triangles.filter(|corners| hit_triangle(corners, p).is_some());
                !self.is_open(body) && odd(hits.count())
            }
            Form::Mesh(_) | Form::Stored(..) => {
                let instance = self.scene.instances.get(body.object as usize);
                let Some(Shape::Mesh { asset, parts }) = instance.map(|instance| &instance.shape)
                else {
                    return Ok(false);
                };
                self.mesh_encloses((*asset, parts), body, p)?
            }
        })
    }

    /// Whether a shape that needs no file encloses nothing.
    fn is_open(&self, body: &Body) -> bool {
        let instance = self.scene.instances.get(body.object as usize);
        instance.is_some_and(|instance| instance.shape.open().is_some())
    }

    fn mesh_encloses(
        &self,
        (asset, parts): (usize, &Parts),
        body: &Body,
        p: DVec3,
    ) -> Result<bool, ImportError> {
        let files: &dyn Files = self.materials.files;
        if closed::surface(asset, parts, (files, self.stages))?.boundary_edges > 0 {
            return Ok(false);
        }
        let facts = &files.assets()[asset];
        let chosen = facts.chosen(parts);
        let mut key = KeyOf::stage("is a point in a mesh");
        for part in &chosen {
            key.bytes(&facts.parts[*part].content);
        }
        key.floats(&body.transform.numbers()).floats(&p.to_array());
        self.stages.try_value(key.end(), || {
            let meshes = files.load_meshes(&[asset].into())?;
            let crossed = |part: &Part| {
                let placed = |q: [f32; 3]| body.transform.point(DVec3::from(q.map(f64::from)));
                let corners = |tri_idx| part.corners(tri_idx).map(placed);
                let all = 0..part.triangles.len();
                all.filter(|tri_idx| hit_triangle(&corners(*tri_idx), p).is_some()).count()
            };
            let file = meshes.get(&asset);
            let parts = file.map_or(&[][..], |file| &file.parts[..]);
            let crossings: usize =
                chosen.iter().filter_map(|part| parts.get(*part)).map(crossed).sum();
            Ok(crossings % 2 == 1)
        })
    }

    fn camera_inside(&self, room: &Boxed<'_>) -> Option<Diagnostic> {
        let camera = &self.scene.camera;
        let around = self.scene.instances.get(room.body.object as usize)?;
        let name = &around.name.text;
        let text = format!("the camera is inside of `{name}`, and no light is in there");
        let warning = Diagnostic::warning(Code("W0717"), "camera_inside", text)
            .at(camera.name.span, "sees the inside of it, which is black")
            .because(around.name.span, "closed and opaque");
        Some(help_to_fit(warning, typed_name(self.scene, room)))
    }

    /// Warns of lights in things in which the camera is not.
    fn lights_inside(
        &self,
        things: &[Boxed<'_>],
        rooms: &[usize],
        diagnostics: &mut Vec<Diagnostic>,
    ) -> Result<(), ImportError> {
        let lamps: Vec<&Boxed<'_>> = things.iter().filter(|thing| thing.glows).collect();
        let solids = things
            .iter()
            .enumerate()
            .filter(|(i, thing)| thing.opaque && !self.is_open(thing.body) && !rooms.contains(i));
        let solids: Vec<&Boxed<'_>> = solids.map(|(_, thing)| thing).collect();
        if lamps.len().saturating_mul(solids.len()) > MOST_PAIRS {
            return Ok(());
        }
        let mut found = 0;
        for lamp in lamps {
            let middle = DVec3::from(lamp.bounds.middle());
            for solid in &solids {
                if found < MOST
                    && solid.bounds.contains(&lamp.bounds)
                    && self.encloses(solid, middle)?
                {
                    found += 1;
                    diagnostics.extend(self.light_inside(lamp, solid));
                    break;
                }
            }
        }
        Ok(())
    }

    fn light_inside(&self, lamp: &Boxed<'_>, solid: &Boxed<'_>) -> Option<Diagnostic> {
        let around = self.scene.instances.get(solid.body.object as usize)?;
        let index = lamp.body.object as usize;
        let n = self.scene.instances.len();
        let lit = self.scene.instances.get(index).map(|instance| &instance.name);
        let light = index.checked_sub(n).and_then(|i| self.scene.lights.get(i));
        let name = lit.or(light.map(|light| &light.name))?;
        let text =
            format!("`{}` is inside of `{}`: it lights nothing", name.text, around.name.text);
        let warning = Diagnostic::warning(Code("W0718"), "light_inside", text)
            .at(name.span, "no light comes out")
            .because(around.name.span, "closed and opaque");
        let Some(light) = light else {
            return Some(
                warning.with_help("move it out; `rtc show --bounds` prints where both are"),
            );
        };
        let [x, _, z] = light.center;
        let above = solid.bounds.hi[1] + 2.0 * light.radius;
        let [x, y, z] = [x, above, z].map(|c| units::show_number((c * 1e3).round() / 1e3));
        Some(warning.with_help(format!("to put it above, write `center = ({x}, {y}, {z})m`")))
    }
}
