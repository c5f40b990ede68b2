//! Things become triangles and spheres of the normalised frame with their shading data, or places of meshes that
//! are stored once.
//!
//! Things that `share` does not name are flattened: each has its own triangles. Rectangles are two triangles, boxes
//! twelve. Triangles that have no area once they are rounded are left out and counted. Everything that emits is
//! noted as an `Emitter` on the way. Triangles that the pack of the last compilation has are taken from there.

pub(super) mod body;
pub(super) mod mesh;
pub(super) mod transform;

use std::collections::BTreeMap;
use std::ops::Range;

use glam::DVec3;
use pack::Pack;
use pack::abi::{self, LightKind, NONE, TRI_SMOOTH};
use serde::{Deserialize, Serialize};

use super::extent::Receivers;
use super::files::Meshes;
use super::light::Emitter;
use super::material::MaterialTable;
use super::stored::{Placed, Stored, has_no_area};
use crate::bvh::Motion;
use crate::normalize::Normalization;
use crate::stage::{self, Key, KeyOf, Stages};
use body::{Ball, Bodies, Body, Face, Form, MeshForm};
use mesh::{Pieces, triangles};

/// Geometry of the whole scene when the shutter opens, normalised frame, in order of declaration.
#[derive(Debug, Default)]
pub(super) struct Placement {
    /// Corners of every triangle that is stored in the world.
    pub(super) corners: Vec<[[f32; 3]; 3]>,
    /// What these corners are called in the last pack, three times `NONE` where it does not have them.
    pub(super) labels: Vec<[u32; 3]>,
    /// Shading data, one a triangle; `light` is `NONE` still.
    pub(super) shades: Vec<abi::TriShade>,
    /// Colours of the corners of every triangle; empty where nothing asks for them.
    pub(super) colors: Vec<abi::VertexColors>,
    /// Triangles of each mesh instance: `groups[i]` is where group `i` ends.
    pub(super) groups: Vec<u32>,
    /// Meshes that are stored once.
    pub(super) meshes: Vec<Stored>,
    /// Where they are.
    pub(super) placed: Vec<Placed>,
    /// Centre and radius of every sphere.
    pub(super) spheres: Vec<([f32; 3], f32)>,
    /// Material of every sphere.
    pub(super) sphere_materials: Vec<u32>,
    /// Object of every sphere.
    pub(super) sphere_objects: Vec<u32>,
    /// What emits, in order of declaration.
    pub(super) emitters: Vec<Emitter>,
    /// Index of each triangle of a part of a mesh that emits, its material, and its area as in `Emitter`.
    glowing: Vec<(u32, u32, f64)>,
    /// Triangles that have no area.
    pub(super) dropped: u64,
    /// What the next compilation may take from the pack.
    pub(super) parts: Vec<Part<MeshRest>>,
}

/// Triangles that belong together, to be found in the pack by their key.
#[derive(Debug)]
pub(super) struct Part<T> {
    key: Key,
    /// Among all triangles in order of declaration.
    triangles: Range<usize>,
    rest: T,
}

/// A part in a pack: where each triangle is, and what else is known.
#[derive(Serialize, Deserialize)]
pub(super) struct Found<T> {
    #[serde(with = "stage::plain")]
    at: Vec<u32>,
    rest: T,
}

/// What is known of a mesh in the world beside its triangles.
#[derive(Debug, Default, Serialize, Deserialize)]
pub(super) struct MeshRest {
    dropped: u64,
    /// Index of each triangle that emits, its material, and its area as in `Emitter`.
    emitters: Vec<(u32, u32, f64)>,
}

impl<T: Serialize> Part<T> {
    pub(super) fn new(key: Key, triangles: Range<usize>, rest: T) -> Self {
        Self { key, triangles, rest }
    }

    /// Notes where its triangles are in the pack that is being made.
    pub(super) fn put(self, triangle_at: &[u32], stages: &Stages) {
        let at = triangle_at[self.triangles].to_vec();
        stages.put_part(self.key, &Found { at, rest: self.rest });
    }
}

/// The records of a part, if the last pack has it, and what else is known of it.
pub(super) fn part<T: for<'de> Deserialize<'de>>(
    stages: &Stages,
    key: Key,
) -> Option<(Records<'_>, T)> {
    let (Found { at, rest }, pack) = stages.part::<Found<T>>(key)?;
    let (triangles, shades): (&[abi::Triangle], &[abi::TriShade]) =
        (pack.records(), pack.records());
    let fits = triangles.len() == shades.len();
    let fits = fits && at.iter().all(|at| (*at as usize) < triangles.len());
    fits.then_some((Records { pack, at }, rest))
}

/// Triangles of the last pack.
pub(super) struct Records<'a> {
    pack: &'a Pack,
    at: Vec<u32>,
}

