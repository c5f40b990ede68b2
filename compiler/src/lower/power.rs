//! How strongly each emitter lights the scene, for choosing between them.

use pack::abi::LightKind;

use super::light::Emitter;
use super::material::MaterialTable;

/// The sky as an emitter; `area`: see `Receivers::sky_area`.
pub(super) fn sky(area: f64) -> Emitter {
    let (kind, facing) = (LightKind::Sky, [0.0; 5]);
    Emitter { kind, primitive: 0, count: 0, material: 0, area, facing }
}

/// Power of each emitter, up to a factor. `flux`: the integral of the sky's luminance over all directions.
pub(super) fn powers(
    emitters: &[Emitter],
    materials: &MaterialTable<'_>,
    flux: Option<f64>,
) -> Vec<f64> {
    let power = |emitter: &Emitter| match emitter.kind {
        LightKind::Sky => emitter.area * flux.unwrap_or(0.0),
        LightKind::Sphere | LightKind::Rectangle | LightKind::Triangle => {
            emitter.area * materials.glow(emitter.material)
        }
    };
    emitters.iter().map(power).collect()
}
