//! A rough field of three octave sums: offsets added to results (the naive form) or to points (ours).

use glam::Vec3;
use runtime::kernel::f32::Kernel;

use super::{Topic, percent, row};
use crate::kernel::Bench;
use crate::statistics::Mean;
use crate::statistics::stream::Stream;

/// Key of the noise.
const KEY: u32 = 1;

/// The naive stone over the kernel's noise, its vector offsets read as numbers: they are added to the octave
/// sums.
#[must_use]
pub fn stone_naive(kernel: &mut Kernel<'_>, p: Vec3) -> f32 {
    let blocks = kernel.fbm_value(p * 3.0, 3, KEY);
    let fine = kernel.fbm_value(p * 11.0, 3, KEY) + 1.7;
    let cracks = kernel.fbm_value(p * 25.0, 2, KEY) + 3.1;
    blocks * 0.5 + fine * 0.3 + cracks * 0.2
}

/// The kernel's stone.
#[must_use]
pub fn stone_ours(kernel: &mut Kernel<'_>, p: Vec3) -> f32 {
    let bands = kernel.stone_bands(p, 1.0, KEY);
    kernel.stone_field(bands)
}

/// What a field does.
#[derive(Clone, Copy, Debug)]
pub struct Field {
    /// Smallest and largest value.
    pub range: [f32; 2],
    /// Largest roughness, 0.4 to 0.75 over the field's 0 to 1.
    pub roughness: f32,
    /// Share of roughness above 1.
    pub beyond: Mean,
}

/// Samples a field in a box of side 8.
#[must_use]
pub fn sample(field: fn(&mut Kernel<'_>, Vec3) -> f32, n: u64) -> Field {
    let bench = Bench::new();
    let mut kernel = bench.single();
    let mut stream = Stream::new(197, 0);
    let start = [f32::MAX, f32::MIN];
    let mut found = Field { range: start, roughness: 0.0, beyond: Mean::default() };
    for _ in 0..n {
        let p = Vec3::from([0; 3].map(|_| 8.0 * stream.unit24()));
        let f = field(&mut kernel, p);
        found.range = [found.range[0].min(f), found.range[1].max(f)];
        let roughness = 0.4 + 0.35 * f;
        found.roughness = found.roughness.max(roughness);
        found.beyond.add(if roughness > 1.0 { 1.0 } else { 0.0 });
    }
    found
}

/// Measures the topic.
#[must_use]
pub fn topic() -> Topic {
    let [naive, ours] = [sample(stone_naive, 300_000), sample(stone_ours, 300_000)];
    let range = |f: &Field| format!("{:.3} to {:.3}", f.range[0], f.range[1]);
    Topic {
        title: "Offset the point, not the noise",
        places: &["shaders/wgsl/bsdf/stone.wgsl"],
        rows: vec![
            row("values of the stone's field; [0, 1] is announced", range(&naive), range(&ours)),
            row(
                "roughness from it: largest, and share above 1",
                format!("{:.3}, {}", naive.roughness, percent(naive.beyond.value())),
                format!("{:.3}, {}", ours.roughness, percent(ours.beyond.value())),
            ),
        ],
        fact: "An offset added to the noise leaves its lattice in place and moves the field out of \
            its range. fbm(p · 11 + offset) looks up another part of the noise.",
    }
}
