//! All radiance times a power of two: the picture times that power. Which light is chosen, where paths end
//! and what fog hides must not depend on how bright the scene is.

use lang::scene::{MediumModel, Rgb, Scene, SkyModel};
use tests::features::{changed, named};

use crate::RICH;
use crate::compare::{assert_exact, film};

/// The lowest makes 1e-6 of a light, the highest 1e9.
const POWERS: [i32; 3] = [-20, 1, 30];

/// Fields of materials that are radiance, or the factor on a colour that is.
const RADIANCE: [&str; 4] = ["strength", "power", "emission.strength", "depth.color"];

/// Multiplies every radiance of the scene. Colours that come from images have a factor next to them.
fn brighten(scene: &mut Scene, factor: f64) {
    let times = |color: &mut Rgb| *color = color.map(|c| c * factor);
    scene.lights.iter_mut().for_each(|light| times(&mut light.radiance));
    scene.directional.iter_mut().for_each(|light| times(&mut light.radiance));
    for material in &mut scene.materials {
        material.model.numbers_mut(&mut |field, values| {
            if RADIANCE.contains(&field.name) {
                for value in values {
                    *value *= factor;
                }
            }
        });
    }
    for medium in &mut scene.media {
        match &mut medium.model {
            MediumModel::Homogeneous { .. } => {}
            MediumModel::Fog { color, .. } => times(color),
        }
    }
    match scene.sky.as_mut().map(|sky| &mut sky.model) {
        None => {}
        Some(SkyModel::Constant(color)) => times(color),
        Some(SkyModel::Gradient { zenith, middle, horizon, ground, glow, disc, .. }) => {
            [zenith, middle, horizon, ground, glow, disc].into_iter().for_each(times);
        }
        Some(SkyModel::Image { strength, .. }) => *strength *= factor,
        Some(SkyModel::SunSky(day)) => day.strength *= factor,
    }
}

#[test]
fn light_times_a_power_of_two_is_the_picture_times_that_power() {
    for name in RICH {
        let base = film(&changed(named(name), |_| {}));
        for power in POWERS {
            let factor = 2.0_f64.powi(power);
            let bright = film(&changed(named(name), |scene| brighten(scene, factor)));
            assert_exact(&format!("{name}, 2^{power}"), &base, &bright, factor);
        }
    }
}
