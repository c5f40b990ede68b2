//! Binary trees become wide ones.
//!
//! Turns a binary tree into the same tree with fewer inner nodes: some are dissolved into their parents,
//! so that no node has more than four children. Which ones is chosen so that the expected number of nodes
//! a ray visits, by the surface-area heuristic, is the least possible (Ylitie, Karras & Laine 2017,
//! "Efficient Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs", HPG, section 3.1, without
//! changes to leaves). Leaves stay as they are: their references may stand for anything.
//! It does not know what boxes look like in the pack.

use pack::abi::{ChildRef, Node, WIDTH};

use super::fragment::Bounds;
use super::top::children;

/// What is known of a node's subtree when it is to be several children of one node.
#[derive(Clone, Copy)]
struct Plan {
    /// Least cost with at most 1, 2 and 3 roots.
    cost: [f32; WIDTH - 1],
    /// How many of at most 2, 3 and 4 roots the left subtree gets, at least 1.
    left: [u8; WIDTH - 1],
    /// With at most 2 and 3 roots: whether one root is best, which is the node itself.
    whole: [bool; WIDTH - 2],
}

impl Plan {
    const UNKNOWN: Self = Self { cost: [0.0; 3], left: [1; 3], whole: [true; 2] };
}

/// How the nodes of a binary tree are put together.
pub(super) struct Collapse<'a> {
    nodes: &'a [Node],
    /// Empty: no node is dissolved.
    plans: Vec<Plan>,
}

impl<'a> Collapse<'a> {
    /// The best way; children come after their parents.
    pub(super) fn best(nodes: &'a [Node]) -> Self {
        let mut plans = vec![Plan::UNKNOWN; nodes.len()];
        for (index, node) in nodes.iter().enumerate().rev() {
            plans[index] = plan(node, &plans);
        }
        Self { nodes, plans }
    }

    /// No node is dissolved: two children each.
    pub(super) fn none(nodes: &'a [Node]) -> Self {
        Self { nodes, plans: Vec::new() }
    }

    /// Boxes and references of the children of node `index`, 2 to 4, from left to right.
    pub(super) fn children_of(&self, index: u32, out: &mut Vec<(Bounds, u32)>) {
        let parts = match self.plans.get(index as usize) {
            Some(plan) => [usize::from(plan.left[2]), WIDTH - usize::from(plan.left[2])],
            None => [1, 1],
        };
        for (child, roots) in children(&self.nodes[index as usize]).into_iter().zip(parts) {
            self.gather(child, roots, out);
        }
    }

    /// The subtree below `child` as at most `roots` children, 1 to 3.
    fn gather(&self, child: (Bounds, u32), roots: usize, out: &mut Vec<(Bounds, u32)>) {
        let (ChildRef::Inner(index), 2..) = (ChildRef::decode(child.1), roots) else {
            return out.push(child);
        };
        let Plan { left, whole, .. } = self.plans[index as usize];
        if whole[roots - 2] {
            return self.gather(child, roots - 1, out);
        }
        let n_left = usize::from(left[roots - 2]);
        let [a, b] = children(&self.nodes[index as usize]);
        self.gather(a, n_left, out);
        self.gather(b, roots - n_left, out);
    }
}

/// Costs of a leaf: none, it is there whatever is chosen.
const LEAF: [f32; WIDTH - 1] = [0.0; WIDTH - 1];

/// The plan of a node whose children have theirs.
fn plan(node: &Node, plans: &[Plan]) -> Plan {
    let sides = children(node);
    let below = sides.map(|(_, word)| match ChildRef::decode(word) {
        ChildRef::Inner(child) => plans[child as usize].cost,
        _ => LEAF,
    });
    // The cheapest way to share at most 2, 3 and 4 roots; of equal ones the most even.
    let shared = [2, 3, 4].map(|roots| {
        let ways = (1..roots).filter(|left| *left < WIDTH && roots - left < WIDTH);
        let cost = |left: usize| below[0][left - 1] + below[1][roots - left - 1];
        let key = |left: &usize| (cost(*left), left.abs_diff(roots - left));
        let best = ways.min_by(|a, b| {
            let (a, b) = (key(a), key(b));
            a.0.total_cmp(&b.0).then(a.1.cmp(&b.1))
        });
        best.map_or((f32::INFINITY, 1), |left| (cost(left), left))
    });
    let left = shared.map(|(_, left)| u8::try_from(left).expect("at most 3"));
    let own = sides[0].0.union(sides[1].0).half_area() + shared[2].0;
    let mut plan = Plan { cost: [own; 3], left, whole: [true; 2] };
    for (k, (cost, _)) in shared.into_iter().enumerate().take(WIDTH - 2) {
        plan.whole[k] = cost >= plan.cost[k];
        plan.cost[k + 1] = cost.min(plan.cost[k]);
    }
    plan
}
