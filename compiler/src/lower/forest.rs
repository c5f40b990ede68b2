//! One tree a mesh, one for all small things, one for the spheres; read from the cache or built.
//!
//! Instances with fewer than `POOLED` triangles share one tree: a tree of its own would fence a few
//! triangles off from neighbours that the heuristic would rather put beside them.

use std::ops::Range;
use std::time::Duration;

use rayon::prelude::*;

use crate::bvh::{BvhError, Fragment, Group, GroupKind};
use crate::cache::{Cache, CacheWarning, Cached, Source};

/// Instances below this number of triangles are pooled.
const POOLED: u32 = 64;

/// The trees of a scene before they are joined.
pub(super) struct Forest {
    pub(super) groups: Vec<Group>,
    /// How many trees came from the cache.
    pub(super) n_cached: u64,
    /// What building those took once, less what reading them took now.
    pub(super) saved: Duration,
    pub(super) warnings: Vec<CacheWarning>,
}

impl Forest {
    /// `ends[i]` is where the triangles of instance `i` end in `corners`.
    pub(super) fn grow(
        cache: &Cache,
        corners: &[[[f32; 3]; 3]],
        ends: &[u32],
        balls: &[([f32; 3], f32)],
    ) -> Result<Self, BvhError> {
        let mut plan: Vec<(GroupKind, Vec<Range<u32>>)> =
            triangle_groups(ends).into_iter().map(|m| (GroupKind::Triangles, m)).collect();
        if !balls.is_empty() {
            let all = 0..balls.len() as u32;
            plan.push((GroupKind::Spheres, std::iter::once(all).collect()));
        }
        let trees: Vec<Cached> = plan
            .par_iter()
            .map(|(kind, members)| {
                let indices = (0..).zip(members.iter().flat_map(Clone::clone));
                cache.tree(match kind {
                    GroupKind::Triangles => indices
                        .map(|(local, i)| Fragment::of_triangle(&corners[i as usize], local))
                        .collect(),
                    GroupKind::Spheres => indices
                        .map(|(local, i)| {
                            let (center, radius) = balls[i as usize];
                            Fragment::of_sphere(center, radius, local)
                        })
                        .collect(),
                })
            })
            .collect::<Result<_, _>>()?;
        Ok(Self::of(plan, trees))
    }

    fn of(plan: Vec<(GroupKind, Vec<Range<u32>>)>, trees: Vec<Cached>) -> Self {
        let mut forest =
            Self { groups: Vec::new(), n_cached: 0, saved: Duration::ZERO, warnings: Vec::new() };
        for ((kind, members), cached) in plan.into_iter().zip(trees) {
            if let Source::Loaded { saved } = cached.source {
                forest.n_cached += 1;
                forest.saved += saved;
            }
            forest.warnings.extend(cached.warning);
            forest.groups.push(Group { kind, tree: cached.tree, members });
        }
        // One unwritable directory makes one warning, however many trees wanted to go there.
        forest.warnings.dedup();
        forest
    }
}

/// Ranges of triangles that share a tree: large instances one each, then all the others together.
fn triangle_groups(ends: &[u32]) -> Vec<Vec<Range<u32>>> {
    let starts = std::iter::once(0).chain(ends.iter().copied());
    let instances = starts.zip(ends).map(|(start, &end)| start..end);
    let (small, large): (Vec<_>, Vec<_>) =
        instances.filter(|range| !range.is_empty()).partition(|range| range.end - range.start < POOLED);
    let mut groups: Vec<Vec<Range<u32>>> = large.into_iter().map(|range| vec![range]).collect();
    if !small.is_empty() {
        groups.push(small);
    }
    groups
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_instances_share_a_group_and_large_ones_have_their_own() {
        assert_eq!(triangle_groups(&[2, 102, 104]), [vec![2..102], vec![0..2, 102..104]]);
        assert_eq!(triangle_groups(&[]), Vec::<Vec<Range<u32>>>::new());
    }
}
