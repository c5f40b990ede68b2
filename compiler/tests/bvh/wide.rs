//! Binary trees made wide: the same leaves in boxes that are no smaller, and as few nodes as can be.

use std::collections::BTreeMap;

use compiler::bvh::{self, Joined, Layout, Preset, Primitives, widen};
use compiler::cache::Cache;
use pack::abi::{ChildRef, MAX_STACK, NONE, Node, WIDTH, WideNode};
use pack::bvh::stack_need;

use crate::shapes::{Rng, ball, degenerate};

type Corners = [[f32; 3]; 2];

/// The box of every leaf, by its reference.
fn leaves_of(nodes: &[Node]) -> BTreeMap<u32, Corners> {
    let sides = |n: &Node| [([n.left_lo, n.left_hi], n.left), ([n.right_lo, n.right_hi], n.right)];
    let children = nodes.iter().flat_map(sides);
    let leaf = |(_, word): &(Corners, u32)| !matches!(ChildRef::decode(*word), ChildRef::Inner(_));
    children.filter(leaf).map(|(corners, word)| (word, corners)).collect()
}

fn contains(outer: Corners, inner: Corners) -> bool {
    (0..3).all(|k| outer[0][k] <= inner[0][k] && inner[1][k] <= outer[1][k])
}

/// Makes the tree wide; it must have the same leaves, each once, in boxes that contain the boxes they had.
pub(crate) fn check(joined: &Joined) -> Vec<WideNode> {
    let mut wide = Vec::new();
    let root = widen(&joined.nodes, joined.root, &mut wide).unwrap();
    if joined.nodes.is_empty() {
        assert!(wide.is_empty() && root == joined.root);
        return wide;
    }
    assert_eq!(ChildRef::decode(root), ChildRef::Inner(0));
    assert!(stack_need(&wide, &[], root) <= MAX_STACK);
    let mut leaves = leaves_of(&joined.nodes);
    let mut seen = vec![0; wide.len()];
    seen[0] = 1;
    for (index, node) in (0..).zip(&wide) {
        let children = node.words();
        let n = children.iter().filter(|word| **word != NONE).count();
        assert!(n >= 2 && children[n..].iter().all(|word| *word == NONE), "node {index}");
        for (slot, word) in children.into_iter().enumerate().take(n) {
            let ChildRef::Inner(child) = ChildRef::decode(word) else {
                let was = leaves.remove(&word).unwrap_or_else(|| panic!("leaf {word:x} twice"));
                assert!(contains(node.corners(slot), was), "leaf {word:x} was {was:?}");
                continue;
            };
            assert!(child > index, "node {index} has child {child}");
            seen[child as usize] += 1;
            let below = wide[child as usize];
            let [lo, mut hi] = node.corners(slot);
            (0..3).for_each(|k| hi[k] += below.scale[k]);
            for slot in (0..WIDTH).filter(|slot| below.words()[*slot] != NONE) {
                assert!(contains([lo, hi], below.corners(slot)), "node {child} sticks out");
            }
        }
    }
    assert!(leaves.is_empty(), "{} leaves are lost", leaves.len());
    assert!(seen.iter().all(|n| *n == 1));
    wide
}

fn joined(triangles: &[[[f32; 3]; 3]], preset: Preset) -> Joined {
    let primitives = Primitives {
        triangles,
        mesh_sizes: &[triangles.len()],
        mesh_motions: &[],
        spheres: &[],
        sphere_motions: &[],
    };
    bvh::build_scene(&primitives, preset, &Cache::disabled()).unwrap().0
}

#[test]
fn every_degenerate_input_becomes_wide() {
    for kind in ["soup", "same", "point", "nested", "geom", "flat", "line", "far", "fan", "long"] {
        for preset in Preset::ALL {
            check(&joined(&degenerate(kind, 3000), preset));
        }
    }
}

#[test]
fn a_node_of_four_saves_two() {
    let tree = joined(&ball(64, 0.7), Preset::Default);
    let wide = check(&tree);
    let part = wide.len() as f64 / tree.nodes.len() as f64;
    // A third is the least: every node has three children more than it is nodes.
    assert!((0.33..0.42).contains(&part), "{part} of the nodes are left");
}

/// Half the area of what a node holds.
fn area(node: &Node) -> f64 {
    let side = |k: usize| {
        let (lo, hi) =
            (node.left_lo[k].min(node.right_lo[k]), node.left_hi[k].max(node.right_hi[k]));
        f64::from(hi) - f64::from(lo)
    };
    side(0) * side(1) + side(1) * side(2) + side(2) * side(0)
}

/// How many children the node `index` has if the marked nodes dissolve, at most 5.
fn n_children(nodes: &[Node], index: usize, dissolved: u32) -> usize {
    let of = |word| match ChildRef::decode(word) {
        ChildRef::Inner(child) if dissolved >> child & 1 == 1 => {
            n_children(nodes, child as usize, dissolved)
        }
        _ => 1,
    };
    (of(nodes[index].left) + of(nodes[index].right)).min(WIDTH + 1)
}

