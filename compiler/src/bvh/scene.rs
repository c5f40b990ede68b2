//! From the primitives of a scene to its one tree.
//!
//! Turns lists of triangles and spheres into groups (see [`plan`]), gets each group's tree from the
//! cache or the builder, and joins them. Meshes that are stored once have trees in their own frames, which are
//! found in the cache wherever and however often the meshes are shown. Warnings of the cache are returned, each
//! only once.

use std::borrow::Cow;
use std::ops::Range;
use std::time::Duration;

use glam::Vec4;
use rayon::prelude::*;

use super::join::{Group, GroupKind, Joined, join_groups};
use super::plan::{SMALL_MESH, plan};
use super::probe::visits;
use super::top::{InstanceLeaf, Piece, clusters};
use super::{Bounds, BvhError, Fragment, Input, MAX_PRIMITIVES, Motion, Preset};
use crate::cache::{Cache, CacheWarning, Cached, Source};

/// The primitives of a scene when the shutter opens, in the frame in which the kernel sees them.
#[derive(Clone, Copy, Debug)]
pub struct Primitives<'a> {
    /// Corners of all triangles, mesh after mesh.
    pub triangles: &'a [[[f32; 3]; 3]],
    /// How many triangles each mesh has; the sum is `triangles.len()`.
    pub mesh_sizes: &'a [usize],
    /// How each mesh moves while the shutter is open; empty where nothing does.
    pub mesh_motions: &'a [Motion],
    /// Centre and radius of all spheres.
    pub spheres: &'a [([f32; 3], f32)],
    /// How each sphere moves while the shutter is open; empty where nothing does.
    pub sphere_motions: &'a [Motion],
}

/// Meshes that are stored once, and where they are shown.
#[derive(Clone, Copy, Debug, Default)]
pub struct Shared<'a> {
    /// Corners of the triangles of each mesh, in its own frame; none is empty.
    pub meshes: &'a [Vec<[[f32; 3]; 3]>],
    /// Of each instance its mesh, and the corners of the box of all places where it is while the shutter is
    /// open, in the frame in which the kernel sees the scene.
    pub instances: &'a [(usize, [[f32; 3]; 2])],
}

/// What building cost and what the cache did.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct BuildReport {
    /// Which builder was asked for.
    pub preset: Preset,
    /// Trees that were built or loaded.
    pub groups: usize,
    /// Triangles in leaves; those that were split count once for each piece.
    pub references: usize,
    /// Whether some meshes were so overlapping that one tree over all of their triangles was taken.
    pub merged: bool,
    /// Groups whose trees are large enough for the cache and were built and stored.
    pub stored: usize,
    /// Groups whose trees came from the cache.
    pub loaded: usize,
    /// Time spent in building, summed over groups (which may have run side by side).
    pub build_time: Duration,
    /// What the loaded trees would have cost beyond reading them.
    pub saved: Duration,
    /// What went wrong without harm.
    pub warnings: Vec<CacheWarning>,
}

/// Builds the tree of a scene.
///
/// Meshes that fill the same space all over (leaves and twigs, halves of one shell) remain overlapping
/// after joining: every ray visits both trees. Where joining could not separate meshes, one tree
/// over the triangles of these is made as well, and what takes fewer visits is used. Meshes elsewhere keep their
/// trees: moving one of them builds no tree but its own.
///
/// # Errors
/// When there are too many primitives, the sizes of the meshes do not add up, or the builder is broken.
pub fn build_scene(
    primitives: &Primitives,
    preset: Preset,
    cache: &Cache,
) -> Result<(Joined, BuildReport), BvhError> {
    build_instanced(primitives, &Shared::default(), preset, cache)
}

/// As [`build_scene`], with instances of meshes that are stored once. In `Joined::triangle_order` the triangles
/// of these meshes follow those of the scene, mesh after mesh.
///
/// # Errors
/// As [`build_scene`].
pub fn build_instanced(
    primitives: &Primitives,
    shared: &Shared,
    preset: Preset,
    cache: &Cache,
) -> Result<(Joined, BuildReport), BvhError> {
    check_counts(primitives, shared)?;
    let instances: Vec<InstanceLeaf> =
        shared.instances.iter().map(|instance| instance_leaf(shared, instance)).collect();
    let mut report = BuildReport { preset, ..BuildReport::default() };
    let by_mesh = plan(primitives.triangles, primitives.mesh_sizes);
    let groups = build_groups(primitives, by_mesh, preset, cache, &mut report)?;
    let (mut joined, overlapping) = join_groups(&groups, &instances)?;
    let clusters =
        overlapping.map_or_else(Vec::new, |pieces| clusters_of_triangles(&groups, pieces));
    if !clusters.is_empty() {
        let groups = merge_clusters(primitives, groups, &clusters, preset, cache, &mut report)?;
        let (merged, _) = join_groups(&groups, &instances)?;
        let [one, many] = [&merged, &joined].map(|tree| visits(tree, primitives.triangles));
        if one < many {
            joined = merged;
            report.merged = true;
        }
    }
    let first = primitives.triangles.len();
    let meshes = build_meshes(shared.meshes, first, preset, cache, &mut report)?;
    let mesh_of: Vec<usize> = shared.instances.iter().map(|instance| instance.0).collect();
    joined.add_meshes(&meshes, &mesh_of)?;
    report.references = joined.triangle_order.len();
    if report.stored > 0 {
        // A cache that stays too large harms nobody; the next run tries again.
        let _ = cache.prune();
    }
    Ok((joined, report))
}

