//! What changes from dispatch to dispatch: the kernel's only uniform, written by the runtime.

use super::AlbedoTable;
use super::field::abi_struct;

abi_struct! {
    /// One dispatch: which pixels, which samples, and where the heap's tables begin.
    pub struct Frame {
        /// First pixel of the tile, image coordinates, origin top left.
        pub tile_origin: [u32; 2],
        /// Tile size in pixels; film word index is `(y * tile_size.x + x) * 2` inside the tile.
        pub tile_size: [u32; 2],
        /// Whole image in pixels.
        pub image_size: [u32; 2],
        /// First sample index of this dispatch.
        pub sample_first: u32,
        /// Samples in this dispatch, 1 ..= `BATCH`; never crosses a multiple of `BATCH`.
        pub sample_count: u32,
        /// Seed of the whole image; a coordinate of every random number.
        pub seed: u32,
        /// Longest path in segments; 1 sees emission only, `NONE` is no limit.
        pub max_depth: u32,
        /// Bounce from which Russian roulette may end a path.
        pub roulette_depth: u32,
        /// Number of lights in the selection table; 0 switches next-event estimation off.
        pub n_lights: u32,
        /// First heap word (16 bytes each) of the `Camera`.
        pub camera_at: u32,
        /// First heap word of the `Sky`; `NONE` without a sky.
        pub sky_at: u32,
        /// First heap word of the `Material` table.
        pub material_at: u32,
        /// First heap word of the `Object` table; `NONE` without objects.
        pub object_at: u32,
        /// First heap word of the `Medium` table.
        pub medium_at: u32,
        /// First heap word of the `Light` table.
        pub light_at: u32,
        /// First heap word of the `Texture` table.
        pub texture_at: u32,
        /// First heap word of the 256-entry sRGB decoding table, four entries a word.
        pub srgb_at: u32,
        /// BVH root: a `ChildRef` as in `Node`; `NONE` for a scene without geometry.
        pub root: u32,
        /// Estimator switch for tests: 0 MIS (balance), 1 light samples only, 2 BSDF samples only,
        /// 3 MIS (power 2).
        pub estimator: u32,
        /// `SamplerKind`; the full kernel asks, a specialised one knows.
        pub sampler: u32,
        /// Index of the `Medium` outside of everything, or `NONE`.
        pub air: u32,
        /// Indices of the `Material`s inside of which the camera is, the one that counts first, then
        /// `NONE`.
        pub inside: [u32; 4],
        /// 0: the nodes are `Node`s, else `WideNode`s. The full kernel asks, a specialised one knows.
        pub wide: u32,
        /// First heap word of the table by which the sky is sampled.
        pub sky_table_at: u32,
        /// First heap word of the tree of lights; `NONE`: lights are chosen by their table.
        pub light_tree_at: u32,
        /// Index of the `Medium` that is fog, or `NONE`.
        pub fog: u32,
        /// First heap word of the `Instance` table.
        pub instance_at: u32,
        /// Largest channel of the indirect light of a sample; 0: it is not clamped.
        pub clamp_indirect: f32,
        /// `FilterKind`. The full kernel asks, a specialised one knows.
        pub pixel_filter: u32,
        /// Side of the square outside of which the filter is 0, pixels.
        pub filter_width: f32,
        /// First heap word of the first four `AlbedoTable`s; `NONE` for those that no material reads.
        pub albedo_at: [u32; 4],
        /// First heap word of the `MotionPiece` table; `NONE`: what moves does so on straight lines.
        pub path_at: u32,
        /// First heap word of the `CameraKey` table; `NONE`: the camera stands still.
        pub camera_key_at: u32,
        /// First heap word of the other `AlbedoTable`s; likewise.
        pub albedo_more_at: [u32; 2],
        /// First heap word of the `LightLink` table; `NONE`: every light lights everything.
        pub link_at: u32,
        /// First heap word of the `VertexColors` table; `NONE`: no texture asks for them.
        pub vertex_color_at: u32,
        /// Unused.
        pub _pad0: u32,
        /// Unused.
        pub _pad1: u32,
    }
}

impl Frame {
    /// `albedo_at` and `albedo_more_at`, of the first heap word of each table.
    #[must_use]
    pub fn albedo_places(tables: [u32; AlbedoTable::ALL.len()]) -> ([u32; 4], [u32; 2]) {
        let [gloss, brushed, glass, leaf, more @ ..] = tables;
        ([gloss, brushed, glass, leaf], more)
    }
}
