//! How strongly each emitter lights the scene, for choosing between them.
//!
//! What counts is the power that comes into the ball around everything that can receive light. An emitter in
//! the ball gives it all its power, one far away the share that the ball takes of the directions around it; the
//! sky gives it its flux times the ball's disc. All are in units of watts / pi. Shares are estimates: they are
//! wrong by up to a factor of two for lights near the edge or with a front and a back, which costs noise only.

use glam::DVec3;
use pack::abi::LightKind;

use super::geometry::Placement;
use super::light::Emitter;
use super::material::MaterialTable;

/// Weighs the areas of the emitters of `placement`; `ball`: centre and radius of the one around everything that
/// receives light. Returns what is the area of the sky in these units; `None` in a scene without size.
pub(super) fn weigh(placement: &mut Placement, ball: Option<([f64; 3], f64)>) -> Option<f64> {
    let (center, radius) = ball?;
    let mut emitters = std::mem::take(&mut placement.emitters);
    for emitter in &mut emitters {
        let distance = (middle(placement, emitter) - DVec3::from(center)).length();
        if distance > radius {
            let ratio = radius / distance;
            let square = ratio * ratio;
            // 1 - sqrt(1 - x), without the cancellation.
            emitter.area *= square / (1.0 + (1.0 - square).sqrt());
        }
    }
    placement.emitters = emitters;
    Some(radius * radius)
}

/// The sky as an emitter; `area`: see [`weigh`].
pub(super) fn sky(area: f64) -> Emitter {
    let (kind, tint) = (LightKind::Sky, [0.0; 4]);
    Emitter { kind, primitive: 0, count: 0, material: 0, area, tint }
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

fn middle(placement: &Placement, emitter: &Emitter) -> DVec3 {
    let primitive = emitter.primitive as usize;
    match emitter.kind {
        LightKind::Sphere => placement.spheres[primitive].0,
        LightKind::Triangle => placement.corners[primitive].iter().sum::<DVec3>() / 3.0,
        // Opposite corners.
        LightKind::Rectangle => {
            0.5 * (placement.corners[primitive][0] + placement.corners[primitive][2])
        }
        LightKind::Sky => DVec3::ZERO,
    }
}
