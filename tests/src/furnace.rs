//! White furnaces: what a surface without absorption gives back of a direction's light, reflected and let through.
//!
//! Every surface stands in light of radiance 1 from everywhere; with nothing lost each direction gives back 1. The share
//! is the mean weight of samples of the kernel's own sampling, so that a wrong density shows as well as a wrong lobe.

use std::fmt::Write as _;

use glam::DVec3;
use pack::abi::{Material, MaterialKind, SamplerKind};
use runtime::kernel::f32 as single;

use crate::kernel::{Bench, Lobe};
use crate::layers::Layers;

/// Cosines of the direction, down to grazing.
pub const COSINES: [f64; 4] = [1.0, 0.5, 0.1, 0.02];

/// A white surface.
#[derive(Clone, Debug)]
pub struct Surface {
    /// What it is.
    pub family: &'static str,
    /// Its parameters.
    pub name: String,
    lobe: Lobe,
    record: Material,
}

impl Surface {
    fn new(family: &'static str, name: String, lobe: Lobe, record: Material) -> Self {
        Self { family, name, lobe, record }
    }

    /// Share of light that comes back from cosine `mu`, by `n` samples.
    #[must_use]
    pub fn share(&self, mu: f64, turn: f64, n: u32) -> f64 {
        let bench = Bench::new().sampler(SamplerKind::Sobol).materials(&[self.record]);
        let mut kernel = bench.single();
        let scatter = self.lobe.single();
        let wo = self.toward(mu, turn).as_vec3();
        let mut sum = 0.0;
        for sample in 0..n {
            let key = single::SampleKey { pixel: 77, sample, bounce: 1, seed: 5 };
            let out = kernel.dispatch_sample(single::Scatter { key, ..scatter }, wo, key);
            sum += f64::from(out.weight.x) * f64::from(out.eta2);
        }
        sum / f64::from(n)
    }

    /// The direction at cosine `mu`, turned by `turn` right angles from the tangent.
    fn toward(&self, mu: f64, turn: f64) -> DVec3 {
        let (n, t) = (self.lobe.normal, self.lobe.tangent());
        let (sin, cos) = (turn * std::f64::consts::FRAC_PI_2).sin_cos();
        (n * mu + (t * cos + n.cross(t) * sin) * (1.0 - mu * mu).max(0.0).sqrt()).normalize()
    }

    /// The largest deviation from 1 over cosines and, where the surface is brushed, azimuths.
    #[must_use]
    pub fn worst(&self, n: u32) -> f64 {
        let turns: &[f64] = if self.lobe.anisotropy > 0.0 { &[0.0, 0.5, 1.0] } else { &[0.0] };
        let all = COSINES.iter().flat_map(|mu| turns.iter().map(|turn| self.share(*mu, *turn, n)));
        all.map(|share| share - 1.0)
            .fold(0.0, |a: f64, b: f64| if b.abs() > a.abs() { b } else { a })
    }
}

const ROUGHNESS: [f32; 7] = [0.03, 0.1, 0.2, 0.3, 0.5, 0.7, 1.0];

/// All surfaces of the grid.
#[must_use]
pub fn surfaces() -> Vec<Surface> {
    let mut all = conductors();
    all.extend(principled());
    all.extend(brushed());
    all.extend(sheens());
    all.extend(dielectrics());
    all.extend(coats());
    all.extend(sheets());
    all.extend(patterns());
    all
}

fn conductors() -> Vec<Surface> {
    let brushed = |r: f32| [0.0, 0.2, 0.5, 0.8, 1.0].map(move |a: f32| (r, a));
    let one = |(r, a): (f32, f32)| {
        let lobe = Lobe::conductor(r, a);
        let family = if a > 0.0 { "conductor, brushed" } else { "conductor" };
        Surface::new(family, format!("roughness {r}, anisotropy {a}"), lobe, lobe.record())
    };
    ROUGHNESS.into_iter().flat_map(brushed).map(one).collect()
}

