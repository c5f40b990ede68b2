//! `tobj`'s models become parts: polygons cut, triangles judged, missing normals computed.

use super::super::check::{Quality, grow, is_zero, quality, single, unit};
use super::super::error::{ErrorKind, ImportError};
use super::super::file::Limits;
use super::super::mesh::{Attribute, NO_CORNER, Part};
use super::super::normals::{self, FLAT, Wanting};
use super::super::polygon;
use super::super::report::ImportReport;
use super::frame::Frame;
use super::scan::{PartName, Scanned, Tag, line_of_face};
use std::collections::BTreeMap;

/// What the parts are made from, beside the models.
pub(super) struct Source<'a> {
    pub(super) file: &'a str,
    pub(super) bytes: &'a [u8],
    pub(super) frame: Frame,
    pub(super) scanned: &'a Scanned,
    /// For each of `scanned.materials`, its index among the imported ones.
    pub(super) material_ids: &'a [Option<u32>],
    pub(super) limits: &'a Limits,
}

/// A part under construction.
#[derive(Default)]
struct Draft {
    name: u32,
    material: Option<u32>,
    positions: Vec<[f32; 3]>,
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
    fn place(&self, face_idx: u64) -> String {
        format!("{}:{}", self.file, line_of_face(self.bytes, face_idx))
    }

    fn limit(&self, message: String) -> ImportError {
        ImportError::new(ErrorKind::Limit, self.file, message)
    }
}

/// Makes the parts, in the order in which their names and materials first appear.
pub(super) fn parts(
    models: Vec<tobj::Model>,
    source: &Source<'_>,
    report: &mut ImportReport,
) -> Result<Vec<Part>, ImportError> {
    let mut drafts: Vec<Draft> = Vec::new();
    let mut ids: BTreeMap<(u32, Option<u32>), usize> = BTreeMap::new();
    let mut n_triangles = 0;
    for model in models {
        let tag = model.name.parse::<usize>().ok().and_then(|i| source.scanned.tags.get(i));
        let Some((tag, first_face)) = tag else {
            continue; // the model without faces that `tobj` makes of an empty file
        };
        let material = tag.material.and_then(|id| *source.material_ids.get(id as usize)?);
        let new = drafts.len();
        let draft_idx = *ids.entry((tag.name, material)).or_insert(new);
        if draft_idx == new {
            drafts.push(Draft { name: tag.name, material, ..Draft::default() });
        }
        let draft = &mut drafts[draft_idx];
        let before = draft.triangles.len();
        add_model(draft, &model.mesh, (tag, *first_face), source, report)?;
        n_triangles += (draft.triangles.len() - before) as u64;
        if n_triangles > source.limits.triangles {
            let max = source.limits.triangles;
            return Err(source.limit(format!("more than {max} triangles")));
        }
    }
    drafts.retain(|draft| !draft.triangles.is_empty());
    compute_normals(&mut drafts, source, report)?;
    for draft in &drafts {
        grow(&mut report.bounds, &draft.positions);
    }
    Ok(drafts.into_iter().map(|draft| finish(draft, &source.scanned.names)).collect())
}

