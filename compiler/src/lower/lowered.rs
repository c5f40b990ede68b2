//! What lowering gives: the records of a pack, and what was counted on the way.

use std::time::Duration;

use lang::source::Span;
use pack::abi;
use serde::{Deserialize, Serialize};

use super::rows::Rows;
use crate::bvh::{self, BuildReport, BvhError};
use crate::import::ImportError;

/// What was counted while lowering.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Counters {
    /// Triangles in the pack.
    pub triangles: u64,
    /// Triangles in the world: those of a mesh that is stored once count at each of its places.
    pub shown: u64,
    /// Meshes that are stored once.
    pub meshes: u64,
    /// Their places.
    pub instances: u64,
    /// Triangles in the leaves of the tree; those that were split count once for each piece.
    pub references: u64,
    /// Triangles that had no area once positions were rounded; not in the pack.
    pub dropped_triangles: u64,
    /// Distinct vertex positions.
    pub vertices: u64,
    /// Spheres in the pack.
    pub spheres: u64,
    /// Entries of the light table.
    pub lights: u64,
}

/// Time spent.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Times {
    /// Placing instances, normalising, welding.
    pub geometry: Duration,
    /// Building, fetching and joining trees.
    pub bvh: Duration,
    /// Putting primitives in order, lights.
    pub order: Duration,
}

/// What of a pack the last one had.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Reused {
    /// All triangles, spheres and trees.
    pub geometry: bool,
    /// Triangles of some things.
    pub parts: bool,
    /// All texels.
    pub textures: bool,
}

/// All records of a pack.
#[derive(Clone, Debug)]
pub struct Lowered {
    /// Settings.
    pub render: abi::RenderSettings,
    /// Camera.
    pub camera: abi::Camera,
    /// Sky; `None` is black.
    pub sky: Option<abi::Sky>,
    /// By which the sky is sampled; empty if it is no light.
    pub sky_table: Vec<[f32; 4]>,
    /// Tables of directional albedo; empty if no material reads one.
    pub albedo: Vec<[f32; 4]>,
    /// Nodes of the joined tree; empty if they are wide.
    pub nodes: Rows<abi::Node>,
    /// Nodes of the joined tree; empty if they are binary.
    pub wide_nodes: Rows<abi::WideNode>,
    /// Triangles in leaf order.
    pub triangles: Rows<abi::Triangle>,
    /// Shading data in leaf order.
    pub shades: Rows<abi::TriShade>,
    /// Colours of the corners of triangles, in leaf order; empty where no texture asks for them.
    pub vertex_colors: Rows<abi::VertexColors>,
    /// Spheres in leaf order.
    pub spheres: Vec<abi::Sphere>,
    /// Light linking: of all lights, then of all things; empty if every light lights everything.
    pub links: Vec<abi::LightLink>,
    /// Pieces of the ways of things that turn, or do not move on one straight line.
    pub motion: Vec<abi::MotionPiece>,
    /// Keys of a camera that moves.
    pub camera_keys: Vec<abi::CameraKey>,
    /// Things in the world; empty when no material depends on them and none moves.
    pub objects: Vec<abi::Object>,
    /// Places of meshes that are stored once.
    pub instances: Vec<abi::Instance>,
    /// Materials in use.
    pub materials: Vec<abi::Material>,
    /// Media of the scene.
    pub media: Vec<abi::Medium>,
    /// Name and place of each material.
    pub material_names: Vec<(String, Option<Span>)>,
    /// Light table.
    pub lights: Vec<abi::Light>,
    /// Tree of lights; empty if the table is good enough.
    pub light_nodes: Vec<abi::LightNode>,
    /// Textures in use.
    pub textures: Vec<abi::Texture>,
    /// Texels of all textures.
    pub texels: Rows<[u32; 4]>,
    /// What was counted.
    pub counters: Counters,
    /// What took how long.
    pub times: Times,
    /// What building the trees cost, and what the cache did.
    pub trees: BuildReport,
    /// What of it the last pack had.
    pub reused: Reused,
}

/// Why a scene could not be lowered, apart from faults in its text.
#[derive(Debug, thiserror::Error)]
pub enum LowerError {
    /// The tree could not be built.
    #[error(transparent)]
    Bvh(#[from] BvhError),
    /// A file could not be loaded that had been before.
    #[error(transparent)]
    Import(#[from] ImportError),
    /// More triangles than the pack can number.
    #[error("{count} triangles are too many; at most {} are possible", bvh::MAX_PRIMITIVES)]
    TooManyTriangles {
        /// How many there are.
        count: usize,
    },
    /// More materials than a mix can name.
    #[error(
        "{count} materials are too many where some are mixed; at most {} are possible",
        abi::Material::MIXABLE
    )]
    TooManyMaterials {
        /// How many there are.
        count: usize,
    },
}
