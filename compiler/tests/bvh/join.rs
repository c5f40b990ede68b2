//! Trees of groups joined into one.

use std::ops::Range;

use compiler::bvh::{
    self, BvhError, Fragment, Group, GroupKind, Input, Joined, Preset, Primitives, SMALL_MESH,
    build_scene, join,
};
use compiler::cache::Cache;
use pack::abi::{ChildRef, NONE};

use crate::shapes::{Rng, Tri, degenerate, fragments, grid};
use crate::verify;

fn spheres(n: usize) -> Vec<([f32; 3], f32)> {
    let mut rng = Rng::new(5);
    (0..n).map(|_| (rng.point(1.0), rng.range(0.001, 0.1))).collect()
}

/// Builds, verifies and returns the tree of a scene.
fn check(triangles: &[Tri], mesh_sizes: &[usize], spheres: &[([f32; 3], f32)]) -> Joined {
    let primitives =
        Primitives { triangles, mesh_sizes, mesh_motions: &[], spheres, sphere_motions: &[] };
    let (tree, report) = build_scene(&primitives, Preset::Fast, &Cache::disabled()).unwrap();
    assert_eq!((report.stored, report.loaded, report.warnings.len()), (0, 0, 0));
    let balls: Vec<_> =
        (0..).zip(spheres).map(|(i, &(c, r))| Fragment::of_sphere(c, r, i)).collect();
    verify::joined(&tree, &fragments(triangles), &balls);
    tree
}

#[test]
fn nothing_has_no_root() {
    let tree = check(&[], &[], &[]);
    assert_eq!((tree.root, tree.stack_need), (NONE, 0));
    assert_eq!(check(&[], &[0, 0], &[]).root, NONE);
    assert_eq!(join(&[]).unwrap().root, NONE);
}

#[test]
fn few_primitives_are_a_leaf() {
    let same = degenerate("same", 8);
    let tree = check(&same, &[8], &[]);
    assert_eq!(ChildRef::decode(tree.root), ChildRef::Triangles { first: 0, count: 8 });
    let tree = check(&[], &[], &[([0.0; 3], 1.0)]);
    assert_eq!(ChildRef::decode(tree.root), ChildRef::Spheres { first: 0, count: 1 });
    let tree = check(&same[..1], &[1], &spheres(1));
    assert_eq!((tree.nodes.len(), tree.stack_need), (1, 1));
}

#[test]
fn any_mix_of_groups_is_a_tree() {
    let soup = degenerate("soup", 5000);
    for sizes in [
        vec![5000],
        vec![2500, 2500],
        vec![1, 4999],
        vec![64, 63, 65, 4808],
        vec![5; 1000],
        vec![100; 50],
        vec![0, 5000, 0],
    ] {
        check(&soup, &sizes, &[]);
        check(&soup, &sizes, &spheres(300));
        let joined = join(&own_groups(&soup, &sizes)).unwrap();
        verify::joined(&joined, &fragments(&soup), &[]);
    }
    check(&[], &[], &spheres(1000));
}

#[test]
fn degenerate_groups_are_joined() {
    for kind in ["same", "point", "nested", "geom", "line", "nan"] {
        check(&degenerate(kind, 4000), &[1000; 4], &[]);
        check(&degenerate(kind, 3200), &[100; 32], &spheres(9));
        let triangles = degenerate(kind, 3200);
        for sizes in [vec![1; 3200], vec![100; 32], vec![1600; 2]] {
            let joined = join(&own_groups(&triangles, &sizes)).unwrap();
            verify::joined(&joined, &fragments(&triangles), &[]);
        }
    }
}

#[test]
fn small_meshes_share_a_group() {
    let (small, large) = (10, u32::try_from(SMALL_MESH).unwrap());
    let sizes = [small, SMALL_MESH + 7, small, 0, SMALL_MESH, SMALL_MESH - 1];
    let plan = bvh::plan(&vec![[[0.0; 3]; 3]; sizes.iter().sum()], &sizes);
    assert_eq!(plan.len(), 3);
    assert_eq!(plan[0].as_slice(), std::slice::from_ref(&(10..17 + large)));
    assert_eq!(plan[1].as_slice(), std::slice::from_ref(&(27 + large..27 + 2 * large)));
    assert_eq!(plan[2], [0..10, 17 + large..27 + large, 27 + 2 * large..26 + 3 * large]);
    assert!(bvh::plan(&[], &[0, 0]).is_empty());
}

