// One dispatch: which pixels, which samples, and where the heap's tables begin.
struct Frame {
    // First pixel of the tile, image coordinates, origin top left.
    tile_origin: vec2<u32>,
    // Tile size in pixels; film word index is `(y * tile_size.x + x) * 2` inside the tile.
    tile_size: vec2<u32>,
    // Whole image in pixels.
    image_size: vec2<u32>,
    // First sample index of this dispatch.
    sample_first: u32,
    // Samples in this dispatch, 1 ..= `BATCH`; never crosses a multiple of `BATCH`.
    sample_count: u32,
    // Seed of the whole image; a coordinate of every random number.
    seed: u32,
    // Longest path in segments; 1 sees emission only.
    max_depth: u32,
    // Bounce from which Russian roulette may end a path.
    roulette_depth: u32,
    // Number of lights in the selection table; 0 switches next-event estimation off.
    n_lights: u32,
    // First heap word (16 bytes each) of the `Camera`.
    camera_at: u32,
    // First heap word of the `Sky`; `NONE` without a sky.
    sky_at: u32,
    // First heap word of the `Material` table.
    material_at: u32,
    // First heap word of the `Object` table; `NONE` without objects.
    object_at: u32,
    // First heap word of the `Medium` table.
    medium_at: u32,
    // First heap word of the `Light` table.
    light_at: u32,
    // First heap word of the `Texture` table.
    texture_at: u32,
    // First heap word of the 256-entry sRGB decoding table, four entries a word.
    srgb_at: u32,
    // BVH root: a `ChildRef` as in `Node`; `NONE` for a scene without geometry.
    root: u32,
    // Estimator switch for tests: 0 MIS (balance), 1 light samples only, 2 BSDF samples only,
    // 3 MIS (power 2).
    estimator: u32,
    // `SamplerKind`; the full kernel asks, a specialised one knows.
    sampler: u32,
    // Index of the `Medium` outside of everything, or `NONE`.
    air: u32,
    // Indices of the `Material`s inside of which the camera is, the one that counts first, then
    // `NONE`.
    inside: vec4<u32>,
    // 0: the nodes are `Node`s, else `WideNode`s. The full kernel asks, a specialised one knows. On the CPU 2
    // says that they are walked by what stands in the WGSL, too, and 3 that nothing is cut out.
    wide: u32,
    // First heap word of the table by which the sky is sampled.
    sky_table_at: u32,
    // First heap word of the tree of lights; `NONE`: lights are chosen by their table.
    light_tree_at: u32,
    // Index of the `Medium` that is fog, or `NONE`.
    fog: u32,
    // First heap word of the `Instance` table.
    instance_at: u32,
    _pad0: u32,
    _pad1: u32,
    _pad2: u32,
}
