//! What a perspective camera looks through: what a declaration says of it becomes angles and lengths.

use crate::schema;
use crate::units::{self, Dim};

/// What a perspective camera looks through.
#[derive(Clone, Debug, PartialEq)]
pub struct Lens {
    /// Horizontal field of view at the film's aspect ratio, radians.
    pub fov_horizontal: f64,
    /// Vertical field of view at the film's aspect ratio, radians.
    pub fov_vertical: f64,
    /// Its radius, metres; 0 is a pinhole.
    pub radius: f64,
    /// Blades of the aperture, 3 ..= 16; `None`: its opening is round.
    pub blades: Option<u32>,
    /// By how much they are turned, clockwise in the image, from a corner at the top; radians.
    pub rotation: f64,
    /// Distance to the plane of focus, metres, > 0.
    pub focus_distance: f64,
}

/// What a declaration says of a lens.
#[derive(Clone, Debug, PartialEq)]
pub struct LensSpec {
    /// Width of the sensor, metres.
    pub sensor: f64,
    /// How much it sees.
    pub view: FieldOfView,
    /// Its opening.
    pub opening: Opening,
    /// As in `Lens`.
    pub blades: Option<u32>,
    /// As in `Lens`.
    pub rotation: f64,
    /// As in `Lens`; `None`: what is in the middle of the image is sharp.
    pub focus_distance: Option<f64>,
}

/// How much a lens sees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FieldOfView {
    /// Focal length, metres.
    FocalLength(f64),
    /// Angle from the left to the right edge of the image, radians.
    Horizontal(f64),
    /// Angle from the lower to the upper edge, radians.
    Vertical(f64),
}

/// How wide a lens is open.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Opening {
    /// Its diameter, metres; 0 is a pinhole.
    Diameter(f64),
    /// The focal length over it.
    FStop(f64),
}

impl Lens {
    /// What it sees, if that cannot be drawn: `0deg across and 1e-9deg up`.
    #[must_use]
    pub fn beyond_drawing(&self) -> Option<String> {
        let numbers = [self.fov_horizontal, self.fov_vertical, self.radius, self.focus_distance];
        let flat = std::f64::consts::PI - 1e-3;
        let sound =
            numbers.iter().all(|v| v.is_finite() && *v >= 0.0 && *v < schema::MAX_MAGNITUDE);
        let angles = [self.fov_horizontal, self.fov_vertical];
        let drawn =
            sound && angles.iter().all(|v| *v > 1e-9 && *v < flat) && self.focus_distance > 0.0;
        let [across, up] = angles.map(|angle| units::show(angle, Dim::ANGLE));
        (!drawn).then(|| format!("{across} across and {up} up"))
    }
}

impl LensSpec {
    /// The lens; `aspect`: height over width of the film; `distance` of what is in the middle of the image, metres.
    #[must_use]
    pub fn lens(&self, aspect: f64, distance: f64) -> Lens {
        let (across, up) = match self.view {
            FieldOfView::Horizontal(across) => (across, across_other(across, aspect)),
            FieldOfView::Vertical(up) => (across_other(up, 1.0 / aspect), up),
            FieldOfView::FocalLength(length) => {
                let across = 2.0 * libm::atan(0.5 * self.sensor / length);
                (across, across_other(across, aspect))
            }
        };
        let focal_length = 0.5 * self.sensor / libm::tan(0.5 * across);
        let opening = match self.opening {
            Opening::Diameter(opening) => opening,
            Opening::FStop(f_stop) => focal_length / f_stop,
        };
        Lens {
            fov_horizontal: across,
            fov_vertical: up,
            radius: 0.5 * opening,
            blades: self.blades,
            rotation: self.rotation,
            focus_distance: self.focus_distance.unwrap_or(distance),
        }
    }
}

/// The angle across the other side of an image, which is `ratio` times as long as the one of this angle.
pub(crate) fn across_other(angle: f64, ratio: f64) -> f64 {
    2.0 * libm::atan(libm::tan(0.5 * angle) * ratio)
}