/// Appends the faces of one model.
fn add_model(
    draft: &mut Draft,
    mesh: &tobj::Mesh,
    (tag, first_face): (&Tag, u64),
    source: &Source<'_>,
    report: &mut ImportReport,
) -> Result<(), ImportError> {
    let bases = add_values(draft, mesh, tag, source)?;
    let smoothing = tag.smoothing.unwrap_or(u32::MAX);
    let mut start = 0;
    let n_faces =
        if mesh.face_arities.is_empty() { mesh.indices.len() / 3 } else { mesh.face_arities.len() };
    for face in 0..n_faces {
        let n_corners = mesh.face_arities.get(face).map_or(3, |n| *n as usize);
        let face_idx = first_face + face as u64;
        let corner = |list: &[u32], base: u32, i: u32| base + list[start + i as usize];
        for cut in cut_face(draft, mesh, bases[0], start..start + n_corners, report, || {
            source.place(face_idx)
        }) {
            let tri = cut.map(|i| corner(&mesh.indices, bases[0], i));
            let points = tri.map(|vertex| draft.positions[vertex as usize]);
            match quality(points) {
                Quality::ZeroArea => {
                    report.zero_area.add(|| source.place(face_idx));
                    continue;
                }
                Quality::Needle => report.needles.add(|| source.place(face_idx)),
                Quality::Fine => {}
            }
            draft.triangles.push(tri);
            draft.smoothing.push(smoothing);
            draft.uv_corners.push(if tag.has_uv {
                cut.map(|i| corner(&mesh.texcoord_indices, bases[1], i))
            } else {
                NONE_HERE
            });
            let mut normals = NONE_HERE;
            if tag.has_normal {
                normals = cut.map(|i| corner(&mesh.normal_indices, bases[2], i));
                if normals.iter().any(|n| is_zero(draft.normals[*n as usize])) {
                    report.zero_normals.add(|| source.place(face_idx));
                    normals = NONE_HERE;
                }
            }
            draft.normal_corners.push(normals);
        }
        start += n_corners;
    }
    Ok(())
}

/// Triangles of one face, as indices of its corners.
fn cut_face(
    draft: &Draft,
    mesh: &tobj::Mesh,
    base: u32,
    corners: std::ops::Range<usize>,
    report: &mut ImportReport,
    place: impl FnOnce() -> String,
) -> Vec<[u32; 3]> {
    if corners.len() == 3 {
        return vec![[0, 1, 2]];
    }
    let position = |vertex: &u32| draft.positions[(base + vertex) as usize];
    let points: Vec<[f32; 3]> = mesh.indices[corners].iter().map(position).collect();
    let cut = polygon::triangulate(&points);
    report.n_polygons += 1;
    if cut.crooked {
        report.crooked_polygons.add(place);
    }
    cut.triangles
}

/// Appends positions, UVs and normals of a model; returns where each of them begins.
fn add_values(
    draft: &mut Draft,
    mesh: &tobj::Mesh,
    tag: &Tag,
    source: &Source<'_>,
) -> Result<[u32; 3], ImportError> {
    let base = |here: usize, more: usize| {
        let fits = here.checked_add(more).is_some_and(|n| n < NO_CORNER as usize);
        let base = u32::try_from(here).ok().filter(|_| fits);
        base.ok_or_else(|| source.limit("more than 2^32 vertices in one group".to_owned()))
    };
    let n = [mesh.positions.len() / 3, mesh.texcoords.len() / 2, mesh.normals.len() / 3];
    let bases = [
        base(draft.positions.len(), n[0])?,
        base(draft.uvs.len(), n[1])?,
        base(draft.normals.len(), n[2])?,
    ];
    draft.positions.reserve(n[0]);
    for p in mesh.positions.chunks_exact(3) {
        let metres = single(source.frame.position([p[0], p[1], p[2]]));
        if !metres.iter().all(|x| x.is_finite()) {
            let message = format!("vertex ({}, {}, {}) is infinite in metres", p[0], p[1], p[2]);
            return Err(ImportError::new(ErrorKind::Number, source.file, message)
                .with_help("check the `unit:` of the asset"));
        }
        draft.positions.push(metres);
    }
    if tag.has_uv {
        draft.uvs.extend(mesh.texcoords.chunks_exact(2).map(|uv| [uv[0], uv[1]]));
    }
    if tag.has_normal {
        let turn = |n: &[f32]| {
            let turned = source.frame.turn([n[0].into(), n[1].into(), n[2].into()]);
            unit(turned).map_or([0.0; 3], single) // zero marks it; `add_model` replaces it
        };
        draft.normals.extend(mesh.normals.chunks_exact(3).map(turn));
    }
    Ok(bases)
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

const _: () = assert!(FLAT == 0, "`s off` is group 0 in the scanner, too");
