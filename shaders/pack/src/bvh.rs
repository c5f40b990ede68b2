//! Facts about the tree that compiler and reader must agree on.
//!
//! Turns nodes into the length of the traversal stack. It trusts nothing: any words give a number.

use crate::abi::{ChildRef, Instance, NONE, Node, WideNode};
use crate::kind::PackRecord;

/// An inner node of either layout.
pub trait InnerNode: PackRecord + Sync {
    /// Names of its children, in order.
    const SIDES: &'static [&'static str];

    /// `ChildRef` word of child `side`, below the number of `SIDES`; `NONE` where there is none.
    fn child(&self, side: usize) -> u32;

    /// The words of the children that are there.
    fn children(&self) -> impl Iterator<Item = u32> {
        (0..Self::SIDES.len()).map(|side| self.child(side)).filter(|word| *word != NONE)
    }
}

impl InnerNode for Node {
    const SIDES: &'static [&'static str] = &["left", "right"];

    fn child(&self, side: usize) -> u32 {
        [self.left, self.right][side]
    }
}

impl InnerNode for WideNode {
    const SIDES: &'static [&'static str] = &["child0", "child1", "child2", "child3"];

    fn child(&self, side: usize) -> u32 {
        self.words()[side]
    }
}

/// Entries that the traversal stack needs over all rays and orders: at every inner node all
/// children may be hit, the others wait on the stack while one is followed, so
/// `need(inner) = children - 1 + max(need(child))` and `need(leaf) = 0`. Of a binary tree that is the
/// most inner nodes on a path from the root. The way out of an instance waits, too:
/// `need(instance) = 1 + need(its root)`.
///
/// Children that break the order (not after their parent, or not there) count as leaves, and so do
/// instances in the tree of an instance; the checks of a pack refuse them. Linear in the number of nodes.
#[must_use]
pub fn stack_need<N: InnerNode>(nodes: &[N], instances: &[Instance], root: u32) -> u32 {
    let closed = needs(nodes, |_| 0);
    if instances.is_empty() {
        return need_of(&closed, |_| 0, root);
    }
    let instance = |index: u32| {
        let instance = instances.get(index as usize);
        instance.map_or(0, |instance| 1 + need_of(&closed, |_| 0, instance.root))
    };
    need_of(&needs(nodes, instance), instance, root)
}

/// The need of every node, where `instance` is that of an instance.
fn needs<N: InnerNode>(nodes: &[N], instance: impl Fn(u32) -> u32) -> Vec<u32> {
    let mut needs = vec![0; nodes.len()];
    for (index, node) in nodes.iter().enumerate().rev() {
        let (mut others, mut below) = (0_u32, 0);
        for word in node.children() {
            let need = match ChildRef::decode(word) {
                ChildRef::Inner(child) if child as usize <= index => 0,
                ChildRef::Inner(_)
                | ChildRef::Triangles { .. }
                | ChildRef::Spheres { .. }
                | ChildRef::Instance(_)
                | ChildRef::Empty => need_of(&needs, &instance, word),
            };
            others += 1;
            below = need.max(below);
        }
        needs[index] = below.saturating_add(others.saturating_sub(1));
    }
    needs
}

