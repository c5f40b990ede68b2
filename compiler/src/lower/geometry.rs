//! Instances become triangles and spheres in the world, in `f64`, with their shading data, or places of meshes
//! that are stored once.
//!
//! Instances that `share` does not name are flattened: each writes its own triangles. Rectangles are two
//! triangles, boxes twelve. Everything that emits is noted as an `Emitter` on the way.

use std::borrow::Cow;

use glam::{DMat3, DVec2, DVec3};
use lang::diagnostic::{Code, Diagnostic};
use lang::scene::{Instance, Scene, Shape};
use pack::abi::{self, LightKind, NONE, TRI_SMOOTH};

use super::light::{self, Emitter};
use super::material::{MaterialRef, MaterialTable};
use super::motion::Shutter;
use super::object::Thing;
use super::share::{Plan, chosen};
use super::sheet::{Sheets, pieces_of};
use super::stored::{Placed, Stored};
use super::{Loaded, grain};
use crate::import::{Attribute, MeshFile, Part};

/// Geometry of the whole scene when the shutter opens, before normalisation, in order of declaration.
#[derive(Debug, Default)]
pub struct Placement {
    /// Corners of every triangle that is stored in the world, world frame, metres.
    pub corners: Vec<[DVec3; 3]>,
    /// Shading data, one a triangle; `light` is `NONE` still.
    pub shades: Vec<abi::TriShade>,
    /// Triangles of each mesh instance: `groups[i]` is where group `i` ends.
    pub groups: Vec<u32>,
    /// Meshes that are stored once.
    pub meshes: Vec<Stored>,
    /// Where they are.
    pub placed: Vec<Placed>,
    /// Centre and radius of every sphere, metres.
    pub spheres: Vec<(DVec3, f64)>,
    /// Material of every sphere.
    pub sphere_materials: Vec<u32>,
    /// Object of every sphere.
    pub sphere_objects: Vec<u32>,
    /// Things in the world: their instances, then the lights.
    pub things: Vec<Thing>,
    /// What emits, in order of declaration.
    pub(super) emitters: Vec<Emitter>,
    /// Where what each of the things brought ends in the lists above.
    pub(super) ends: Vec<Ends>,
}

/// How many triangles, spheres and emitters there are with those of a thing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Ends {
    /// Triangles.
    pub(super) triangles: u32,
    /// Spheres.
    pub(super) spheres: u32,
    /// Emitters.
    pub(super) emitters: u32,
}

/// What is placed, and what need not be.
pub(super) struct Stage<'a> {
    pub(super) scene: &'a Scene,
    pub(super) loaded: &'a Loaded,
    pub(super) plan: &'a Plan,
    /// Of each instance, whether its triangles are known already: it is a thing and leaves nothing else. Beyond the
    /// end none are known.
    pub(super) known: &'a [bool],
}

/// Places everything; complaints about single instances go to `diagnostics`. What is stored once may be there
/// already.
pub(super) fn place(
    stage: &Stage<'_>,
    meshes: Vec<Stored>,
    materials: &mut MaterialTable<'_>,
    diagnostics: &mut Vec<Diagnostic>,
) -> Placement {
    let mut placement = Placement { meshes, ..Placement::default() };
    let shutter = Shutter::of(&stage.scene.camera);
    for (index, instance) in stage.scene.instances.iter().enumerate() {
        let object = placement.things.len() as u32;
        placement.things.push(Thing::of(instance, shutter));
        if !stage.known.get(index).is_some_and(|known| *known) {
            let mut placer = Placer {
                object,
                sheets: Sheets::of(stage.scene, instance),
                transform: Transform::of(instance, shutter),
                instance,
                materials: &mut *materials,
                placement: &mut placement,
            };
            placer.instance(stage, index, diagnostics);
        }
        placement.close();
    }
    for (index, light) in stage.scene.lights.iter().enumerate() {
        let material = materials.index(MaterialRef::Light(index));
        let object = placement.things.len() as u32;
        let thing = Thing::lit(light, shutter);
        let ball = Ball { center: thing.origin, radius: light.radius, material, object };
        placement.things.push(thing);
        let before = placement.emitters.len();
        placement.add_sphere(&ball, materials);
        // A black light is no emitter.
        if let (Some(tint), Some(emitter)) =
            (light::tint(light), placement.emitters.get_mut(before))
        {
            let [x, y, z] = tint.direction.map(|c| c as f32);
            emitter.tint = [x, y, z, libm::cos(tint.angle) as f32];
        }
        placement.close();
    }
    placement
}

