//! Geometry of a file becomes parts: polygons cut, triangles judged, missing normals computed.

use super::budget::Loan;
use super::check::{Quality, grow, is_zero, quality, single, unit};
use super::error::{ErrorKind, ImportError};
use super::file::Limits;
use super::frame::Frame;
use super::geometry::{Face, Geometry, PartName};
use super::mesh::{Attribute, NO_CORNER, Part, keep};
use super::normals::{self, FLAT, Wanting};
use super::polygon;
use super::report::ImportReport;
use std::collections::BTreeMap;

/// What the parts are made from, beside the geometry.
pub(super) struct Source<'a> {
    pub(super) file: &'a str,
    pub(super) faces: Faces,
    pub(super) frame: Frame,
    /// Names that runs refer to.
    pub(super) names: &'a [PartName],
    /// For each material that runs refer to, its index among the imported ones.
    pub(super) material_ids: &'a [Option<u32>],
    pub(super) limits: &'a Limits,
}

/// How a face is named in messages.
#[derive(Clone, Copy)]
pub(super) enum Faces {
    /// By its line: `file:12`.
    ByLine,
    /// By its number: `file: face 12`.
    ByNumber,
}

/// A part under construction.
#[derive(Default)]
struct Draft {
    name: u32,
    material: Option<u32>,
    positions: Vec<[f32; 3]>,
    colors: Vec<[f32; 4]>,
    triangles: Vec<[u32; 3]>,
    uvs: Vec<[f32; 2]>,
    uv_corners: Vec<[u32; 3]>,
    normals: Vec<[f32; 3]>,
    normal_corners: Vec<[u32; 3]>,
    smoothing: Vec<u32>,
}

/// No triangle has values of a kind.
const NONE_HERE: [u32; 3] = [NO_CORNER; 3];

impl Source<'_> {
    fn place(&self, face: Face) -> String {
        let (file, at) = (self.file, face.at);
        match self.faces {
            Faces::ByLine => format!("{file}:{at}"),
            Faces::ByNumber => format!("{file}: face {at}"),
        }
    }

    fn limit(&self, message: String) -> ImportError {
        ImportError::new(ErrorKind::Limit, self.file, message)
    }

    /// A position of the file in metres, +Y up.
    fn position(&self, p: [f32; 3]) -> Result<[f32; 3], ImportError> {
        let metres = single(self.frame.position(p));
        if metres.iter().all(|x| x.is_finite()) {
            return Ok(metres);
        }
        let message = format!("vertex ({}, {}, {}) is infinite in metres", p[0], p[1], p[2]);
        Err(ImportError::new(ErrorKind::Number, self.file, message)
            .with_help("check the `unit:` of the asset"))
    }

    /// A normal of the file as a unit vector, +Y up; zero where it has no direction.
    fn normal(&self, n: [f32; 3]) -> [f32; 3] {
        unit(self.frame.turn(n.map(f64::from))).map_or([0.0; 3], single)
    }
}

/// Makes the parts, in the order in which their names and materials first appear, and takes what they need.
pub(super) fn parts(
    geometry: Geometry,
    loan: Loan,
    source: &Source<'_>,
    report: &mut ImportReport,
) -> Result<Vec<Part>, ImportError> {
    let n_faces = geometry.faces.len();
    let parts = made(geometry, source, report)?;
    drop(loan);
    keep(&parts, source.file, source.limits)?;
    report.n_triangles = parts.iter().map(|part| part.triangles.len() as u64).sum();
    if report.n_triangles == 0 {
        let message = match n_faces {
            0 => "the file has no faces".to_owned(),
            n => format!("none of its {n} faces has an area"),
        };
        return Err(ImportError::new(ErrorKind::Empty, source.file, message));
    }
    Ok(parts)
}

fn made(
    geometry: Geometry,
    source: &Source<'_>,
    report: &mut ImportReport,
) -> Result<Vec<Part>, ImportError> {
    let mut drafts = drafts(geometry, source, report)?;
    drafts.retain(|draft| !draft.triangles.is_empty());
    compute_normals(&mut drafts, source, report)?;
    for draft in &drafts {
        grow(&mut report.bounds, &draft.positions);
    }
    Ok(drafts.into_iter().map(|draft| finish(draft, source.names)).collect())
}

