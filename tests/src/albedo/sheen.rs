//! What the fibres of sheen give back, by quadrature over the hemisphere.

use std::f64::consts::PI;

use glam::DVec3;
use runtime::kernel::f64::Kernel;

use super::facets::direction;
use crate::kernel::{Bench, Lobe};

/// Points along the cosine and around the normal.
const POINTS: [usize; 2] = [256, 256];
/// Nodes of A, over the square root of the cosine.
const NODES: usize = 200;

/// Fibres of one roughness.
pub(super) struct Fibres {
    bench: Bench,
    alpha: f64,
    /// A at the nodes.
    unbounded: Vec<f64>,
    /// E at the nodes.
    albedos: Vec<f64>,
}

impl Fibres {
    pub(super) fn new(roughness: f64) -> Self {
        let bench = Lobe::principled(1.0, 0.0).bench();
        let mut fibres = Self {
            bench,
            alpha: roughness * roughness,
            unbounded: Vec::new(),
            albedos: Vec::new(),
        };
        let at = |k: usize| fibres.given_back((k as f64 / NODES as f64).powi(2), |_| 1.0);
        fibres.unbounded = (0..=NODES).map(at).collect();
        let at = |k: usize| fibres.albedo((k as f64 / NODES as f64).powi(2));
        fibres.albedos = (0..=NODES).map(at).collect();
        fibres
    }

    /// The part of A, of what they would give back, that counts at cosine `c`.
    pub(super) fn kept(&self, c: f64) -> f64 {
        1.0 / between(&self.unbounded, c).max(1.0)
    }

    /// E at cosine `c`.
    pub(super) fn albedo(&self, c: f64) -> f64 {
        let own = self.kept(c);
        self.given_back(c, |other| own.min(self.kept(other)))
    }

    /// E at cosine `c`, between nodes.
    pub(super) fn albedo_near(&self, c: f64) -> f64 {
        between(&self.albedos, c)
    }

    /// The share that comes back of light from cosine `c`, where the lobe counts `part` of the other cosine.
    fn given_back(&self, c: f64, part: impl Fn(f64) -> f64) -> f64 {
        let mut kernel: Kernel<'_> = self.bench.double();
        let o = direction(c, 0.0);
        let [n, m] = POINTS;
        let mut sum = 0.0;
        for k in 0..n {
            let t = (k as f64 + 0.5) / n as f64;
            let part = part(t * t);
            for j in 0..m {
                // Points crowd opposite to the direction, where light goes forward.
                let x = (j as f64 + 0.5) / m as f64;
                let i = direction(t * t, PI * (1.0 - x * x));
                let h = (o + i).normalize().z;
                let once = kernel.sheen_once(self.alpha, DVec3::new(o.z, i.z, h));
                sum += once * part * i.z * 4.0 * t * 2.0 * x * PI;
            }
        }
        sum / (n * m) as f64
    }
}

/// The value at cosine `c` between `nodes`.
#[expect(clippy::cast_possible_truncation, reason = "0 to `NODES`, and the part is cut off")]
fn between(nodes: &[f64], c: f64) -> f64 {
    let at = c.sqrt().clamp(0.0, 1.0) * NODES as f64;
    let node = (at as usize).min(NODES - 1);
    let [low, high] = [nodes[node], nodes[node + 1]];
    low + (high - low) * (at - node as f64)
}
