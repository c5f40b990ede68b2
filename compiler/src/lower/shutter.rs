//! The shutter of the camera: when things are where, and how far they come.

use glam::DVec3;
use lang::scene::Camera;

/// When the shutter opens and closes, seconds after the moment at which things are where the scene says.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shutter {
    open: f64,
    close: f64,
}

impl Shutter {
    pub(super) fn of(camera: &Camera) -> Self {
        let [open, close] = camera.shutter;
        Self { open, close }
    }

    /// How far a thing has come when the shutter opens, metres; `velocity` in metres per second.
    pub(super) fn lead(self, velocity: [f64; 3]) -> DVec3 {
        DVec3::from(velocity) * self.open
    }

    /// How far a thing comes while the shutter is open, metres.
    pub(super) fn travel(self, velocity: [f64; 3]) -> DVec3 {
        DVec3::from(velocity) * (self.close - self.open)
    }
}
