//! Triangles of a mesh file in the world, metres, with their shading data; and what is measured of them.

use std::collections::BTreeMap;
use std::ops::Range;

use glam::{DVec2, DVec3};
use pack::abi::{self, NONE, TRI_SMOOTH};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::body::{Body, MeshForm};
use super::transform::octahedral;
use crate::import::Part;
use crate::lower::extent::Extent;
use crate::lower::files::Meshes;
use crate::lower::inside::Boundary;
use crate::lower::material::MaterialTable;
use crate::lower::sheet::pieces_of;

/// Leaves and petals of each part of a file that has some: the piece of each triangle.
pub(in crate::lower) struct Pieces(BTreeMap<(usize, usize), Vec<u32>>);

impl Pieces {
    /// Those of some things.
    pub(in crate::lower) fn of(forms: &[&MeshForm], meshes: &Meshes) -> Self {
        let sheets = forms.iter().filter(|form| form.sheets.is_some());
        let parts = sheets.flat_map(|form| form.parts.iter().map(|part| (form.asset, part.0)));
        let parts: std::collections::BTreeSet<(usize, usize)> = parts.collect();
        let pieces =
            |(asset, part): (usize, usize)| ((asset, part), pieces_of(&meshes[&asset].parts[part]));
        Self(parts.into_par_iter().map(pieces).collect())
    }
}

/// What is known of a mesh in the world without its triangles.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(in crate::lower) struct Measured {
    pub(in crate::lower) extent: Extent,
    /// Surfaces of parts whose materials have an inside.
    pub(in crate::lower) boundaries: Vec<Boundary>,
}

/// Measures the mesh `form` of `body`; its surfaces are of use if `inside` says so.
pub(in crate::lower) fn measure(
    (body, form): (&Body, &MeshForm),
    (meshes, pieces): (&Meshes, &Pieces),
    materials: &MaterialTable<'_>,
    inside: bool,
) -> Measured {
    let nothing = || Measured { extent: Extent::NOTHING, boundaries: Vec::new() };
    let measured = triangles((body, form), (meshes, pieces), nothing, |found, corner, material| {
        let looks = materials.looks(material);
        let corners = corner.positions();
        for p in corners {
            found.extent.add(p, looks.glows);
        }
        if inside && looks.has_inside {
            found.boundaries.push(Boundary::triangle(&corners, material, body.object));
        }
    });
    measured.into_iter().fold(nothing(), |mut all, mut part| {
        all.extent = all.extent.union(part.extent);
        all.boundaries.append(&mut part.boundaries);
        all
    })
}

/// Triangles that are one piece of work.
const CHUNK: usize = 1 << 14;

/// Calls `visit` with each triangle of the mesh `form` of `body` that is there, and its material; many are visited
/// side by side. What each piece of work makes of `start`, in the order of the triangles.
pub(in crate::lower) fn triangles<T: Send>(
    (body, form): (&Body, &MeshForm),
    (meshes, pieces): (&Meshes, &Pieces),
    start: impl Fn() -> T + Sync,
    visit: impl Fn(&mut T, Triangle<'_>, u32) + Sync,
) -> Vec<T> {
    let file = &meshes[&form.asset];
    let mut work = Vec::new();
    for &(index, material) in &form.parts {
        let n = file.parts[index].triangles.len();
        let chunk = |from: usize| (index, material, from..n.min(from + CHUNK));
        work.extend((0..n).step_by(CHUNK).map(chunk));
    }
    let make = |(index, material, range): (usize, u32, Range<usize>)| {
        let part = &file.parts[index];
        let pieces = pieces.0.get(&(form.asset, index)).filter(|_| form.sheets.is_some());
        let mut made = start();
        for tri_idx in range {
            let piece = pieces.map_or(0, |pieces| pieces[tri_idx]);
            if form.sheets.as_ref().is_none_or(|sheets| sheets.exists(piece)) {
                visit(&mut made, Triangle { body, form, part, tri_idx, piece }, material);
            }
        }
        made
    };
    work.into_par_iter().map(make).collect()
}

/// A triangle of a mesh.
pub(in crate::lower) struct Triangle<'a> {
    body: &'a Body,
    form: &'a MeshForm,
    part: &'a Part,
    tri_idx: usize,
    piece: u32,
}

impl Triangle<'_> {
    /// Which corner of the file comes first, second, third: counter-clockwise seen from the front.
    fn order(&self) -> [usize; 3] {
        if self.body.transform.mirrors { [0, 2, 1] } else { [0, 1, 2] }
    }

    /// Its corners in the world, metres.
    pub(in crate::lower) fn positions(&self) -> [DVec3; 3] {
        let corners = self.part.corners(self.tri_idx);
        let corners = corners.map(|p| self.body.transform.point(DVec3::from(p.map(f64::from))));
        self.order().map(|k| corners[k])
    }

    /// Its shading data.
    pub(in crate::lower) fn shade(&self, material: u32) -> abi::TriShade {
        let transform = &self.body.transform;
        let normals =
            self.normals().map(|normals| normals.map(|n| octahedral(transform.normal * n)));
        let uvs = self.part.corner_uvs(self.tri_idx).unwrap_or_default();
        let [uv0, uv1, uv2] = self.order().map(|k| uvs[k]);
        let smooth = if normals.is_some() { TRI_SMOOTH } else { 0 };
        let object = self.body.object | smooth;
        let normals = normals.map_or([0; 3], |normals| self.order().map(|k| normals[k]));
        abi::TriShade { normals, material, uv0, uv1, uv2, light: NONE, object }
    }

    /// The colours of its corners.
    pub(in crate::lower) fn colors(&self) -> abi::VertexColors {
        let colors = self.part.corner_colors(self.tri_idx);
        abi::VertexColors::of(self.order().map(|k| colors[k]))
    }

    /// Its shading normals, object frame, if it has any.
    fn normals(&self) -> Option<[DVec3; 3]> {
        let Self { part, tri_idx, piece, .. } = *self;
        let own = part.corner_normals(tri_idx);
        let own = own.map(|normals| normals.map(|n| DVec3::from(n.map(f64::from))));
        let sheets = self.form.sheets.as_ref().filter(|sheets| sheets.leans());
        let Some(sheets) = sheets else { return own };
        let [a, b, c] = part.corners(tri_idx).map(|p| DVec3::from(p.map(f64::from)));
        let uvs = part.corner_uvs(tri_idx).unwrap_or([[0.5; 2]; 3]);
        let uvs = uvs.map(|uv| DVec2::from(uv.map(f64::from)));
        let (d1, d2) = (uvs[1] - uvs[0], uvs[2] - uvs[0]);
        let along = ((b - a) * d2.y - (c - a) * d1.y) * d1.perp_dot(d2).signum();
        let flat = (b - a).cross(c - a);
        let base = own.unwrap_or([flat; 3]);
        Some([0, 1, 2].map(|k| sheets.normal(piece, base[k], along, uvs[k])))
    }
}
