//! What each thing of a scene is, before anything is placed: its shape, where it stands, and its materials.
//!
//! Materials are numbered here, in the order in which the things ask for them. Of mesh files only what is known of
//! them is looked at.

use std::collections::BTreeSet;

use glam::{DVec2, DVec3};
use lang::diagnostic::{Code, Diagnostic};
use lang::scene::{Instance, Light, Parts, Scene, Shape};
use pack::abi::NONE;

use super::transform::Transform;
use crate::import::{ImportError, PartFacts};
use crate::lower::grain;
use crate::lower::light;
use crate::lower::material::{MaterialRef, MaterialTable};
use crate::lower::measured;
use crate::lower::object::Thing;
use crate::lower::share::Plan;
use crate::lower::sheet::Sheets;
use crate::lower::shutter::Shutter;
use crate::stage::{Key, KeyOf, Stages};

/// Corner, first and second edge of a parallelogram, object frame; front is `cross(edge1, edge2)`.
type Parallelogram = [DVec3; 3];

/// A thing of the scene.
pub(in crate::lower) struct Body {
    /// Index into `Bodies::things`.
    pub(in crate::lower) object: u32,
    pub(in crate::lower) transform: Transform,
    pub(in crate::lower) form: Form,
}

/// What a thing is made of.
pub(in crate::lower) enum Form {
    /// It is not there.
    Nothing,
    Sphere(Ball),
    Faces(Vec<Face>, u32),
    /// Triangles of a file, stored for this thing alone.
    Mesh(MeshForm),
    /// A place of a mesh that is stored once: its index into `Bodies::meshes`, and the material of all of it or
    /// `NONE`.
    Stored(usize, u32),
}

/// A sphere in the world, metres.
#[derive(Clone, Copy)]
pub(in crate::lower) struct Ball {
    pub(in crate::lower) center: DVec3,
    pub(in crate::lower) radius: f64,
    pub(in crate::lower) material: u32,
    /// See `Emitter::facing`.
    pub(in crate::lower) facing: [f32; 5],
    /// Its light over that of a ball that looks the same from everywhere.
    pub(in crate::lower) share: f64,
}

/// A parallelogram or a triangle in the world, metres.
pub(in crate::lower) struct Face {
    /// Counter-clockwise seen from its front.
    pub(in crate::lower) corners: [DVec3; 4],
    /// It is the triangle of the first three corners.
    pub(in crate::lower) half: bool,
    pub(in crate::lower) uvs: [DVec2; 4],
    /// Square metres.
    pub(in crate::lower) area: f64,
}

/// Parts of a mesh file.
pub(in crate::lower) struct MeshForm {
    /// Index into `Scene::assets`.
    pub(in crate::lower) asset: usize,
    /// Index of each part in the file, and its material.
    pub(in crate::lower) parts: Vec<(usize, u32)>,
    /// How its leaves or petals differ.
    pub(in crate::lower) sheets: Option<Sheets>,
    /// What its geometry is, whatever file it comes from.
    content: Key,
}

/// A mesh that is stored once.
#[derive(Default)]
pub(in crate::lower) struct Shared {
    /// Index into `Scene::assets`.
    pub(in crate::lower) asset: usize,
    /// Indices of its parts in the file.
    pub(in crate::lower) parts: Vec<usize>,
    /// The material of each part: the file's own, or those of the last place where no place asks for them.
    pub(in crate::lower) materials: Vec<u32>,
    /// `materials` are the file's.
    own: bool,
    content: Option<Key>,
}

/// All things of a scene: its instances, then its lights.
#[derive(Default)]
pub(in crate::lower) struct Bodies {
    pub(in crate::lower) list: Vec<Body>,
    pub(in crate::lower) things: Vec<Thing>,
    pub(in crate::lower) meshes: Vec<Shared>,
}

impl Bodies {
    /// Those of a scene; complaints about single instances go to `diagnostics`.
    ///
    /// # Errors
    /// When a file cannot be loaded that must be looked at.
    pub(in crate::lower) fn of(
        scene: &Scene,
        plan: &Plan,
        stages: &Stages,
        materials: &mut MaterialTable<'_>,
        diagnostics: &mut Vec<Diagnostic>,
    ) -> Result<Self, ImportError> {
        let shutter = Shutter::of(&scene.camera);
        let mut bodies = Self::default();
        for (index, instance) in scene.instances.iter().enumerate() {
            let transform = Transform::of(instance, shutter);
            bodies.things.push(Thing::of(instance, shutter));
            let mut maker = Maker { scene, instance, transform: &transform, materials, stages };
            let form = maker.form(plan.mesh_of(index), &mut bodies.meshes, diagnostics);
            let thing = &bodies.things[index];
            diagnostics.extend(maker.grain(thing, &form)?);
            bodies.list.push(Body { object: index as u32, transform, form });
        }
        for (index, light) in scene.lights.iter().enumerate() {
            let material = materials.index(MaterialRef::Light(index));
            let thing = Thing::lit(light, shutter);
            let ball = lamp(light, thing.origin, material);
            let object = bodies.things.len() as u32;
            let transform = Transform::new(glam::DMat3::IDENTITY, thing.origin);
            bodies.things.push(thing);
            bodies.list.push(Body { object, transform, form: Form::Sphere(ball) });
        }
        Ok(bodies)
    }

