//! Where light comes from.

use super::common::{Name, Rgb};
use super::links::LightLinks;

/// A sphere light.
#[derive(Clone, Debug, PartialEq)]
pub struct Light {
    /// Declared name.
    pub name: Name,
    /// Centre at the moment 0, world frame, metres.
    pub center: [f64; 3],
    /// World frame, metres per second.
    pub velocity: [f64; 3],
    /// Radius, metres, > 0.
    pub radius: f64,
    /// Radiance, W/(m2 sr) up to the scene's own scale.
    pub radiance: Rgb,
    /// What colours part of its light.
    pub tint: Option<Tint>,
    /// The cone into which it shines; all around without.
    pub beam: Option<Beam>,
    /// How bright it is in each direction; the same in all without.
    pub profile: Option<Profile>,
    /// The camera sees it.
    pub visible: bool,
    /// Its light group, if it names one.
    pub group: Option<String>,
    /// What it lights; `None`: everything.
    pub links: Option<LightLinks>,
}

/// A light at infinity.
#[derive(Clone, Debug, PartialEq)]
pub struct Directional {
    /// Declared name.
    pub name: Name,
    /// Unit vector towards the middle of the light, world frame.
    pub direction: [f64; 3],
    /// Half the angle that it fills, radians, > 0.
    pub half_angle: f64,
    /// Radiance, the same everywhere in its cone, W/(m2 sr) up to the scene's own scale.
    pub radiance: Rgb,
    /// The camera sees it.
    pub visible: bool,
    /// Its light group, if it names one.
    pub group: Option<String>,
    /// What it lights; `None`: everything.
    pub links: Option<LightLinks>,
}

impl Directional {
    /// 1 less the cosine of `half_angle`, without the cancellation.
    #[must_use]
    pub fn rim(&self) -> f64 {
        let sine = libm::sin(0.5 * self.half_angle);
        2.0 * sine * sine
    }
}

/// A cone of light. Between the angles the light falls off smoothly.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Beam {
    /// Unit vector along its middle, world frame.
    pub direction: [f64; 3],
    /// Cosine of the angle with the middle up to which all of the light goes.
    pub inner: f64,
    /// Cosine of the angle beyond which nothing does; 0 .. inner.
    pub outer: f64,
}

impl Beam {
    /// Its light over that of a light that shines all around as its middle does.
    #[must_use]
    pub fn share(&self) -> f64 {
        // Integral of the smooth step over the sphere, divided by 4 pi.
        0.5 * (1.0 - 0.5 * (self.inner + self.outer))
    }
}

/// Brightness by direction: an image whose rows are angles from the beam, 0 to 180 degrees, and whose columns turn around
/// it, counter-clockwise seen from behind the lamp.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Profile {
    /// Index into `Scene::textures`.
    pub texture: usize,
    /// Unit vector along the beam, world frame.
    pub direction: [f64; 3],
    /// Unit vector across it, where the first column lies.
    pub first: [f64; 3],
}

/// A factor on the light of a sphere light by the direction from which it comes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tint {
    /// The factor.
    pub color: Rgb,
    /// Largest angle between a tinted ray towards the light and `direction`, radians, 0 .. pi.
    pub angle: f64,
    /// Unit vector towards the light, world frame.
    pub direction: [f64; 3],
}
