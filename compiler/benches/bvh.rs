//! Building and caching trees, per mesh of 131,072 triangles.

use std::hint::black_box;

use compiler::bvh::{self, Input, Preset};
use compiler::cache::Cache;
use criterion::{BatchSize, Criterion, criterion_group, criterion_main};

/// A bumpy height field of `2 * n * n` triangles.
fn terrain(n: u16) -> Vec<[[f32; 3]; 3]> {
    let at = |i: u16, j: u16| {
        let (x, z) = (f32::from(i) / f32::from(n), f32::from(j) / f32::from(n));
        [x, 0.05 * (20.0 * x).sin() * (17.0 * z).cos() + 0.01 * (170.0 * (x + z)).sin(), z]
    };
    let quad = |i: u16, j: u16| {
        let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
        [[a, b, c], [a, c, d]]
    };
    (0..n).flat_map(|i| (0..n).flat_map(move |j| quad(i, j))).collect()
}

fn benches(criterion: &mut Criterion) {
    let triangles = terrain(256);
    let input = Input::of_triangles(&triangles);
    let mut group = criterion.benchmark_group("bvh");
    group.sample_size(10);
    for preset in [Preset::Fast, Preset::Default, Preset::Extreme] {
        group.bench_function(format!("build/{preset}/terrain"), |b| {
            let build = |input| bvh::build(preset, black_box(input));
            b.iter_batched(|| input.clone(), build, BatchSize::LargeInput);
        });
    }
    let folder = tempfile::tempdir().expect("a temporary folder");
    let cache = Cache::at(folder.path());
    cache.tree(Preset::Default, input.clone()).expect("an ordinary mesh");
    group.bench_function("load/terrain", |b| {
        let load = |input| cache.tree(Preset::Default, black_box(input));
        b.iter_batched(|| input.clone(), load, BatchSize::LargeInput);
    });
    group.finish();
}

criterion_group!(all, benches);
criterion_main!(all);
