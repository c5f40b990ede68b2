//! How primitives move while the shutter is open, and the boxes of all places where they come.
//!
//! A way is a list of pieces; in each the thing turns evenly about an axis through the pivot and moves straight on. It
//! does not know where ways come from.

use glam::{DMat3, DQuat, DVec3};
use pack::abi;

use std::f64::consts::TAU;
use std::sync::Arc;

/// How a thing moves while the shutter is open, in the frame in which the kernel sees it.
#[derive(Clone, Debug, PartialEq)]
pub enum Motion {
    /// So far, on a straight line; nothing at all for what stands still.
    Straight([f32; 3]),
    /// By the pieces of a way.
    Along(Arc<Path>),
}

/// A way.
#[derive(Clone, Debug, PartialEq)]
pub struct Path {
    /// The point about which the thing turns, where the shutter opens.
    pub pivot: DVec3,
    /// One after the other, from 0 to 1.
    pub pieces: Vec<Piece>,
}

/// A piece of a way: see `abi::MotionPiece`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Piece {
    /// When it starts and ends, 0 where the shutter opens, 1 where it closes.
    pub times: [f32; 2],
    /// How far the thing has come before.
    pub shift: DVec3,
    /// How far it comes.
    pub travel: DVec3,
    /// About which unit vector it turns.
    pub axis: DVec3,
    /// By how much, radians.
    pub angle: f64,
    /// How it is turned before.
    pub turn: DQuat,
}

/// Poses that are looked at are at most so far apart, radians.
const STEP: f64 = TAU / 64.0;
/// At most so many of a piece: a thing that turns more often is taken to be everywhere around its pivot.
const MAX_STEPS: f64 = 4096.0;

/// What a ray's way to the pose at the opening and back rounds, normalised frame: less than 40 roundings to 2^-24, of
/// coordinates below 2.
const ROOM: f64 = 1.0 / 131_072.0; // 2^-17

impl Default for Motion {
    fn default() -> Self {
        Self::Straight([0.0; 3])
    }
}

impl Motion {
    /// Whether it leads anywhere.
    #[must_use]
    pub fn moves(&self) -> bool {
        match self {
            Self::Straight(way) => way.iter().any(|x| x.abs() > 0.0),
            Self::Along(_) => true,
        }
    }

    /// The least and the largest displacement on the way, axis by axis, of what does not turn.
    #[must_use]
    pub fn range(&self) -> [DVec3; 2] {
        match self {
            Self::Straight(way) => {
                let way = DVec3::from(way.map(f64::from));
                [way.min(DVec3::ZERO), way.max(DVec3::ZERO)]
            }
            Self::Along(path) => {
                let ends = path.pieces.iter().flat_map(|p| [p.shift, p.shift + p.travel]);
                ends.fold([DVec3::ZERO; 2], |[lo, hi], p| [lo.min(p), hi.max(p)])
            }
        }
    }
}

impl Path {
    /// Whether the thing turns.
    #[must_use]
    pub fn turns(&self) -> bool {
        self.pieces.iter().any(|piece| piece.angle.abs() > 0.0)
    }

    /// Corners of a box around all places of the box between `lo` and `hi`.
    ///
    /// Of two poses, `d` radians apart, that are looked at, the points between are c(u) = a(u) + s(u): a is an arc of
    /// radius r at most and s a straight line. By Taylor's theorem a(u) is no farther than r d^2 / 8 from the point u of
    /// its chord, and chord and line together lie between the two poses.
    #[must_use]
    pub fn sweep(&self, lo: DVec3, hi: DVec3) -> [DVec3; 2] {
        let (middle, half) = (0.5 * (lo + hi) - self.pivot, 0.5 * (hi - lo));
        let radius = middle.length() + half.length();
        let empty = [DVec3::INFINITY, DVec3::NEG_INFINITY];
        self.pieces.iter().fold(empty, |[mut lo, mut hi], piece| {
            let n = (piece.angle.abs() / STEP).ceil().clamp(1.0, MAX_STEPS);
            let step = piece.angle.abs() / n;
            let bulge = (radius * step * step / 8.0).min(2.0 * radius);
            let mut k = 0.0;
            while k <= n {
                let (turn, shift) = piece.pose(k / n);
                let matrix = DMat3::from_quat(turn);
                let reach =
                    DMat3::from_cols(matrix.x_axis.abs(), matrix.y_axis.abs(), matrix.z_axis.abs())
                        * half
                        + DVec3::splat(bulge);
                let at = matrix * middle + self.pivot + shift;
                (lo, hi) = (lo.min(at - reach), hi.max(at + reach));
                k += 1.0;
            }
            [lo, hi]
        })
    }

    /// The same with room for what the kernel rounds; normalised frame.
    #[must_use]
    pub fn sweep_with_room(&self, lo: DVec3, hi: DVec3) -> [DVec3; 2] {
        let [lo, hi] = self.sweep(lo, hi);
        [lo - DVec3::splat(ROOM), hi + DVec3::splat(ROOM)]
    }

    /// The records.
    pub fn records(&self) -> impl Iterator<Item = abi::MotionPiece> {
        self.pieces.iter().map(Piece::record)
    }
}

impl Piece {
    /// How the thing is turned, and how far it has come, when `u` of the piece has gone by.
    fn pose(&self, u: f64) -> (DQuat, DVec3) {
        (about(self.axis, self.angle * u) * self.turn, self.shift + self.travel * u)
    }

    #[expect(clippy::cast_possible_truncation, reason = "records hold f32")]
    fn record(&self) -> abi::MotionPiece {
        abi::MotionPiece {
            shift: self.shift.as_vec3().to_array(),
            start: self.times[0],
            travel: self.travel.as_vec3().to_array(),
            end: self.times[1],
            axis: self.axis.as_vec3().to_array(),
            turns: (self.angle / TAU) as f32,
            turn: self.turn.to_array().map(|x| x as f32),
        }
    }
}

/// The turn about a unit vector, counter-clockwise seen from its tip, radians.
#[must_use]
pub fn about(axis: DVec3, angle: f64) -> DQuat {
    let v = axis * libm::sin(0.5 * angle);
    DQuat::from_xyzw(v.x, v.y, v.z, libm::cos(0.5 * angle))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn boxes_hold_every_pose_between_those_that_are_looked_at() {
        let turn = about(DVec3::new(0.6, 0.0, 0.8), 1.1);
        for angle in [0.0, 0.05, 1.0, -4.0, 30.0, 1e6] {
            let piece = Piece {
                times: [0.0, 1.0],
                shift: DVec3::new(0.1, 0.0, -0.2),
                travel: DVec3::new(-0.3, 0.4, 0.1),
                axis: DVec3::new(0.0, 0.6, -0.8),
                angle,
                turn,
            };
            let path = Path { pivot: DVec3::new(0.2, -0.1, 0.3), pieces: vec![piece] };
            let [a, b] = [DVec3::new(-0.5, 0.2, 0.1), DVec3::new(-0.4, 0.5, 0.4)];
            let [lo, hi] = path.sweep(a, b);
            for i in 0..1009 {
                let (turn, shift) = piece.pose(f64::from(i) / 1008.0);
                for corner in [a, b, DVec3::new(a.x, b.y, a.z), DVec3::new(b.x, a.y, b.z)] {
                    let p = turn * (corner - path.pivot) + path.pivot + shift;
                    let inside = p.cmpge(lo - 1e-12).all() && p.cmple(hi + 1e-12).all();
                    assert!(inside, "{angle}: {p} is not between {lo} and {hi}");
                }
            }
        }
    }
}
