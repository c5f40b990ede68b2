//! What the primitives of one thing in the world share.

use super::field::abi_struct;

abi_struct! {
    /// A thing in the world, 80 bytes: its own frame, its motion, its key. The point `p` of the
    /// normalised world frame is (row_x . p + offset_x, ...) in the object, in metres, unscaled:
    /// patterns turn and move with the thing, but do not grow with it.
    pub struct Object {
        /// First row of the rotation, times metres per normalised unit.
        pub row_x: [f32; 3],
        /// x of the origin of the world in the object, metres.
        pub offset_x: f32,
        /// Second row.
        pub row_y: [f32; 3],
        /// y of the origin of the world.
        pub offset_y: f32,
        /// Third row.
        pub row_z: [f32; 3],
        /// z of the origin of the world.
        pub offset_z: f32,
        /// How far it moves while the shutter is open, normalised world frame; the geometry of the
        /// pack is where it is when the shutter opens.
        pub motion: [f32; 3],
        /// A hash of its name: what differs from one petal to the next depends on it alone.
        pub key: u32,
        /// The point about which it turns, normalised world frame, where the shutter opens.
        pub pivot: [f32; 3],
        /// 1 + the index of the first `MotionPiece` of its way; 0: its way is `motion`.
        pub path: u32,
    }
}

impl Object {
    /// Whether it moves while the shutter is open.
    #[must_use]
    pub fn moves(&self) -> bool {
        self.path != 0 || self.motion.iter().any(|component| *component != 0.0)
    }
}
