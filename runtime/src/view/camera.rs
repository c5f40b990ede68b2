//! The camera of a pack ⇄ a camera as scenes declare it: metres and degrees, world space, where it is and where it looks.

use crate::scene::Scene;
use glam::DVec3;
use pack::abi::{Camera, CameraKind};
use serde::{Deserialize, Serialize};
use std::fmt::Write as _;

/// Widest field of view, degrees, as in scene texts.
const MAX_FOV: f64 = 179.0;
/// Farthest from the scene, of which the radius is between .5 and 1.
const MAX_DISTANCE: f64 = 1e6;

/// A camera of the kind of the pack's.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct View {
    /// The centre of the lens, metres, world space.
    pub from: [f64; 3],
    /// The point in the middle of the image.
    pub to: [f64; 3],
    /// Which way is up in the image; not along the view.
    pub up: [f64; 3],
    /// Horizontal field of view, degrees. Of parallel rays: the angle at which `from` sees the width of the view around
    /// `to`, so that a camera that comes nearer sees less. Of a panorama: nothing, it sees as much as that of the pack.
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
        let half_width = f64::from(camera.half_width);
        let distance = f64::from(camera.focus_distance);
        let distance = match kind_of(camera) {
            // Where the width of the view makes an angle that `fov` may have.
            CameraKind::Orthographic => distance.clamp(half_width / 50.0, half_width * 5e4),
            CameraKind::Panoramic | CameraKind::Perspective => distance,
        };
        let focus = distance / scale;
        let tangent = match kind_of(camera) {
            CameraKind::Orthographic => half_width / distance,
            CameraKind::Panoramic => 1.0,
            CameraKind::Perspective => half_width,
        };
        let degrees = 2.0 * libm::atan(tangent).to_degrees();
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
        let own = scene.pack().camera();
        let has_lens = kind_of(own) == CameraKind::Perspective;
        let tangent = libm::tan(0.5 * self.fov.to_radians());
        let [w, h] = settings.image_size.map(f64::from);
        let [half_width, half_height] = match kind_of(own) {
            CameraKind::Orthographic => {
                let half_width = tangent * (to - from).length() * scale;
                [half_width, half_width * h / w]
            }
            CameraKind::Panoramic => [own.half_width, own.half_height].map(f64::from),
            CameraKind::Perspective => [tangent, tangent * h / w],
        };
        let sound = sound
            && [half_width, half_height].iter().all(|half| (1e-9..MAX_DISTANCE).contains(half));
        let narrow = |v: DVec3| v.as_vec3().to_array();
        #[expect(clippy::cast_possible_truncation, reason = "rounded once, as the compiler does")]
        sound.then(|| Camera {
            origin: narrow(origin),
            lens_radius: if has_lens { radius as f32 } else { 0.0 },
            right: narrow(right),
            half_height: half_height as f32,
            up: narrow(right.cross(forward)),
            focus_distance: focus as f32,
            forward: narrow(forward),
            half_width: half_width as f32,
            ..*own
        })
    }

    /// The declaration, to be pasted into a scene text; `own`: the camera of the pack, whose kind it has.
    #[must_use]
    pub fn text(&self, name: &str, own: &Camera) -> String {
        let kind = kind_of(own);
        let far = self.from.into_iter().chain(self.to).fold(0.0, |far, x| x.abs().max(far));
        let vector = |v: [f64; 3], far: f64| {
            let [x, y, z] = v.map(|x| short_beside(x, far));
            format!("({x}, {y}, {z})")
        };
        let mut text = format!("camera {name}: {} {{\n", kind.stem());
        // Writing to a string cannot fail.
        let _ = writeln!(text, "  from = {}m", vector(self.from, far));
        let _ = writeln!(text, "  to = {}m", vector(self.to, far));
        if DVec3::from(self.up) != DVec3::Y {
            let _ = writeln!(text, "  up = {}", vector(self.up, 1.0));
        }
        let tangent = libm::tan(0.5 * self.fov.to_radians());
        let distance = (DVec3::from(self.to) - DVec3::from(self.from)).length();
        let _ = match kind {
            CameraKind::Perspective => {
                writeln!(text, "  fov.horizontal = {}deg", short(self.fov))
            }
            CameraKind::Orthographic => {
                writeln!(text, "  width = {}m", short(2.0 * tangent * distance))
            }
            CameraKind::Panoramic => {
                writeln!(text, "  fov.horizontal = {}deg", short(720.0 * f64::from(own.half_width)))
            }
        };
        if kind == CameraKind::Perspective && self.aperture > 0.0 {
            let _ = writeln!(text, "  aperture = {}mm", short(1e3 * self.aperture));
            let _ = writeln!(text, "  focus = {}m", short(self.focus));
            if own.blades > 0 {
                let rotation = short(360.0 * f64::from(own.blade_rotation));
                let _ = writeln!(text, "  blades = {}\n  rotation = {rotation}deg", own.blades);
            }
        }
        text + "}\n"
    }
}

/// What kind of camera it is; packs that have been checked hold no others.
pub(super) fn kind_of(camera: &Camera) -> CameraKind {
    CameraKind::from_tag(camera.kind).unwrap_or(CameraKind::Perspective)
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
