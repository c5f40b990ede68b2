//! One tree: degenerate input, small counts, determinism.

use std::time::{Duration, Instant};

use compiler::bvh::{self, Bounds, Fragment, Input, Preset, Tree};
use pack::abi::{ChildRef, NONE};

use crate::shapes::{KINDS, Rng, Tri, degenerate, fragments};
use crate::verify;

fn build(preset: Preset, triangles: &[Tri]) -> Tree {
    bvh::build(preset, Input::of_triangles(triangles)).unwrap()
}

fn on_threads(threads: usize, preset: Preset, kind: &str, n: u32) -> Tree {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
    let triangles = degenerate(kind, n);
    pool.install(|| build(preset, &triangles))
}

#[test]
fn every_degenerate_input_gives_a_correct_tree_quickly() {
    for kind in KINDS {
        let triangles = degenerate(kind, 20_000);
        for preset in Preset::ALL {
            let start = Instant::now();
            let tree = build(preset, &triangles);
            let took = start.elapsed();
            // Quadratic behaviour would take minutes; a loaded machine does not take 10 s.
            assert!(took < Duration::from_secs(10), "{preset} {kind}: {took:?}");
            verify::tree(&tree, &triangles);
        }
    }
}

#[test]
fn coincident_primitives_give_a_balanced_tree() {
    for kind in ["same", "point"] {
        for preset in [Preset::Fast, Preset::Default, Preset::Extreme] {
            let tree = on_threads(2, preset, kind, 20_000);
            // 8 * 2^12 > 20,000 > 8 * 2^11
            assert_eq!(tree.depth, 12, "{preset} {kind}");
        }
    }
}

#[test]
fn threads_do_not_change_a_byte() {
    // Beyond the sizes from which work is divided.
    let kinds = [("soup", 150_000), ("long", 70_000), ("nested", 20_000), ("same", 20_000)];
    for (preset, (kind, n)) in Preset::ALL.into_iter().flat_map(|p| kinds.map(|k| (p, k))) {
        let one = on_threads(1, preset, kind, n);
        for threads in [2, 3, 4] {
            let many = on_threads(threads, preset, kind, n);
            assert_eq!(
                bytemuck::cast_slice::<_, u8>(&one.nodes),
                bytemuck::cast_slice::<_, u8>(&many.nodes),
                "{preset} {kind}"
            );
            assert_eq!((one.root, &one.order), (many.root, &many.order), "{preset} {kind}");
            assert_eq!(one.splits, many.splits, "{preset} {kind}");
        }
    }
}

#[test]
fn small_counts_give_small_trees() {
    for preset in Preset::ALL {
        let empty = build(preset, &[]);
        assert_eq!((empty.root, empty.nodes.len(), empty.depth), (NONE, 0, 0));
        assert_eq!(empty.bounds, Bounds::EMPTY);
    }
    let one = ChildRef::Triangles { first: 0, count: 1 };
    for (preset, kind) in Preset::ALL.into_iter().flat_map(|p| KINDS.map(|k| (p, k))) {
        for n in 1..=40 {
            let triangles = degenerate(kind, n);
            let tree = build(preset, &triangles);
            verify::tree(&tree, &triangles);
            assert!(n > 1 || ChildRef::decode(tree.root) == one, "{preset} {kind}");
        }
    }
    let same = |n| build(Preset::Fast, &degenerate("same", n));
    assert_eq!(ChildRef::decode(same(8).root), ChildRef::Triangles { first: 0, count: 8 });
    assert_eq!(same(9).nodes.len(), 1);
}

#[test]
fn separate_primitives_are_separated() {
    let far_apart = [0.0, 1000.0_f32].map(|x| [[x, 0.0, 0.0], [x + 1.0, 0.0, 0.0], [x, 1.0, 1.0]]);
    for preset in [Preset::Fast, Preset::Default, Preset::Extreme] {
        let tree = build(preset, &far_apart);
        assert_eq!(tree.nodes.len(), 1);
        assert_eq!(tree.nodes[0].left_hi, [1.0, 1.0, 1.0]);
        assert_eq!(tree.nodes[0].right_lo, [1000.0, 0.0, 0.0]);
    }
}

#[test]
fn pieces_are_few_and_worth_it() {
    let triangles = degenerate("long", 20_000);
    let whole = build(Preset::Fast, &triangles);
    for (preset, most) in [(Preset::Default, 26_000), (Preset::Extreme, 32_000)] {
        let tree = build(preset, &triangles);
        assert!(tree.splits.len() > 4000, "{preset}: {}", tree.splits.len());
        assert!(tree.order.len() <= most, "{preset}: {} references", tree.order.len());
        assert!(sah(&tree) < 0.8 * sah(&whole), "{preset}: {} {}", sah(&tree), sah(&whole));
    }
}

/// Gentle hills of `2 * n * n` triangles.
fn hills(n: u16) -> Vec<Tri> {
    let at = |i: u16, j: u16| {
        let (x, z) = (f32::from(i) * 0.1, f32::from(j) * 0.1);
        [x, libm::sinf(0.7 * x) * libm::cosf(0.6 * z), z]
    };
    let quad = |i: u16, j: u16| {
        let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
        [[a, b, c], [a, c, d]]
    };
    (0..n).flat_map(|i| (0..n).flat_map(move |j| quad(i, j))).collect()
}

