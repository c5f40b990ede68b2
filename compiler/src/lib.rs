//! (to be written)

pub mod bvh;
