//! Things in the world become `Object` records: a frame for patterns, and a key.

use std::sync::Arc;

use glam::{DMat3, DVec3};
use lang::scene::{Instance, Light};
use pack::abi;

use super::shutter::Shutter;
use crate::bvh::{Motion, Path, Piece};
use crate::normalize::Normalization;

/// A thing in the world, metres.
#[derive(Clone, Debug)]
pub(super) struct Thing {
    /// Name, with its index for indexed instances.
    pub(super) name: String,
    /// Where its origin is.
    pub(super) origin: DVec3,
    /// World from object without scale: columns are unit and at right angles.
    pub(super) rotation: DMat3,
    /// How far it comes while the shutter is open, if that is on a straight line.
    pub(super) motion: DVec3,
    /// Its way, if that is more than a line.
    pub(super) path: Option<Arc<Path>>,
}

impl Thing {
    /// A light.
    pub(super) fn lit(light: &Light, shutter: Shutter) -> Self {
        Self {
            name: light.name.text.clone(),
            origin: DVec3::from(light.center) + shutter.lead(light.velocity),
            rotation: DMat3::IDENTITY,
            motion: shutter.travel(light.velocity),
            path: None,
        }
    }

    /// The frame of an instance. Scale, shear and mirroring are left out: y keeps its direction, x
    /// is turned to a right angle with it, z completes a right-handed frame.
    pub(super) fn of(instance: &Instance, shutter: Shutter) -> Self {
        let (linear, origin) = shutter.pose(instance);
        let y = linear.y_axis.normalize_or(DVec3::Y);
        let x = linear.x_axis;
        let x = (x - y * x.dot(y)).normalize_or(y.any_orthonormal_vector());
        let rotation = DMat3::from_cols(x, y, x.cross(y));
        let (motion, path) = shutter.way(instance);
        Self { name: instance.name.text.clone(), origin, rotation, motion, path }
    }

    /// Whether it moves while the shutter is open.
    pub(super) fn moves(&self) -> bool {
        self.path.is_some() || self.motion != DVec3::ZERO
    }

    /// How it moves while the shutter is open, normalised frame.
    pub(super) fn displacement(&self, frame: &Normalization) -> Motion {
        let Some(path) = &self.path else {
            return Motion::Straight(self.motion.to_array().map(|metres| frame.length(metres)));
        };
        let length = |v: DVec3| DVec3::from(v.to_array().map(|x| f64::from(frame.length(x))));
        let piece = |p: &Piece| Piece { shift: length(p.shift), travel: length(p.travel), ..*p };
        Motion::Along(Arc::new(Path {
            pivot: DVec3::from(frame.point(path.pivot.to_array()).map(f64::from)),
            pieces: path.pieces.iter().map(piece).collect(),
        }))
    }

    /// The record in the normalised frame; pieces of its way are added to `pieces`.
    pub(super) fn record(
        &self,
        frame: &Normalization,
        pieces: &mut Vec<abi::MotionPiece>,
    ) -> abi::Object {
        let (motion, pivot, path) = match self.displacement(frame) {
            Motion::Straight(motion) => (motion, [0.0; 3], 0),
            Motion::Along(path) => {
                let first = pieces.len() as u32 + 1;
                pieces.extend(path.records());
                ([0.0; 3], path.pivot.as_vec3().to_array(), first)
            }
        };
        let metres = 1.0 / frame.scale();
        let rows = self.rotation.transpose();
        let offset = rows * (DVec3::from(frame.center) - self.origin);
        let row = |k: usize| (rows.row(k) * metres).as_vec3().to_array();
        abi::Object {
            row_x: row(0),
            offset_x: offset.x as f32,
            row_y: row(1),
            offset_y: offset.y as f32,
            row_z: row(2),
            offset_z: offset.z as f32,
            motion,
            key: key(&self.name),
            pivot,
            path,
        }
    }
}

/// A hash of the name: the same in every scene, whatever else is in it.
fn key(name: &str) -> u32 {
    let hash = blake3::hash(name.as_bytes());
    let bytes = hash.as_bytes();
    u32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_point_of_the_world_is_found_in_the_object() {
        let rotation = DMat3::from_rotation_z(std::f64::consts::FRAC_PI_2);
        let (name, origin) = ("log".to_owned(), DVec3::new(1.0, 2.0, 3.0));
        let thing = Thing { name, origin, rotation, motion: DVec3::new(0.0, 2.0, 0.0), path: None };
        let frame = Normalization::of_points([[-5.0; 3], [3.0, 7.0, 9.0]]);
        let object = thing.record(&frame, &mut Vec::new());
        // 2 m along the object's x, which is the world's y.
        let p = frame.point([1.0, 4.0, 3.0]).map(f64::from);
        let dot = |row: [f32; 3]| (0..3).map(|k| f64::from(row[k]) * p[k]).sum::<f64>();
        let x = dot(object.row_x) + f64::from(object.offset_x);
        let y = dot(object.row_y) + f64::from(object.offset_y);
        let z = dot(object.row_z) + f64::from(object.offset_z);
        let expected = [0.0, frame.length(2.0), 0.0];
        assert_eq!(object.motion.map(f32::to_bits), expected.map(f32::to_bits));
        assert!((x - 2.0).abs() < 1e-5 && y.abs() < 1e-5 && z.abs() < 1e-5, "{x} {y} {z}");
    }

    #[test]
    fn names_that_differ_have_keys_that_differ() {
        assert_ne!(key("petals[0]"), key("petals[1]"));
    }
}
