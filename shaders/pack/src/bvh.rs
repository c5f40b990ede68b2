//! Facts about the tree that compiler and reader must agree on.
//!
//! Turns nodes into the length of the traversal stack. It trusts nothing: any words give a number.

use crate::abi::{ChildRef, Node};

/// Entries that the traversal stack needs over all rays and orders: at every inner node both
/// children may be hit, one waits on the stack while the other is followed, so
/// `need(inner) = 1 + max(need(left), need(right))` and `need(leaf) = 0`. In other words, the most
/// inner nodes on a path from the root.
///
/// Children that break the order (not after their parent, or not there) count as leaves; the checks
/// of a pack refuse them. Linear in the number of nodes.
#[must_use]
pub fn stack_need(nodes: &[Node], root: u32) -> u32 {
    let ChildRef::Inner(root) = ChildRef::decode(root) else { return 0 };
    if root as usize >= nodes.len() {
        return 0;
    }
    // Inner nodes on the longest path from the root up to and including each node; 0 is unreached.
    let mut level = vec![0u32; nodes.len()];
    level[root as usize] = 1;
    let mut need = 0;
    for (index, node) in nodes.iter().enumerate().skip(root as usize) {
        let here = level[index];
        if here == 0 {
            continue;
        }
        need = need.max(here);
        for word in [node.left, node.right] {
            if let ChildRef::Inner(child) = ChildRef::decode(word)
                && child as usize > index
                && let Some(below) = level.get_mut(child as usize)
            {
                *below = (*below).max(here + 1);
            }
        }
    }
    need
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::abi::NONE;

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
        assert_eq!(stack_need(&[], NONE), 0);
        assert_eq!(stack_need(&[], leaf(0)), 0);
        assert_eq!(stack_need(&[], inner(0)), 0);
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

    /// A stack machine that follows either child first never holds more, and reaches the bound.
    #[test]
    fn a_traversal_that_hits_everything_reaches_the_bound() {
        let tree = [
            node(inner(1), inner(2)),
            node(leaf(0), inner(3)),
            node(leaf(1), leaf(2)),
            node(inner(4), leaf(3)),
            node(leaf(4), leaf(5)),
        ];
        let need = stack_need(&tree, inner(0)) as usize;
        let mut deepest = 0;
        for order in 0..1u32 << tree.len() {
            let mut stack = Vec::new();
            let mut current = Some(inner(0));
            while let Some(word) = current {
                current = if let ChildRef::Inner(index) = ChildRef::decode(word) {
                    let node = &tree[index as usize];
                    let swap = order >> index & 1 == 1;
                    let (near, far) =
                        if swap { (node.right, node.left) } else { (node.left, node.right) };
                    stack.push(far);
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
}