/// Corner, first and second edge of a parallelogram, object frame; front is `cross(edge1, edge2)`.
type Parallelogram = [DVec3; 3];

fn rectangle([x, z]: [f64; 2]) -> Parallelogram {
    [DVec3::new(-x, 0.0, z) / 2.0, DVec3::new(x, 0.0, 0.0), DVec3::new(0.0, 0.0, -z)]
}

/// The six faces of a box around the origin, fronts outside.
fn box_faces(size: [f64; 3]) -> Vec<Parallelogram> {
    let size = DVec3::from(size);
    let mut faces = Vec::with_capacity(6);
    for axis in 0..3 {
        let edge = |k: usize| DVec3::AXES[k] * size[k];
        let (u, v) = (edge((axis + 1) % 3), edge((axis + 2) % 3));
        let normal = edge(axis);
        faces.push([(normal - u - v) / 2.0, u, v]);
        faces.push([(-normal - u - v) / 2.0, v, u]);
    }
    faces
}

/// `world_from_object` at the moment when the shutter opens, split.
pub(super) struct Transform {
    pub(super) linear: DMat3,
    pub(super) translation: DVec3,
    /// Turns normals: the cofactor matrix, signed so that outside stays outside.
    normal: DMat3,
    /// The transform mirrors: winding must be reversed.
    mirrors: bool,
}

impl Transform {
    pub(super) fn of(instance: &Instance, shutter: Shutter) -> Self {
        let m = instance.world_from_object;
        let column = |k: usize| DVec3::new(m[0][k], m[1][k], m[2][k]);
        let linear = DMat3::from_cols(column(0), column(1), column(2));
        Self::new(linear, column(3) + shutter.lead(instance.velocity))
    }

    pub(super) fn new(linear: DMat3, translation: DVec3) -> Self {
        let (x, y, z) = (linear.x_axis, linear.y_axis, linear.z_axis);
        let cofactors = DMat3::from_cols(y.cross(z), z.cross(x), x.cross(y));
        let mirrors = linear.determinant() < 0.0;
        let normal = if mirrors { cofactors * -1.0 } else { cofactors };
        Self { linear, translation, normal, mirrors }
    }

    fn point(&self, p: DVec3) -> DVec3 {
        self.linear * p + self.translation
    }

    /// The common length of the axes, or `None` when the transform is not a similarity.
    fn uniform_scale(&self) -> Option<f64> {
        let axes = [self.linear.x_axis, self.linear.y_axis, self.linear.z_axis];
        let scale = axes[0].length();
        // Rotations written in degrees leave errors of a few units in the last place.
        let close = |value: f64, to: f64| libm::fabs(value - to) <= 1e-9 * scale * scale;
        let equal = axes.iter().all(|axis| close(axis.length_squared(), scale * scale));
        let square = (0..3).all(|k| close(axes[k].dot(axes[(k + 1) % 3]), 0.0));
        (equal && square && scale > 0.0).then_some(scale)
    }
}

/// A sphere in the world, metres.
#[derive(Clone, Copy)]
struct Ball {
    center: DVec3,
    radius: f64,
    material: u32,
    /// Index into `Placement::things`.
    object: u32,
}

/// One instance on its way into the world.
struct Placer<'a, 'b> {
    /// Index into `Placement::things`.
    object: u32,
    /// How its leaves or petals differ.
    sheets: Option<Sheets>,
    instance: &'a Instance,
    transform: Transform,
    materials: &'a mut MaterialTable<'b>,
    placement: &'a mut Placement,
}