    /// Mesh files that some of these things show.
    pub(in crate::lower) fn assets<'a>(
        &self,
        bodies: impl IntoIterator<Item = &'a Body>,
    ) -> BTreeSet<usize> {
        let asset = |body: &Body| match &body.form {
            Form::Mesh(mesh) => Some(mesh.asset),
            Form::Stored(mesh, _) => Some(self.meshes[*mesh].asset),
            Form::Nothing | Form::Sphere(_) | Form::Faces(..) => None,
        };
        bodies.into_iter().filter_map(asset).collect()
    }

    /// Adds all that is made of these things, but the numbers of materials alone.
    pub(in crate::lower) fn read(&self, materials: &MaterialTable<'_>, key: &mut KeyOf) {
        for mesh in &self.meshes {
            key.key(mesh.key(materials.textures.has_vertex_colors()));
            mesh.materials.iter().for_each(|index| read_looks(materials, *index, key));
        }
        for (body, thing) in self.list.iter().zip(&self.things) {
            body.read(materials, key);
            key.floats(&thing.motion.to_array());
            if let Some(path) = &thing.path {
                key.floats(&path.pivot.to_array());
                path.records().for_each(|piece| {
                    key.bytes(bytemuck::bytes_of(&piece));
                });
            }
        }
    }
}

impl Body {
    /// The mesh that this thing alone shows.
    pub(in crate::lower) fn mesh(&self) -> Option<&MeshForm> {
        match &self.form {
            Form::Mesh(mesh) => Some(mesh),
            Form::Nothing | Form::Sphere(_) | Form::Faces(..) | Form::Stored(..) => None,
        }
    }

    /// Adds all that is made of this thing alone.
    pub(in crate::lower) fn read(&self, materials: &MaterialTable<'_>, key: &mut KeyOf) {
        let material = |key: &mut KeyOf, index: u32| read_looks(materials, index, key);
        match &self.form {
            Form::Nothing => {
                key.number(0_u32);
            }
            Form::Sphere(ball) => {
                key.number(1_u32).floats(&ball.center.to_array()).floats(&[ball.radius]);
                key.floats(&ball.facing.map(f64::from));
                material(key, ball.material);
            }
            Form::Faces(faces, index) => {
                key.number(2_u32).number(faces.len() as u64);
                for face in faces {
                    for corner in face.corners {
                        key.floats(&corner.to_array());
                    }
                    for uv in face.uvs {
                        key.floats(&uv.to_array());
                    }
                    key.floats(&[face.area]).number(face.half);
                }
                material(key, *index);
            }
            Form::Mesh(mesh) => {
                key.number(3_u32).key(mesh.content).floats(&self.transform.numbers());
                mesh.parts.iter().for_each(|(_, index)| material(key, *index));
                if let Some(sheets) = &mesh.sheets {
                    sheets.read(key.number(1_u32));
                }
            }
            Form::Stored(mesh, index) => {
                key.number(4_u32).number(*mesh as u64).floats(&self.transform.numbers());
                material(key, *index);
            }
        }
    }

    /// The key of what is made of a mesh that this thing alone shows.
    pub(in crate::lower) fn key(&self, materials: &MaterialTable<'_>) -> Key {
        let mut key = KeyOf::stage("mesh in the world");
        self.read(materials, &mut key);
        key.end()
    }
}

impl Shared {
    /// The key of its triangles; `colored`: with the colours of their corners.
    pub(in crate::lower) fn key(&self, colored: bool) -> Key {
        let mut key = KeyOf::stage("mesh stored once");
        if colored {
            key.number(1_u32);
        }
        if let Some(content) = self.content {
            key.key(content);
        }
        for material in &self.materials {
            key.number(*material);
        }
        key.end()
    }
}

/// Adds the number of a material, and what geometry knows of it.
fn read_looks(materials: &MaterialTable<'_>, index: u32, key: &mut KeyOf) {
    key.number(index);
    if index != NONE {
        let looks = materials.looks(index);
        key.number(looks.glows).number(looks.has_inside).number(looks.is_partial);
    }
}

