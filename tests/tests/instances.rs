//! Meshes that are stored once show what they would show if every place had its own triangles.

#[path = "instances/cache.rs"]
mod cache;
#[path = "instances/pictures.rs"]
mod pictures;
#[path = "instances/rays.rs"]
mod rays;
