//! The tree by which one of many lights is chosen for a point.

use super::field::abi_struct;

/// Bit of `LightNode::child` that marks a leaf.
pub const LIGHT_LEAF: u32 = 1 << 31;

/// Most turns between the root of the tree of lights and a leaf: bits of `Light::trail`.
pub const MAX_LIGHT_DEPTH: u32 = 32;

abi_struct! {
    /// Some lights, 48 bytes. Normalised world frame.
    pub struct LightNode {
        /// Middle of the box around the lights.
        pub center: [f32; 3],
        /// Square of half its diagonal, > 0.
        pub radius2: f32,
        /// Axis of the cone of directions that the lights face, unit.
        pub axis: [f32; 3],
        /// Power of the lights, in any unit that is the same for all nodes.
        pub power: f32,
        /// Cosine of the largest angle between `axis` and a light's normal; -1 for lights that face everywhere.
        pub cos_spread: f32,
        /// Its sine.
        pub sin_spread: f32,
        /// A leaf: bit 31, and the index of its `Light`. Otherwise the index of the second child; the first
        /// is the next node.
        pub child: u32,
        /// Unused.
        pub _pad0: u32,
    }
}