impl Placer<'_, '_> {
    /// The instance with this index in the scene.
    fn instance(&mut self, stage: &Stage<'_>, index: usize, diagnostics: &mut Vec<Diagnostic>) {
        let instance = self.instance;
        if !matches!(instance.shape, Shape::Mesh { .. }) && !self.exists(0) {
            return;
        }
        let first = self.placement.corners.len();
        match &instance.shape {
            Shape::Sphere { radius } => self.sphere(*radius, diagnostics),
            Shape::Rectangle { size } => self.rectangles(&[rectangle(*size)]),
            Shape::Box { size } => self.rectangles(&box_faces(*size)),
            Shape::Mesh { asset, part } => {
                let stored = stage.plan.mesh_of(index);
                match (&stage.loaded.assets[*asset], stored) {
                    (None, Some(stored)) => self.stored_before(stored),
                    (file, _) => {
                        let file = file.as_ref().expect("used assets are loaded");
                        self.mesh(*asset, file, part.as_deref(), stored, diagnostics);
                    }
                }
            }
        }
        let placement = &*self.placement;
        let corners = match placement.placed.last() {
            Some(placed)
                if placed.object == self.object && grain::matters(stage.scene, instance) =>
            {
                Cow::Owned(placement.triangles_of(placed))
            }
            _ => Cow::Borrowed(&placement.corners[first..]),
        };
        let thing = &placement.things[self.object as usize];
        diagnostics.extend(grain::check(stage.scene, instance, thing, &corners));
    }

    /// The instance's own material, else `fallback`.
    fn material(&mut self, fallback: MaterialRef) -> u32 {
        let of = self.instance.material.map_or(fallback, MaterialRef::Scene);
        self.materials.index(of)
    }

    fn sphere(&mut self, radius: f64, diagnostics: &mut Vec<Diagnostic>) {
        let Some(scale) = self.transform.uniform_scale() else {
            let name = &self.instance.name.text;
            diagnostics.push(
                Diagnostic::error(Code("E0804"), format!("`{name}` would not stay a sphere"))
                    .at(self.instance.shape_span, "a sphere, scaled differently along its axes")
                    .with_help("give `scale` one number, or use a mesh"),
            );
            return;
        };
        let material = self.material(MaterialRef::Default);
        let center = self.transform.point(DVec3::ZERO);
        let ball = Ball { center, radius: radius * scale, material, object: self.object };
        self.placement.add_sphere(&ball, self.materials);
    }

    fn rectangles(&mut self, faces: &[Parallelogram]) {
        let material = self.material(MaterialRef::Default);
        let emits = self.materials.glow(material) > 0.0;
        for [corner, edge1, edge2] in faces {
            let origin = self.transform.point(*corner);
            let (mut edge1, mut edge2) =
                (self.transform.linear * *edge1, self.transform.linear * *edge2);
            let mut uv = [DVec2::X, DVec2::Y];
            if self.transform.mirrors {
                (edge1, edge2) = (edge2, edge1);
                uv.swap(0, 1);
            }
            let corners = [origin, origin + edge1, origin + edge1 + edge2, origin + edge2];
            let uvs = [DVec2::ZERO, uv[0], DVec2::ONE, uv[1]];
            let first = self.placement.corners.len() as u32;
            for [a, b, c] in [[0, 1, 2], [0, 2, 3]] {
                let shade = abi::TriShade {
                    material,
                    uv0: uvs[a].as_vec2().to_array(),
                    uv1: uvs[b].as_vec2().to_array(),
                    uv2: uvs[c].as_vec2().to_array(),
                    light: NONE,
                    object: self.object,
                    ..Default::default()
                };
                self.placement.corners.push([corners[a], corners[b], corners[c]]);
                self.placement.shades.push(shade);
            }
            if emits {
                self.placement.emitters.push(Emitter {
                    kind: LightKind::Rectangle,
                    primitive: first,
                    count: 2,
                    material,
                    area: edge1.cross(edge2).length(),
                    tint: [0.0; 4],
                });
            }
        }
    }

