//! The sun of a clear sky becomes a light at infinity.

use std::f64::consts::PI;

use lang::scene::{Directional, Scene, SkyModel};

use crate::atmosphere;

/// The scene with the sun of its sky among its lights, named as the sky and in its group; `None` where it has no sun
/// above the horizon.
#[must_use]
pub fn with_sun(scene: &Scene) -> Option<Scene> {
    let sky = scene.sky.as_ref()?;
    let SkyModel::SunSky(day) = &sky.model else { return None };
    let light = atmosphere::sunlight(day);
    if light.iter().all(|c| *c <= 0.0) {
        return None;
    }
    // As a cone of even radiance around the normal gives it.
    let sine = libm::sin(day.half_angle);
    let sun = Directional {
        name: sky.name.clone(),
        direction: day.sun_direction,
        half_angle: day.half_angle,
        radiance: light.map(|c| c / (PI * sine * sine)),
        visible: sky.visible,
        group: sky.group.clone(),
        links: None,
    };
    let mut scene = scene.clone();
    scene.directional.push(sun);
    Some(scene)
}
