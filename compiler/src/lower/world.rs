//! The large sections of a pack: triangles, spheres, instances and the tree over them, each primitive with its light.
//!
//! One stage, whose key is all that things are and how trees are made. What is small of its result is kept: the frame,
//! what emits, and what was counted; the rest is in the pack. Which emitters are lights is asked between: a material
//! that glows more brightly changes no triangle, one that takes the place of another in the table of lights does.

use std::sync::Arc;
use std::time::Instant;

use pack::abi::{self, LightKind, NONE};
use pack::{Kind, Pack};
use serde::{Deserialize, Serialize};

use super::extent::Receivers;
use super::geometry::body::Bodies;
use super::geometry::{self, Placement, Stage};
use super::inside::Boundary;
use super::light::Emitter;
use super::lowered::{Counters, LowerError, Times};
use super::material::MaterialTable;
use super::motion;
use super::order::{Declared, order};
use super::rows::Rows;
use super::survey::{self, Survey};
use super::trees::{Corners, Trees, add_meshes, build_tree};
use crate::bvh::{self, BuildReport, Joined, Motion};
use crate::normalize::Normalization;
use crate::stage::{Key, KeyOf, Stages};
use crate::weld::{Welded, weld, weld_labelled};

/// What is small of a world.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Outline {
    /// Centre and exponent of the normalised frame.
    frame: ([f64; 3], i32),
    /// Area of the sky as an emitter, see `Receivers::sky_area`.
    pub(super) sky_area: Option<f64>,
    /// Surfaces of filled things; empty where nobody must know what is inside of what.
    pub(super) boundaries: Vec<Boundary>,
    /// Material and area of all that emits, but the sky.
    emitters: Vec<(u32, f64)>,
    /// Of each of them, whether it is a light.
    selected: Vec<bool>,
    counters: Counters,
    /// Trees that were built or fetched.
    n_trees: usize,
}

/// The sections.
pub(super) struct Sections {
    pub(super) nodes: Rows<abi::Node>,
    pub(super) wide_nodes: Rows<abi::WideNode>,
    pub(super) triangles: Rows<abi::Triangle>,
    pub(super) shades: Rows<abi::TriShade>,
    pub(super) vertex_colors: Rows<abi::VertexColors>,
    pub(super) spheres: Vec<abi::Sphere>,
    pub(super) instances: Vec<abi::Instance>,
    /// Of surfaces that are lights: their records without how they are chosen.
    pub(super) lights: Vec<abi::Light>,
    /// Root of the tree, and the stack that it needs.
    pub(super) entry: (u32, u32),
    pub(super) counters: Counters,
    pub(super) trees: BuildReport,
}

/// What a world is made of, besides its files.
pub(super) struct World<'a> {
    pub(super) bodies: &'a Bodies,
    pub(super) materials: &'a MaterialTable<'a>,
    pub(super) stages: &'a Stages,
    pub(super) trees: &'a Trees<'a>,
    /// Light must know what it is inside of.
    pub(super) inside: bool,
    /// Lights before those of surfaces in the table of lights, whose numbers primitives know.
    pub(super) n_far: usize,
}

/// A world on its way.
pub(super) enum Progress<'a> {
    /// The last pack has it.
    Known(Outline, &'a Arc<Pack>),
    /// It is placed.
    Placed(Box<Placed>),
}

/// All that is placed, before there are trees.
pub(super) struct Placed {
    placement: Placement,
    frame: Normalization,
    receivers: Receivers,
    boundaries: Vec<Boundary>,
    times: Times,
}

impl<'a> World<'a> {
    /// Names all geometry.
    pub(super) fn key(&self) -> Key {
        let mut key = KeyOf::stage("world");
        key.text(&self.trees.recipe()).number(self.inside);
        if self.n_far > 0 {
            key.number(self.n_far as u64);
        }
        if self.materials.textures.has_vertex_colors() {
            key.text("vertex colours");
        }
        self.bodies.read(self.materials, &mut key);
        key.end()
    }