    fn mesh(
        &mut self,
        asset: usize,
        file: &MeshFile,
        part: Option<&str>,
        stored: Option<usize>,
        diagnostics: &mut Vec<Diagnostic>,
    ) {
        let mut bare = None;
        let parts = chosen(file, part);
        let mut materials = Vec::with_capacity(parts.len());
        for part in &parts {
            let own = part.material.map_or(MaterialRef::Default, |material| MaterialRef::Asset {
                asset,
                material: material as usize,
            });
            let material = self.material(own);
            if part.uvs == Attribute::Absent
                && reads_textures(&self.materials.records()[material as usize])
            {
                bare = bare.or(Some(*part));
            }
            materials.push(material);
        }
        diagnostics.extend(bare.map(|part| self.without_uvs(part)));
        if let Some(index) = stored {
            return self.stored(index, &parts, &materials);
        }
        for (part, material) in parts.into_iter().zip(materials) {
            self.part(part, material);
        }
    }

    /// Notes a place of the stored mesh `index`, made of `parts` with these materials.
    fn stored(&mut self, index: usize, parts: &[&Part], materials: &[u32]) {
        let meshes = &mut self.placement.meshes;
        if index == meshes.len() {
            meshes.push(Stored::new(parts));
        }
        let own = self.instance.material.is_none();
        meshes[index].set_materials(materials, own);
        self.put(index, if own { NONE } else { materials[0] });
    }

    /// Notes a place of the stored mesh `index`, which is known with its materials.
    fn stored_before(&mut self, index: usize) {
        let own = self.instance.material.is_none();
        let material = if own { NONE } else { self.material(MaterialRef::Default) };
        self.put(index, material);
    }

    fn put(&mut self, index: usize, material: u32) {
        let mesh = &self.placement.meshes[index];
        if !mesh.corners.is_empty() {
            let placed = Placed::new(mesh, index, &self.transform, self.object, material);
            self.placement.placed.push(placed);
        }
    }

    /// Textures are to be read where there are no texture coordinates. A file that says both itself is taken
    /// as it is: its textures are read at one point.
    fn without_uvs(&self, part: &Part) -> Diagnostic {
        let name = match part.name.as_str() {
            "" => format!("the mesh of `{}`", self.instance.name.text),
            name => format!("`{name}`"),
        };
        let text = format!("{name} has no texture coordinates, but its material reads textures");
        let mesh = self.instance.shape_span;
        match self.instance.material_span {
            None => Diagnostic::warning(Code("W0524"), "import", text).at(mesh, "this mesh"),
            Some(span) => Diagnostic::error(Code("E0520"), text)
                .at(span, "reads textures")
                .because(mesh, "has no texture coordinates")
                .with_help("unwrap the mesh where it was made, or use a material without textures"),
        }
    }

    /// Whether piece `piece` of the instance is there.
    fn exists(&self, piece: u32) -> bool {
        self.sheets.as_ref().is_none_or(|sheets| sheets.exists(piece))
    }

    /// Shading normals of a triangle, object frame, if it has any.
    fn normals(&self, part: &Part, tri_idx: usize, piece: u32) -> Option<[DVec3; 3]> {
        let own = part.corner_normals(tri_idx);
        let own = own.map(|normals| normals.map(|n| DVec3::from(n.map(f64::from))));
        let Some(sheets) = self.sheets.as_ref().filter(|sheets| sheets.leans()) else { return own };
        let [a, b, c] = part.corners(tri_idx).map(|p| DVec3::from(p.map(f64::from)));
        let uvs = part.corner_uvs(tri_idx).unwrap_or([[0.5; 2]; 3]);
        let uvs = uvs.map(|uv| DVec2::from(uv.map(f64::from)));
        let (d1, d2) = (uvs[1] - uvs[0], uvs[2] - uvs[0]);
        let along = ((b - a) * d2.y - (c - a) * d1.y) * d1.perp_dot(d2).signum();
        let flat = (b - a).cross(c - a);
        let base = own.unwrap_or([flat; 3]);
        Some([0, 1, 2].map(|k| sheets.normal(piece, base[k], along, uvs[k])))
    }

