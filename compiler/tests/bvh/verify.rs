//! What every tree must keep, checked without the code that built it.

use compiler::bvh::{Fragment, Joined, Tree};
use pack::abi::{ChildRef, Node};

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
            ChildRef::Empty => panic!("an empty child"),
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

/// Checks the tree of a group.
pub(crate) fn tree(tree: &Tree, fragments: &[Fragment]) {
    let depth = walk(&tree.nodes, tree.root, corners(fragments, &tree.order), Vec::new());
    assert_eq!(depth, tree.depth);
    assert!(depth < pack::abi::MAX_DEPTH, "depth {depth}");
}

/// Checks the tree of a scene.
pub(crate) fn joined(joined: &Joined, triangles: &[Fragment], spheres: &[Fragment]) {
    let triangles = corners(triangles, &joined.triangle_order);
    let spheres = corners(spheres, &joined.sphere_order);
    let depth = walk(&joined.nodes, joined.root, triangles, spheres);
    assert_eq!(depth, joined.stack_need);
    assert!(joined.stack_need <= 96);
}