impl Records<'_> {
    /// Each of them with its shading data, without its light.
    pub(super) fn iter(&self) -> impl Iterator<Item = (&abi::Triangle, abi::TriShade)> {
        let (triangles, shades): (&[abi::Triangle], &[abi::TriShade]) =
            (self.pack.records(), self.pack.records());
        self.at.iter().map(move |at| {
            let at = *at as usize;
            (&triangles[at], abi::TriShade { light: NONE, ..shades[at] })
        })
    }

    /// The colours of their corners.
    pub(super) fn colors(&self) -> impl Iterator<Item = abi::VertexColors> {
        let colors: &[abi::VertexColors] = self.pack.records();
        self.at.iter().filter_map(|at| colors.get(*at as usize).copied())
    }
}

/// What is needed to place a scene besides its files.
pub(super) struct Stage<'a> {
    pub(super) bodies: &'a Bodies,
    pub(super) materials: &'a MaterialTable<'a>,
    pub(super) frame: &'a Normalization,
    /// By which emitters are weighed.
    pub(super) receivers: Receivers,
    /// Some texture asks for the colours of vertices.
    pub(super) colored: bool,
    pub(super) stages: &'a Stages,
}

/// The key of the triangles that `body`, which shows a mesh, has in a frame.
fn key_of(stage: &Stage<'_>, body: &Body) -> Key {
    let mut key = KeyOf::stage("triangles of a mesh");
    key.key(body.key(stage.materials)).floats(&stage.frame.center);
    key.number(u64::from(stage.frame.exponent as u32));
    stage.receivers.read(&mut key);
    if stage.colored {
        key.number(1_u32);
    }
    key.end()
}

/// Meshes of things, by their place in `Bodies::list`, that the last pack has.
pub(super) type Known<'a> = BTreeMap<u32, (Records<'a>, MeshRest)>;

/// What the last pack has of the things that show meshes of their own, and the things of which it has nothing.
pub(super) fn known<'a>(stage: &Stage<'a>) -> (Known<'a>, Vec<&'a Body>) {
    let (mut known, mut new) = (Known::new(), Vec::new());
    for body in &stage.bodies.list {
        match &body.form {
            Form::Nothing | Form::Sphere(_) | Form::Faces(..) | Form::Stored(..) => {}
            Form::Mesh(_) => match part(stage.stages, key_of(stage, body)) {
                Some(found) => drop(known.insert(body.object, found)),
                None => new.push(body),
            },
        }
    }
    (known, new)
}

/// Places everything that is not stored once; `files` has all that is not `known`.
pub(super) fn place(
    stage: &Stage<'_>,
    mut known: Known<'_>,
    files: (&Meshes, &Pieces),
) -> Placement {
    let mut placement = Placement::default();
    for body in &stage.bodies.list {
        match &body.form {
            Form::Nothing | Form::Stored(..) => {}
            Form::Sphere(ball) => placement.add_sphere(stage, body.object, ball),
            Form::Faces(faces, material) => {
                placement.add_faces(stage, body.object, faces, *material);
            }
            Form::Mesh(form) => {
                let known = known.remove(&body.object);
                placement.add_mesh(stage, (body, form), known, files);
            }
        }
        placement.close();
    }
    placement
}

impl Placement {
    fn add_sphere(&mut self, stage: &Stage<'_>, object: u32, ball: &Ball) {
        let Ball { center, radius, material, facing, share } = *ball;
        let looks = stage.materials.looks(material);
        // Where it is there in part a ray may meet either end, and one sample of a light would stand for both: only
        // rays that are scattered find it.
        if looks.glows && !looks.is_partial {
            let area = 4.0 * std::f64::consts::PI * radius * radius * share;
            self.emitters.push(Emitter {
                kind: LightKind::Sphere,
                primitive: self.spheres.len() as u32,
                count: 1,
                material,
                area: stage.receivers.weigh(area, center),
                facing,
            });
        }
        // No radius is lost.
        let radius = stage.frame.length(radius).max(f32::MIN_POSITIVE);
        self.spheres.push((stage.frame.point(center.to_array()), radius));
        self.sphere_materials.push(material);
        self.sphere_objects.push(object);
    }

    /// A face that loses a triangle without area is no light.
    fn add_faces(&mut self, stage: &Stage<'_>, object: u32, faces: &[Face], material: u32) {
        for face in faces {
            let first = self.corners.len() as u32;
            for [a, b, c] in face.halves().iter().copied() {
                let uv = |corner: usize| face.uvs[corner].as_vec2().to_array();
                let shade = abi::TriShade {
                    material,
                    uv0: uv(a),
                    uv1: uv(b),
                    uv2: uv(c),
                    light: NONE,
                    object,
                    ..Default::default()
                };
                let corners = [a, b, c].map(|corner| face.corners[corner]);
                self.add(stage, &corners, (shade, &|| abi::VertexColors::WHITE));
            }
            let count = face.halves().len() as u32;
            let is_whole = self.corners.len() as u32 == first + count;
            if is_whole && stage.materials.looks(material).glows {
                // Between opposite corners.
                let middle = 0.5 * (face.corners[0] + face.corners[2]);
                let kind = if face.half { LightKind::Triangle } else { LightKind::Rectangle };
                self.emitters.push(Emitter {
                    kind,
                    primitive: first,
                    count,
                    material,
                    area: stage.receivers.weigh(face.area, middle),
                    facing: [0.0; 5],
                });
            }
        }
    }

