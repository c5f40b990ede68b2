//! The naive tree and its walk: triangles into nodes that own their boxes, a ray into the nearest triangle
//! that its stack and its count of steps let it find.
//!
//! It does not know how our own tree is built or walked, but can take one over.

use compiler::bvh::Tree;
use glam::Vec3;
use pack::abi::ChildRef;

use super::triangle;

/// A triangle.
pub type Corners = [Vec3; 3];
type Box3 = (Vec3, Vec3);

/// A node of the naive tree: the box of what is below it, and that.
struct Node {
    bounds: Box3,
    below: Below,
}

enum Below {
    Pair(usize, usize),
    Leaf(Vec<usize>),
}

/// The naive tree; the root is the last node.
pub struct MedianTree {
    nodes: Vec<Node>,
    triangles: Vec<Corners>,
}

fn box_of(t: &Corners) -> Box3 {
    (t[0].min(t[1]).min(t[2]), t[0].max(t[1]).max(t[2]))
}

fn around(triangles: &[Corners], items: &[usize]) -> Box3 {
    let none = (Vec3::INFINITY, Vec3::NEG_INFINITY);
    items.iter().fold(none, |(lo, hi), i| {
        let (l, h) = box_of(&triangles[*i]);
        (lo.min(l), hi.max(h))
    })
}

impl MedianTree {
    /// Cuts the longest side of each box in the middle; leaves hold 8.
    #[must_use]
    pub fn spatial_median(triangles: Vec<Corners>) -> Self {
        let mut tree = Self { nodes: Vec::new(), triangles };
        let mut items: Vec<usize> = (0..tree.triangles.len()).collect();
        // From the root down one side splits off at a time; nodes are made on the way back up.
        let mut forks = Vec::new();
        let mut rest = loop {
            let (lo, hi) = around(&tree.triangles, &items);
            let axis = (hi - lo).max_position();
            let middle = 0.5 * (lo[axis] + hi[axis]);
            let below = |i: &usize| {
                let (l, h) = box_of(&tree.triangles[*i]);
                0.5 * (l[axis] + h[axis]) < middle
            };
            let (left, right): (Vec<usize>, Vec<usize>) = items.iter().partition(|i| below(i));
            if items.len() <= 8 || right.len() > 8 || left.is_empty() || right.is_empty() {
                break tree.leaf(items);
            }
            forks.push(right);
            items = left;
        };
        for right in forks.into_iter().rev() {
            let right = tree.leaf(right);
            rest = tree.pair(rest, right);
        }
        tree
    }

    /// Our tree in the naive form.
    #[must_use]
    pub fn of_ours(tree: &Tree, triangles: &[Corners]) -> Self {
        let triangles = tree.order.iter().map(|i| triangles[*i as usize]).collect();
        let mut naive = Self { nodes: Vec::new(), triangles };
        naive.copy(tree, tree.root);
        naive
    }

    fn copy(&mut self, tree: &Tree, word: u32) -> usize {
        match ChildRef::decode(word) {
            ChildRef::Inner(i) => {
                let node = &tree.nodes[i as usize];
                let (left, right) = (self.copy(tree, node.left), self.copy(tree, node.right));
                self.pair(left, right)
            }
            ChildRef::Triangles { first, count } | ChildRef::Spheres { first, count } => {
                self.leaf((first as usize..(first + count) as usize).collect())
            }
            ChildRef::Instance(_) | ChildRef::Empty => self.leaf(Vec::new()),
        }
    }

    fn leaf(&mut self, items: Vec<usize>) -> usize {
        let bounds = around(&self.triangles, &items);
        self.nodes.push(Node { bounds, below: Below::Leaf(items) });
        self.nodes.len() - 1
    }

    fn pair(&mut self, left: usize, right: usize) -> usize {
        let (a, b) = (self.nodes[left].bounds, self.nodes[right].bounds);
        let bounds = (a.0.min(b.0), a.1.max(b.1));
        self.nodes.push(Node { bounds, below: Below::Pair(left, right) });
        self.nodes.len() - 1
    }

    /// Index of the nearest triangle: at most `stack` nodes wait, what does not fit is dropped; after `most`
    /// nodes the ray has missed.
    #[must_use]
    pub fn trace(&self, origin: Vec3, dir: Vec3, stack: usize, most: usize) -> Option<usize> {
        let (mut best, mut found) = (f32::INFINITY, None);
        let mut waiting = vec![self.nodes.len() - 1];
        let mut steps = 0;
        while let Some(at) = waiting.pop() {
            steps += 1;
            if steps > most {
                return None;
            }
            match &self.nodes[at].below {
                Below::Leaf(items) => {
                    for i in items {
                        let hit = triangle::naive(self.triangles[*i], origin, dir, 1e-6);
                        if let Some(t) = hit.filter(|t| *t < best) {
                            (best, found) = (t, Some(*i));
                        }
                    }
                }
                Below::Pair(left, right) => {
                    let enter = |i: &usize| enter(self.nodes[*i].bounds, origin, dir, best);
                    let (l, r) = (enter(left), enter(right));
                    let order =
                        if l <= r { [(r, right), (l, left)] } else { [(l, left), (r, right)] };
                    for (_, child) in order.into_iter().filter(|(t, _)| t.is_finite()) {
                        if waiting.len() < stack {
                            waiting.push(*child);
                        }
                    }
                }
            }
        }
        found
    }
}

/// Where a ray enters a box, or infinity.
fn enter((lo, hi): Box3, origin: Vec3, dir: Vec3, best: f32) -> f32 {
    let (a, b) = ((lo - origin) / dir, (hi - origin) / dir);
    let (near, far) = (a.min(b).max_element().max(0.0), a.max(b).min_element());
    if near <= far.min(best) { near } else { f32::INFINITY }
}