    fn part(&mut self, part: &Part, material: u32) {
        let emits = self.materials.glow(material) > 0.0;
        let pieces = if self.sheets.is_some() { pieces_of(part) } else { Vec::new() };
        for tri_idx in 0..part.triangles.len() {
            let piece = pieces.get(tri_idx).copied().unwrap_or(0);
            if !self.exists(piece) {
                continue;
            }
            let corners =
                part.corners(tri_idx).map(|p| self.transform.point(DVec3::from(p.map(f64::from))));
            let normals = self
                .normals(part, tri_idx, piece)
                .map(|normals| normals.map(|n| octahedral(self.transform.normal * n)));
            let uvs = part.corner_uvs(tri_idx).unwrap_or_default();
            let order = if self.transform.mirrors { [0, 2, 1] } else { [0, 1, 2] };
            let corners = order.map(|k| corners[k]);
            let [uv0, uv1, uv2] = order.map(|k| uvs[k]);
            let smooth = if normals.is_some() { TRI_SMOOTH } else { 0 };
            let object = self.object | smooth;
            let normals = normals.map_or([0; 3], |normals| order.map(|k| normals[k]));
            if emits {
                let [a, b, c] = corners;
                self.placement.emitters.push(Emitter {
                    kind: LightKind::Triangle,
                    primitive: self.placement.corners.len() as u32,
                    count: 1,
                    material,
                    area: 0.5 * (b - a).cross(c - a).length(),
                    tint: [0.0; 4],
                });
            }
            self.placement.corners.push(corners);
            let shade = abi::TriShade { normals, material, uv0, uv1, uv2, light: NONE, object };
            self.placement.shades.push(shade);
        }
    }
}

impl Placement {
    /// Triangles of a placed mesh in the world, metres.
    fn triangles_of(&self, placed: &Placed) -> Vec<[DVec3; 3]> {
        let corners = &self.meshes[placed.mesh].corners;
        corners.iter().map(|corners| placed.triangle(corners)).collect()
    }

    fn add_sphere(&mut self, ball: &Ball, materials: &MaterialTable<'_>) {
        let Ball { center, radius, material, object } = *ball;
        if materials.glow(material) > 0.0 {
            self.emitters.push(Emitter {
                kind: LightKind::Sphere,
                primitive: self.spheres.len() as u32,
                count: 1,
                material,
                area: 4.0 * std::f64::consts::PI * radius * radius,
                tint: [0.0; 4],
            });
        }
        self.spheres.push((center, radius));
        self.sphere_materials.push(material);
        self.sphere_objects.push(object);
    }

    /// Takes triangles out. A rectangle that loses one of its two is no longer a rectangle light.
    pub(super) fn remove_triangles(&mut self, remove: &[bool]) {
        let left = counted(remove.iter().map(|removed| !removed));
        let stays = |emitter: &Emitter| {
            let (first, end) = (emitter.primitive, emitter.primitive + emitter.count);
            emitter.kind == LightKind::Sphere
                || left[end as usize] - left[first as usize] == emitter.count
        };
        let emitters_left = counted(self.emitters.iter().map(stays));
        self.emitters.retain_mut(|emitter| {
            let stays = stays(emitter);
            if emitter.kind != LightKind::Sphere {
                emitter.primitive = left[emitter.primitive as usize];
            }
            stays
        });
        for end in &mut self.groups {
            *end = left[*end as usize];
        }
        self.groups.dedup();
        self.groups.retain(|end| *end > 0);
        for ends in &mut self.ends {
            ends.triangles = left[ends.triangles as usize];
            ends.emitters = emitters_left[ends.emitters as usize];
        }
        let mut index = 0;
        self.shades.retain(|_| {
            index += 1;
            !remove[index - 1]
        });
    }