fn lamp(light: &Light, center: DVec3, material: u32) -> Ball {
    let share = light.beam.map_or(1.0, |beam| beam.share());
    Ball { center, radius: light.radius, material, facing: light::facing(light), share }
}

/// One instance becomes a body.
struct Maker<'a, 'b> {
    scene: &'a Scene,
    instance: &'a Instance,
    transform: &'a Transform,
    materials: &'a mut MaterialTable<'b>,
    stages: &'a Stages,
}

impl Maker<'_, '_> {
    /// `stored`: the mesh that is stored once, if it shows one.
    fn form(
        &mut self,
        stored: Option<usize>,
        meshes: &mut Vec<Shared>,
        diagnostics: &mut Vec<Diagnostic>,
    ) -> Form {
        let sheets = Sheets::of(self.scene, self.instance);
        let is_mesh = matches!(self.instance.shape, Shape::Mesh { .. });
        if !is_mesh && sheets.as_ref().is_some_and(|sheets| !sheets.exists(0)) {
            return Form::Nothing;
        }
        match &self.instance.shape {
            Shape::Sphere { radius } => self.sphere(*radius, diagnostics),
            Shape::Rectangle { size } => self.faces(&[rectangle(*size)]),
            Shape::Quad { corners } => self.faces(&[quad(*corners)]),
            Shape::Box { size } => self.faces(&box_faces(*size)),
            Shape::Faces { points, triangles } => self.triangles(points, triangles, diagnostics),
            Shape::Mesh { asset, parts } => {
                let mesh = self.mesh(*asset, parts, sheets, diagnostics);
                match stored {
                    None => Form::Mesh(mesh),
                    Some(index) => self.stored(index, &mesh, meshes),
                }
            }
        }
    }

    /// The instance's own material, else `fallback`.
    fn material(&mut self, fallback: MaterialRef) -> u32 {
        let of = self.instance.material.map_or(fallback, MaterialRef::Scene);
        self.materials.index(of)
    }

    fn sphere(&mut self, radius: f64, diagnostics: &mut Vec<Diagnostic>) -> Form {
        let Some(scale) = self.transform.uniform_scale() else {
            let name = &self.instance.name.text;
            diagnostics.push(
                Diagnostic::error(Code("E0804"), format!("`{name}` would not stay a sphere"))
                    .at(self.instance.shape_span, "a sphere, scaled differently along its axes")
                    .with_help("give `scale` one number, or use a mesh"),
            );
            return Form::Nothing;
        };
        let material = self.material(MaterialRef::Default);
        let center = self.transform.point(DVec3::ZERO);
        Form::Sphere(Ball {
            center,
            radius: radius * scale,
            material,
            facing: [0.0; 5],
            share: 1.0,
        })
    }

    fn faces(&mut self, faces: &[Parallelogram]) -> Form {
        let material = self.material(MaterialRef::Default);
        Form::Faces(faces.iter().map(|face| self.face(face)).collect(), material)
    }

    /// A mesh of the text.
    fn triangles(
        &mut self,
        points: &[[f64; 3]],
        triangles: &[[u32; 3]],
        diagnostics: &mut Vec<Diagnostic>,
    ) -> Form {
        let material = self.material(MaterialRef::Default);
        if self.materials.reads_textures(material) {
            diagnostics.push(self.without_uvs("this mesh"));
        }
        let face = |corners: &[u32; 3]| {
            let place = |i: u32| self.transform.point(DVec3::from(points[i as usize]));
            let [a, mut b, mut c] = corners.map(place);
            if self.transform.mirrors {
                (b, c) = (c, b);
            }
            let area = 0.5 * (b - a).cross(c - a).length();
            Face { corners: [a, b, c, c], uvs: [DVec2::ZERO; 4], half: true, area }
        };
        Form::Faces(triangles.iter().map(face).collect(), material)
    }

    fn face(&self, [corner, edge1, edge2]: &Parallelogram) -> Face {
        let origin = self.transform.point(*corner);
        let (mut edge1, mut edge2) =
            (self.transform.linear * *edge1, self.transform.linear * *edge2);
        let mut uv = [DVec2::X, DVec2::Y];
        if self.transform.mirrors {
            (edge1, edge2) = (edge2, edge1);
            uv.swap(0, 1);
        }
        Face {
            corners: [origin, origin + edge1, origin + edge1 + edge2, origin + edge2],
            uvs: [DVec2::ZERO, uv[0], DVec2::ONE, uv[1]],
            half: false,
            area: edge1.cross(edge2).length(),
        }
    }

