//! (to be written)

pub mod bvh;
pub mod cache;
pub mod normalize;
pub mod weld;
pub mod import;
