//! Ending paths by chance: survival by throughput, capped or cut, and not.

use glam::{Vec2, Vec3};
use runtime::kernel::f32 as single;

use super::{Topic, estimate, row};
use crate::kernel::Bench;
use crate::statistics::Mean;
use crate::statistics::stream::Stream;

/// When a path goes on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Rule {
    /// With the probability of its throughput, at most `0`.
    Capped(f64),
    /// With the probability of its throughput, and never below `0`.
    Cut(f64),
}

impl Rule {
    /// Throughput after the roulette; 0 if the path ends.
    fn survivor(self, throughput: f64, u: f64) -> f64 {
        let q = match self {
            Self::Capped(cap) => throughput.min(cap),
            Self::Cut(threshold) if throughput < threshold => return 0.0,
            Self::Cut(_) => throughput.min(1.0),
        };
        if u < q { throughput / q } else { 0.0 }
    }
}

/// Radiance in a closed room of reflectance `rho` whose walls emit 1 - rho: exactly 1. Roulette from the
/// fourth vertex.
#[must_use]
pub fn room(rho: f64, rule: Rule, n: u64) -> Mean {
    let mut mean = Mean::default();
    for path in 0..n {
        let mut stream = Stream::new(139, path);
        let (mut radiance, mut throughput, mut bounce) = (0.0, 1.0, 0);
        while throughput > 0.0 {
            radiance += throughput * (1.0 - rho);
            throughput *= rho;
            if bounce >= 3 {
                throughput = rule.survivor(throughput, stream.unit());
            }
            bounce += 1;
        }
        mean.add(radiance);
    }
    mean
}

/// A path at the camera.
fn begin(kernel: &mut single::Kernel<'_>, sample: u32) -> single::Path {
    let key = kernel.sample_key(Vec2::ZERO.as_uvec2(), sample, 139);
    kernel.state_at_camera(key, single::CameraRay { origin: Vec3::ZERO, dir: Vec3::Z })
}

/// The same room with the kernel's roulette.
#[must_use]
#[expect(clippy::cast_possible_truncation, reason = "the kernel's paths have f32 throughput")]
pub fn room_of_kernel(rho: f64, n: u32) -> Mean {
    let bench = Bench::new().roulette_from(3);
    let mut kernel = bench.single();
    let mut mean = Mean::default();
    for sample in 0..n {
        let ray = single::CameraRay { origin: Vec3::ZERO, dir: Vec3::Z };
        let key = kernel.sample_key(Vec2::ZERO.as_uvec2(), sample, 139);
        let mut path = kernel.state_at_camera(key, ray);
        let mut radiance = 0.0;
        while path.open {
            radiance += f64::from(path.throughput.x) * (1.0 - rho);
            path.throughput *= rho as f32;
            let key = path.key;
            path.key.bounce += 1;
            path.open = kernel.vertex_roulette(&mut path, key);
        }
        mean.add(radiance);
    }
    mean
}

/// Throughput of `n` paths of throughput `before` after the kernel's roulette at `bounce`, 0 if they ended; roulette from
/// the fourth vertex.
#[must_use]
pub fn survivors(before: f32, bounce: u32, n: u32) -> Vec<f32> {
    let bench = Bench::new().roulette_from(3);
    let mut kernel = bench.single();
    let mut after = |sample| {
        let mut path = begin(&mut kernel, sample);
        path.key.bounce = bounce;
        path.throughput = Vec3::new(0.0, before, 0.5 * before);
        let key = path.key;
        if kernel.vertex_roulette(&mut path, key) { path.throughput.y } else { 0.0 }
    };
    (0..n).map(&mut after).collect()
}

/// Share of `n` paths that survive all of `route`: the weight and the square of the relative index of each scattering,
/// from the first on. Roulette from the fourth vertex.
#[must_use]
pub fn alive(route: &[(f32, f32)], n: u32) -> f64 {
    let bench = Bench::new().roulette_from(3);
    let mut kernel = bench.single();
    let mut lives = |sample| {
        let mut path = begin(&mut kernel, sample);
        route.iter().all(|&(weight, eta2)| {
            let next =
                single::Scattered { wi: Vec3::Z, pdf: 0.0, weight: Vec3::splat(weight), eta2 };
            kernel.vertex_leave(&mut path, next, 0.0);
            path.open
        })
    };
    f64::from((0..n).map(|sample| u32::from(lives(sample))).sum::<u32>()) / f64::from(n)
}

/// Measures the topic.
#[must_use]
pub fn topic() -> Topic {
    let n = 200_000;
    let rows = [0.98, 0.995].map(|rho| {
        let capped = room(rho, Rule::Capped(0.95), u64::from(n));
        let ours = room_of_kernel(rho, n);
        let show = |mean: &Mean| format!("{:.3}, noise {:.2}", mean.value(), mean.deviation());
        row(
            format!("closed room of reflectance {rho}, survival capped at 0.95"),
            show(&capped),
            show(&ours),
        )
    });
    let cut = room(0.3, Rule::Cut(0.05), 2_000_000);
    let cut_row = row(
        "room of reflectance 0.3, paths below a throughput of 0.05 dropped",
        estimate(&cut),
        estimate(&room_of_kernel(0.3, 2_000_000)),
    );
    Topic {
        title: "Russian roulette needs neither a cap nor a cutoff",
        places: &["shaders/wgsl/kernel/vertex.wgsl"],
        rows: rows.into_iter().chain([cut_row]).collect(),
        fact: "Survival with probability q = min(1, 2 × largest throughput) keeps mean and variance. A \
            cap q ≤ 0.95 has infinite variance in a room of reflectance above 0.975; dropping \
            paths below a throughput loses light.",
    }
}