/// The large meshes that fill the same space, as indices of their groups, see [`clusters`]. Small ones share trees with
/// what is near them anyway, and a cluster with some would be another one whenever one of them moved.
fn clusters_of_triangles(groups: &[Group], mut pieces: Vec<Piece>) -> Vec<Vec<usize>> {
    let is_large = |group: &Group| {
        let is_mesh = group.kind == GroupKind::Triangles && group.members.len() == 1;
        is_mesh && group.tree.n_primitives() >= SMALL_MESH
    };
    pieces.retain(|piece| groups.get(piece.group).is_some_and(is_large));
    clusters(groups.len(), &pieces)
}

/// The same groups with one for each cluster, which has a tree of its own.
fn merge_clusters(
    primitives: &Primitives,
    mut groups: Vec<Group>,
    clusters: &[Vec<usize>],
    preset: Preset,
    cache: &Cache,
    report: &mut BuildReport,
) -> Result<Vec<Group>, BvhError> {
    let members = |cluster: &Vec<usize>| {
        let mut ranges: Vec<Range<u32>> =
            cluster.iter().flat_map(|group| groups[*group].members.clone()).collect();
        ranges.sort_by_key(|range| range.start);
        (GroupKind::Triangles, ranges)
    };
    let merged = clusters.iter().map(members).collect();
    let mut merged = build_all(primitives, merged, preset, cache, report)?;
    let mut index = 0;
    groups.retain(|_| {
        index += 1;
        !clusters.iter().flatten().any(|group| group + 1 == index)
    });
    groups.append(&mut merged);
    Ok(groups)
}

fn instance_leaf(shared: &Shared, (mesh, [lo, hi]): &(usize, [[f32; 3]; 2])) -> InstanceLeaf {
    let corner = |[x, y, z]: [f32; 3]| Vec4::new(x, y, z, 0.0);
    let bounds = Bounds { lo: corner(*lo), hi: corner(*hi) };
    InstanceLeaf { bounds, weight: shared.meshes[*mesh].len() }
}

/// The trees of meshes that are stored once, side by side; their triangles are numbered from `first` on.
fn build_meshes(
    meshes: &[Vec<[[f32; 3]; 3]>],
    first: usize,
    preset: Preset,
    cache: &Cache,
    report: &mut BuildReport,
) -> Result<Vec<Group>, BvhError> {
    let results: Vec<Cached> = (meshes.par_iter())
        .map(|corners| cache.tree(preset, Input::of_triangles(corners)))
        .collect::<Result<_, _>>()?;
    let mut end = u32::try_from(first).expect("counts were checked");
    let finish = |(corners, cached): (&Vec<_>, Cached)| {
        report.add(cached.source, cached.warning);
        let start = end;
        end += u32::try_from(corners.len()).expect("counts were checked");
        let members = std::iter::once(start..end).collect();
        Group { kind: GroupKind::Triangles, tree: cached.tree, members }
    };
    Ok(meshes.iter().zip(results).map(finish).collect())
}

fn check_counts(primitives: &Primitives, shared: &Shared) -> Result<(), BvhError> {
    let count = primitives.triangles.len();
    let listed = primitives.mesh_sizes.iter().try_fold(0_usize, |sum, &n| sum.checked_add(n));
    let fits = |motions: &[Motion], n: usize| motions.is_empty() || motions.len() == n;
    let moved = fits(primitives.mesh_motions, primitives.mesh_sizes.len())
        && fits(primitives.sphere_motions, primitives.spheres.len());
    if listed != Some(count) || !moved {
        return Err(BvhError::Sizes { count });
    }
    let stored = shared.meshes.iter().map(Vec::len).sum::<usize>();
    // References to spheres have one bit less, see `ChildRef`.
    let counts = [
        (count.saturating_add(stored), MAX_PRIMITIVES),
        (primitives.spheres.len(), MAX_PRIMITIVES / 2),
    ];
    match counts.into_iter().find(|&(n, most)| n > most) {
        Some((count, _)) => Err(BvhError::TooMany { count }),
        None => Ok(()),
    }
}

