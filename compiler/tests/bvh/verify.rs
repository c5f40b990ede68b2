//! What every tree must keep, checked without the code that built it.

use compiler::bvh::{Fragment, Joined, Tree};
use pack::abi::{ChildRef, Node};

use crate::shapes::Tri;

/// Lower and upper corner.
type Corners = ([f32; 3], [f32; 3]);

fn union(a: Corners, b: Corners) -> Corners {
    ([0, 1, 2].map(|k| a.0[k].min(b.0[k])), [0, 1, 2].map(|k| a.1[k].max(b.1[k])))
}

fn contains(outer: Corners, inner: Corners) -> bool {
    (0..3).all(|k| outer.0[k] <= inner.0[k] && inner.1[k] <= outer.1[k])
}

/// A tree to be walked, with the boxes of its primitives in leaf order.
struct Walk<'a> {
    nodes: &'a [Node],
    triangles: Vec<Corners>,
    spheres: Vec<Corners>,
    seen_nodes: Vec<u32>,
    seen_triangles: Vec<u32>,
    seen_spheres: Vec<u32>,
    depth: u32,
}

impl Walk<'_> {
    /// Walks a subtree; returns the exact box of the primitives in it.
    fn visit(&mut self, word: u32, depth: u32) -> Corners {
        let (boxes, seen, first, count) = match ChildRef::decode(word) {
            ChildRef::Inner(index) => {
                let node = self.nodes[index as usize];
                self.seen_nodes[index as usize] += 1;
                self.depth = self.depth.max(depth + 1);
                let mut all = None;
                for (lo, hi, child) in [
                    (node.left_lo, node.left_hi, node.left),
                    (node.right_lo, node.right_hi, node.right),
                ] {
                    if let ChildRef::Inner(below) = ChildRef::decode(child) {
                        assert!(below > index, "node {index} has child {below}");
                    }
                    assert!(lo.iter().chain(&hi).all(|x| x.is_finite()));
                    let exact = self.visit(child, depth + 1);
                    assert!(contains((lo, hi), exact), "node {index} cuts its primitives");
                    all = Some(all.map_or(exact, |a| union(a, exact)));
                }
                return all.unwrap();
            }
            ChildRef::Triangles { first, count } => {
                (&self.triangles, &mut self.seen_triangles, first, count)
            }
            ChildRef::Spheres { first, count } => {
                (&self.spheres, &mut self.seen_spheres, first, count)
            }
            ChildRef::Instance(_) | ChildRef::Empty => panic!("an empty child, or an instance"),
        };
        assert!((1..=8).contains(&count));
        let range = first as usize..(first + count) as usize;
        seen[range.clone()].iter_mut().for_each(|n| *n += 1);
        boxes[range].iter().copied().reduce(union).unwrap()
    }
}

fn corners(fragments: &[Fragment], order: &[u32]) -> Vec<Corners> {
    let mut seen = vec![false; fragments.len()];
    let boxes = order.iter().map(|&i| {
        assert!(!std::mem::replace(&mut seen[i as usize], true), "primitive {i} twice");
        let b = fragments[i as usize].bounds();
        (b.lo3(), b.hi3())
    });
    let boxes: Vec<_> = boxes.collect();
    assert_eq!(boxes.len(), fragments.len(), "lost primitives");
    boxes
}

fn walk(nodes: &[Node], root: u32, triangles: Vec<Corners>, spheres: Vec<Corners>) -> u32 {
    let mut walk = Walk {
        nodes,
        seen_nodes: vec![0; nodes.len()],
        seen_triangles: vec![0; triangles.len()],
        seen_spheres: vec![0; spheres.len()],
        triangles,
        spheres,
        depth: 0,
    };
    if ChildRef::decode(root) != ChildRef::Empty {
        walk.visit(root, 0);
    }
    for seen in [&walk.seen_nodes, &walk.seen_triangles, &walk.seen_spheres] {
        assert!(seen.iter().all(|&n| n == 1), "something is reached not once");
    }
    walk.depth
}

