//! What must be known of all things together before triangles are made: the frame of the scene, what receives
//! light, and what surfaces things with an inside have.
//!
//! Of meshes that stand where they stood it is known; others are measured.

use std::collections::BTreeSet;

use glam::DVec3;
use rayon::prelude::*;

use super::extent::{self, Extent, Receivers};
use super::files::{Files, Meshes};
use super::geometry::body::{Ball, Bodies, Body, Face, Form, MeshForm, Shared};
use super::geometry::mesh::{Measured, Pieces, measure};
use super::geometry::{Part, part};
use super::inside::Boundary;
use super::material::MaterialTable;
use super::stored::{Placed, Stored, StoredRest};
use crate::import::ImportError;
use crate::normalize::Normalization;
use crate::stage::{KeyOf, Stages};

/// See the module.
pub(super) struct Survey {
    pub(super) frame: Normalization,
    pub(super) receivers: Receivers,
    pub(super) boundaries: Vec<Boundary>,
    /// Meshes that are stored once.
    pub(super) meshes: Vec<Stored>,
    /// Where they are.
    pub(super) placed: Vec<Placed>,
}

impl Survey {
    /// Of all things; `inside`: light must know what it is inside of.
    ///
    /// # Errors
    /// When a mesh cannot be loaded.
    pub(super) fn of(
        bodies: &Bodies,
        materials: &MaterialTable<'_>,
        stages: &Stages,
        inside: bool,
    ) -> Result<Self, ImportError> {
        let files = materials.files;
        let mut of_meshes = measured(bodies, materials, stages, inside)?.into_iter();
        let colored = materials.textures.has_vertex_colors();
        let meshes = stored(bodies, colored, files, stages)?;
        let (mut extents, mut boundaries, mut placed) = (Vec::new(), Vec::new(), Vec::new());
        for body in &bodies.list {
            let mut extent = Extent::NOTHING;
            match &body.form {
                Form::Nothing => {}
                Form::Mesh(_) => {
                    let measured = of_meshes.next().expect("every mesh has been measured");
                    extent = measured.extent;
                    boundaries.extend(measured.boundaries);
                }
                Form::Sphere(ball) => {
                    let looks = materials.looks(ball.material);
                    extent.add(ball.center - ball.radius, looks.glows);
                    extent.add(ball.center + ball.radius, looks.glows);
                    if inside && looks.has_inside {
                        let (center, radius) = (ball.center, ball.radius);
                        let object = body.object;
                        boundaries.push(Boundary::sphere(center, radius, ball.material, object));
                    }
                }
                Form::Faces(faces, material) => {
                    let looks = materials.looks(*material);
                    for corners in faces.iter().flat_map(Face::triangles) {
                        for p in corners {
                            extent.add(p, looks.glows);
                        }
                        if inside && looks.has_inside {
                            boundaries.push(Boundary::triangle(&corners, *material, body.object));
                        }
                    }
                }
                Form::Stored(index, material) => {
                    let mesh = &meshes[*index];
                    if !mesh.corners.is_empty() {
                        let (transform, object) = (&body.transform, body.object);
                        let place = Placed::new(mesh, *index, transform, object, *material);
                        place.bounds.iter().for_each(|corner| extent.add(*corner, false));
                        if inside {
                            add_surfaces(mesh, &place, materials, &mut boundaries);
                        }
                        placed.push(place);
                    }
                }
            }
            extents.push(extent);
        }
        let frame = extent::frame(&extents, ends(bodies, &extents));
        let receivers = Receivers::of(&extents);
        Ok(Self { frame, receivers, boundaries, meshes, placed })
    }
}

/// What is known of each thing that shows a mesh of its own, in order.
fn measured(
    bodies: &Bodies,
    materials: &MaterialTable<'_>,
    stages: &Stages,
    inside: bool,
) -> Result<Vec<Measured>, ImportError> {
    let key = |body: &Body| {
        let mut key = KeyOf::stage("what is measured of a mesh");
        key.key(body.key(materials)).number(inside).end()
    };
    let of_mesh = bodies.list.iter().filter(|body| body.mesh().is_some());
    let mut found: Vec<(&Body, Option<Measured>)> =
        of_mesh.map(|body| (body, stages.get(key(body)))).collect();
    let new: Vec<&Body> = found.iter().filter(|(_, m)| m.is_none()).map(|(b, _)| *b).collect();
    let (meshes, pieces) = load(bodies, &new, materials.files)?;
    found.par_iter_mut().filter(|(_, measured)| measured.is_none()).for_each(|(body, measured)| {
        if let Some(form) = body.mesh() {
            let made = measure((body, form), (&meshes, &pieces), materials, inside);
            stages.put(key(body), &made);
            *measured = Some(made);
        }
    });
    Ok(found.into_iter().filter_map(|(_, measured)| measured).collect())
}

