//! Two ways of finding a light, and what weights make of them.
//!
//! A white Lambert receiver under a sphere, sampled by the kernel's light cone (density `pl`) and by the
//! kernel's diffuse lobe (`pb`). All values are over the truth.

use glam::{DVec3, Vec3};

use super::sphere_light::Setting;
use super::{Topic, estimate, row};
use crate::kernel::{Bench, Lobe};
use crate::statistics::Mean;
use crate::statistics::stream::Stream;

/// Sums of the same samples under different weights.
#[derive(Clone, Copy, Debug, Default)]
pub struct Weighted {
    /// The balance heuristic on both sides: ours.
    pub both: Mean,
    /// The balance heuristic on light samples, weight 1 on scattered rays that hit the light.
    pub light_only: Mean,
    /// Weight 1 on both.
    pub neither: Mean,
    /// The balance heuristic on light samples, scattered rays that hit the light dropped.
    pub dropped: Mean,
    /// One strategy chosen evenly, divided by the mixture whose weights are the balance heuristic's.
    pub nested: Mean,
    /// Proxies of the densities in the weights only.
    pub proxy_weights: Mean,
    /// The same proxies in the weights and as divisors.
    pub proxy_divisors: Mean,
}

/// Proxies that are no densities: of the light's, of the lobe's.
fn proxies(pl: f64, pb: f64) -> [f64; 2] {
    [7.0 * pl, pb.powi(3) + 0.1]
}

impl Weighted {
    /// One light sample with f cos = `fl`, one scattered ray with f cos times radiance = `fb`, each with both
    /// densities; `first` chooses the light sample where only one counts.
    fn add(&mut self, [fl, l_pl, l_pb]: [f64; 3], [fb, b_pl, b_pb]: [f64; 3], first: bool) {
        let balance = fl / (l_pl + l_pb);
        self.both.add(balance + fb / (b_pl + b_pb));
        self.light_only.add(balance + fb / b_pb);
        self.neither.add(fl / l_pl + fb / b_pb);
        self.dropped.add(balance);
        let nested = |f: f64, pl: f64, pb: f64| f * (pl + pb) / (pl * pl + pb * pb);
        self.nested.add(if first { nested(fl, l_pl, l_pb) } else { nested(fb, b_pl, b_pb) });
        let [l, other_l] = proxies(l_pl, l_pb);
        let [other_b, b] = proxies(b_pl, b_pb);
        self.proxy_weights.add(fl / l_pl * l / (l + other_l) + fb / b_pb * b / (b + other_b));
        self.proxy_divisors.add(fl / (l + other_l) + fb / (b + other_b));
    }
}

/// `n` samples of each strategy.
#[must_use]
pub fn measure(setting: Setting, n: u64) -> Weighted {
    let mut stream = Stream::new(113, u64::from(setting.ratio.to_bits()));
    let bench = Bench::new();
    let mut kernel = bench.single();
    let lobe = Lobe { normal: DVec3::Z, ..Lobe::diffuse() }.single();
    let light = setting.light();
    let pl = f64::from(kernel.sphere_light_pdf(light, Vec3::ZERO));
    let cone = f64::from(kernel.sphere_light_cone(light, Vec3::ZERO));
    let mut sums = Weighted::default();
    for _ in 0..n {
        let to = kernel.sphere_light_sample(light, Vec3::ZERO, stream.pair24());
        let f = f64::from(kernel.diffuse_eval(lobe, to.wi).f.x) / setting.truth();
        let l = [f, f64::from(to.pdf), f64::from(kernel.diffuse_eval(lobe, to.wi).pdf)];
        let next = kernel.diffuse_sample(lobe, stream.pair24());
        // |wi - c|^2 / 2 = 1 - cos for unit vectors.
        let hit = 0.5 * (next.wi - light.origin).as_dvec3().length_squared() <= cone;
        let f = f64::from(kernel.diffuse_eval(lobe, next.wi).f.x) / setting.truth();
        let b = [if hit { f } else { 0.0 }, if hit { pl } else { 0.0 }, f64::from(next.pdf)];
        sums.add(l, b, stream.unit() < 0.5);
    }
    sums
}

/// Measures the topic.
#[must_use]
pub fn topic() -> Topic {
    let n = 2_000_000;
    let sums = measure(Setting { ratio: 0.8, cos: 1.0 }, n);
    let small = measure(Setting { ratio: 0.1, cos: 0.8 }, n);
    let ours = estimate(&sums.both);
    Topic {
        title: "Multiple importance sampling: both strategies, one denominator",
        places: &["shaders/wgsl/kernel/direct.wgsl"],
        rows: vec![
            row(
                "radius / distance 0.8: weight on the light sample only",
                estimate(&sums.light_only),
                ours.clone(),
            ),
            row("no weights at all", estimate(&sums.neither), ours.clone()),
            row(
                "scattered rays that find the light dropped",
                estimate(&sums.dropped),
                ours.clone(),
            ),
            row(
                "balance weights as the weights of a mixture, radius / distance 0.1",
                estimate(&small.nested),
                estimate(&small.both),
            ),
            row("proxies instead of densities as divisor", estimate(&sums.proxy_divisors), ours),
            row("the same proxies in the weights only", "-", estimate(&sums.proxy_weights)),
        ],
        fact: "Weights must sum to 1 over all strategies in every direction: a light sample \
            contributes L f |cos| / (P pl + pb), a scattered ray that finds the light has weight \
            pb / (P pl + pb). Weights on one side only, weights used as those of a mixture, and \
            stand-ins for the densities in the divisor are all biased. (Veach 1997, *Robust Monte \
            Carlo Methods for Light Transport Simulation*, ch. 9.)",
    }
}
