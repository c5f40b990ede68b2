//! The camera of a pack ⇄ a camera as scenes declare it: metres and degrees, world space, where it is and where it looks.

use crate::scene::Scene;
use glam::DVec3;
use pack::abi::Camera;
use serde::{Deserialize, Serialize};
use std::fmt::Write as _;

/// Widest field of view, degrees, as in scene texts.
const MAX_FOV: f64 = 179.0;
/// Farthest from the scene, of which the radius is between .5 and 1.
const MAX_DISTANCE: f64 = 1e6;

/// A thin-lens camera.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct View {
    /// The centre of the lens, metres, world space.
    pub from: [f64; 3],
    /// The point in the middle of the image.
    pub to: [f64; 3],
    /// Which way is up in the image; not along the view.
    pub up: [f64; 3],
    /// Horizontal field of view, degrees.
    pub fov: f64,
    /// Distance at which things are sharp, metres.
    pub focus: f64,
    /// Diameter of the lens, metres; 0 is a pinhole.
    pub aperture: f64,
}

impl View {
    /// The camera of the pack. It looks at what it focuses on: what else `to` was the pack does not tell.
    #[must_use]
    pub fn of(scene: &Scene) -> Self {
        let camera = scene.pack().camera();
        let (scale, center) = (scene.settings().scale(), DVec3::from(scene.settings().center()));
        let wide = |v: [f32; 3]| DVec3::from(v.map(f64::from));
        let from = wide(camera.origin) / scale + center;
        let focus = f64::from(camera.focus_distance) / scale;
        let degrees = 2.0 * libm::atan(f64::from(camera.tan_half_width)).to_degrees();
        Self {
            from: from.to_array(),
            to: (from + wide(camera.forward) * focus).to_array(),
            up: upright(wide(camera.right), wide(camera.up)).to_array(),
            fov: degrees,
            focus,
            aperture: 2.0 * f64::from(camera.lens_radius) / scale,
        }
    }

    /// The record for a scene; `None` when this is no camera.
    #[must_use]
    pub fn camera(&self, scene: &Scene) -> Option<Camera> {
        let settings = scene.settings();
        let (scale, center) = (settings.scale(), DVec3::from(settings.center()));
        let [from, to, up] = [self.from, self.to, self.up].map(DVec3::from);
        let forward = (to - from).try_normalize()?;
        let right = forward.cross(up.try_normalize()?);
        let right = if right.length() > 1e-6 { right.normalize() } else { return None };
        let origin = (from - center) * scale;
        let [focus, radius] = [self.focus * scale, 0.5 * self.aperture * scale];
        let sound = origin.is_finite()
            && origin.length() < MAX_DISTANCE
            && (1e-7..MAX_DISTANCE).contains(&focus)
            && (0.0..MAX_DISTANCE).contains(&radius)
            && self.fov > 1e-3
            && self.fov <= MAX_FOV;
        let tan_half_width = libm::tan(0.5 * self.fov.to_radians());
        let [w, h] = settings.image_size.map(f64::from);
        let narrow = |v: DVec3| v.as_vec3().to_array();
        #[expect(clippy::cast_possible_truncation, reason = "rounded once, as the compiler does")]
        sound.then(|| Camera {
            origin: narrow(origin),
            lens_radius: radius as f32,
            right: narrow(right),
            tan_half_height: (tan_half_width * h / w) as f32,
            up: narrow(right.cross(forward)),
            focus_distance: focus as f32,
            forward: narrow(forward),
            tan_half_width: tan_half_width as f32,
        })
    }

    /// The declaration, to be pasted into a scene text.
    #[must_use]
    pub fn text(&self, name: &str) -> String {
        let far = self.from.into_iter().chain(self.to).fold(0.0, |far, x| x.abs().max(far));
        let vector = |v: [f64; 3], far: f64| {
            let [x, y, z] = v.map(|x| short_beside(x, far));
            format!("({x}, {y}, {z})")
        };
        let mut text = format!("camera {name}: perspective {{\n");
        // Writing to a string cannot fail.
        let _ = writeln!(text, "  from = {}m", vector(self.from, far));
        let _ = writeln!(text, "  to = {}m", vector(self.to, far));
        if DVec3::from(self.up) != DVec3::Y {
            let _ = writeln!(text, "  up = {}", vector(self.up, 1.0));
        }
        let _ = writeln!(text, "  fov.horizontal = {}deg", short(self.fov));
        if self.aperture > 0.0 {
            let _ = writeln!(text, "  aperture = {}mm", short(1e3 * self.aperture));
            let _ = writeln!(text, "  focus = {}m", short(self.focus));
        }
        text + "}\n"
    }
}

/// The vertical of the world where the image stands upright, otherwise the top of the image: turning the camera then
/// keeps the horizon level.
fn upright(right: DVec3, up: DVec3) -> DVec3 {
    let axes = [DVec3::Y, DVec3::Z, DVec3::X];
    let level = axes.into_iter().find(|axis| right.dot(*axis).abs() < 1e-5 && up.dot(*axis) != 0.0);
    level.map_or(up, |axis| axis * up.dot(axis).signum())
}

/// Six significant digits, which is what the records hold, without an exponent.
fn short(x: f64) -> String {
    let rounded: f64 = format!("{x:.5e}").parse().unwrap_or(x);
    // Without the sign of `-0`.
    (rounded + 0.0).to_string()
}

/// The same for a coordinate beside others as large as `far`: what is a millionth of that is rounding.
fn short_beside(x: f64, far: f64) -> String {
    if x.abs() < 1e-6 * far { "0".to_owned() } else { short(x) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short() {
        for (x, text) in [(1.0 / 3.0, "0.333333"), (-0.0, "0"), (1234.5678, "1234.57"), (2.0, "2")]
        {
            assert_eq!(short(x), text);
        }
        assert_eq!([short_beside(-5e-7, 9.0), short_beside(-5e-7, 1e-3)], ["0", "-0.0000005"]);
    }

    #[test]
    fn a_level_camera_stays_level_and_a_tilted_one_tilted() {
        assert_eq!(upright(DVec3::X, DVec3::new(0.0, 0.8, -0.6)), DVec3::Y);
        assert_eq!(upright(-DVec3::X, DVec3::new(0.0, -1.0, 0.0)), -DVec3::Y);
        let tilted = DVec3::new(0.3, 0.9, 0.1).normalize();
        let right = tilted.cross(DVec3::new(0.2, 0.1, 0.9)).normalize();
        assert_eq!(upright(right, tilted), tilted);
    }
}