fn drafts(
    mut file: Geometry,
    source: &Source<'_>,
    report: &mut ImportReport,
) -> Result<Vec<Draft>, ImportError> {
    let mut drafts: Vec<Draft> = Vec::new();
    let mut ids: BTreeMap<(u32, Option<u32>), usize> = BTreeMap::new();
    let mut copier = Copier::new(&file);
    let mut corners = std::mem::take(&mut file.corners);
    let (mut next_face, mut next_corner) = (0, 0);
    let mut n_triangles = 0;
    for run in &file.runs {
        let faces = &file.faces[next_face..][..run.n_faces];
        let n_corners = faces.iter().map(|face| face.n_corners as usize).sum();
        let corners = &mut corners[next_corner..][..n_corners];
        (next_face, next_corner) = (next_face + faces.len(), next_corner + n_corners);
        let state = &run.state;
        let material = state.material.and_then(|id| *source.material_ids.get(id as usize)?);
        let new = drafts.len();
        let draft_idx = *ids.entry((state.name, material)).or_insert(new);
        if draft_idx == new {
            drafts.push(Draft { name: state.name, material, ..Draft::default() });
        }
        let draft = &mut drafts[draft_idx];
        let before = draft.triangles.len();
        copier.copy(corners, draft, &file, source)?;
        let smoothing = state.smoothing.unwrap_or(u32::MAX);
        add_triangles(draft, (faces, corners), smoothing, source, report);
        n_triangles += (draft.triangles.len() - before) as u64;
        if n_triangles > source.limits.triangles {
            let max = source.limits.triangles;
            return Err(source.limit(format!("more than {max} triangles")));
        }
    }
    Ok(drafts)
}

/// Appends the triangles of some faces, whose corners refer to the values of `draft`.
fn add_triangles(
    draft: &mut Draft,
    (faces, mut corners): (&[Face], &[[u32; 3]]),
    smoothing: u32,
    source: &Source<'_>,
    report: &mut ImportReport,
) {
    for face in faces {
        let (of_face, rest) = corners.split_at(face.n_corners as usize);
        corners = rest;
        for cut in cut_face(draft, of_face, report, || source.place(*face)) {
            let [tri, uvs, mut normals] =
                [0, 1, 2].map(|which| cut.map(|i| of_face[i as usize][which]));
            let points = tri.map(|vertex| draft.positions[vertex as usize]);
            match quality(points) {
                Quality::ZeroArea => {
                    report.zero_area.add(|| source.place(*face));
                    continue;
                }
                Quality::Needle => report.needles.add(|| source.place(*face)),
                Quality::Fine => {}
            }
            let is_zero = |n: &u32| draft.normals.get(*n as usize).is_some_and(|n| is_zero(*n));
            if normals.iter().any(is_zero) {
                report.zero_normals.add(|| source.place(*face));
                normals = NONE_HERE;
            }
            draft.triangles.push(tri);
            draft.smoothing.push(smoothing);
            draft.uv_corners.push(uvs);
            draft.normal_corners.push(normals);
        }
    }
}

/// Triangles of one face, as indices of its corners.
fn cut_face(
    draft: &Draft,
    corners: &[[u32; 3]],
    report: &mut ImportReport,
    place: impl FnOnce() -> String,
) -> Vec<[u32; 3]> {
    if corners.len() == 3 {
        return vec![[0, 1, 2]];
    }
    let position = |corner: &[u32; 3]| draft.positions[corner[0] as usize];
    let points: Vec<[f32; 3]> = corners.iter().map(position).collect();
    let cut = polygon::triangulate(&points);
    report.n_polygons += 1;
    if cut.crooked {
        report.crooked_polygons.add(place);
    }
    cut.triangles
}

/// Copies the values that a run of faces uses to a part, each once, in the order of their first use.
struct Copier {
    positions: Renumbering,
    uvs: Renumbering,
    normals: Renumbering,
}

impl Copier {
    fn new(file: &Geometry) -> Self {
        Self {
            positions: Renumbering::new(file.positions.len()),
            uvs: Renumbering::new(file.uvs.len()),
            normals: Renumbering::new(file.normals.len()),
        }
    }

    /// Afterwards `corners` refer to the values of `draft`.
    fn copy(
        &mut self,
        corners: &mut [[u32; 3]],
        draft: &mut Draft,
        file: &Geometry,
        source: &Source<'_>,
    ) -> Result<(), ImportError> {
        for [vertex, uv, normal] in corners {
            let old = *vertex;
            let n_before = draft.positions.len();
            let position = |old: u32| source.position(file.positions[old as usize]);
            self.positions.renumber(vertex, &mut draft.positions, source, position)?;
            if draft.positions.len() > n_before {
                draft.colors.extend(file.colors.get(old as usize));
            }
            let value = |old: u32| Ok(file.uvs[old as usize]);
            self.uvs.renumber(uv, &mut draft.uvs, source, value)?;
            let value = |old: u32| Ok(source.normal(file.normals[old as usize]));
            self.normals.renumber(normal, &mut draft.normals, source, value)?;
        }
        for renumbering in [&mut self.positions, &mut self.uvs, &mut self.normals] {
            renumbering.forget();
        }
        Ok(())
    }
}

