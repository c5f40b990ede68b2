//! The acceleration structure: degenerate input, rays against brute force, joining, the cache.

mod cache;
mod join;
mod rays;
mod shapes;
mod trees;
mod verify;
