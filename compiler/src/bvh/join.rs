//! Trees of groups become the one tree of the scene.
//!
//! Turns the trees of meshes and of the spheres into one flat node array in depth-first order, with
//! primitives numbered as the pack stores them. Any number of groups of any size is fine: none
//! gives an empty tree, few primitives a root that is a leaf. Trees of meshes that are stored once, in frames
//! of their own, come after it.
//!
//! Boxes are made a little larger than their contents, see [`pad_lo`].

use std::ops::Range;

use pack::abi::{CHILD_INNER, ChildRef, Instance, NONE, Node};
use pack::bvh::InnerNode;
use rayon::prelude::*;

use super::build::PARALLEL_MIN;
use super::fragment::{Bounds, MAX_PRIMITIVES};
use super::top::{self, InstanceLeaf, MAX_TOP_LEVELS, Piece, Top};
use super::words::{as_spheres, shift_word};
use super::{BvhError, Tree, word_of};

/// What a group holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GroupKind {
    /// Triangles.
    Triangles,
    /// Spheres.
    Spheres,
}

/// Primitives of one kind with a tree of their own.
#[derive(Clone, Debug)]
pub struct Group {
    /// What the tree's leaves stand for.
    pub kind: GroupKind,
    /// The tree, with indices local to the group.
    pub tree: Tree,
    /// Where the group's primitives are among the scene's primitives of this kind: local index `i`
    /// is the `i`-th element of these ranges strung together.
    pub members: Vec<Range<u32>>,
}

/// The tree of the scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Joined {
    /// All inner nodes in depth-first order.
    pub nodes: Vec<Node>,
    /// Reference to the root; `NONE` when there is nothing.
    pub root: u32,
    /// For each triangle as the pack stores it, its index in the scene's list. A triangle that was split
    /// is there once for each of its pieces.
    pub triangle_order: Vec<u32>,
    /// For each sphere as the pack stores it, its index in the scene's list.
    pub sphere_order: Vec<u32>,
    /// References to the roots of meshes that are stored once.
    pub mesh_roots: Vec<u32>,
    /// Entries of the traversal stack that the worst ray needs; at most 95.
    pub stack_need: u32,
    /// Box of everything; `Bounds::EMPTY` when there is nothing.
    pub bounds: Bounds,
}

/// Joins groups. Every primitive of the scene must be a member of exactly one group.
///
/// # Errors
/// When there are too many references.
pub fn join(groups: &[Group]) -> Result<Joined, BvhError> {
    let (mut joined, _) = join_groups(groups, &[])?;
    joined.stack_need = pack::bvh::stack_need(&joined.nodes, &[], joined.root);
    Ok(joined)
}

/// The joined tree; and where some groups overlap in more places than could be separated, what they were taken apart
/// into.
type Overlapping = (Joined, Option<Vec<Piece>>);

/// Joins groups and instances; how long the stack must be is left to the caller.
pub(super) fn join_groups(
    groups: &[Group],
    instances: &[InstanceLeaf],
) -> Result<Overlapping, BvhError> {
    let count = |kind| {
        let of_kind = groups.iter().filter(|g| g.kind == kind);
        of_kind.map(|g| g.tree.order.len()).sum::<usize>()
    };
    let counts = [count(GroupKind::Triangles), count(GroupKind::Spheres)];
    if let Some(&count) = counts.iter().find(|&&n| n > MAX_PRIMITIVES) {
        return Err(BvhError::TooMany { count });
    }
    let trees: Vec<&Tree> = groups.iter().map(|g| &g.tree).collect();
    let (mut pieces, overlapping) = top::pieces(&trees, instances);
    let n_nodes: usize = trees.iter().map(|t| t.nodes.len()).sum();
    let mut out = Joined {
        nodes: Vec::with_capacity(n_nodes + groups.len()),
        root: NONE,
        triangle_order: Vec::with_capacity(counts[0]),
        sphere_order: Vec::with_capacity(counts[1]),
        mesh_roots: Vec::new(),
        stack_need: 0,
        bounds: (trees.iter().map(|tree| tree.bounds))
            .chain(instances.iter().map(|instance| instance.bounds))
            .fold(Bounds::EMPTY, Bounds::union),
    };
    if pieces.is_empty() {
        return Ok((out, None));
    }
    let members: Vec<Vec<u32>> = groups.par_iter().map(scene_order).collect();
    out.root = write(&top::build(&mut pieces, MAX_TOP_LEVELS), groups, &members, &mut out);
    debug_assert_eq!([out.triangle_order.len(), out.sphere_order.len()], counts);
    Ok((out, overlapping.then_some(pieces)))
}

impl Joined {
    /// Adds the trees of meshes that are stored once; `mesh_of` says which of them each instance shows.
    ///
    /// # Errors
    /// When there are too many references.
    pub(super) fn add_meshes(
        &mut self,
        meshes: &[Group],
        mesh_of: &[usize],
    ) -> Result<(), BvhError> {
        let count = self.triangle_order.len()
            + meshes.iter().map(|mesh| mesh.tree.order.len()).sum::<usize>();
        if count > MAX_PRIMITIVES {
            return Err(BvhError::TooMany { count });
        }
        let members: Vec<Vec<u32>> = meshes.iter().map(scene_order).collect();
        let trees: Vec<&Tree> = meshes.iter().map(|mesh| &mesh.tree).collect();
        for mesh in 0..meshes.len() {
            let root = if trees[mesh].root == NONE {
                NONE
            } else {
                write(&Top::Piece(Piece::whole(&trees, mesh)), meshes, &members, self)
            };
            self.mesh_roots.push(root);
        }
        self.stack_need = stack_need(&self.nodes, &self.mesh_roots, mesh_of, self.root);
        Ok(())
    }

