//! Boxes of what each thing brings into the world, metres.
//!
//! From them follow the frame of the scene and the ball around what receives light. They are kept with a pack: where
//! a thing is moved, the boxes of all others need not be looked for again.

use glam::DVec3;
use pack::abi::LightKind;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::geometry::{Ends, Placement};
use crate::normalize::Normalization;

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
    const NOTHING: Self = Self { all: NOTHING, dark: NOTHING };

    fn add(&mut self, p: DVec3, glows: bool) {
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

/// Of each thing of a placement whose triangles are not normalised yet.
pub(super) fn extents(placement: &Placement) -> Vec<Extent> {
    let spans: Vec<(Ends, Ends)> = placement.spans().collect();
    let mut extents: Vec<Extent> =
        spans.into_par_iter().map(|span| extent(placement, span)).collect();
    for placed in &placement.placed {
        for corner in placed.bounds {
            extents[placed.object as usize].add(corner, false);
        }
    }
    extents
}

fn extent(placement: &Placement, (from, to): (Ends, Ends)) -> Extent {
    let mut extent = Extent::NOTHING;
    let emitters = &placement.emitters[from.emitters as usize..to.emitters as usize];
    let mut triangles = vec![false; (to.triangles - from.triangles) as usize];
    let sphere_glows = emitters.iter().any(|emitter| emitter.kind == LightKind::Sphere);
    for emitter in emitters.iter().filter(|emitter| emitter.kind != LightKind::Sphere) {
        let first = (emitter.primitive - from.triangles) as usize;
        triangles[first..][..emitter.count as usize].fill(true);
    }
    let corners = &placement.corners[from.triangles as usize..to.triangles as usize];
    for (corners, glows) in corners.iter().zip(triangles) {
        for p in corners {
            extent.add(*p, glows);
        }
    }
    for (center, radius) in &placement.spheres[from.spheres as usize..to.spheres as usize] {
        extent.add(*center - *radius, sphere_glows);
        extent.add(*center + *radius, sphere_glows);
    }
    extent
}

/// The frame of all things, and of the places where moving ones end.
pub(super) fn frame(extents: &[Extent], ends: Vec<[f64; 3]>) -> Normalization {
    let [lo, hi] = extents.iter().map(|extent| extent.all).fold(NOTHING, union);
    if lo[0] > hi[0] {
        return Normalization::of_points(ends);
    }
    Normalization::of_points([lo, hi].into_iter().chain(ends))
}

/// Centre and radius of the ball around what does not emit, or around everything if all does; `None` in a scene
/// without size.
pub(super) fn receivers(extents: &[Extent]) -> Option<([f64; 3], f64)> {
    let all = |of: fn(&Extent) -> Corners| extents.iter().map(of).fold(NOTHING, union);
    let dark = all(|extent| extent.dark);
    let [lo, hi] = if dark == NOTHING { all(|extent| extent.all) } else { dark };
    let [lo, hi] = [DVec3::from(lo), DVec3::from(hi)];
    let radius = 0.5 * (hi - lo).length();
    (radius > 0.0 && radius.is_finite()).then(|| ((0.5 * (lo + hi)).to_array(), radius))
}
