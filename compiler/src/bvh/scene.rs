//! From the primitives of a scene to its one tree.
//!
//! Turns lists of triangles and spheres into groups (see [`plan`]), gets each group's tree from the
//! cache or the builder, and joins them. Warnings of the cache are returned, each only once.

use std::ops::Range;
use std::time::Duration;

use rayon::prelude::*;

use super::join::{Group, GroupKind, Joined, join};
use super::{BvhError, Fragment};
use crate::cache::{Cache, CacheWarning, Source};

/// Meshes of fewer triangles share a group.
pub const SMALL_MESH: usize = 64;

/// The primitives of a scene, in the frame in which the kernel sees them.
#[derive(Clone, Copy, Debug)]
pub struct Primitives<'a> {
    /// Corners of all triangles, mesh after mesh.
    pub triangles: &'a [[[f32; 3]; 3]],
    /// How many triangles each mesh has; the sum is `triangles.len()`.
    pub mesh_sizes: &'a [usize],
    /// Centre and radius of all spheres.
    pub spheres: &'a [([f32; 3], f32)],
}

/// What building cost and what the cache did.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct BuildReport {
    /// Groups in total.
    pub groups: usize,
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

/// Which meshes share a tree, as ranges of triangles of the scene. A mesh of at least [`SMALL_MESH`]
/// triangles has its own tree, so that it is found in the cache whatever else the scene holds. All
/// smaller ones are one group, the last: a tree over their triangles is better than a tree over
/// their trees, and building it costs next to nothing.
#[must_use]
pub fn plan(mesh_sizes: &[usize]) -> Vec<Vec<Range<u32>>> {
    let mut groups = Vec::new();
    let mut small = Vec::new();
    let mut first = 0;
    for &size in mesh_sizes {
        let end = first + size;
        let bound = |x: usize| u32::try_from(x).expect("checked by the caller");
        match size {
            0 => {}
            _ if size < SMALL_MESH => small.push(bound(first)..bound(end)),
            _ => groups.push(vec![bound(first)..bound(end)]),
        }
        first = end;
    }
    groups.extend((!small.is_empty()).then_some(small));
    groups
}

/// Builds the tree of a scene.
pub fn build_scene(
    primitives: &Primitives,
    cache: &Cache,
) -> Result<(Joined, BuildReport), BvhError> {
    let Primitives { triangles, mesh_sizes, spheres } = *primitives;
    let listed = mesh_sizes.iter().try_fold(0_usize, |sum, &n| sum.checked_add(n));
    if listed != Some(triangles.len()) {
        return Err(BvhError::Sizes { count: triangles.len() });
    }
    if let Some(&count) =
        [triangles.len(), spheres.len()].iter().find(|&&n| n > super::MAX_PRIMITIVES)
    {
        return Err(BvhError::TooMany { count });
    }
    let mut todo: Vec<_> =
        plan(mesh_sizes).into_iter().map(|members| (GroupKind::Triangles, members)).collect();
    if !spheres.is_empty() {
        let end = u32::try_from(spheres.len()).expect("checked above");
        todo.push((GroupKind::Spheres, std::iter::once(0..end).collect()));
    }
    let results: Vec<_> = todo
        .into_par_iter()
        .map(|(kind, members)| {
            let scene = members.iter().flat_map(Clone::clone);
            let fragments = match kind {
                GroupKind::Triangles => (0..)
                    .zip(scene)
                    .map(|(i, t)| Fragment::of_triangle(&triangles[t as usize], i))
                    .collect(),
                GroupKind::Spheres => (0..)
                    .zip(spheres)
                    .map(|(i, &(center, radius))| Fragment::of_sphere(center, radius, i))
                    .collect(),
            };
            cache.tree(fragments).map(|cached| (kind, members, cached))
        })
        .collect::<Result<_, _>>()?;
    let mut report = BuildReport { groups: results.len(), ..BuildReport::default() };
    let mut groups = Vec::with_capacity(results.len());
    for (kind, members, cached) in results {
        report.add(cached.source, cached.warning);
        groups.push(Group { kind, tree: cached.tree, members });
    }
    if report.stored > 0 {
        // A cache that stays too large harms nobody; the next run tries again.
        let _ = cache.prune();
    }
    Ok((join(&groups)?, report))
}

impl BuildReport {
    fn add(&mut self, source: Source, warning: Option<CacheWarning>) {
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