    fn mesh(
        &mut self,
        asset: usize,
        shown: &Parts,
        sheets: Option<Sheets>,
        diagnostics: &mut Vec<Diagnostic>,
    ) -> MeshForm {
        let files = self.materials.files;
        let file = &files.assets()[asset];
        let mut content = KeyOf::stage("parts of a mesh");
        let (mut parts, mut bare, mut colorless) = (Vec::new(), None, None);
        for index in file.chosen(shown) {
            let part = &file.parts[index];
            let own = part.material.map_or(MaterialRef::Default, |material| MaterialRef::Asset {
                asset,
                material: material as usize,
            });
            let material = self.material(own);
            if !part.has_uvs && self.materials.reads_textures(material) {
                bare = bare.or(Some(part));
            }
            if !part.has_colors && self.materials.reads_vertex_colors(material) {
                colorless = colorless.or(Some(part));
            }
            content.bytes(&part.content);
            parts.push((index, material));
        }
        let called = |part: &PartFacts| match part.name.as_str() {
            "" => format!("the mesh of `{}`", self.instance.name.text),
            name => format!("`{name}`"),
        };
        diagnostics.extend(bare.map(|part| self.without_uvs(&called(part))));
        diagnostics.extend(colorless.map(|part| self.without_colors(&called(part))));
        MeshForm { asset, parts, sheets, content: content.end() }
    }

    /// Notes a place of the stored mesh `index`, made of `mesh`.
    fn stored(&self, index: usize, mesh: &MeshForm, meshes: &mut Vec<Shared>) -> Form {
        let own = self.instance.material.is_none();
        let materials: Vec<u32> = mesh.parts.iter().map(|part| part.1).collect();
        let material = if own { NONE } else { materials.first().copied().unwrap_or(NONE) };
        if index == meshes.len() {
            let (asset, content) = (mesh.asset, Some(mesh.content));
            let parts = mesh.parts.iter().map(|part| part.0).collect();
            meshes.push(Shared { asset, parts, materials, own, content });
        } else if !meshes[index].own {
            (meshes[index].materials, meshes[index].own) = (materials, own);
        }
        Form::Stored(index, material)
    }

    /// Textures are to be read where there are no texture coordinates. A file that says both itself is taken
    /// as it is: its textures are read at one point.
    fn without_uvs(&self, name: &str) -> Diagnostic {
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

    /// Vertex colours are to be read where there are none.
    fn without_colors(&self, name: &str) -> Diagnostic {
        let text = format!("{name} has no vertex colours: `vertex_color` is white there");
        let mesh = self.instance.shape_span;
        let warning = Diagnostic::warning(Code("W0404"), "no_effect", text);
        let warning = warning.at(mesh, "this mesh");
        match self.instance.material_span {
            Some(span) => warning.because(span, "reads `vertex_color`"),
            None => warning,
        }
    }

    /// What is wrong with the grain of the instance.
    fn grain(&self, thing: &Thing, form: &Form) -> Result<Option<Diagnostic>, ImportError> {
        if !grain::matters(self.scene, self.instance) {
            return Ok(None);
        }
        let beam = match form {
            Form::Nothing | Form::Sphere(_) => grain::beam(thing, &[]),
            Form::Faces(faces, _) => {
                let corners: Vec<_> = faces.iter().flat_map(Face::triangles).collect();
                grain::beam(thing, &corners)
            }
            Form::Mesh(_) | Form::Stored(..) => {
                let Shape::Mesh { asset, parts } = &self.instance.shape else { return Ok(None) };
                let (mesh, numbers) = ((*asset, parts), self.transform.numbers());
                let known = (self.materials.files, self.stages);
                measured::of_parts("beam", mesh, &numbers, known, |parts| {
                    let placed =
                        parts.iter().flat_map(|part| measured::placed(part, self.transform));
                    grain::beam(thing, &placed.collect::<Vec<_>>())
                })?
            }
        };
        Ok(beam.and_then(|beam| grain::check(self.scene, self.instance, &beam)))
    }
}

impl Face {
    /// Its triangles, by corner.
    pub(in crate::lower) fn halves(&self) -> &'static [[usize; 3]] {
        if self.half { &[[0, 1, 2]] } else { &[[0, 1, 2], [0, 2, 3]] }
    }

    pub(in crate::lower) fn triangles(&self) -> impl Iterator<Item = [DVec3; 3]> {
        self.halves().iter().map(|corners| corners.map(|corner| self.corners[corner]))
    }
}

fn rectangle([x, z]: [f64; 2]) -> Parallelogram {
    [DVec3::new(-x, 0.0, z) / 2.0, DVec3::new(x, 0.0, 0.0), DVec3::new(0.0, 0.0, -z)]
}

fn quad(corners: [[f64; 3]; 3]) -> Parallelogram {
    let [a, b, c] = corners.map(DVec3::from);
    [a, b - a, c - b]
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
}
