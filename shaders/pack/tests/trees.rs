//! Random trees over random primitives: accepted, walked within the promised stack, all found.

mod common;

use common::sound::assert_sound;
use common::{Scene, inner, node, spheres, triangles};
use pack::Pack;
use pack::abi::{ChildRef, MOVES, NONE, Node};
use pack::bvh::stack_need;
use proptest::prelude::*;

/// What a build has used up: two counts of primitives and the nodes so far.
struct Build {
    nodes: Vec<Node>,
    n_triangles: u32,
    n_spheres: u32,
}

impl Build {
    /// A subtree shaped by `bits`: even numbers end in a leaf.
    fn subtree(&mut self, bits: &mut impl Iterator<Item = u32>) -> u32 {
        let shape = bits.next().unwrap_or(0);
        let count = shape / 4 % 8 + 1;
        match shape % 4 {
            0 => {
                self.n_triangles += count;
                triangles(self.n_triangles - count, count)
            }
            2 => {
                self.n_spheres += count;
                spheres(self.n_spheres - count, count)
            }
            _ => {
                let index = self.nodes.len();
                self.nodes.push(node(NONE, NONE));
                let (left, right) = (self.subtree(bits), self.subtree(bits));
                (self.nodes[index].left, self.nodes[index].right) = (left, right);
                inner(u32::try_from(index).expect("a test's tree is small"))
            }
        }
    }
}

/// Most inner nodes on a path, by recursion.
fn height(nodes: &[Node], word: u32) -> u32 {
    match ChildRef::decode(word) {
        ChildRef::Inner(index) => {
            let node = nodes[index as usize];
            1 + height(nodes, node.left).max(height(nodes, node.right))
        }
        _ => 0,
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn random_trees_are_accepted_and_sound(bits in prop::collection::vec(0u32..64, 1..120)) {
        let mut build = Build { nodes: Vec::new(), n_triangles: 0, n_spheres: 0 };
        let root = build.subtree(&mut bits.into_iter());
        let need = stack_need(&build.nodes, &[], root);
        prop_assert_eq!(need, height(&build.nodes, root));

        let mut scene = Scene::full();
        scene.lights.clear();
        scene.render.n_lights = 0;
        scene.render.root = root;
        scene.render.stack_need = need;
        let (mut triangle, mut shade, mut sphere) =
            (scene.triangles[0], scene.shades[0], scene.spheres[0]);
        (triangle.id0, triangle.id1, triangle.id2) = (MOVES, MOVES | 1, MOVES | 2);
        (shade.light, sphere.light) = (NONE, NONE);
        scene.triangles = vec![triangle; build.n_triangles as usize];
        scene.shades = vec![shade; build.n_triangles as usize];
        scene.spheres = vec![sphere; build.n_spheres as usize];
        scene.nodes = build.nodes;
        let result = scene.writer().to_bytes();
        if need > pack::abi::MAX_STACK {
            prop_assert!(result.is_err());
        } else {
            let pack = Pack::from_bytes(result.expect("the tree is sound"))
                .expect("what was written can be read");
            assert_sound(&pack);
        }
    }
}
