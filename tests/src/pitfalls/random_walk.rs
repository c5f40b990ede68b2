//! Light that walks inside a medium: absorbed twice and colourless (the naive form), once and by channel (ours).
//!
//! Isotropic scattering, no interface, light at normal incidence, as in `slab`.

#![expect(clippy::cast_possible_truncation, reason = "the kernel computes in f32")]

use glam::{DVec3, Vec2};
use runtime::kernel::f32::{Kernel, Medium as Record};

use super::{Row, Topic, estimate, off, row, slab};
use crate::kernel::Bench;
use crate::statistics::Mean;
use crate::statistics::stream::Stream;

/// A medium: coefficients per unit of length and channel, and its thickness.
#[derive(Clone, Copy, Debug)]
pub struct Medium {
    /// Scattering.
    pub sigma_s: DVec3,
    /// Absorption.
    pub sigma_a: DVec3,
    /// Thickness, or infinity.
    pub thickness: f64,
}

impl Medium {
    /// A grey half-space of one mean free path a unit.
    #[must_use]
    pub fn grey(albedo: f64) -> Self {
        let (sigma_s, sigma_a) = (DVec3::splat(albedo), DVec3::splat(1.0 - albedo));
        Self { sigma_s, sigma_a, thickness: f64::INFINITY }
    }

    fn sigma_t(&self) -> DVec3 {
        self.sigma_s + self.sigma_a
    }
}

/// How a step is taken and weighed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Steps {
    /// The mean of `sigma_t`, and absorption both along the step and at its end.
    Naive,
    /// The kernel's: one channel's `sigma_t`, the weights of all three by the balance heuristic of one sample.
    Ours,
}

fn exp(v: DVec3) -> DVec3 {
    DVec3::new(v.x.exp(), v.y.exp(), v.z.exp())
}

/// A step from `depth` along cosine `mu`: the new depth, inside or out, and the factor of the throughput.
fn step(
    medium: &Medium,
    kernel: Option<&mut Kernel<'_>>,
    (depth, mu): (f64, f64),
    throughput: DVec3,
    stream: &mut Stream,
) -> (f64, DVec3) {
    let edge = if mu < 0.0 { -depth / mu } else { (medium.thickness - depth) / mu };
    let Some(kernel) = kernel else {
        let sigma_t = medium.sigma_t();
        let d = -(-stream.unit()).ln_1p() * 3.0 / sigma_t.element_sum();
        let factor = exp(-medium.sigma_a * d) * (medium.sigma_s / sigma_t);
        return (depth + d * mu, if d < edge { factor } else { DVec3::ONE });
    };
    let record = Record {
        sigma_a: medium.sigma_a.as_vec3(),
        sigma_s: medium.sigma_s.as_vec3(),
        ..Record::ZERO
    };
    let u = Vec2::new(stream.unit24(), stream.unit24());
    let (throughput, edge) = (throughput.as_vec3(), edge as f32);
    let t = kernel.homogeneous_free_path(record, throughput, u);
    let weight = kernel.homogeneous_weight(record, throughput, t, edge);
    // What passes is beyond the edge, by how much does not matter.
    let d = if t < edge { f64::from(t) } else { f64::INFINITY };
    (depth + d * mu, weight.as_dvec3())
}

/// What one walk brings back through the front, and through the back.
fn walk(
    medium: &Medium,
    mut kernel: Option<&mut Kernel<'_>>,
    most: u32,
    stream: &mut Stream,
) -> [DVec3; 2] {
    let (mut depth, mut mu, mut throughput) = (0.0, 1.0, DVec3::ONE);
    for _ in 0..most {
        let (to, factor) = step(medium, kernel.as_deref_mut(), (depth, mu), throughput, stream);
        throughput *= factor;
        if to < 0.0 {
            return [throughput, DVec3::ZERO];
        }
        if to > medium.thickness {
            return [DVec3::ZERO, throughput];
        }
        let q = throughput.max_element().min(1.0);
        if stream.unit() >= q {
            break;
        }
        throughput /= q;
        (depth, mu) = (to, stream.between(-1.0, 1.0));
    }
    [DVec3::ZERO; 2]
}

/// Reflectance and transmittance of one channel by `n` walks of at most `most` steps.
#[must_use]
pub fn measure(medium: &Medium, steps: Steps, most: u32, channel: usize, n: u64) -> [Mean; 2] {
    let bench = Bench::new();
    let mut kernel = (steps == Steps::Ours).then(|| bench.single());
    let mut sums = [Mean::default(); 2];
    for i in 0..n {
        let mut stream = Stream::new(191, i);
        let out = walk(medium, kernel.as_mut(), most, &mut stream);
        for (sum, light) in sums.iter_mut().zip(out) {
            sum.add(light[channel]);
        }
    }
    sums
}

fn rows() -> Vec<Row> {
    let n = 400_000;
    let mut rows = Vec::new();
    let off =
        |mean: &Mean, truth: f64| format!("{} ({})", estimate(mean), off(mean.value(), truth));
    for albedo in [0.5, 0.9, 0.99] {
        let medium = Medium::grey(albedo);
        let truth = slab::half_space(albedo);
        let at = |steps| measure(&medium, steps, u32::MAX, 0, n)[0];
        rows.push(row(
            format!("reflectance of a half-space of albedo {albedo} (exact {truth:.4})"),
            off(&at(Steps::Naive), truth),
            off(&at(Steps::Ours), truth),
        ));
    }
    let medium = Medium::grey(0.999);
    let truth = slab::half_space(0.999);
    rows.push(row(
        format!("walks that end after 20 steps, albedo 0.999 (exact {truth:.4})"),
        off(&measure(&medium, Steps::Ours, 20, 0, 100_000)[0], truth),
        off(&measure(&medium, Steps::Ours, u32::MAX, 0, 100_000)[0], truth),
    ));
    let medium = colored();
    for (channel, name) in ["red", "green", "blue"].into_iter().enumerate() {
        let sigma_t = medium.sigma_t()[channel];
        let albedo = medium.sigma_s[channel] / sigma_t;
        let [truth, _] = slab::layer(medium.thickness * sigma_t, albedo);
        let at = |steps| measure(&medium, steps, u32::MAX, channel, n)[0];
        rows.push(row(
            format!("{name} of a slab, σt {sigma_t:.2}, albedo {albedo:.3} (exact {truth:.4})"),
            off(&at(Steps::Naive), truth),
            off(&at(Steps::Ours), truth),
        ));
    }
    rows
}

/// A slab that scatters blue most.
fn colored() -> Medium {
    let (sigma_s, sigma_a) = (DVec3::new(1.0, 2.0, 4.0), DVec3::new(0.01, 0.1, 1.0));
    Medium { sigma_s, sigma_a, thickness: 1.0 }
}

/// Measures the topic.
#[must_use]
pub fn topic() -> Topic {
    Topic {
        title: "A random walk is absorbed once",
        places: &["shaders/wgsl/media/homogeneous.wgsl"],
        rows: rows(),
        fact: "A free path drawn with σt already stops where absorption would; what is left to pay \
            is the albedo. Multiplying by e^(-σa d) as well absorbs twice, one mean free path for \
            all channels loses the colour of depth, and a limit of 20 steps loses the light of \
            long walks.",
    }
}