    /// Reference to the root, and the stack that a walk from it needs.
    #[must_use]
    pub fn entry(&self) -> (u32, u32) {
        (self.root, self.stack_need)
    }

    /// Expected cost of a ray by the surface-area heuristic, up to a factor that depends on the scene
    /// alone: the sum over all children of half-area times 1 (node) or the number of primitives.
    #[must_use]
    pub fn cost(&self) -> f64 {
        let half_area = |lo: [f32; 3], hi: [f32; 3]| {
            let [x, y, z] = [0, 1, 2].map(|k| f64::from(hi[k]) - f64::from(lo[k]));
            x * y + y * z + z * x
        };
        let tests = |word| match ChildRef::decode(word) {
            ChildRef::Triangles { count, .. } | ChildRef::Spheres { count, .. } => count,
            ChildRef::Inner(_) | ChildRef::Instance(_) | ChildRef::Empty => 1,
        };
        let cost = |n: &Node| {
            half_area(n.left_lo, n.left_hi) * f64::from(tests(n.left))
                + half_area(n.right_lo, n.right_hi) * f64::from(tests(n.right))
        };
        self.nodes.iter().map(cost).sum()
    }
}

/// Entries of the traversal stack that the worst ray needs, where instance `i` shows the mesh with root
/// `mesh_roots[mesh_of[i]]`.
#[must_use]
pub fn stack_need<N: InnerNode>(
    nodes: &[N],
    mesh_roots: &[u32],
    mesh_of: &[usize],
    root: u32,
) -> u32 {
    let shown = |mesh: &usize| Instance { root: mesh_roots[*mesh], ..Instance::default() };
    let instances: Vec<Instance> = mesh_of.iter().map(shown).collect();
    pack::bvh::stack_need(nodes, &instances, root)
}

/// The primitives of a group's leaves, in leaf order, as the scene numbers them.
fn scene_order(group: &Group) -> Vec<u32> {
    let mut order = group.tree.primitives();
    match group.members.as_slice() {
        [one] if one.start == 0 => {}
        [one] => order.iter_mut().for_each(|i| *i += one.start),
        ranges => {
            let table: Vec<u32> = ranges.iter().flat_map(Clone::clone).collect();
            for i in &mut order {
                *i = table[*i as usize];
            }
        }
    }
    order
}

/// Widens a box downwards, so that no face of it contains a vertex.
///
/// A ray that runs exactly in a face, parallel to an axis, has `0 * (1 / tiny)` = 0 for the distance
/// to that face: the slab test would say that it leaves the box at its origin. With a face that is
/// 2^-32 away or more, the distance is beyond any hit for any `tiny` below 1e-10. Two units in the
/// last place also cover the rounding of the slab test itself. In the normalised frame, where
/// coordinates near 1 are 6e-8 apart, this costs no measurable step.
fn pad_lo(lo: [f32; 3]) -> [f32; 3] {
    lo.map(|x| x - margin(x))
}

/// Widens a box upwards, see [`pad_lo`].
fn pad_hi(hi: [f32; 3]) -> [f32; 3] {
    hi.map(|x| x + margin(x))
}

/// 2^-22 relative plus 2^-32; both functions above stay monotone, so boxes stay nested.
fn margin(x: f32) -> f32 {
    x.abs() * (1.0 / 4_194_304.0) + 1.0 / 4_294_967_296.0
}

/// Appends a subtree to the output and returns its reference there.
fn write(top: &Top, groups: &[Group], members: &[Vec<u32>], out: &mut Joined) -> u32 {
    match top {
        Top::Fork { sides, bounds } => {
            let at = out.nodes.len();
            out.nodes.push(Node {
                left_lo: pad_lo(bounds[0].lo3()),
                left_hi: pad_hi(bounds[0].hi3()),
                right_lo: pad_lo(bounds[1].lo3()),
                right_hi: pad_hi(bounds[1].hi3()),
                ..Node::default()
            });
            let left = write(&sides[0], groups, members, out);
            let right = write(&sides[1], groups, members, out);
            (out.nodes[at].left, out.nodes[at].right) = (left, right);
            CHILD_INNER | word_of(at)
        }
        Top::Piece(piece) if piece.group >= groups.len() => piece.word,
        Top::Piece(piece) => {
            let group = &groups[piece.group];
            let span = top::span(&group.tree, piece.word);
            let order = match group.kind {
                GroupKind::Triangles => &mut out.triangle_order,
                GroupKind::Spheres => &mut out.sphere_order,
            };
            // Differences modulo 2^32: the sum is right whichever of the two is larger.
            let nodes = word_of(out.nodes.len()).wrapping_sub(word_of(span.nodes.start));
            let prims = word_of(order.len()).wrapping_sub(word_of(span.prims.start));
            order.extend_from_slice(&members[piece.group][span.prims]);
            let word = |word| {
                let word = shift_word(word, nodes, prims);
                if group.kind == GroupKind::Spheres { as_spheres(word) } else { word }
            };
            let copy = |n: &Node| Node {
                left_lo: pad_lo(n.left_lo),
                left: word(n.left),
                left_hi: pad_hi(n.left_hi),
                right: word(n.right),
                right_lo: pad_lo(n.right_lo),
                right_hi: pad_hi(n.right_hi),
                ..Node::default()
            };
            let nodes = &group.tree.nodes[span.nodes];
            if nodes.len() < PARALLEL_MIN {
                out.nodes.extend(nodes.iter().map(copy));
            } else {
                out.nodes.par_extend(nodes.par_iter().with_min_len(PARALLEL_MIN).map(copy));
            }
            word(piece.word)
        }
    }
}
