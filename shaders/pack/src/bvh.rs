//! Facts about the tree that compiler and reader must agree on.
//!
//! Turns nodes into the length of the traversal stack. It trusts nothing: any words give a number.

use crate::abi::{ChildRef, NONE, Node, WideNode};
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
/// most inner nodes on a path from the root.
///
/// Children that break the order (not after their parent, or not there) count as leaves; the checks
/// of a pack refuse them. Linear in the number of nodes.
#[must_use]
pub fn stack_need<N: InnerNode>(nodes: &[N], root: u32) -> u32 {
    let ChildRef::Inner(root) = ChildRef::decode(root) else { return 0 };
    if root as usize >= nodes.len() {
        return 0;
    }
    // One more than what may wait when a node is entered; 0 is unreached.
    let mut waiting = vec![0u32; nodes.len()];
    waiting[root as usize] = 1;
    let mut need = 0;
    for (index, node) in nodes.iter().enumerate().skip(root as usize) {
        if waiting[index] == 0 {
            continue;
        }
        let others = node.children().count().saturating_sub(1);
        let here = waiting[index].saturating_add(u32::try_from(others).unwrap_or(u32::MAX));
        need = need.max(here - 1);
        for word in node.children() {
            if let ChildRef::Inner(child) = ChildRef::decode(word)
                && child as usize > index
                && let Some(below) = waiting.get_mut(child as usize)
            {
                *below = (*below).max(here);
            }
        }
    }
    need
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
            _ => 0,
        }
    }

    #[test]
    fn leaves_need_nothing() {
        assert_eq!(stack_need::<Node>(&[], NONE), 0);
        assert_eq!(stack_need::<Node>(&[], leaf(0)), 0);
        assert_eq!(stack_need::<WideNode>(&[], inner(0)), 0);
    }

    #[test]
    fn a_chain_needs_its_length_and_a_full_tree_its_depth() {
        let chain = [node(leaf(0), inner(1)), node(inner(2), leaf(1)), node(leaf(2), leaf(3))];
        assert_eq!(stack_need(&chain, inner(0)), 3);
        let full = [node(inner(1), inner(2)), node(leaf(0), leaf(1)), node(leaf(2), leaf(3))];
        assert_eq!(stack_need(&full, inner(0)), 2);
        for tree in [&chain, &full] {
            assert_eq!(stack_need(tree, inner(0)), by_definition(tree, inner(0)));
        }
    }

    #[test]
    fn broken_trees_give_a_number() {
        let cycle = [node(inner(0), inner(7)), node(inner(0), inner(1))];
        assert_eq!(stack_need(&cycle, inner(0)), 1);
        assert_eq!(stack_need(&cycle, inner(1)), 1);
    }

    /// A stack machine that follows any child first never holds more, and reaches the bound.
    fn check_bound<N: InnerNode>(tree: &[N]) {
        let need = stack_need(tree, inner(0)) as usize;
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
        assert_eq!(stack_need(&tree, inner(0)), 2 + 1 + 3 + 1);
    }
}
