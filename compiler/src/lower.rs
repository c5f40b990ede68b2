//! A checked scene and its loaded files become the records of a pack.
//!
//! Each submodule turns one kind of declaration into one kind of record; `assemble` puts them
//! together. What no instance uses never gets here: materials and textures are numbered in the
//! order in which geometry first asks for them. It does not know text or the disk.

#![expect(
    clippy::cast_possible_truncation,
    reason = "records hold f32 and u32; indices are bounded by the format's limits before"
)]

mod again;
mod assemble;
mod camera;
mod closed;
mod extent;
mod finish;
mod fresnel;
mod geometry;
mod grain;
mod inside;
mod known;
mod light;
mod light_tree;
mod lowered;
mod material;
mod medium;
mod motion;
mod moved;
mod object;
mod order;
mod pieces;
mod power;
mod roster;
mod rows;
mod share;
mod sheet;
mod sketch;
mod sky;
mod sky_source;
mod sky_table;
mod stored;
mod texture;
mod thick;
mod trees;

pub use again::lower_again;
pub use assemble::lower;
pub use geometry::Placement;
pub use lowered::{Counters, LowerError, Lowered, Times};
pub use moved::{Left, files_of_moved, lower_moved};
pub use roster::Roster;
pub use rows::{Kept, Rows};
pub use share::{Instancing, MIN_SAVED, MIN_TRIANGLES, UnknownInstancing};
pub use sketch::Sketch;
pub use stored::{Placed, Stored};
pub use texture::{TextureTable, srgb_table};
pub use trees::Trees;

use std::sync::Arc;

use crate::import::{Environment, Image, MeshFile};

/// What the files of a scene turned out to contain, in the order of `Scene::assets` and
/// `Scene::textures`; an entry is `None` when its file could not be read.
#[derive(Debug, Default)]
pub struct Loaded {
    /// Mesh files.
    pub assets: Vec<Option<Arc<MeshFile>>>,
    /// Images.
    pub textures: Vec<Option<Arc<Image>>>,
    /// The image of the sky, if it has one.
    pub environment: Option<Environment>,
}