    /// What each of the things brought, by its index.
    pub(super) fn spans(&self) -> impl Iterator<Item = (Ends, Ends)> {
        let starts = std::iter::once(Ends::default()).chain(self.ends.iter().copied());
        starts.zip(self.ends.iter().copied())
    }

    /// Triangles of each group.
    pub(super) fn mesh_sizes(&self) -> Vec<usize> {
        let starts = std::iter::once(&0).chain(&self.groups);
        starts.zip(&self.groups).map(|(start, end)| (end - start) as usize).collect()
    }

    /// The entry of `of_thing` for each group.
    pub(super) fn mesh_motions(&self, of_thing: &[[f32; 3]]) -> Vec<[f32; 3]> {
        let starts = std::iter::once(&0).chain(&self.groups).take(self.groups.len());
        let thing = |start: &u32| self.shades[*start as usize].object & !TRI_SMOOTH;
        starts.map(|start| of_thing[thing(start) as usize]).collect()
    }

    /// Ends what one thing brings.
    fn close(&mut self) {
        self.close_with(self.spheres.len() as u32);
    }

    /// As `close`, where there are that many spheres up to here. Things without triangles make no group.
    pub(super) fn close_with(&mut self, spheres: u32) {
        let triangles = self.shades.len() as u32;
        if self.groups.last().copied().unwrap_or(0) < triangles {
            self.groups.push(triangles);
        }
        let emitters = self.emitters.len() as u32;
        self.ends.push(Ends { triangles, spheres, emitters });
    }
}

/// How many of the first `0..=n` are true.
fn counted(all: impl Iterator<Item = bool>) -> Vec<u32> {
    let mut so_far = 0;
    let sum = all.map(|one| {
        so_far += u32::from(one);
        so_far
    });
    let sum: Vec<u32> = sum.collect();
    std::iter::once(0).chain(sum).collect()
}

/// Whether any texture belongs to the material.
fn reads_textures(material: &abi::Material) -> bool {
    material.textures().iter().any(|texture| *texture != NONE)
}

/// A direction as two 16-bit signed normalised integers, x in the low half (Cigolle et al. 2014,
/// "A Survey of Efficient Representations for Independent Unit Vectors", JCGT 3(2)). Zero gives +z.
pub(super) fn octahedral(n: DVec3) -> u32 {
    let sum = n.x.abs() + n.y.abs() + n.z.abs();
    let (mut x, mut y) = if sum > 0.0 { (n.x / sum, n.y / sum) } else { (0.0, 0.0) };
    if n.z < 0.0 {
        let sign = |v: f64| if v < 0.0 { -1.0 } else { 1.0 };
        (x, y) = ((1.0 - y.abs()) * sign(x), (1.0 - x.abs()) * sign(y));
    }
    let quantise = |v: f64| (libm::round(v.clamp(-1.0, 1.0) * 32767.0) as i16) as u16;
    u32::from(quantise(x)) | u32::from(quantise(y)) << 16
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn faces_of_a_box_look_outside_and_enclose_its_volume() {
        let size = [1.0, 2.0, 3.0];
        let mut volume = 0.0;
        for [corner, u, v] in box_faces(size) {
            let normal = u.cross(v);
            assert!(normal.dot(corner + (u + v) / 2.0) > 0.0);
            volume += corner.dot(normal) / 3.0;
        }
        assert!((volume - 6.0).abs() < 1e-12);
    }

    #[test]
    fn a_rectangle_looks_up() {
        let [_, u, v] = rectangle([2.0, 3.0]);
        assert_eq!(u.cross(v).normalize(), DVec3::Y);
    }

    #[test]
    fn octahedral_keeps_the_axes_exactly() {
        assert_eq!(octahedral(DVec3::Z), 0);
        assert_eq!(octahedral(DVec3::X), 32767);
        assert_eq!(octahedral(DVec3::NEG_Y), u32::from((-32767_i16) as u16) << 16);
        assert_eq!(octahedral(DVec3::ZERO), 0);
    }
}
