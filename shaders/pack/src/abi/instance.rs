//! Where a mesh that is stored once is shown.

use super::field::abi_struct;

/// What `TriShade::object` says, beside `TRI_SMOOTH`, of a triangle that is stored once for several
/// instances: the object is that of the instance.
pub const OBJECT_OF_INSTANCE: u32 = (1 << 31) - 1;

abi_struct! {
    /// A mesh in the world, 112 bytes. Its triangles have a frame of their own; the point p of the
    /// normalised world frame, when the shutter opens, is (row_x . (p - center), ...) there, and the point
    /// q of that frame is center + col_x q.x + col_y q.y + col_z q.z in the world. Any affine map that
    /// has an inverse: a mirrored one keeps the front of triangles outside.
    pub struct Instance {
        /// First row of the inverse.
        pub row_x: [f32; 3],
        /// Root of the mesh's tree: a `ChildRef` word, an inner node or triangles.
        pub root: u32,
        /// Second row of the inverse.
        pub row_y: [f32; 3],
        /// Index of the `Material` that all of it has, or `NONE`: its triangles have their own.
        pub material: u32,
        /// Third row of the inverse.
        pub row_z: [f32; 3],
        /// Bits 0-30: index of the `Object`. Bit 31, `MOVES`: it moves while the shutter is open.
        pub object: u32,
        /// Where the origin of the mesh's frame is, normalised world frame.
        pub center: [f32; 3],
        /// Rays that leave its surface start 2^-20 of this off it: the largest number, normalised world
        /// frame, that goes into a point of the surface or takes a ray to the mesh's frame and back.
        pub reach: f32,
        /// First column of the map from the mesh's frame.
        pub col_x: [f32; 3],
        /// Unused.
        pub _pad0: u32,
        /// Second column of the map.
        pub col_y: [f32; 3],
        /// Unused.
        pub _pad1: u32,
        /// Third column of the map.
        pub col_z: [f32; 3],
        /// Unused.
        pub _pad2: u32,
    }
}

impl Instance {
    /// How far the product of the two matrices is from the identity: the largest entry of the difference, each
    /// over the magnitudes of the products that it is the sum of, where these are above 1. Infinite for what
    /// is no number.
    #[must_use]
    pub fn inverse_error(&self) -> f32 {
        let rows = [self.row_x, self.row_y, self.row_z];
        let cols = [self.col_x, self.col_y, self.col_z];
        let mut worst = 0.0_f32;
        for (i, row) in rows.iter().enumerate() {
            for (j, col) in cols.iter().enumerate() {
                let products = [0, 1, 2].map(|k| row[k] * col[k]);
                let size: f32 = products.iter().map(|product| product.abs()).sum();
                let sum: f32 = products.iter().sum();
                let error = (sum - if i == j { 1.0 } else { 0.0 }).abs() / size.max(1.0);
                worst = worst.max(if error.is_nan() { f32::INFINITY } else { error });
            }
        }
        worst
    }
}
