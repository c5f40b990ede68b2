//! The camera declaration becomes the `Camera` record in the normalised frame.

use lang::scene;
use pack::abi;

use crate::normalize::Normalization;

/// Right-handed frame: `forward` to `to`, `right = forward x up`.
pub(super) fn camera(camera: &scene::Camera, frame: &Normalization) -> abi::Camera {
    let from = glam::DVec3::from(camera.from);
    let forward = (glam::DVec3::from(camera.to) - from).normalize();
    let right = forward.cross(glam::DVec3::from(camera.up)).normalize();
    let up = right.cross(forward);
    abi::Camera {
        origin: frame.point(camera.from),
        lens_radius: frame.length(camera.lens_radius),
        right: right.as_vec3().to_array(),
        tan_half_height: libm::tan(0.5 * camera.fov_vertical) as f32,
        up: up.as_vec3().to_array(),
        focus_distance: frame.length(camera.focus_distance),
        forward: forward.as_vec3().to_array(),
        tan_half_width: libm::tan(0.5 * camera.fov_horizontal) as f32,
    }
}