/// Checks the tree of a group of triangles that stand still.
pub(crate) fn tree(tree: &Tree, triangles: &[Tri]) {
    fragments(tree, triangles, &crate::shapes::fragments(triangles));
}

/// Checks the tree of a group of triangles, of which those with other boxes than their corners' move.
pub(crate) fn fragments(tree: &Tree, triangles: &[Tri], fragments: &[Fragment]) {
    let split = &tree.splits;
    assert_eq!(tree.order.len(), fragments.len() + split.len(), "lost pieces");
    let mut seen = vec![false; tree.order.len()];
    for &piece in &tree.order {
        assert!(!std::mem::replace(&mut seen[piece as usize], true), "piece {piece} twice");
    }
    let mut places: Vec<Vec<Corners>> = vec![Vec::new(); fragments.len()];
    let all = (tree.bounds.lo3(), tree.bounds.hi3());
    let primitives = tree.primitives();
    let depth = visit_leaves(tree, tree.root, all, &mut |at, bounds| {
        places[primitives[at] as usize].push(bounds);
    });
    assert_eq!(depth, tree.depth);
    assert!(depth < pack::abi::MAX_DEPTH, "depth {depth}");
    for ((places, fragment), triangle) in places.iter().zip(fragments).zip(triangles) {
        if let [place] = places.as_slice() {
            let b = fragment.bounds();
            assert!(contains(*place, (b.lo3(), b.hi3())), "a box cuts {triangle:?}");
        } else {
            check_cover(triangle, places);
        }
    }
}

/// Walks a subtree; tells each place in its leaves with the box that a ray must meet to get there.
fn visit_leaves(
    tree: &Tree,
    word: u32,
    outer: Corners,
    tell: &mut impl FnMut(usize, Corners),
) -> u32 {
    match ChildRef::decode(word) {
        ChildRef::Inner(index) => {
            let node = tree.nodes[index as usize];
            let left = (node.left_lo, node.left_hi);
            let right = (node.right_lo, node.right_hi);
            assert!(contains(outer, left) && contains(outer, right), "node {index} sticks out");
            let left = visit_leaves(tree, node.left, left, tell);
            1 + left.max(visit_leaves(tree, node.right, right, tell))
        }
        ChildRef::Triangles { first, count } => {
            assert!((1..=8).contains(&count));
            (first..first + count).for_each(|at| tell(at as usize, outer));
            0
        }
        ChildRef::Spheres { .. } => panic!("a sphere"),
        ChildRef::Instance(_) | ChildRef::Empty => 0,
    }
}

/// Points all over a triangle are in one of its boxes, those on planes between boxes included.
fn check_cover(triangle: &Tri, places: &[Corners]) {
    assert!(places.len() > 1, "lost: {triangle:?}");
    let corners = triangle.map(|p| p.map(f64::from));
    // Only the sum below rounds.
    let room = corners.as_flattened().iter().fold(0.0_f64, |m, x| m.max(x.abs())) * 1e-15;
    let within = |p: [f64; 3], (lo, hi): &Corners| {
        (0..3).all(|k| f64::from(lo[k]) <= p[k] + room && p[k] - room <= f64::from(hi[k]))
    };
    for i in 0..=24 {
        for j in 0..=24 - i {
            let (u, v) = (f64::from(i) / 24.0, f64::from(j) / 24.0);
            let p = [0, 1, 2]
                .map(|k| corners[0][k] * (1.0 - u - v) + corners[1][k] * u + corners[2][k] * v);
            assert!(places.iter().any(|b| within(p, b)), "{p:?} of {triangle:?} is in no leaf");
        }
    }
}

/// Checks the tree of a scene in which nothing was split, binary and wide.
pub(crate) fn joined(joined: &Joined, triangles: &[Fragment], spheres: &[Fragment]) {
    crate::wide::check(joined);
    let triangles = corners(triangles, &joined.triangle_order);
    let spheres = corners(spheres, &joined.sphere_order);
    let depth = walk(&joined.nodes, joined.root, triangles, spheres);
    assert_eq!(depth, joined.stack_need);
    assert!(joined.stack_need <= 96);
}
