//! Boxes of what moves while the shutter is open.

use compiler::bvh::{BvhError, Fragment, Motion, Preset, Primitives, SMALL_MESH, build_scene};
use compiler::cache::Cache;

use crate::shapes::{Rng, Tri, degenerate, fragments};
use crate::verify;

const STILL: [f32; 3] = [0.0; 3];

fn straight(ways: &[[f32; 3]]) -> Vec<Motion> {
    ways.iter().copied().map(Motion::Straight).collect()
}

/// Where the kernel finds a point at `time`.
fn moved(p: [f32; 3], motion: [f32; 3], time: f32) -> [f32; 3] {
    [0, 1, 2].map(|k| p[k] + motion[k] * time)
}

#[test]
fn boxes_hold_what_moves_on_all_its_way() {
    let mut rng = Rng::new(11);
    let triangles: Vec<Tri> = degenerate("soup", u32::try_from(SMALL_MESH).unwrap() + 90);
    let sizes = [40, SMALL_MESH, 0, 30, 20];
    // One comes much farther than its size, one stands still.
    let motions = [[0.3, -0.2, 0.0], [0.0, 1e-3, 0.01], STILL, STILL, [-40.0, 0.7, 3.0]];
    let spheres: Vec<([f32; 3], f32)> =
        (0..50).map(|_| (rng.point(1.0), rng.range(1e-5, 0.1))).collect();
    let sphere_motions: Vec<[f32; 3]> =
        (0..50).map(|i| if i % 3 == 0 { STILL } else { rng.point(2.0) }).collect();
    let primitives = Primitives {
        triangles: &triangles,
        mesh_sizes: &sizes,
        mesh_motions: &motions.map(Motion::Straight),
        spheres: &spheres,
        sphere_motions: &straight(&sphere_motions),
    };
    let (tree, _) = build_scene(&primitives, Preset::Fast, &Cache::disabled()).unwrap();
    let of_triangle: Vec<[f32; 3]> = (sizes.iter().zip(motions))
        .flat_map(|(size, motion)| std::iter::repeat_n(motion, *size))
        .collect();
    for time in [0.0, 0.2, 0.5, 0.9, 1.0 - 1.0 / 16_777_216.0] {
        let now: Vec<Tri> = (triangles.iter().zip(&of_triangle))
            .map(|(corners, motion)| corners.map(|p| moved(p, *motion, time)))
            .collect();
        let balls: Vec<Fragment> = (0..)
            .zip(spheres.iter().zip(&sphere_motions))
            .map(|(i, (&(c, r), motion))| Fragment::of_sphere(moved(c, *motion, time), r, i))
            .collect();
        verify::joined(&tree, &fragments(&now), &balls);
    }
}

#[test]
fn the_cache_tells_displacements_apart() {
    let dir = tempfile::tempdir().unwrap();
    let cache = Cache::at(dir.path());
    let triangles = degenerate("soup", u32::try_from(SMALL_MESH).unwrap());
    let run = |motions: &[[f32; 3]]| {
        let primitives = Primitives {
            triangles: &triangles,
            mesh_sizes: &[SMALL_MESH],
            mesh_motions: &straight(motions),
            spheres: &[],
            sphere_motions: &[],
        };
        build_scene(&primitives, Preset::Fast, &cache).unwrap()
    };
    let loaded = [&[][..], &[STILL], &[[0.1, 0.0, 0.0]], &[[0.2, 0.0, 0.0]], &[[0.1, 0.0, 0.0]]]
        .map(|motions| run(motions).1.loaded);
    assert_eq!(loaded, [0, 1, 0, 0, 1]);
}

#[test]
fn displacements_must_be_as_many_as_what_they_move() {
    let triangles = degenerate("soup", 10);
    for (meshes, balls) in [(2, 1), (1, 2), (3, 0)] {
        let primitives = Primitives {
            triangles: &triangles,
            mesh_sizes: &[10],
            mesh_motions: &straight(&vec![STILL; meshes]),
            spheres: &[(STILL, 1.0)],
            sphere_motions: &straight(&vec![STILL; balls]),
        };
        let error = build_scene(&primitives, Preset::Fast, &Cache::disabled()).unwrap_err();
        assert_eq!(error, BvhError::Sizes { count: 10 });
    }
}
