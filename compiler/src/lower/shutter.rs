//! The shutter of the camera: when things are where, and how they move.

use std::sync::Arc;

use glam::{DMat3, DQuat, DVec3};
use lang::scene::{Camera, Instance, Motion, MotionKey, at_time, bends};

use crate::bvh::{Path, Piece, about};

/// When the shutter opens and closes, seconds after the moment at which things are where the scene says.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shutter {
    open: f64,
    close: f64,
}

/// Where a thing turns about several axes at once, each piece of its way is one axis and so many radians at most.
const STEP: f64 = std::f64::consts::PI / 36.0;
/// At most so many pieces between two keys.
const MAX_STEPS: f64 = 1024.0;

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

    /// `world_from_object` when the shutter opens: its linear part, and the translation.
    pub(super) fn pose(self, instance: &Instance) -> (DMat3, DVec3) {
        let m = instance.world_from_object;
        let column = |k: usize| DVec3::new(m[0][k], m[1][k], m[2][k]);
        let linear = DMat3::from_cols(column(0), column(1), column(2));
        let (at, lead) = (column(3), self.lead(instance.velocity));
        let Some(motion) = &instance.motion else { return (linear, at + lead) };
        let [then, now] = [at_time(&motion.keys, 0.0), at_time(&motion.keys, self.open)];
        let offset = at - DVec3::from(then.at);
        let to = DVec3::from(now.at) + lead;
        if is_turned(&then, &now).is_empty() {
            return (linear, to + offset);
        }
        let turn = DMat3::from_quat(turned(motion, &now) * turned(motion, &then).inverse());
        (turn * linear, to + turn * offset)
    }

    /// How far a thing comes on a straight line, metres; or its way, if that is more than a line.
    pub(super) fn way(self, instance: &Instance) -> (DVec3, Option<Arc<Path>>) {
        let straight = self.travel(instance.velocity);
        let Some(motion) = instance.motion.as_ref().filter(|_| self.close > self.open) else {
            return (straight, None);
        };
        let pieces = self.pieces(motion, instance.velocity);
        match pieces.as_slice() {
            [] => (DVec3::ZERO, None),
            [one] if one.angle.abs() <= 0.0 => (one.travel, None),
            _ => {
                let now = at_time(&motion.keys, self.open);
                let pivot = DVec3::from(now.at) + self.lead(instance.velocity);
                (DVec3::ZERO, Some(Arc::new(Path { pivot, pieces })))
            }
        }
    }

    /// The pieces of a way, none if it leads nowhere.
    fn pieces(self, motion: &Motion, velocity: [f64; 3]) -> Vec<Piece> {
        let keys = &motion.keys;
        let mut times = vec![self.open];
        times.extend(bends(keys, self.open, self.close));
        times.push(self.close);
        let open = at_time(keys, self.open);
        let start = Opening { at: DVec3::from(open.at), back: turned(motion, &open).inverse() };
        let mut pieces = Vec::new();
        let mut from = 0.0;
        for pair in times.windows(2) {
            let [a, b] = [pair[0], pair[1]].map(|time| at_time(keys, time));
            let (n, axes) = (steps(&a, &b), is_turned(&a, &b));
            let mut k = 0.0;
            while k < n {
                let part = |u: f64| at_time(keys, a.time + (b.time - a.time) * u / n);
                let ends = [k, k + 1.0].map(|u| {
                    if u <= 0.0 {
                        a
                    } else if u >= n {
                        b
                    } else {
                        part(u)
                    }
                });
                let to = self.share(pair[0] + (pair[1] - pair[0]) * (k + 1.0) / n);
                let (axis, angle) = turn_between(motion, &ends, &axes);
                let [shift, end] = ends.map(|key| DVec3::from(key.at) - start.at);
                let drift = |time: f32| self.travel(velocity) * f64::from(time);
                let turn = turned(motion, &ends[0]) * start.back;
                let shift = shift + drift(from);
                let travel = end + drift(to) - shift;
                if to > from {
                    pieces.push(Piece { times: [from, to], shift, travel, axis, angle, turn });
                    from = to;
                }
                k += 1.0;
            }
        }
        let rests = |p: &Piece| p.travel == DVec3::ZERO && p.angle.abs() <= 0.0;
        if pieces.iter().all(rests) { Vec::new() } else { pieces }
    }

    /// A moment as a share of the time that the shutter is open; exactly 1 where it closes.
    fn share(self, time: f64) -> f32 {
        if time >= self.close {
            1.0
        } else {
            ((time - self.open) / (self.close - self.open)) as f32
        }
    }
}

/// How a thing is when the shutter opens.
struct Opening {
    at: DVec3,
    /// Undoes how it is turned.
    back: DQuat,
}

/// Which angles differ.
fn is_turned(a: &MotionKey, b: &MotionKey) -> Vec<usize> {
    (0..3).filter(|k| (a.rotate[*k] - b.rotate[*k]).abs() > 0.0).collect()
}

/// Into how many pieces the way between two keys is cut: one, unless it turns about several axes.
fn steps(a: &MotionKey, b: &MotionKey) -> f64 {
    if is_turned(a, b).len() < 2 {
        return 1.0;
    }
    let sum: f64 = a.rotate.iter().zip(b.rotate).map(|(a, b)| (a - b).abs()).sum();
    (sum / STEP).ceil().clamp(1.0, MAX_STEPS)
}

/// World from the frame in which angles are.
fn frame(motion: &Motion) -> DQuat {
    DQuat::from_mat3(&DMat3::from_cols_array_2d(&motion.frame)).normalize()
}

/// How a thing is turned at a key, world frame: about x, then y, then z of the frame of its angles.
fn turned(motion: &Motion, key: &MotionKey) -> DQuat {
    let [x, y, z] = key.rotate;
    frame(motion)
        * about(DVec3::Z, z)
        * about(DVec3::Y, y)
        * about(DVec3::X, x)
        * frame(motion).inverse()
}

/// The axis, world frame, and the angle of the turn from one key to the other; `axes`: which angles change.
fn turn_between(motion: &Motion, [a, b]: &[MotionKey; 2], axes: &[usize]) -> (DVec3, f64) {
    let [_, y, z] = a.rotate;
    let by = |k: usize| b.rotate[k] - a.rotate[k];
    match axes {
        [] => (DVec3::X, 0.0),
        // The turns that come after one about x turn its axis.
        [0] => {
            let axis = about(DVec3::Z, z) * about(DVec3::Y, y) * DVec3::X;
            ((frame(motion) * axis).normalize(), by(0))
        }
        [1] => ((frame(motion) * (about(DVec3::Z, z) * DVec3::Y)).normalize(), by(1)),
        [2] => ((frame(motion) * DVec3::Z).normalize(), by(2)),
        _ => {
            let turn = turned(motion, b) * turned(motion, a).inverse();
            let turn = if turn.w < 0.0 { -turn } else { turn };
            let v = DVec3::new(turn.x, turn.y, turn.z);
            (v.normalize_or(DVec3::X), 2.0 * libm::atan2(v.length(), turn.w))
        }
    }
}
