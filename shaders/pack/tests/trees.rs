//! Random trees over random primitives: accepted, walked within the promised stack, all found.

mod common;

use common::sound::assert_sound;
use common::{Scene, inner, node, spheres, triangles, wide_node};
use pack::Pack;
use pack::abi::{ChildRef, MOVES, NONE, Node, WIDTH, WideNode};
use pack::bvh::{InnerNode, stack_need};
use proptest::prelude::*;

/// What a build has used up: two counts of primitives and the children of the nodes so far.
struct Build {
    nodes: Vec<Vec<u32>>,
    /// Most children of a node.
    width: usize,
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
                self.nodes.push(Vec::new());
                let n_children = 2 + shape as usize / 4 % (self.width - 1);
                self.nodes[index] = (0..n_children).map(|_| self.subtree(bits)).collect();
                inner(u32::try_from(index).expect("a test's tree is small"))
            }
        }
    }
}

/// Most that can wait on a path, by recursion.
fn height<N: InnerNode>(nodes: &[N], word: u32) -> u32 {
    match ChildRef::decode(word) {
        ChildRef::Inner(index) => {
            let children: Vec<u32> = nodes[index as usize].children().collect();
            let below = children.iter().map(|word| height(nodes, *word)).max();
            u32::try_from(children.len()).expect("at most 4") - 1 + below.expect("at least 2")
        }
        _ => 0,
    }
}

/// A scene with this tree and as many primitives as it has.
fn scene(build: &Build, root: u32, stack_need: u32) -> Scene {
    let mut scene = Scene::full();
    scene.lights.clear();
    scene.render.n_lights = 0;
    scene.render.root = root;
    scene.render.stack_need = stack_need;
    let (mut triangle, mut shade, mut sphere) =
        (scene.triangles[0], scene.shades[0], scene.spheres[0]);
    (triangle.id0, triangle.id1, triangle.id2) = (MOVES, MOVES | 1, MOVES | 2);
    (shade.light, sphere.light) = (NONE, NONE);
    scene.triangles = vec![triangle; build.n_triangles as usize];
    scene.shades = vec![shade; build.n_triangles as usize];
    scene.spheres = vec![sphere; build.n_spheres as usize];
    scene.nodes.clear();
    scene
}

fn check(scene: &Scene) {
    let result = scene.writer().to_bytes();
    if scene.render.stack_need > pack::abi::MAX_STACK {
        assert!(result.is_err());
    } else {
        let pack = Pack::from_bytes(result.expect("the tree is sound"))
            .expect("what was written can be read");
        assert_sound(&pack);
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn random_trees_are_accepted_and_sound(bits in prop::collection::vec(0u32..64, 1..120)) {
        let mut build = Build { nodes: Vec::new(), width: 2, n_triangles: 0, n_spheres: 0 };
        let root = build.subtree(&mut bits.into_iter());
        let nodes: Vec<Node> = build.nodes.iter().map(|c| node(c[0], c[1])).collect();
        let need = stack_need(&nodes, &[], root);
        prop_assert_eq!(need, height(&nodes, root));
        check(&Scene { nodes, ..scene(&build, root, need) });
    }

    #[test]
    fn random_wide_trees_are_accepted_and_sound(bits in prop::collection::vec(0u32..64, 1..200)) {
        let mut build = Build { nodes: Vec::new(), width: WIDTH, n_triangles: 0, n_spheres: 0 };
        let root = build.subtree(&mut bits.into_iter());
        let child = |c: &Vec<u32>, side: usize| c.get(side).copied().unwrap_or(NONE);
        let four = |c: &Vec<u32>| wide_node([0, 1, 2, 3].map(|side| child(c, side)));
        let wide_nodes: Vec<WideNode> = build.nodes.iter().map(four).collect();
        let need = stack_need(&wide_nodes, &[], root);
        prop_assert_eq!(need, height(&wide_nodes, root));
        check(&Scene { wide_nodes, ..scene(&build, root, need) });
    }
}
