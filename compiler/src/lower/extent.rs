//! Boxes of what each thing brings into the world, metres.
//!
//! From them follow the frame of the scene and the ball around what receives light.

use glam::DVec3;
use serde::{Deserialize, Serialize};

use crate::normalize::Normalization;
use crate::stage::KeyOf;

/// Lower and upper corner; the wrong way round where there is nothing.
type Corners = [[f64; 3]; 2];

const NOTHING: Corners = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];

/// What one thing brings.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Extent {
    /// All of it; points that are not finite left out.
    all: Corners,
    /// What does not emit.
    dark: Corners,
}

impl Extent {
    pub(super) const NOTHING: Self = Self { all: NOTHING, dark: NOTHING };

    /// All of it; `None` where there is nothing.
    pub(super) fn corners(&self) -> Option<[DVec3; 2]> {
        (self.all[0][0] <= self.all[1][0]).then(|| self.all.map(DVec3::from))
    }

    /// Both together.
    pub(super) fn union(self, other: Self) -> Self {
        Self { all: union(self.all, other.all), dark: union(self.dark, other.dark) }
    }

    /// Adds a point, of something that gives light if it `glows`.
    pub(super) fn add(&mut self, p: DVec3, glows: bool) {
        // Zeros of either sign are one: the result does not depend on the order of the points.
        let p = (p + DVec3::ZERO).to_array();
        if p.iter().all(|x| x.is_finite()) {
            grow(&mut self.all, p);
        }
        if !glows {
            grow(&mut self.dark, p);
        }
    }
}

fn grow([lo, hi]: &mut Corners, p: [f64; 3]) {
    for k in 0..3 {
        (lo[k], hi[k]) = (lo[k].min(p[k]), hi[k].max(p[k]));
    }
}

fn union([lo, hi]: Corners, [a, b]: Corners) -> Corners {
    [[0, 1, 2].map(|k| lo[k].min(a[k])), [0, 1, 2].map(|k| hi[k].max(b[k]))]
}

/// The frame of all things, and of the places where moving ones end.
pub(super) fn frame(extents: &[Extent], ends: Vec<[f64; 3]>) -> Normalization {
    let [lo, hi] = extents.iter().map(|extent| extent.all).fold(NOTHING, union);
    if lo[0] > hi[0] {
        return Normalization::of_points(ends);
    }
    Normalization::of_points([lo, hi].into_iter().chain(ends))
}

/// The ball around what does not emit, or around everything if all does.
///
/// An emitter counts by the power that comes into this ball: one in the ball gives it all its power, one far away
/// the share that the ball takes of the directions around it; the sky gives it its flux times the ball's disc. All
/// are in units of watts / pi. Shares are estimates: they are wrong by up to a factor of two for lights near the edge
/// or with a front and a back, which costs noise only.
#[derive(Clone, Copy, Debug)]
pub(super) struct Receivers(Option<([f64; 3], f64)>);

impl Receivers {
    pub(super) fn of(extents: &[Extent]) -> Self {
        let all = |of: fn(&Extent) -> Corners| extents.iter().map(of).fold(NOTHING, union);
        let dark = all(|extent| extent.dark);
        let [lo, hi] = if dark == NOTHING { all(|extent| extent.all) } else { dark };
        let [lo, hi] = [DVec3::from(lo), DVec3::from(hi)];
        let radius = 0.5 * (hi - lo).length();
        let sound = radius > 0.0 && radius.is_finite();
        Self(sound.then(|| ((0.5 * (lo + hi)).to_array(), radius)))
    }

    /// The area of an emitter, less the share that leaves the scene.
    pub(super) fn weigh(self, area: f64, middle: DVec3) -> f64 {
        let Some((center, radius)) = self.0 else { return area };
        let distance = (middle - DVec3::from(center)).length();
        if distance > radius {
            let ratio = radius / distance;
            let square = ratio * ratio;
            // 1 - sqrt(1 - x), without the cancellation.
            return area * (square / (1.0 + (1.0 - square).sqrt()));
        }
        area
    }

    /// What is the area of the sky in these units; `None` in a scene without size.
    pub(super) fn sky_area(self) -> Option<f64> {
        self.0.map(|(_, radius)| radius * radius)
    }

    /// Adds all of it.
    pub(super) fn read(self, key: &mut KeyOf) {
        let [x, y, z] = self.0.map_or([0.0; 3], |ball| ball.0);
        key.floats(&[x, y, z, self.0.map_or(-1.0, |ball| ball.1)]);
    }
}
