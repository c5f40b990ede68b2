//! What a kernel relies on, written a second time: the judge of packs that the checks let through.

#![allow(clippy::unwrap_used, reason = "helpers of tests are tests")]

use pack::Pack;
use pack::abi::{
    CHILD_OUT, ChildRef, Instance, Light, LightKind, Material, NONE, Node, Sphere, Texture,
    TriShade, Triangle, WideNode,
};
use pack::bvh::InnerNode;

/// The relations that a kernel relies on, written a second time.
pub(crate) fn assert_sound(pack: &Pack) {
    let n_materials = pack.records::<Material>().len();
    let n_lights = pack.records::<Light>().len();
    let n_textures = pack.records::<Texture>().len();
    let (n_triangles, n_spheres) =
        (pack.records::<Triangle>().len(), pack.records::<Sphere>().len());
    let or_none = |index: u32, count: usize| index == NONE || (index as usize) < count;
    assert_eq!(pack.records::<TriShade>().len(), n_triangles);
    for shade in pack.records::<TriShade>() {
        assert!((shade.material as usize) < n_materials && or_none(shade.light, n_lights));
    }
    for sphere in pack.records::<Sphere>() {
        assert!((sphere.material as usize) < n_materials && or_none(sphere.light, n_lights));
        assert!(sphere.radius > 0.0 && sphere.center.iter().all(|x| x.is_finite()));
    }
    for light in pack.records::<Light>() {
        let kind = LightKind::from_tag(light.kind).unwrap();
        let count = match kind {
            LightKind::Sphere => n_spheres,
            LightKind::Rectangle | LightKind::Triangle => n_triangles,
            LightKind::Sky | LightKind::Directional => usize::MAX,
        };
        assert!((light.primitive as usize) < count && (light.material as usize) < n_materials);
    }
    for material in pack.records::<Material>() {
        for id in material.textures() {
            assert!(or_none(id, n_textures));
        }
    }
    for texture in pack.records::<Texture>() {
        let end = u64::from(texture.offset) + texture.words().unwrap();
        assert!(end <= pack.texels().len() as u64);
    }
    let wide = pack.records::<WideNode>();
    if wide.is_empty() {
        assert_tree(pack, pack.records::<Node>(), n_triangles, n_spheres);
    } else {
        assert!(pack.records::<Node>().is_empty());
        assert_tree(pack, wide, n_triangles, n_spheres);
    }
}

/// Walks the tree with a stack of exactly the promised length and counts every primitive and every instance.
fn assert_tree<N: InnerNode>(pack: &Pack, nodes: &[N], n_triangles: usize, n_spheres: usize) {
    let instances = pack.records::<Instance>();
    let mut seen = (vec![0; nodes.len()], vec![0; n_triangles], vec![0; n_spheres]);
    let mut shown = vec![0; instances.len()];
    let mut stack = Vec::new();
    let mut current = Some(pack.render().root);
    while let Some(word) = current {
        if word == CHILD_OUT {
            current = stack.pop();
            continue;
        }
        current = match ChildRef::decode(word) {
            ChildRef::Inner(index) => {
                seen.0[index as usize] += 1;
                let mut children = nodes[index as usize].children();
                let first = children.next();
                stack.extend(children);
                assert!(stack.len() <= pack.render().stack_need as usize);
                first
            }
            ChildRef::Triangles { first, count } => {
                (first..first + count).for_each(|index| seen.1[index as usize] += 1);
                stack.pop()
            }
            ChildRef::Spheres { first, count } => {
                (first..first + count).for_each(|index| seen.2[index as usize] += 1);
                stack.pop()
            }
            ChildRef::Instance(index) => {
                shown[index as usize] += 1;
                let root = instances[index as usize].root;
                stack.push(CHILD_OUT);
                assert!(stack.len() <= pack.render().stack_need as usize);
                // The trees of meshes are walked once, for the first place.
                let first = instances.iter().position(|instance| instance.root == root);
                if first == Some(index as usize) { Some(root) } else { stack.pop() }
            }
            ChildRef::Empty => None,
        };
    }
    assert!([seen.0, seen.1, seen.2, shown].concat().iter().all(|count| *count == 1));
}
