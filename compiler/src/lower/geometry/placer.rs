//! One instance becomes triangles, a sphere, or the place of a mesh that is stored once.

use std::borrow::Cow;

use glam::{DVec2, DVec3};
use lang::diagnostic::{Code, Diagnostic};
use lang::scene::{Instance, Shape};
use pack::abi::{self, LightKind, NONE, TRI_SMOOTH};

use super::transform::{Transform, octahedral};
use super::{Ball, Placement, Stage};
use crate::import::{Attribute, MeshFile, Part};
use crate::lower::grain;
use crate::lower::light::Emitter;
use crate::lower::material::{MaterialRef, MaterialTable};
use crate::lower::share::chosen;
use crate::lower::sheet::{Sheets, pieces_of};
use crate::lower::stored::{Placed, Stored};

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

/// One instance on its way into the world.
pub(super) struct Placer<'a, 'b> {
    /// Index into `Placement::things`.
    pub(super) object: u32,
    /// How its leaves or petals differ.
    pub(super) sheets: Option<Sheets>,
    pub(super) instance: &'a Instance,
    pub(super) transform: Transform,
    pub(super) materials: &'a mut MaterialTable<'b>,
    pub(super) placement: &'a mut Placement,
}

impl Placer<'_, '_> {
    /// The instance with this index in the scene.
    pub(super) fn instance(
        &mut self,
        stage: &Stage<'_>,
        index: usize,
        diagnostics: &mut Vec<Diagnostic>,
    ) {
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

/// Whether any texture belongs to the material.
fn reads_textures(material: &abi::Material) -> bool {
    material.textures().iter().any(|texture| *texture != NONE)
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