/// The files of some things, and the pieces of those of their parts that are leaves or petals.
pub(super) fn load(
    bodies: &Bodies,
    of: &[&Body],
    files: &dyn Files,
) -> Result<(Meshes, Pieces), ImportError> {
    let meshes = files.load_meshes(&bodies.assets(of.iter().copied()))?;
    let forms: Vec<&MeshForm> = of.iter().filter_map(|body| body.mesh()).collect();
    let pieces = Pieces::of(&forms, &meshes);
    Ok((meshes, pieces))
}

/// The meshes that are stored once; `colored`: with the colours of their corners.
fn stored(
    bodies: &Bodies,
    colored: bool,
    files: &dyn Files,
    stages: &Stages,
) -> Result<Vec<Stored>, ImportError> {
    let known = |shared: &Shared| {
        let (records, rest) = part::<StoredRest>(stages, shared.key(colored))?;
        let (mut corners, mut labels, mut shades) = (Vec::new(), Vec::new(), Vec::new());
        for (triangle, shade) in records.iter() {
            corners.push([triangle.v0, triangle.v1, triangle.v2]);
            labels.push([triangle.id0, triangle.id1, triangle.id2]);
            shades.push(shade);
        }
        let colors = if colored { records.colors().collect() } else { Vec::new() };
        Some(Stored::of_triangles(&rest, (corners, labels), (shades, colors)))
    };
    let known: Vec<Option<Stored>> = bodies.meshes.par_iter().map(known).collect();
    let new = bodies.meshes.iter().zip(&known).filter(|(_, known)| known.is_none());
    let assets: BTreeSet<usize> = new.map(|(shared, _)| shared.asset).collect();
    let meshes = files.load_meshes(&assets)?;
    let make = |(shared, known): (&Shared, Option<Stored>)| {
        known.unwrap_or_else(|| {
            let file = &meshes[&shared.asset];
            let parts = shared.parts.iter().zip(&shared.materials);
            let parts: Vec<_> = parts.map(|(part, m)| (&file.parts[*part], *m)).collect();
            Stored::new(&parts, colored)
        })
    };
    Ok(bodies.meshes.par_iter().zip(known).map(make).collect())
}

/// What the next compilation may take from the pack of the meshes that are stored once, whose triangles begin at
/// `first`.
pub(super) fn parts(
    bodies: &Bodies,
    colored: bool,
    meshes: &[Stored],
    mut first: usize,
) -> Vec<Part<StoredRest>> {
    let part = |(shared, mesh): (&Shared, &Stored)| {
        let triangles = first..first + mesh.corners.len();
        first = triangles.end;
        Part::new(shared.key(colored), triangles, mesh.rest())
    };
    bodies.meshes.iter().zip(meshes).map(part).collect()
}

/// Adds the surfaces of a place whose materials have an inside.
fn add_surfaces(
    mesh: &Stored,
    place: &Placed,
    materials: &MaterialTable<'_>,
    boundaries: &mut Vec<Boundary>,
) {
    for (corners, own) in mesh.triangles() {
        let material = place.material_of(own);
        if materials.looks(material).has_inside {
            let corners = place.triangle(corners);
            boundaries.push(Boundary::triangle(&corners, material, place.object));
        }
    }
}

/// Where moving things are when the shutter closes, or come on their way, metres, as points whose bounds are theirs.
fn ends(bodies: &Bodies, extents: &[Extent]) -> Vec<[f64; 3]> {
    let mut ends: Vec<DVec3> = Vec::new();
    for ((body, thing), extent) in bodies.list.iter().zip(&bodies.things).zip(extents) {
        if let Some(path) = &thing.path {
            let of_ball = |ball: &Ball| [ball.center - ball.radius, ball.center + ball.radius];
            let corners = match &body.form {
                Form::Sphere(ball) => Some(of_ball(ball)),
                Form::Nothing | Form::Faces(..) | Form::Mesh(_) | Form::Stored(..) => {
                    extent.corners()
                }
            };
            ends.extend(corners.into_iter().flat_map(|[lo, hi]| path.sweep(lo, hi)));
            continue;
        }
        if thing.motion == DVec3::ZERO {
            continue;
        }
        if let Form::Sphere(ball) = &body.form {
            let center = ball.center + thing.motion;
            ends.extend([center - ball.radius, center + ball.radius]);
        } else {
            // Sums are rounded alike: what is lowest stays lowest.
            ends.extend(extent.corners().into_iter().flatten().map(|p| p + thing.motion));
        }
    }
    ends.into_iter().map(DVec3::into).collect()
}