    /// The world that the last pack has, or everything placed.
    ///
    /// # Errors
    /// When a file cannot be loaded, or there are too many triangles.
    pub(super) fn begin(&self) -> Result<Progress<'a>, LowerError> {
        match self.stages.in_pack::<Outline>(self.key()) {
            Some((outline, pack)) => Ok(Progress::Known(outline, pack)),
            None => Ok(Progress::Placed(Box::new(self.place()?))),
        }
    }

    fn place(&self) -> Result<Placed, LowerError> {
        let start = Instant::now();
        let &Self { bodies, materials, stages, .. } = self;
        check_mixes(materials.records())?;
        let Survey { frame, receivers, boundaries, meshes, placed } =
            Survey::of(bodies, materials, stages, self.inside)?;
        let colored = materials.textures.has_vertex_colors();
        let stage = Stage { bodies, materials, frame: &frame, receivers, colored, stages };
        let (known, new) = geometry::known(&stage);
        let (files, pieces) = survey::load(bodies, &new, materials.files)?;
        let mut placement = geometry::place(&stage, known, (&files, &pieces));
        (placement.meshes, placement.placed) = (meshes, placed);
        check_count(&placement)?;
        // What was read is copied: from here on it would only take room, and so would a third of the last pack.
        drop((files, pieces));
        materials.files.release();
        stages.release_parts();
        let times = Times { geometry: start.elapsed(), ..Times::default() };
        Ok(Placed { placement, frame, receivers, boundaries, times })
    }

    /// The sections; `ids`: the light of each emitter or `NONE`. Also whether they are those of the last pack.
    ///
    /// # Errors
    /// As those of `begin`, and when no tree can be built.
    pub(super) fn finish(
        &self,
        progress: Progress<'_>,
        ids: &[u32],
    ) -> Result<(Sections, Times, bool), LowerError> {
        let is_light = |id: &u32| *id != NONE;
        match progress {
            Progress::Known(outline, pack)
                if outline.selected.iter().copied().eq(ids.iter().map(is_light)) =>
            {
                self.stages.keep_all();
                Ok((outline.sections(pack, self.trees), Times::default(), true))
            }
            Progress::Known(..) => self.build(self.place()?, ids),
            Progress::Placed(placed) => self.build(*placed, ids),
        }
    }

    fn build(&self, placed: Placed, ids: &[u32]) -> Result<(Sections, Times, bool), LowerError> {
        let outline = placed.outline(ids);
        let Placed { mut placement, frame, mut times, .. } = placed;
        let start = Instant::now();
        let mut counters = outline.counters;
        let n_world = placement.corners.len();
        let colored = self.materials.textures.has_vertex_colors();
        let parts = survey::parts(self.bodies, colored, &placement.meshes, n_world);
        let corners = add_meshes(&mut placement, &mut counters);
        let welded = welded(&mut placement, &corners);
        counters.vertices = u64::from(welded.n_ids);
        times.geometry += start.elapsed();

        let start = Instant::now();
        let motions = motion::displacements(&self.bodies.things, &frame);
        let (joined, wide_nodes, trees) =
            build_tree(&placement, &corners, (&motions, &frame), self.trees)?;
        times.bvh = start.elapsed();

        let start = Instant::now();
        let instances = instances(&placement, &joined, &motions, &frame);
        let declared = Declared { corners: corners.all, welded };
        let of_meshes = std::mem::take(&mut placement.parts);
        let mut ordered = order(&mut placement, ids, declared, &joined);
        counters.references = ordered.triangles.len() as u64;
        counters.spheres = ordered.spheres.len() as u64;
        // Records of things that move are marked: they are not those of the same things when these stand still.
        if motions.is_empty() {
            for part in of_meshes {
                part.put(&ordered.triangle_at, self.stages);
            }
            for part in parts {
                part.put(&ordered.triangle_at, self.stages);
            }
        }
        motion::mark(&motions, &mut ordered);
        times.order = start.elapsed();
        self.stages
            .put_in_pack(self.key(), &Outline { counters, n_trees: trees.groups, ..outline });
        let sections = Sections {
            entry: joined.entry(),
            nodes: joined.nodes.into(),
            wide_nodes: wide_nodes.into(),
            triangles: ordered.triangles.into(),
            shades: ordered.shades.into(),
            vertex_colors: ordered.colors.into(),
            spheres: ordered.spheres,
            instances,
            lights: ordered.lights,
            counters,
            trees,
        };
        Ok((sections, times, false))
    }
}

