//! Refraction past the critical angle.

#![expect(
    clippy::cast_possible_truncation,
    reason = "the naive form and the kernel compute in f32"
)]

use glam::{DVec3, Vec3};
use pack::abi::MaterialKind;

use super::{Topic, row, share};
use crate::kernel::{Bench, Lobe};
use crate::statistics::stream::Stream;

/// The naive refracted direction: the root of the absolute value.
#[must_use]
pub fn naive(dir: Vec3, n: Vec3, eta: f32) -> Vec3 {
    let cos = (-dir).dot(n).min(1.0);
    let flat = eta * (dir + cos * n);
    flat - (1.0 - flat.dot(flat)).abs().sqrt() * n
}

/// What came of rays that leave glass of index 1.5 past the critical angle.
#[derive(Clone, Copy, Debug)]
pub struct Past {
    /// How many rays.
    pub rays: usize,
    /// Shortest and longest direction.
    pub lengths: [f32; 2],
    /// Rays that went through.
    pub through: usize,
}

impl Past {
    fn none() -> Self {
        Self { rays: 0, lengths: [f32::INFINITY, 0.0], through: 0 }
    }

    fn add(&mut self, wi: Vec3) {
        let length = wi.length();
        self.rays += 1;
        self.lengths = [self.lengths[0].min(length), self.lengths[1].max(length)];
        self.through += usize::from(wi.z < 0.0);
    }
}

/// The naive function alone, and the kernel's dielectric, for the same rays.
#[must_use]
pub fn past_critical(n: usize) -> [Past; 2] {
    let bench = Bench::new();
    let mut kernel = bench.single();
    let glass = Lobe { normal: DVec3::Z, front: false, ..Lobe::new(MaterialKind::Dielectric) };
    let mut stream = Stream::new(149, 0);
    let critical = (1.0_f64 / 1.5).asin();
    let [mut told, mut ours] = [Past::none(); 2];
    for _ in 0..n {
        let angle = stream.between(critical + 1e-4, std::f64::consts::FRAC_PI_2);
        let phi = stream.between(0.0, std::f64::consts::TAU);
        let (side, up) = (angle.sin() as f32, angle.cos() as f32);
        let wo = Vec3::new(side * phi.cos() as f32, side * phi.sin() as f32, up);
        told.add(naive(-wo, Vec3::Z, 1.5));
        ours.add(kernel.dielectric_sample(glass.single(), wo, stream.unit24()).wi);
    }
    [told, ours]
}

/// Measures the topic.
#[must_use]
pub fn topic() -> Topic {
    let [naive, ours] = past_critical(200_000);
    let lengths = |past: &Past| format!("{:.4} to {:.4}", past.lengths[0], past.lengths[1]);
    Topic {
        title: "Past the critical angle nothing is refracted",
        places: &["shaders/wgsl/bsdf/dielectric.wgsl"],
        rows: vec![
            row("length of the direction, out of index 1.5", lengths(&naive), lengths(&ours)),
            row(
                "rays that leave although none can",
                share(naive.through, naive.rays),
                share(ours.through, ours.rays),
            ),
        ],
        fact: "The absolute value of Snell's root turns total internal reflection into a ray that \
            does not exist. A negative argument means reflection.",
    }
}
