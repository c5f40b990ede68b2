//! How strongly each emitter lights the scene, for choosing between them.

use lang::scene::Directional;
use pack::abi::LightKind;

use super::light::{Emitter, luminance};
use super::material::MaterialTable;

/// The sky as an emitter; `area`: see `Receivers::sky_area`.
pub(super) fn sky(area: f64) -> Emitter {
    let (kind, facing) = (LightKind::Sky, [0.0; 5]);
    Emitter { kind, primitive: 0, count: 0, material: 0, area, facing }
}

/// Whether a light at infinity is one that is sampled.
pub(super) fn shines(light: &Directional) -> bool {
    luminance(light.radiance) > 0.0
}

/// A light at infinity as an emitter, the `index`th; `area`: see `Receivers::sky_area`. Its area is its power.
pub(super) fn directional(index: usize, light: &Directional, area: f64) -> Emitter {
    let solid_angle = 2.0 * std::f64::consts::PI * light.rim();
    let area = area * solid_angle * luminance(light.radiance);
    let (kind, primitive, facing) = (LightKind::Directional, index as u32, [0.0; 5]);
    Emitter { kind, primitive, count: 0, material: 0, area, facing }
}

/// Power of each emitter, up to a factor. `flux`: the integral of the sky's luminance over all directions.
pub(super) fn powers(
    emitters: &[Emitter],
    materials: &MaterialTable<'_>,
    flux: Option<f64>,
) -> Vec<f64> {
    let power = |emitter: &Emitter| match emitter.kind {
        LightKind::Sky => emitter.area * flux.unwrap_or(0.0),
        LightKind::Directional => emitter.area,
        LightKind::Sphere | LightKind::Rectangle | LightKind::Triangle => {
            emitter.area * materials.glow(emitter.material)
        }
    };
    emitters.iter().map(power).collect()
}