#[test]
fn many_small_meshes_share_groups_with_those_near_them() {
    let size = SMALL_MESH / 2;
    let mesh = |x: f32, width: f32| vec![[[x, 0.0, 0.0], [x + width, 0.0, 0.0], [x; 3]]; size];
    let grouped = |places: &[(f32, f32)]| {
        let triangles: Vec<_> = places.iter().flat_map(|(x, width)| mesh(*x, *width)).collect();
        let groups = bvh::plan(&triangles, &vec![size; places.len()]);
        let number = |range: &Range<u32>| range.start as usize / size;
        let groups = groups.iter().map(|group| group.iter().map(number).collect::<Vec<_>>());
        let mut groups: Vec<_> = groups.collect();
        groups.sort();
        groups
    };
    let mut places = vec![(-0.9, 0.01); 4];
    places.extend([(-0.4, 0.01); 4]);
    places.extend([(0.2, 0.01); 2]);
    assert_eq!(grouped(&places[..8]), [(0..8).collect::<Vec<_>>()]);
    let apart = [vec![0, 1, 2, 3, 4, 5, 6, 7], vec![8, 9]];
    assert_eq!(grouped(&places), apart);
    // One that moves changes two groups; one that is wider than any half is with the others that are left over.
    let mut wide = places.clone();
    wide.extend([(0.7, 0.01), (-0.7, 1.4)]);
    assert_eq!(grouped(&wide), [vec![0, 1, 2, 3, 4, 5, 6, 7], vec![8, 9, 10], vec![11]]);
    // Too few for a group of their own.
    places.pop();
    assert_eq!(grouped(&places), [vec![0, 1, 2, 3, 4, 5, 6, 7], vec![8]]);
    // All in one place cannot be divided.
    assert_eq!(grouped(&[(0.5, 0.0); 20]).len(), 1);
}

#[test]
fn sizes_that_do_not_add_up_are_an_error() {
    let triangles = degenerate("soup", 10);
    for sizes in [vec![], vec![9], vec![11], vec![usize::MAX, 11]] {
        let primitives = Primitives {
            triangles: &triangles,
            mesh_sizes: &sizes,
            mesh_motions: &[],
            spheres: &[],
            sphere_motions: &[],
        };
        let error = build_scene(&primitives, Preset::Fast, &Cache::disabled()).unwrap_err();
        assert_eq!(error, BvhError::Sizes { count: 10 });
    }
}

#[test]
fn the_joined_tree_does_not_depend_on_threads() {
    let soup = degenerate("soup", 20_000);
    let sizes = [5000, 10, 4990, 10_000];
    let run = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| check(&soup, &sizes, &spheres(2000)))
    };
    assert_eq!(run(1), run(4));
}

/// Every mesh in a group of its own, whatever its size.
fn own_groups(triangles: &[Tri], sizes: &[usize]) -> Vec<Group> {
    let mut rest = triangles;
    let mut groups = Vec::new();
    for &size in sizes {
        let start = u32::try_from(triangles.len() - rest.len()).unwrap();
        let (part, after) = rest.split_at(size);
        rest = after;
        let members = std::iter::once(start..start + u32::try_from(size).unwrap()).collect();
        let tree = bvh::build(Preset::Fast, Input::of_triangles(part)).unwrap();
        groups.push(Group { kind: GroupKind::Triangles, tree, members });
    }
    assert!(rest.is_empty());
    groups
}

#[test]
fn groups_that_cross_are_opened() {
    // Two walls that cross in the middle: each box contains most of the other wall.
    let wall = |swap: bool| {
        let turn = move |[x, y, _]: [f32; 3]| {
            let z = (x - 0.5) * 0.9;
            if swap { [z, y - 0.5, x - 0.5] } else { [x - 0.5, y - 0.5, z] }
        };
        grid(60, 0.0).into_iter().map(move |t| t.map(turn))
    };
    let walls: Vec<Tri> = wall(false).chain(wall(true)).collect();
    let joined = join(&own_groups(&walls, &[walls.len() / 2; 2])).unwrap();
    verify::joined(&joined, &fragments(&walls), &[]);
    let one = check(&walls, &[walls.len()], &[]);
    assert!(joined.cost() < 1.1 * one.cost(), "{} against {}", joined.cost(), one.cost());
}

/// Two halves of one soup are the worst case: the boxes overlap on every level.
#[test]
fn tangled_meshes_become_one_tree() {
    let soup = degenerate("soup", 2 * u32::try_from(SMALL_MESH).unwrap());
    let one = check(&soup, &[soup.len()], &[]);
    let primitives = Primitives {
        triangles: &soup,
        mesh_sizes: &[SMALL_MESH, SMALL_MESH],
        mesh_motions: &[],
        spheres: &[],
        sphere_motions: &[],
    };
    let (two, report) = build_scene(&primitives, Preset::Fast, &Cache::disabled()).unwrap();
    assert!(report.merged);
    assert_eq!((report.groups, two.cost()), (3, one.cost()));
    let joined = join(&own_groups(&soup, &[SMALL_MESH; 2])).unwrap();
    verify::joined(&joined, &fragments(&soup), &[]);
    assert!(joined.cost() > 1.1 * one.cost(), "{} against {}", joined.cost(), one.cost());
}

#[test]
fn meshes_apart_keep_their_own_trees() {
    let mut both = degenerate("soup", u32::try_from(SMALL_MESH).unwrap());
    both.extend_from_within(..);
    both[SMALL_MESH..].iter_mut().flatten().for_each(|p| p[0] += 10.0);
    let primitives = Primitives {
        triangles: &both,
        mesh_sizes: &[SMALL_MESH, SMALL_MESH],
        mesh_motions: &[],
        spheres: &[],
        sphere_motions: &[],
    };
    let (_, report) = build_scene(&primitives, Preset::Fast, &Cache::disabled()).unwrap();
    assert_eq!((report.groups, report.merged), (2, false));
}