impl Progress<'_> {
    pub(super) fn frame(&self) -> Normalization {
        match self {
            Self::Known(outline, _) => {
                let (center, exponent) = outline.frame;
                Normalization { center, exponent }
            }
            Self::Placed(placed) => placed.frame,
        }
    }

    pub(super) fn sky_area(&self) -> Option<f64> {
        match self {
            Self::Known(outline, _) => outline.sky_area,
            Self::Placed(placed) => placed.receivers.sky_area(),
        }
    }

    pub(super) fn boundaries(&self) -> &[Boundary] {
        match self {
            Self::Known(outline, _) => &outline.boundaries,
            Self::Placed(placed) => &placed.boundaries,
        }
    }

    /// What emits, without its primitives where the last pack has them.
    pub(super) fn emitters(&self) -> Vec<Emitter> {
        let known = |(material, area): &(u32, f64)| Emitter {
            kind: LightKind::Sphere,
            primitive: 0,
            count: 0,
            material: *material,
            area: *area,
            facing: [0.0; 5],
        };
        match self {
            Self::Known(outline, _) => outline.emitters.iter().map(known).collect(),
            Self::Placed(placed) => placed.placement.emitters.clone(),
        }
    }
}

impl Placed {
    fn outline(&self, ids: &[u32]) -> Outline {
        let emitters = &self.placement.emitters;
        Outline {
            frame: (self.frame.center, self.frame.exponent),
            sky_area: self.receivers.sky_area(),
            boundaries: self.boundaries.clone(),
            emitters: emitters.iter().map(|emitter| (emitter.material, emitter.area)).collect(),
            selected: ids.iter().map(|id| *id != NONE).collect(),
            counters: Counters { dropped_triangles: self.placement.dropped, ..Counters::default() },
            n_trees: 0,
        }
    }
}

impl Outline {
    fn sections(self, pack: &Arc<Pack>, trees: &Trees<'_>) -> Sections {
        let lights: &[abi::Light] = pack.records();
        let render = pack.render();
        Sections {
            nodes: Rows::kept(pack, Kind::NODE, Pack::records),
            wide_nodes: Rows::kept(pack, Kind::WIDENODE, Pack::records),
            triangles: Rows::kept(pack, Kind::TRIANGLE, Pack::records),
            shades: Rows::kept(pack, Kind::TRISHADE, Pack::records),
            vertex_colors: Rows::kept(pack, Kind::VERTEXCOLOR, Pack::records),
            spheres: pack.records().to_vec(),
            instances: pack.records().to_vec(),
            lights: lights.iter().filter(|light| light.has_surface()).copied().collect(),
            entry: (render.root, render.stack_need),
            counters: self.counters,
            trees: BuildReport {
                preset: trees.preset,
                groups: self.n_trees,
                loaded: self.n_trees,
                references: pack.records::<abi::Triangle>().len(),
                ..BuildReport::default()
            },
        }
    }
}

/// The vertices of all triangles. Most are named in order by the last pack, if it has the triangles.
fn welded(placement: &mut Placement, corners: &Corners) -> Welded {
    let mut labels = std::mem::take(&mut placement.labels);
    for mesh in &mut placement.meshes {
        labels.append(&mut std::mem::take(&mut mesh.labels));
    }
    if labels.iter().all(|ids| *ids == [NONE; 3]) {
        drop(labels);
        return weld(&corners.all);
    }
    weld_labelled(&corners.all, labels).unwrap_or_else(|| weld(&corners.all))
}

/// Refuses mixes among more materials than a mix can name.
fn check_mixes(materials: &[abi::Material]) -> Result<(), LowerError> {
    let mut kinds = materials.iter().map(|material| material.kind);
    let count = materials.len();
    if count > abi::Material::MIXABLE && kinds.any(|kind| kind == abi::MaterialKind::Mix as u32) {
        return Err(LowerError::TooManyMaterials { count });
    }
    Ok(())
}

/// Refuses more triangles than the pack can number.
fn check_count(placement: &Placement) -> Result<(), LowerError> {
    let stored = placement.meshes.iter().map(|mesh| mesh.corners.len()).sum::<usize>();
    let count = placement.corners.len() + stored;
    if count > bvh::MAX_PRIMITIVES {
        return Err(LowerError::TooManyTriangles { count });
    }
    Ok(())
}

/// The records of placed meshes.
fn instances(
    placement: &Placement,
    joined: &Joined,
    motions: &[Motion],
    frame: &Normalization,
) -> Vec<abi::Instance> {
    let record = |placed: &super::stored::Placed| {
        let moves = motions.get(placed.object as usize).is_some_and(Motion::moves);
        let record = placed.record(&placement.meshes[placed.mesh], frame, moves);
        abi::Instance { root: joined.mesh_roots[placed.mesh], ..record }
    };
    placement.placed.iter().map(record).collect()
}