/// The trees of groups of triangles, side by side, and of the spheres.
fn build_groups(
    primitives: &Primitives,
    groups: Vec<Vec<Range<u32>>>,
    preset: Preset,
    cache: &Cache,
    report: &mut BuildReport,
) -> Result<Vec<Group>, BvhError> {
    let mut todo: Vec<_> =
        groups.into_iter().map(|members| (GroupKind::Triangles, members)).collect();
    if !primitives.spheres.is_empty() {
        let end = u32::try_from(primitives.spheres.len()).expect("counts were checked");
        todo.push((GroupKind::Spheres, std::iter::once(0..end).collect()));
    }
    build_all(primitives, todo, preset, cache, report)
}

/// The trees of some groups, side by side.
fn build_all(
    primitives: &Primitives,
    todo: Vec<(GroupKind, Vec<Range<u32>>)>,
    preset: Preset,
    cache: &Cache,
    report: &mut BuildReport,
) -> Result<Vec<Group>, BvhError> {
    let moves = Moves::new(primitives);
    let results: Vec<_> = todo
        .into_par_iter()
        .map(|(kind, members)| {
            let input = match kind {
                GroupKind::Triangles => triangles(primitives, &members, &moves),
                GroupKind::Spheres => spheres(primitives, &moves),
            };
            cache.tree(preset, input).map(|cached| (kind, members, cached))
        })
        .collect::<Result<_, _>>()?;
    let finish = |(kind, members, cached): (GroupKind, Vec<Range<u32>>, Cached)| {
        report.add(cached.source, cached.warning);
        Group { kind, tree: cached.tree, members }
    };
    Ok(results.into_iter().map(finish).collect())
}

/// What the tree of some meshes is built over.
fn triangles<'a>(
    primitives: &Primitives<'a>,
    members: &[Range<u32>],
    moves: &Moves<'_>,
) -> Input<'a> {
    let fragment = |i: u32, t: u32| {
        let box_ = Fragment::of_triangle(&primitives.triangles[t as usize], i);
        moves.triangle(t).map_or(box_, |motion| box_.moving(motion))
    };
    let fragments = match members {
        [one] => one.clone().into_par_iter().map(|t| fragment(t - one.start, t)).collect(),
        parts => {
            (0..).zip(parts.iter().flat_map(Clone::clone)).map(|(i, t)| fragment(i, t)).collect()
        }
    };
    let part = |r: &Range<u32>| &primitives.triangles[r.start as usize..r.end as usize];
    let corners = match members {
        [one] => Cow::Borrowed(part(one)),
        parts => Cow::Owned(parts.iter().flat_map(part).copied().collect()),
    };
    Input { fragments, corners }
}

/// What the tree of the spheres is built over.
fn spheres(primitives: &Primitives<'_>, moves: &Moves<'_>) -> Input<'static> {
    let fragment = |(i, &(center, radius)): (u32, &([f32; 3], f32))| {
        let box_ = Fragment::of_sphere(center, radius, i);
        moves.sphere(i).map_or(box_, |motion| box_.moving(motion))
    };
    Input::of_boxes((0..).zip(primitives.spheres).map(fragment).collect())
}

/// How single primitives move.
struct Moves<'a> {
    /// Where each mesh ends; empty where nothing moves.
    ends: Vec<u32>,
    meshes: &'a [Motion],
    spheres: &'a [Motion],
}

impl<'a> Moves<'a> {
    fn new(primitives: &Primitives<'a>) -> Self {
        let mut end = 0;
        let sizes = primitives.mesh_sizes.iter().take(primitives.mesh_motions.len());
        let ends = sizes.map(|size| {
            end += u32::try_from(*size).expect("counts were checked");
            end
        });
        let (meshes, spheres) = (primitives.mesh_motions, primitives.sphere_motions);
        Self { ends: ends.collect(), meshes, spheres }
    }

    /// `None` for a triangle that stands still.
    fn triangle(&self, index: u32) -> Option<&Motion> {
        let mesh = self.ends.partition_point(|end| *end <= index);
        self.meshes.get(mesh).filter(|motion| motion.moves())
    }

    /// `None` for a sphere that stands still.
    fn sphere(&self, index: u32) -> Option<&Motion> {
        self.spheres.get(index as usize).filter(|motion| motion.moves())
    }
}

impl BuildReport {
    fn add(&mut self, source: Source, warning: Option<CacheWarning>) {
        self.groups += 1;
        match source {
            Source::Built { took } => self.build_time += took,
            Source::Stored { took } => {
                self.build_time += took;
                self.stored += 1;
            }
            Source::Loaded { saved } => {
                self.saved += saved;
                self.loaded += 1;
            }
        }
        let Some(warning) = warning else { return };
        let unwritable = |w: &CacheWarning| matches!(w, CacheWarning::Unwritable { .. });
        if !(unwritable(&warning) && self.warnings.iter().any(unwritable)) {
            self.warnings.push(warning);
        }
    }
}