/// `n` blades of grass on these hills, which overlap without being in each other's way.
fn grass(n: usize, size: f32) -> Vec<Tri> {
    let mut rng = Rng::new(3);
    let blade = |_| {
        let (x, z) = (rng.range(0.0, size), rng.range(0.0, size));
        let y = libm::sinf(0.7 * x) * libm::cosf(0.6 * z);
        let (lean, tall) = ([rng.range(-0.1, 0.1), rng.range(-0.1, 0.1)], rng.range(0.1, 0.35));
        [[x, y, z], [x + 0.016, y, z], [x + lean[0], y + tall, z + lean[1]]]
    };
    (0..n).map(blade).collect()
}

#[test]
fn ordinary_meshes_are_not_split() {
    let mut meadow = grass(60_000, 20.0);
    meadow.extend(hills(200));
    for (name, triangles) in [("hills", hills(250)), ("meadow", meadow)] {
        let tree = build(Preset::Default, &triangles);
        verify::tree(&tree, &triangles);
        let (n_splits, n) = (tree.splits.len(), triangles.len());
        assert!(n_splits * 100 <= n, "{name}: {n_splits} splits of {n} triangles");
    }
}

#[test]
fn an_ordinary_mesh_does_not_switch_splits_off_beside_it() {
    let mut triangles = degenerate("long", 20_000);
    let alone = build(Preset::Default, &triangles).splits.len();
    // Small, as places for pieces are shared by the lengths of triangles.
    let away = |p: [f32; 3]| [p[0] * 0.05 + 3.0, p[1] * 0.05, p[2] * 0.05];
    triangles.extend(hills(250).into_iter().map(|t| t.map(away)));
    let tree = build(Preset::Default, &triangles);
    verify::tree(&tree, &triangles);
    let beside = tree.splits.len();
    assert!(beside * 10 >= alone * 9, "{beside} splits, {alone} without the hills");
}

/// Two crossed bundles of long triangles beside one that is a million times larger.
#[test]
fn giants_do_not_switch_splits_off() {
    let mut triangles = degenerate("long", 20_000);
    let alone = build(Preset::Default, &triangles).splits.len();
    triangles.push([[-1e6, -1.5, -1e6], [1e6, -1.5, -1e6], [0.0, -1.5, 2e6]]);
    let beside = build(Preset::Default, &triangles).splits.len();
    assert!(beside * 10 >= alone * 9, "{beside} splits, without the giant {alone}");
}

/// What moves is not where its corners say; boxes have none.
#[test]
fn what_must_stay_whole_does() {
    let triangles = degenerate("long", 5000);
    let mut input = Input::of_triangles(&triangles);
    for f in &mut input.fragments[..2500] {
        *f = f.swept([0.01, 0.0, 0.0]);
    }
    let swept = input.fragments.clone();
    let tree = bvh::build(Preset::Default, input).unwrap();
    verify::fragments(&tree, &triangles, &swept);
    let mut times = vec![0; triangles.len()];
    tree.primitives().iter().for_each(|&i| times[i as usize] += 1);
    assert!(times[..2500].iter().all(|&n| n == 1));
    assert!(times[2500..].iter().any(|&n| n > 1));
    let boxes = bvh::build(Preset::Default, Input::of_boxes(fragments(&triangles))).unwrap();
    assert_eq!(boxes, build(Preset::Fast, &triangles));
    let bad = Fragment::of_triangle(&[[0.0; 3], [f32::NAN, 0.0, 0.0], [0.0, 1.0, 0.0]], 0);
    assert!(bad.is_whole());
}

#[test]
fn names_of_builders_are_read_back() {
    for preset in Preset::ALL {
        assert_eq!(preset.to_string().parse(), Ok(preset));
    }
    let error = "sbvh".parse::<Preset>().unwrap_err().to_string();
    assert!(error.contains("`sbvh`") && error.contains("`extreme`"), "{error}");
}

/// Cost by the surface-area heuristic, node and primitive both 1, in units of the root's area.
fn sah(tree: &Tree) -> f64 {
    let area = |lo: [f32; 3], hi: [f32; 3]| {
        let [x, y, z] = [0, 1, 2].map(|k| f64::from(hi[k] - lo[k]));
        x * y + y * z + z * x
    };
    let root = area(tree.bounds.lo3(), tree.bounds.hi3());
    let cost = |word| match ChildRef::decode(word) {
        ChildRef::Triangles { count, .. } => f64::from(count),
        _ => 1.0,
    };
    let inner = tree.nodes.iter().map(|n| {
        area(n.left_lo, n.left_hi) * cost(n.left) + area(n.right_lo, n.right_hi) * cost(n.right)
    });
    cost(tree.root) + inner.sum::<f64>() / root
}

/// Guards the quality: 176.1 and 13.58 were measured when, on a scene of 1.5 million triangles, rays
/// took as many steps and tests as through a tree by Embree (medium quality).
#[test]
fn trees_stay_as_good_as_they_are() {
    let soup = sah(&on_threads(2, Preset::Fast, "soup", 50_000));
    let flat = sah(&on_threads(2, Preset::Fast, "flat", 50_000));
    assert!(soup < 177.0 && flat < 13.7, "soup {soup}, flat {flat}");
}