/// A principled surface with layers, and its family.
fn layered(family: &'static str, lobe: Lobe, layers: Layers) -> Surface {
    let Layers { coat, coat_roughness, transmission, anisotropy, sheen, .. } = layers;
    let mut name =
        format!("roughness {}, metallic {}, index {}", lobe.roughness, lobe.metallic, lobe.ior);
    if coat > 0.0 {
        let _ = write!(name, ", coat {coat} of roughness {coat_roughness}");
    }
    if transmission > 0.0 {
        let _ = write!(name, ", transmission {transmission}");
    }
    if sheen > 0.0 {
        let _ = write!(name, ", sheen {sheen} of roughness {}", layers.sheen_roughness);
    }
    if anisotropy > 0.0 {
        let _ = write!(name, ", anisotropy {anisotropy}");
    }
    Surface::new(family, name, Lobe { anisotropy, ..lobe }, Material::from(layers))
}

/// Principled surfaces under sheen.
fn sheens() -> Vec<Surface> {
    let mut all = Vec::new();
    for roughness in ROUGHNESS {
        for (sheen, sheen_roughness) in
            [(1.0, 0.0), (1.0, 0.1), (1.0, 0.2), (1.0, 0.3), (1.0, 0.5), (0.5, 0.7), (1.0, 1.0)]
        {
            let plain = Layers { sheen, sheen_roughness, ..Layers::PLAIN };
            for ior in [1.05, 1.5, 3.0] {
                let lobe = Lobe { ior, ..Lobe::principled(roughness, 0.0) };
                all.push(layered("principled, sheen", lobe, plain));
                let layers = Layers { transmission: 0.5, ..plain };
                all.push(layered("principled, sheen on a sheet", lobe, layers));
            }
            let metal = Lobe::principled(roughness, 1.0);
            all.push(layered("principled, sheen on metal", metal, plain));
        }
    }
    all
}

/// Principled surfaces that are brushed.
fn brushed() -> Vec<Surface> {
    let mut all = Vec::new();
    for roughness in ROUGHNESS {
        for anisotropy in [0.2, 0.5, 0.8, 1.0] {
            let plain = Layers { anisotropy, ..Layers::PLAIN };
            for ior in [1.05, 1.5, 2.0, 3.0] {
                let lobe = Lobe { ior, ..Lobe::principled(roughness, 0.0) };
                all.push(layered("principled, brushed", lobe, plain));
                let layers = Layers { transmission: 0.5, ..plain };
                all.push(layered("principled, brushed", lobe, layers));
            }
            for metallic in [0.5, 1.0] {
                let lobe = Lobe::principled(roughness, metallic);
                all.push(layered("principled, brushed", lobe, plain));
            }
            for (metallic, coat_roughness) in [(0.0, 0.0), (1.0, 0.0), (0.0, 0.3), (1.0, 0.3)] {
                let layers = Layers { coat: 1.0, coat_roughness, ..plain };
                let lobe = Lobe::principled(roughness, metallic);
                all.push(layered("principled, brushed under a coat", lobe, layers));
            }
        }
    }
    all
}

fn principled() -> Vec<Surface> {
    let mut all = Vec::new();
    for roughness in ROUGHNESS {
        for ior in [1.05, 1.5, 2.0, 3.0] {
            let lobe = Lobe { ior, ..Lobe::principled(roughness, 0.0) };
            all.push(layered("principled, dielectric", lobe, Layers::PLAIN));
            for transmission in [0.5, 1.0] {
                let layers = Layers { transmission, ..Layers::PLAIN };
                all.push(layered("principled, transmission", lobe, layers));
            }
        }
        all.push(layered("principled, metal", Lobe::principled(roughness, 1.0), Layers::PLAIN));
        all.push(layered("principled, mix", Lobe::principled(roughness, 0.5), Layers::PLAIN));
        for (coat, coat_roughness) in [(1.0, 0.0), (1.0, 0.3), (1.0, 0.7), (1.0, 1.0), (0.5, 0.1)] {
            for (metallic, transmission) in [(0.0, 0.0), (1.0, 0.0), (0.5, 0.0), (0.0, 1.0)] {
                let layers = Layers { coat, coat_roughness, transmission, ..Layers::PLAIN };
                all.push(layered(
                    "principled, coat",
                    Lobe::principled(roughness, metallic),
                    layers,
                ));
            }
        }
    }
    all
}