/// From indices into a list of the file to those into a list of a part.
struct Renumbering {
    /// `NO_CORNER` for what is not copied.
    new: Vec<u32>,
    /// Old indices of what is.
    copied: Vec<u32>,
}

impl Renumbering {
    fn new(n: usize) -> Self {
        Self { new: vec![NO_CORNER; n], copied: Vec::new() }
    }

    fn forget(&mut self) {
        for old in self.copied.drain(..) {
            self.new[old as usize] = NO_CORNER;
        }
    }

    /// Makes `index` the new one, unless there is none; what is not copied yet is appended to `values`.
    fn renumber<T>(
        &mut self,
        index: &mut u32,
        values: &mut Vec<T>,
        source: &Source<'_>,
        value: impl FnOnce(u32) -> Result<T, ImportError>,
    ) -> Result<(), ImportError> {
        let old = *index;
        let Some(new) = self.new.get_mut(old as usize) else {
            return Ok(()); // `NO_CORNER`: all others were checked
        };
        if *new == NO_CORNER {
            let next = u32::try_from(values.len()).ok().filter(|next| *next < NO_CORNER - 1);
            let too_many = || source.limit("more than 2^32 vertices in one group".to_owned());
            *new = next.ok_or_else(too_many)?;
            self.copied.push(old);
            values.push(value(old)?);
        }
        *index = *new;
        Ok(())
    }
}

/// Gives normals to the triangles that have none.
fn compute_normals(
    drafts: &mut [Draft],
    source: &Source<'_>,
    report: &mut ImportReport,
) -> Result<(), ImportError> {
    let wanted = |draft: &Draft| -> Vec<u32> {
        let corners = (0..).zip(&draft.normal_corners);
        corners.filter(|(_, normals)| **normals == NONE_HERE).map(|(tri_idx, _)| tri_idx).collect()
    };
    let wanting: Vec<Wanting<'_>> = drafts
        .iter()
        .map(|draft| Wanting {
            positions: &draft.positions,
            triangles: &draft.triangles,
            smoothing: &draft.smoothing,
            wanted: wanted(draft),
        })
        .collect();
    let n_wanted: usize = wanting.iter().map(|part| part.wanted.len()).sum();
    if n_wanted == 0 {
        return Ok(());
    }
    if n_wanted >= 1 << 30 {
        return Err(source.limit("more than 2^30 triangles without normals".to_owned()));
    }
    report.computed_normals = n_wanted as u64;
    let computed = normals::compute(&wanting);
    let lists: Vec<Vec<u32>> = wanting.into_iter().map(|part| part.wanted).collect();
    for ((draft, computed), list) in drafts.iter_mut().zip(computed).zip(lists) {
        if list.len() == draft.triangles.len() {
            draft.normals.clear(); // not even one of them is used
        }
        let base = u32::try_from(draft.normals.len()).unwrap_or(NO_CORNER);
        if (base as usize).saturating_add(computed.values.len()) >= NO_CORNER as usize {
            return Err(source.limit("more than 2^32 normals in one group".to_owned()));
        }
        draft.normals.extend(computed.values);
        for (tri_idx, corners) in list.into_iter().zip(computed.corners) {
            draft.normal_corners[tri_idx as usize] = corners.map(|corner| base + corner);
        }
    }
    Ok(())
}

fn finish(mut draft: Draft, names: &[PartName]) -> Part {
    let unnamed = PartName::default();
    let name = names.get(draft.name as usize).unwrap_or(&unnamed);
    let (name, aliases) = part_names(name);
    let has_uvs = draft.uv_corners.iter().any(|corners| *corners != NONE_HERE);
    draft.positions.shrink_to_fit();
    draft.triangles.shrink_to_fit();
    let uvs = if has_uvs {
        Attribute::Indexed { values: draft.uvs, corners: draft.uv_corners }
    } else {
        Attribute::Absent
    };
    Part {
        name,
        aliases,
        material: draft.material,
        positions: draft.positions,
        normals: Attribute::Indexed { values: draft.normals, corners: draft.normal_corners },
        uvs,
        triangles: draft.triangles,
        colors: draft.colors,
    }
}

/// The name of a part and what else selects it.
fn part_names(name: &PartName) -> (String, Vec<String>) {
    let full = match (name.object.as_str(), name.groups.as_str()) {
        (object, "") => object.to_owned(),
        ("", groups) => groups.to_owned(),
        (object, groups) => format!("{object}/{groups}"),
    };
    let mut aliases: Vec<String> = name.groups.split_whitespace().map(str::to_owned).collect();
    aliases.push(name.groups.clone());
    aliases.push(name.object.clone());
    aliases.retain(|alias| !alias.is_empty() && *alias != full);
    aliases.sort();
    aliases.dedup();
    (full, aliases)
}

const _: () = assert!(FLAT == 0, "group 0 is the one of faces that are flat");
