//! The camera declaration becomes the `Camera` record in the normalised frame; and where the rays of that record go, for
//! the passes of the compiler that trace some.

use std::f64::consts::PI;

use glam::DVec3;
use lang::scene::{self, Projection};
use pack::abi::{self, CameraKind};

use crate::normalize::Normalization;

/// Right-handed frame: `forward` to `to`, `right = forward x up`.
pub(super) fn camera(camera: &scene::Camera, frame: &Normalization) -> abi::Camera {
    let from = DVec3::from(camera.from);
    let forward = (DVec3::from(camera.to) - from).normalize();
    let right = forward.cross(DVec3::from(camera.up)).normalize();
    let up = right.cross(forward);
    let placed = abi::Camera {
        origin: frame.point(camera.from),
        right: right.as_vec3().to_array(),
        up: up.as_vec3().to_array(),
        forward: forward.as_vec3().to_array(),
        focus_distance: frame.length((DVec3::from(camera.to) - from).length()),
        ..abi::Camera::default()
    };
    match &camera.projection {
        Projection::Perspective(lens) => abi::Camera {
            kind: CameraKind::Perspective as u32,
            lens_radius: frame.length(lens.radius),
            half_height: libm::tan(0.5 * lens.fov_vertical) as f32,
            focus_distance: frame.length(lens.focus_distance),
            half_width: libm::tan(0.5 * lens.fov_horizontal) as f32,
            blades: lens.blades.unwrap_or(0),
            blade_rotation: (0.5 * lens.rotation / PI).rem_euclid(1.0) as f32,
            blade_reach: lens.blades.map_or(0.0, blade_reach) as f32,
            ..placed
        },
        Projection::Orthographic { size, .. } => {
            let [width, height] = size.expect("a camera that frames something has been placed");
            abi::Camera {
                kind: CameraKind::Orthographic as u32,
                half_height: frame.length(0.5 * height),
                half_width: frame.length(0.5 * width),
                ..placed
            }
        }
        Projection::Panoramic { fov_horizontal } => abi::Camera {
            kind: CameraKind::Panoramic as u32,
            half_height: 0.25,
            half_width: (0.25 * fov_horizontal / PI) as f32,
            ..placed
        },
    }
}

/// The keys of a camera that moves while its shutter is open, none for one that does not.
pub(super) fn keys(camera: &scene::Camera, frame: &Normalization) -> Vec<abi::CameraKey> {
    let [open, close] = camera.shutter;
    if camera.keys.is_empty() || close <= open {
        return Vec::new();
    }
    let times = std::iter::once(open).chain(scene::bends(&camera.keys, open, close)).chain([close]);
    let mut keys: Vec<abi::CameraKey> = Vec::new();
    for time in times {
        let key = scene::at_time(&camera.keys, time);
        let share = if time >= close { 1.0 } else { ((time - open) / (close - open)) as f32 };
        let focus_distance = match &camera.projection {
            Projection::Perspective(lens) if !camera.follows => frame.length(lens.focus_distance),
            Projection::Perspective(_)
            | Projection::Orthographic { .. }
            | Projection::Panoramic { .. } => 0.0,
        };
        let key = abi::CameraKey {
            origin: frame.point(key.from),
            time: share,
            aim: frame.point(key.to),
            focus_distance,
            up: DVec3::from(camera.up).as_vec3().to_array(),
            ..abi::CameraKey::default()
        };
        // Of keys that are next to each other the later one counts.
        if keys.last().is_some_and(|last| last.time >= key.time) {
            keys.pop();
        }
        keys.push(key);
    }
    let place = |key: &abi::CameraKey| [key.origin, key.aim].map(|p| p.map(f32::to_bits));
    let rests = keys.windows(2).all(|pair| place(&pair[0]) == place(&pair[1]));
    if rests { Vec::new() } else { keys }
}

/// From the middle of a regular polygon with `n` corners, 3 or more, and the area of a disk of radius 1 to its corners:
/// n/2 r^2 sin(2 pi / n) = pi.
fn blade_reach(n: u32) -> f64 {
    let turn = 2.0 * PI / f64::from(n);
    (turn / libm::sin(turn)).sqrt()
}

/// Origin and unit direction of the ray through a place on the film, -1 ..= 1 to the right and up; through the middle of
/// the lens. Normalised frame.
pub(super) fn ray(camera: &abi::Camera, [x, y]: [f64; 2]) -> [DVec3; 2] {
    let of = |v: [f32; 3]| DVec3::from(v.map(f64::from));
    let (x, y) = (x * f64::from(camera.half_width), y * f64::from(camera.half_height));
    let (origin, forward) = (of(camera.origin), of(camera.forward));
    match CameraKind::from_tag(camera.kind) {
        Some(CameraKind::Orthographic) => {
            [origin + of(camera.right) * x + of(camera.up) * y, forward]
        }
        Some(CameraKind::Panoramic) => {
            let [azimuth, elevation] = [x, y].map(|turns| 2.0 * PI * turns);
            let level = of(camera.right) * libm::sin(azimuth) + forward * libm::cos(azimuth);
            let up = of(camera.up) * libm::sin(elevation);
            [origin, (level * libm::cos(elevation) + up).normalize()]
        }
        Some(CameraKind::Perspective) | None => {
            let right = of(camera.right) * x;
            let up = of(camera.up) * y;
            [origin, (forward + right + up).normalize()]
        }
    }
}
