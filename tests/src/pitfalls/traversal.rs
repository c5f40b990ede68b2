//! Walking a tree with a stack of 256 and at most 2000 steps (the naive form), and without limits (ours).
//!
//! Two scenes in which it matters. Sheets: parallel triangles one behind the other, whose boxes all begin at
//! the origin, in a tree of spatial medians. Needles: long thin triangles across each other, in our own tree.

#![expect(
    clippy::cast_possible_truncation,
    reason = "the naive form and the kernel compute in f32"
)]

use compiler::bvh::{Fragment, Input, Preset, Tree, build};
use glam::{DVec3, Vec3};
use pack::abi::{NONE, Triangle};
use runtime::kernel::f32 as single;

use super::median_tree::{Corners, MedianTree};
use super::{Row, Topic, row, share};
use crate::kernel::Bench;
use crate::statistics::stream::Stream;

/// `n` sheets x + y + z = 1 + i / n in the positive octant.
#[must_use]
pub fn sheets(n: usize) -> Vec<Corners> {
    let length = |i: usize| 1.0 + i as f32 / n as f32;
    (0..n).map(|i| [Vec3::X, Vec3::Y, Vec3::Z].map(|axis| axis * length(i))).collect()
}

/// Our tree over triangles, and the bench that holds it.
fn ours(triangles: &[Corners]) -> (Tree, Bench) {
    let corners = |t: &Corners| t.map(|v| v.to_array());
    let fragments = (0..).zip(triangles).map(|(i, t)| Fragment::of_triangle(&corners(t), i));
    let tree = build(Preset::Fast, Input::of_boxes(fragments.collect()))
        .expect("few triangles have a tree");
    let record = |i: &u32| {
        let [v0, v1, v2] = corners(&triangles[*i as usize]);
        Triangle { v0, id0: 3 * i, v1, id1: 3 * i + 1, v2, id2: 3 * i + 2 }
    };
    let records: Vec<Triangle> = tree.order.iter().map(record).collect();
    let bench = Bench::new().tree(&records, &tree.nodes, tree.root);
    (tree, bench)
}

fn kernel_hit(kernel: &mut single::Kernel<'_>, origin: Vec3, dir: Vec3) -> Option<usize> {
    let hit = kernel.trace(crate::kernel::ray(origin, dir));
    (hit.prim != NONE).then_some(hit.prim as usize)
}

/// Rays among `n` sheets, and how many are told a wrong sheet or none: by the naive form with its stack and no
/// cap, with its cap and no end of stack, by the kernel. `outside`: rays come from outside.
#[must_use]
pub fn sheets_lost(n: usize, outside: bool, rays: usize) -> [usize; 4] {
    let triangles = sheets(n);
    let (tree, bench) = ours(&triangles);
    let mut kernel = bench.single();
    let naive = MedianTree::spatial_median(triangles);
    let mut stream = Stream::new(211, n as u64);
    let mut counts = [0; 4];
    for _ in 0..rays {
        let inner = Vec3::from([0; 3].map(|_| 0.6 * stream.unit24()));
        let (origin, dir) = if outside {
            let from = DVec3::splat(2.5) + stream.direction() * 0.3;
            (from.as_vec3(), (inner.as_dvec3() - from).normalize().as_vec3())
        } else {
            (inner, stream.direction().abs().as_vec3())
        };
        // From outside the last sheet is first; from inside the first beyond the origin's own level.
        let level = (inner.element_sum() - 1.0) * n as f32;
        if (level - level.round()).abs() < 0.01 {
            continue; // On a sheet, up to rounding.
        }
        let level = level.ceil().max(0.0) as usize;
        let truth = Some(if outside { n - 1 } else { level });
        counts[0] += 1;
        let mapped = kernel_hit(&mut kernel, origin, dir).map(|i| tree.order[i] as usize);
        let found = [
            naive.trace(origin, dir, 256, usize::MAX),
            naive.trace(origin, dir, usize::MAX, 2000),
            mapped,
        ];
        for (lost, found) in counts[1..].iter_mut().zip(found) {
            *lost += usize::from(found != truth);
        }
    }
    counts
}

/// Of the rays through `n` needles that hit one: how many there are, how many the naive cap loses in our
/// own tree, how many the kernel loses.
#[must_use]
pub fn needles_lost(n: usize, rays: usize) -> [usize; 3] {
    let mut stream = Stream::new(223, 0);
    let triangles: Vec<Corners> = (0..n)
        .map(|_| {
            let (a, b) = (stream.direction(), stream.direction());
            let thin = a.cross(stream.direction()).normalize() * 0.002;
            [a, b, b + thin].map(DVec3::as_vec3)
        })
        .collect();
    let (tree, bench) = ours(&triangles);
    let mut kernel = bench.single();
    let naive = MedianTree::of_ours(&tree, &triangles);
    let mut counts = [0; 3];
    for _ in 0..rays {
        let from = stream.direction() * 2.0;
        let dir = (stream.direction() * 0.3 - from).normalize().as_vec3();
        let origin = from.as_vec3();
        if naive.trace(origin, dir, usize::MAX, usize::MAX).is_none() {
            continue;
        }
        counts[0] += 1;
        counts[1] += usize::from(naive.trace(origin, dir, usize::MAX, 2000).is_none());
        counts[2] += usize::from(kernel_hit(&mut kernel, origin, dir).is_none());
    }
    counts
}

fn rows() -> Vec<Row> {
    let rays = 2000;
    let mut rows = Vec::new();
    for n in [200, 400] {
        let [rays, dropped, _, ours] = sheets_lost(n, false, rays);
        rows.push(row(
            format!("{n} sheets, rays from among them, stack of 256: wrong answers"),
            share(dropped, rays),
            share(ours, rays),
        ));
    }
    for n in [900, 1500] {
        let [rays, _, capped, ours] = sheets_lost(n, true, rays);
        rows.push(row(
            format!("{n} sheets, rays from outside, 2000 steps: wrong answers"),
            share(capped, rays),
            share(ours, rays),
        ));
    }
    let n = 30_000;
    let [hits, capped, ours] = needles_lost(n, 600);
    rows.push(row(
        format!("{n} crossing needles in our own tree, 2000 steps: hits lost, of {hits}"),
        share(capped, hits),
        share(ours, hits),
    ));
    rows
}

/// Measures the topic.
#[must_use]
pub fn topic() -> Topic {
    Topic {
        title: "Traversal needs no step limit, and exactly one stack size",
        places: &["shaders/wgsl/trace/bvh.wgsl", "compiler/src/bvh/build.rs"],
        rows: rows(),
        fact: "A stack that drops nodes and a cap on steps lose surfaces without a word. The depth \
            of the tree is bounded when it is built, the exact stack need is stored in the pack, \
            and the kernel's stack is that long.",
    }
}