fn dielectrics() -> Vec<Surface> {
    let mut all = Vec::new();
    for roughness in ROUGHNESS {
        for ior in [1.05, 1.2, 1.5, 2.0, 3.0] {
            for (front, side) in [(true, "outside"), (false, "inside")] {
                let lobe = Lobe::rough_dielectric(roughness, ior, front);
                let name = format!("roughness {roughness}, index {ior}, {side}");
                let family = if front { "dielectric, outside" } else { "dielectric, inside" };
                all.push(Surface::new(family, name, lobe, lobe.record()));
            }
        }
    }
    all
}

fn coats() -> Vec<Surface> {
    let mut all = Vec::new();
    for fuzz in [0.0, 0.03, 0.1, 0.3, 0.6, 1.0] {
        for ior in [1.05, 1.5, 3.0] {
            let lobe = Lobe { ior, ..Lobe::clearcoat(fuzz) };
            let name = format!("fuzz {fuzz}, index {ior}");
            all.push(Surface::new("clearcoat", name, lobe, lobe.record()));
        }
    }
    all
}

fn sheets() -> Vec<Surface> {
    let mut all = Vec::new();
    for g in [-0.9, -0.3, 0.3, 0.6, 0.8, 0.95, 0.99] {
        for (weight, forward) in [(0.4, 0.5), (1.0, 1.0)] {
            let lobe = Lobe { weight, ..Lobe::new(MaterialKind::Leaf) };
            let record = Material { weight, forward, g, ..lobe.record() };
            let name = format!("translucency {weight}, forward {forward}, g {g}");
            all.push(Surface::new("leaf", name, lobe, record));
        }
    }
    for (weight, g, fuzz) in [(0.2, 0.7, 0.6), (0.5, 0.3, 1.0)] {
        for roughness in [0.03, 0.3, 1.0] {
            for ior in [1.05, 1.4, 3.0] {
                let lobe = Lobe { fuzz, roughness, ior, weight, ..Lobe::new(MaterialKind::Petal) };
                let thickness = 1.0;
                let record = Material {
                    g,
                    sigma_s: 0.8,
                    thickness_edge: thickness,
                    thickness_middle: thickness,
                    ..lobe.record()
                };
                let name = format!("fuzz {fuzz} x {weight}, wax {roughness}, index {ior}");
                all.push(Surface::new("petal", name, lobe, record));
            }
        }
    }
    all
}

fn patterns() -> Vec<Surface> {
    let mut all = Vec::new();
    for gloss in [0.3, 1.0] {
        for roughness in ROUGHNESS {
            let lobe = Lobe { roughness, gloss, weight: 0.3, ..Lobe::new(MaterialKind::Fabric) };
            all.push(Surface::new(
                "fabric",
                format!("gloss {gloss}, roughness {roughness}"),
                lobe,
                lobe.record(),
            ));
            let lobe = Lobe { roughness, gloss, ..Lobe::new(MaterialKind::Stone) };
            all.push(Surface::new(
                "stone",
                format!("gloss {gloss}, roughness {roughness}"),
                lobe,
                lobe.record(),
            ));
            for anisotropy in [0.5, 1.0] {
                let lobe = Lobe { roughness, anisotropy, gloss, ..Lobe::new(MaterialKind::Wood) };
                let name = format!("gloss {gloss}, roughness {roughness}, anisotropy {anisotropy}");
                all.push(Surface::new("wood", name, lobe, lobe.record()));
            }
        }
    }
    all
}
