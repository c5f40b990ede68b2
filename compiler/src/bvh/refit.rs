//! Boxes for a tree whose shape is known.
//!
//! Turns checked references and fragments into nodes: minimum and maximum are exact, so the boxes are
//! the builder's, bit for bit.

use pack::abi::{ChildRef, Node};

use super::fragment::{Bounds, Fragment};

/// The nodes and the box of everything. The shape has passed `check`; hence children come after
/// their parents, and all indices are in range.
pub(super) fn refit(
    root: u32,
    children: &[[u32; 2]],
    order: &[u32],
    fragments: &[Fragment],
) -> (Vec<Node>, Bounds) {
    let mut nodes = vec![Node::default(); children.len()];
    let mut boxes = vec![Bounds::EMPTY; children.len()];
    let box_of = |word: u32, boxes: &[Bounds]| match ChildRef::decode(word) {
        ChildRef::Inner(index) => boxes[index as usize],
        ChildRef::Triangles { first, count } | ChildRef::Spheres { first, count } => {
            let leaf = &order[first as usize..][..count as usize];
            let parts = leaf.iter().map(|&i| fragments[i as usize].bounds());
            parts.fold(Bounds::EMPTY, Bounds::union)
        }
        ChildRef::Instance(_) | ChildRef::Empty => Bounds::EMPTY,
    };
    for (index, &[left, right]) in children.iter().enumerate().rev() {
        let (l, r) = (box_of(left, &boxes), box_of(right, &boxes));
        boxes[index] = l.union(r);
        nodes[index] = Node {
            left_lo: l.lo3(),
            left,
            left_hi: l.hi3(),
            right,
            right_lo: r.lo3(),
            right_hi: r.hi3(),
            ..Node::default()
        };
    }
    let all = box_of(root, &boxes);
    let bounds = if order.is_empty() { Bounds::EMPTY } else { all.without_lanes() };
    (nodes, bounds)
}