/// The least sum of areas over all ways to dissolve nodes.
fn least(nodes: &[Node]) -> f64 {
    let n = u32::try_from(nodes.len()).unwrap();
    let ways = (0..1_u32 << n).step_by(2).filter(|dissolved| {
        let stays = |i: &usize| dissolved >> i & 1 == 0;
        (0..nodes.len()).filter(stays).all(|i| n_children(nodes, i, *dissolved) <= WIDTH)
    });
    let cost = |dissolved: u32| -> f64 {
        let stays = |(i, _): &(usize, &Node)| dissolved >> i & 1 == 0;
        nodes.iter().enumerate().filter(stays).map(|(_, node)| area(node)).sum()
    };
    ways.map(cost).fold(f64::INFINITY, f64::min)
}

/// The sum over what the wide nodes hold, from the binary nodes that became them.
fn cost_of(wide: &[WideNode], nodes: &[Node]) -> f64 {
    let first_leaf = |mut word: u32, left: &dyn Fn(u32) -> u32| {
        while let ChildRef::Inner(index) = ChildRef::decode(word) {
            word = left(index);
        }
        word
    };
    // A subtree is known by its leaves, first and last.
    let binary = |i: u32| {
        let node = nodes[i as usize];
        let first = first_leaf(node.left, &|i| nodes[i as usize].left);
        (first, first_leaf(node.right, &|i| nodes[i as usize].right))
    };
    let by_ends: BTreeMap<(u32, u32), u32> =
        (0..u32::try_from(nodes.len()).unwrap()).map(|i| (binary(i), i)).collect();
    let last = |node: &WideNode| node.words().into_iter().rfind(|word| *word != NONE).unwrap();
    let ends = |node: &WideNode| {
        let first = first_leaf(node.child0, &|i| wide[i as usize].child0);
        (first, first_leaf(last(node), &|i| last(&wide[i as usize])))
    };
    wide.iter().map(|node| area(&nodes[by_ends[&ends(node)] as usize])).sum()
}

#[test]
fn no_other_way_to_dissolve_nodes_is_cheaper() {
    let mut rng = Rng::new(23);
    for round in 0..40 {
        let n = 20 + rng.next() % 70;
        let tree = joined(&degenerate(["soup", "long"][round % 2], n), Preset::ALL[round % 5]);
        if !(2..=17).contains(&tree.nodes.len()) {
            continue;
        }
        let (found, least) = (cost_of(&check(&tree), &tree.nodes), least(&tree.nodes));
        assert!((found / least - 1.0).abs() < 1e-5, "{found}, but {least} is possible");
    }
}

/// A chain of nodes, each with a pair of leaves to its left: the deepest that binary trees may be.
#[test]
fn a_tree_too_deep_for_four_children_keeps_two() {
    let leaf = |first| ChildRef::Triangles { first, count: 1 }.encode().unwrap();
    let inner = |index| ChildRef::Inner(index).encode().unwrap();
    let n = 95;
    let node = |k: u32, left, right| {
        let hi = [1.0 - 0.01 * k as f32; 3];
        let (left_lo, right_lo) = ([0.0; 3], [0.0; 3]);
        Node { left_lo, left_hi: hi, left, right_lo, right_hi: hi, right, ..Node::default() }
    };
    let mut nodes = Vec::new();
    for k in 0..n {
        let next = if k + 1 == n { leaf(2 * n) } else { inner(2 * k + 2) };
        nodes.push(node(k, inner(2 * k + 1), next));
        nodes.push(node(k, leaf(2 * k), leaf(2 * k + 1)));
    }
    assert_eq!(stack_need(&nodes, &[], inner(0)), MAX_STACK);
    let mut tree = joined(&[], Preset::Fast);
    (tree.nodes, tree.root) = (nodes, inner(0));
    let wide = check(&tree);
    assert_eq!(wide.len(), tree.nodes.len());
    assert_eq!(stack_need(&wide, &[], inner(0)), MAX_STACK);
    // One level less deep by half, and four children fit.
    tree.nodes.truncate(2 * 48);
    tree.nodes[94].right = leaf(96);
    assert!(check(&tree).len() < 2 * 48);
}

#[test]
fn several_roots_share_an_array() {
    let tree = joined(&degenerate("soup", 500), Preset::Fast);
    let mut wide = Vec::new();
    let first = widen(&tree.nodes, tree.root, &mut wide).unwrap();
    let n = u32::try_from(wide.len()).unwrap();
    let second = widen(&tree.nodes, tree.root, &mut wide).unwrap();
    assert_eq!(ChildRef::decode(first), ChildRef::Inner(0));
    assert_eq!(ChildRef::decode(second), ChildRef::Inner(n));
    assert_eq!(stack_need(&wide, &[], first), stack_need(&wide, &[], second));
    assert_eq!(wide.len(), 2 * n as usize);
}

#[test]
fn names_of_layouts_are_read_back() {
    for layout in Layout::ALL {
        assert_eq!(layout.to_string().parse(), Ok(layout));
    }
    let unknown = "broad".parse::<Layout>().unwrap_err();
    assert_eq!(unknown.to_string(), "unknown node layout `broad`; expected `wide` or `binary`");
}
