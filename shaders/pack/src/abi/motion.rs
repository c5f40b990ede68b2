//! Ways of things and cameras while the shutter is open, from key to key.

use super::field::abi_struct;

abi_struct! {
    /// A piece of the way of a thing whose way is not one straight line, 64 bytes. Pieces of a way follow each other
    /// in time; the first starts at 0, where the shutter opens, and the last ends at 1, where it closes. At a time of
    /// the piece, u of it gone by, the thing is turned from where the shutter opens about `Object::pivot` by `turn` and
    /// then by u `turns` about `axis`, then moved by `shift` + u `travel`. Normalised world frame.
    pub struct MotionPiece {
        /// How far the thing has come where the piece starts.
        pub shift: [f32; 3],
        /// When the piece starts.
        pub start: f32,
        /// How far it comes in the piece.
        pub travel: [f32; 3],
        /// When the piece ends.
        pub end: f32,
        /// Unit vector about which it turns, counter-clockwise seen from its tip.
        pub axis: [f32; 3],
        /// Turns in the piece; 0: it does not turn.
        pub turns: f32,
        /// How it is turned where the piece starts: a unit quaternion, its real part last.
        pub turn: [f32; 4],
    }
}

abi_struct! {
    /// A key of a camera that moves, 48 bytes; between keys numbers are interpolated, and the frame is built of what
    /// comes out. Times rise from 0, where the shutter opens, to 1, where it closes. Normalised world frame.
    pub struct CameraKey {
        /// As `Camera::origin`.
        pub origin: [f32; 3],
        /// When the camera is there.
        pub time: f32,
        /// The point in the middle of the image.
        pub aim: [f32; 3],
        /// As `Camera::focus_distance`; 0: the distance to `aim`.
        pub focus_distance: f32,
        /// Which way is up in the image, any length.
        pub up: [f32; 3],
        /// Unused.
        pub _pad0: u32,
    }
}
