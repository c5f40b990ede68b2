//! The acceleration structure: degenerate input, rays against brute force, joining, the cache.
#![expect(clippy::unwrap_used, reason = "a test that panics has failed")]
#![expect(clippy::float_cmp, reason = "results are exact or wrong")]

mod cache;
mod join;
mod motion;
mod rays;
mod shapes;
mod trees;
mod verify;
mod wide;
