//! Light linking: which lights light which things.

use super::field::abi_struct;

abi_struct! {
    /// Light linking of a light or of a thing in the world, 16 bytes: those of all `Light`s in their order, then of all
    /// objects. A light that does not light everything is in one of at most 32 sets.
    pub struct LightLink {
        /// Of a thing: bit k says that the lights of set k light it.
        pub receives: u32,
        /// Of a light, and of a thing that glows: the bit of its set. 0: it lights everything.
        pub own_set: u32,
        /// Unused.
        pub _pad0: u32,
        /// Unused.
        pub _pad1: u32,
    }
}