/// The need of what `word` stands for.
fn need_of(needs: &[u32], instance: impl Fn(u32) -> u32, word: u32) -> u32 {
    match ChildRef::decode(word) {
        ChildRef::Inner(index) => needs.get(index as usize).copied().unwrap_or(0),
        ChildRef::Instance(index) => instance(index),
        ChildRef::Triangles { .. } | ChildRef::Spheres { .. } | ChildRef::Empty => 0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn inner(index: u32) -> u32 {
        ChildRef::Inner(index).encode().unwrap()
    }

    fn leaf(first: u32) -> u32 {
        ChildRef::Triangles { first, count: 1 }.encode().unwrap()
    }

    fn node(left: u32, right: u32) -> Node {
        Node { left, right, ..Node::default() }
    }

    /// The definition, word for word, for comparison.
    fn by_definition(nodes: &[Node], word: u32) -> u32 {
        match ChildRef::decode(word) {
            ChildRef::Inner(index) => {
                let node = &nodes[index as usize];
                1 + by_definition(nodes, node.left).max(by_definition(nodes, node.right))
            }
            ChildRef::Triangles { .. }
            | ChildRef::Spheres { .. }
            | ChildRef::Instance(_)
            | ChildRef::Empty => 0,
        }
    }

    #[test]
    fn leaves_need_nothing() {
        assert_eq!(stack_need::<Node>(&[], &[], NONE), 0);
        assert_eq!(stack_need::<Node>(&[], &[], leaf(0)), 0);
        assert_eq!(stack_need::<WideNode>(&[], &[], inner(0)), 0);
    }

    #[test]
    fn a_chain_needs_its_length_and_a_full_tree_its_depth() {
        let chain = [node(leaf(0), inner(1)), node(inner(2), leaf(1)), node(leaf(2), leaf(3))];
        assert_eq!(stack_need(&chain, &[], inner(0)), 3);
        let full = [node(inner(1), inner(2)), node(leaf(0), leaf(1)), node(leaf(2), leaf(3))];
        assert_eq!(stack_need(&full, &[], inner(0)), 2);
        for tree in [&chain, &full] {
            assert_eq!(stack_need(tree, &[], inner(0)), by_definition(tree, inner(0)));
        }
    }

    #[test]
    fn an_instance_needs_its_tree_and_the_way_out() {
        let instance = |index| ChildRef::Instance(index).encode().unwrap();
        let mesh = |root| Instance { root, ..Instance::default() };
        // Node 0 is the world; node 1 is a mesh of two levels, shown twice; the third is one leaf.
        let nodes =
            [node(instance(0), instance(2)), node(inner(2), leaf(0)), node(leaf(1), leaf(2))];
        let instances = [mesh(inner(1)), mesh(inner(1)), mesh(leaf(3))];
        assert_eq!(stack_need(&nodes, &instances, inner(0)), 1 + 1 + 2);
        assert_eq!(stack_need(&nodes, &instances, instance(1)), 1 + 2);
        assert_eq!(stack_need(&nodes, &instances, instance(2)), 1);
        assert_eq!(stack_need(&nodes, &instances, instance(3)), 0);
        // A world within itself is no world; it gives a number.
        assert_eq!(stack_need(&nodes, &[mesh(inner(0))], inner(0)), 1 + 1 + 1);
    }

    #[test]
    fn broken_trees_give_a_number() {
        let cycle = [node(inner(0), inner(7)), node(inner(0), inner(1))];
        assert_eq!(stack_need(&cycle, &[], inner(0)), 1);
        assert_eq!(stack_need(&cycle, &[], inner(1)), 1);
    }

    /// A stack machine that follows any child first never holds more, and reaches the bound.
    fn check_bound<N: InnerNode>(tree: &[N]) {
        let need = stack_need(tree, &[], inner(0)) as usize;
        let mut deepest = 0;
        for order in 0..1u32 << (2 * tree.len()) {
            let mut stack = Vec::new();
            let mut current = Some(inner(0));
            while let Some(word) = current {
                current = if let ChildRef::Inner(index) = ChildRef::decode(word) {
                    let mut children: Vec<u32> = tree[index as usize].children().collect();
                    let first = (order >> (2 * index) & 3) as usize % children.len();
                    let near = children.remove(first);
                    stack.extend(children);
                    deepest = deepest.max(stack.len());
                    Some(near)
                } else {
                    stack.pop()
                };
            }
            assert!(stack.is_empty());
        }
        assert_eq!(deepest, need);
    }

    #[test]
    fn a_traversal_that_hits_everything_reaches_the_bound() {
        check_bound(&[
            node(inner(1), inner(2)),
            node(leaf(0), inner(3)),
            node(leaf(1), leaf(2)),
            node(inner(4), leaf(3)),
            node(leaf(4), leaf(5)),
        ]);
        let wide = |children: [u32; 4]| {
            let [child0, child1, child2, child3] = children;
            WideNode { child0, child1, child2, child3, ..WideNode::default() }
        };
        let tree = [
            wide([leaf(0), inner(1), inner(2), NONE]),
            wide([leaf(1), leaf(2), leaf(3), leaf(4)]),
            wide([leaf(5), inner(3), NONE, NONE]),
            wide([leaf(6), inner(4), leaf(7), leaf(8)]),
            wide([leaf(9), leaf(10), NONE, NONE]),
        ];
        check_bound(&tree);
        assert_eq!(stack_need(&tree, &[], inner(0)), 2 + 1 + 3 + 1);
    }
}
