//! What scattering models do to energy: never more out than in, the same both ways, and the values that
//! are known in closed form.

#![expect(clippy::float_cmp, reason = "some answers are exact")]

#[path = "scattering/energy.rs"]
mod energy;
#[path = "scattering/facets.rs"]
mod facets;
#[path = "scattering/layers.rs"]
mod layers;
#[path = "scattering/matte.rs"]
mod matte;
#[path = "scattering/pattern.rs"]
mod pattern;
#[path = "scattering/sheet.rs"]
mod sheet;
#[path = "scattering/specular.rs"]
mod specular;
#[path = "scattering/weight.rs"]
mod weight;

use glam::DVec3;
use pack::abi::MaterialKind;
use runtime::kernel::f64 as double;
use tests::kernel::Lobe;
use tests::statistics::grid::{Grid, Shape};

/// Cells that resolve the lobe of `lobe` for light from `wo`.
fn grid(lobe: &Lobe, wo: DVec3) -> Grid {
    let mu = lobe.normal.dot(wo);
    if lobe.kind == MaterialKind::Clearcoat && (1e-3..0.3).contains(&lobe.fuzz) {
        let shape = Shape { ring_scale: f64::from(lobe.fuzz), ..Shape::SPHERE };
        return Grid::new(lobe.mirror(wo), lobe.normal, shape);
    }
    let alpha = f64::from(lobe.roughness * lobe.roughness);
    let microfacets = matches!(lobe.kind, MaterialKind::Principled | MaterialKind::Conductor);
    if !microfacets || !(1e-3..0.3).contains(&alpha) {
        return Grid::new(lobe.normal, wo, Shape::HEMISPHERE);
    }
    let ring_scale = (alpha * mu.max(0.05)).min(1.0);
    let shape = Shape { ring_scale, sector_scale: mu.clamp(0.02, 1.0), ..Shape::SPHERE };
    Grid::new(lobe.mirror(wo), lobe.normal, shape)
}

/// Share of light from `wo` that is reflected, by quadrature in double precision; a mirror's part is added.
fn albedo(kernel: &mut double::Kernel<'_>, lobe: &Lobe, wo: DVec3, fine: usize) -> f64 {
    let s = lobe.double();
    let rough =
        grid(lobe, wo).integrate_above(fine, lobe.normal, |wi| kernel.dispatch_eval(s, wo, wi).f.x);
    let mut sum: f64 = rough.iter().sum();
    let smooth = s.roughness * s.roughness < double::GLOSS_SMOOTH;
    if lobe.kind == MaterialKind::Principled && smooth {
        let p = kernel.principled_at(s, wo);
        sum += kernel.principled_fresnel(p, lobe.normal.dot(wo)).x;
    }
    sum
}