    /// Adds a triangle in the world, metres; says whether it has an area.
    fn add(
        &mut self,
        stage: &Stage<'_>,
        corners: &[DVec3; 3],
        (shade, colors): (abi::TriShade, &dyn Fn() -> abi::VertexColors),
    ) -> bool {
        let corners = corners.map(|p| stage.frame.point(p.to_array()));
        if has_no_area(&corners) {
            self.dropped += 1;
            return false;
        }
        self.corners.push(corners);
        self.labels.push([NONE; 3]);
        self.shades.push(shade);
        if stage.colored {
            self.colors.push(colors());
        }
        true
    }

    fn add_mesh(
        &mut self,
        stage: &Stage<'_>,
        (body, form): (&Body, &MeshForm),
        known: Option<(Records<'_>, MeshRest)>,
        files: (&Meshes, &Pieces),
    ) {
        let (first, dropped) = (self.corners.len(), self.dropped);
        let rest = if let Some((records, rest)) = known {
            self.take(&records, (body.object, stage.colored));
            self.dropped += rest.dropped;
            rest
        } else {
            let emitters = self.add_triangles(stage, (body, form), files);
            MeshRest { dropped: self.dropped - dropped, emitters }
        };
        self.emitters.extend(rest.emitters.iter().map(|(index, material, area)| Emitter {
            kind: LightKind::Triangle,
            primitive: first as u32 + index,
            count: 1,
            material: *material,
            area: *area,
            facing: [0.0; 5],
        }));
        self.parts.push(Part::new(key_of(stage, body), first..self.corners.len(), rest));
    }

    /// Adds the triangles of a mesh that is read from its file. Of those that emit: the index of each among those
    /// that were added, its material and its area.
    fn add_triangles(
        &mut self,
        stage: &Stage<'_>,
        mesh: (&Body, &MeshForm),
        files: (&Meshes, &Pieces),
    ) -> Vec<(u32, u32, f64)> {
        let made = triangles(mesh, files, Self::default, |made, triangle, material| {
            let corners = triangle.positions();
            let index = made.corners.len() as u32;
            let shade = triangle.shade(material);
            let stays = made.add(stage, &corners, (shade, &|| triangle.colors()));
            if stays && stage.materials.looks(material).glows {
                let [a, b, c] = corners;
                let area = 0.5 * (b - a).cross(c - a).length();
                let middle = corners.iter().sum::<DVec3>() / 3.0;
                made.glowing.push((index, material, stage.receivers.weigh(area, middle)));
            }
        });
        let (mut n, mut emitters) = (0, Vec::new());
        for part in &made {
            emitters
                .extend(part.glowing.iter().map(|(i, material, area)| (i + n, *material, *area)));
            n += part.corners.len() as u32;
            self.dropped += part.dropped;
        }
        self.colors.extend(made.iter().flat_map(|part| &part.colors));
        let (corners, shades) = (&mut self.corners, &mut self.shades);
        corners.reserve(n as usize);
        shades.reserve(n as usize);
        rayon::join(
            || made.iter().for_each(|part| corners.extend_from_slice(&part.corners)),
            || made.iter().for_each(|part| shades.extend_from_slice(&part.shades)),
        );
        self.labels.resize(self.corners.len(), [NONE; 3]);
        emitters
    }

    /// Adds triangles of the last pack.
    fn take(&mut self, records: &Records<'_>, (object, colored): (u32, bool)) {
        for (triangle, shade) in records.iter() {
            self.corners.push([triangle.v0, triangle.v1, triangle.v2]);
            self.labels.push([triangle.id0, triangle.id1, triangle.id2]);
            let object = object | shade.object & TRI_SMOOTH;
            self.shades.push(abi::TriShade { object, ..shade });
        }
        if colored {
            self.colors.extend(records.colors());
        }
    }

    /// Triangles of each group.
    pub(super) fn mesh_sizes(&self) -> Vec<usize> {
        let starts = std::iter::once(&0).chain(&self.groups);
        starts.zip(&self.groups).map(|(start, end)| (end - start) as usize).collect()
    }

    /// The entry of `of_thing` for each group.
    pub(super) fn mesh_motions(&self, of_thing: &[Motion]) -> Vec<Motion> {
        let starts = std::iter::once(&0).chain(&self.groups).take(self.groups.len());
        let thing = |start: &u32| self.shades[*start as usize].object & !TRI_SMOOTH;
        starts.map(|start| of_thing[thing(start) as usize].clone()).collect()
    }

    /// Ends what one thing brings. Things without triangles make no group.
    fn close(&mut self) {
        let triangles = self.shades.len() as u32;
        if self.groups.last().copied().unwrap_or(0) < triangles {
            self.groups.push(triangles);
        }
    }
}
