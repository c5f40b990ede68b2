//! Collapses beside all others that there are, and plans that end early.

use super::*;
use pack::abi::NONE;

/// A tree at random, the same for the same seed.
struct Random {
    state: u32,
    nodes: Vec<WideNode>,
    n_triangles: u32,
}

impl Random {
    fn below(&mut self, n: u32) -> u32 {
        self.state = self.state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (self.state >> 16) % n
    }

    /// A reference of so many leaves.
    fn tree(&mut self, leaves: u32) -> u32 {
        if leaves == 1 {
            let (first, count) = (self.n_triangles, 1 + self.below(5));
            self.n_triangles += count;
            return ChildRef::Triangles { first, count }.encode().unwrap();
        }
        let at = self.nodes.len();
        self.nodes.push(WideNode { scale: [1.0; 3], ..WideNode::default() });
        let n = 2 + self.below(leaves.min(4) - 1);
        let mut words = [NONE; 4];
        let mut left = leaves;
        for (slot, others) in (0..n).rev().enumerate() {
            let here = if others == 0 { left } else { 1 + self.below(left - others) };
            left -= here;
            words[slot] = self.tree(here);
            for axis in 0..3 {
                let (lo, size) = (self.below(200), 1 + self.below(55));
                self.nodes[at].lo[axis] |= lo << (8 * slot);
                self.nodes[at].hi[axis] |= (lo + size) << (8 * slot);
            }
        }
        let [child0, child1, child2, child3] = words;
        self.nodes[at] = WideNode { child0, child1, child2, child3, ..self.nodes[at] };
        ChildRef::Inner(u32::try_from(at).unwrap()).encode().unwrap()
    }
}

/// A tree over triangles that look like nothing.
fn source<'a>(nodes: &'a [WideNode], triangles: &'a [Triangle]) -> Source<'a> {
    Source { nodes, triangles, shades: &[], materials: &[] }
}

/// What the children of a node cost, with all below them.
fn cost<const W: usize>(plan: &Plan<W>, children: &[Child]) -> f32 {
    assert!(children.len() <= W);
    let of = |child: &Child| match child.item {
        Item::Node(subtree) => area(&child.corners) + cost(plan, &plan.children(subtree)),
        Item::Many { .. } => 2.0 * area(&child.corners),
        _ => area(&child.corners),
    };
    children.iter().map(of).sum()
}

/// Every way to have a subtree in places of a node above: how many, and the cost.
fn ways<const W: usize>(plan: &Plan<W>, subtree: usize) -> Vec<(usize, f32)> {
    let Subtree { corners, content, .. } = plan.subtrees[subtree];
    let area = area(&corners);
    match content {
        Content::End(Item::Many { .. }) => vec![(1, 2.0 * area)],
        Content::End(_) => vec![(1, area)],
        Content::Halves { halves, few } => {
            let [a, b] = halves.map(|half| ways(plan, half));
            let both = a.iter().flat_map(|a| b.iter().map(move |b| (a.0 + b.0, a.1 + b.1)));
            let mut ways: Vec<_> = both.filter(|way| way.0 <= W).collect();
            let inside = ways.iter().map(|way| way.1).fold(f32::INFINITY, f32::min);
            ways.push((1, if few.is_some() { area } else { area + inside }));
            ways
        }
    }
}

#[test]
fn no_other_collapse_costs_less() {
    for seed in 0..200 {
        costs_least::<8>(seed);
        costs_least::<16>(seed);
    }
}

fn costs_least<const W: usize>(seed: u32) {
    let mut random = Random { state: seed, nodes: Vec::new(), n_triangles: 0 };
    let leaves = 2 + random.below(13);
    random.tree(leaves);
    let triangles = vec![Triangle::default(); random.n_triangles as usize];
    let source = source(&random.nodes, &triangles);
    let plan = Plan::<W>::new(&source, 0, usize::MAX);
    let root = plan.root.unwrap();
    let least = match plan.subtrees[root].content {
        Content::Halves { halves: [a, b], few: None } => {
            let (a, b) = (ways(&plan, a), ways(&plan, b));
            let both = a.iter().flat_map(|a| b.iter().map(move |b| (a.0 + b.0, a.1 + b.1)));
            both.filter(|way| way.0 <= W).map(|way| way.1).fold(f32::INFINITY, f32::min)
        }
        _ => cost(&plan, &[plan.child(root)]),
    };
    let found = cost(&plan, &plan.top());
    assert!((found - least).abs() <= 1e-5 * least, "{seed}: {found} {least}");
}

/// Triangles below these children, with those of stubs, of which `stubs` counts the ones met.
fn n_triangles<const W: usize>(
    source: &Source<'_>,
    plan: &Plan<W>,
    children: &[Child],
    stubs: &mut usize,
) -> usize {
    let mut of = |child: &Child| match child.item {
        Item::Node(subtree) => n_triangles(source, plan, &plan.children(subtree), stubs),
        Item::Inner(index) => {
            *stubs += 1;
            let below = Plan::<W>::new(source, index, usize::MAX);
            n_triangles(source, &below, &below.top(), stubs)
        }
        Item::Few(few) => few.triangles().len(),
        Item::Many { count, .. } => count as usize,
        Item::Moving(_) | Item::Other(_) => 0,
    };
    children.iter().map(&mut of).sum()
}

#[test]
fn a_plan_may_end_early_and_loses_nothing() {
    let mut random = Random { state: 7, nodes: Vec::new(), n_triangles: 0 };
    random.tree(60);
    let triangles = vec![Triangle::default(); random.n_triangles as usize];
    let source = source(&random.nodes, &triangles);
    for (left, ends_early) in [(1, true), (5, true), (usize::MAX, false)] {
        let plan = Plan::<8>::new(&source, 0, left);
        let mut stubs = 0;
        assert_eq!(n_triangles(&source, &plan, &plan.top(), &mut stubs), triangles.len());
        assert_eq!(stubs > 0, ends_early);
    }
}
