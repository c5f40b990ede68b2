// What sheen (`sheen.wgsl`) lets through to the surface under it, and what that does to the surface's means.
//
// T = 1 - q E, with q the largest channel of the sheen's colour and E the directional albedo of white fibres: whatever
// they do not reflect goes on, and is let out by the same law. From a table: E of 32 cosines, uniform in their square
// roots, x 16 roughnesses from 0.15 on, as cells with the values at their corners; 1 / max(1, A) likewise, A the
// albedo before what exceeds 1 is divided out; then words for 16 roughnesses of the fibres x 16 of a lobe below,
// uniform in the square root: the means over the hemisphere, weighted by the cosine, of E, E B, and E M with that
// lobe's B and M, and of F. At last F, what white facets lose because they send light out flatter than it came in: for
// 8 roughnesses of the fibres cells of 16 roughnesses of the lobe x 16 cosines, both uniform in their square roots.
// The tables know of round lobes only, and of no coat: no scene has sheen on what is brushed or coated.

#import "bsdf/albedo_table.wgsl"
#import "bsdf/gloss_albedo.wgsl"
#import "math/vector.wgsl"
#import "scene/records.wgsl"

// Smoother fibres than this would be seen at the very rim only.
const UNDER_SHEEN_SMOOTHEST: f32 = 0.15;

// The roughness that fibres have of what the material says.
fn under_sheen_roughness(roughness: f32) -> f32 {
    return clamp(roughness, UNDER_SHEEN_SMOOTHEST, 1.0);
}

// The row of a roughness of fibres.
fn under_sheen_row(roughness: f32) -> AlbedoCell {
    return albedo_table_cell((roughness - UNDER_SHEEN_SMOOTHEST) / (1.0 - UNDER_SHEEN_SMOOTHEST), 16u);
}

// T at cosine `c`, 0 ..= 1. `sheen`: colour and roughness.
fn under_sheen_through(sheen: vec4f, c: f32) -> f32 {
    let q = vector_max(sheen.xyz);
    if (q <= 0.0) {
        return 1.0;
    }
    let row = under_sheen_row(under_sheen_roughness(sheen.w));
    let column = albedo_table_cell(sqrt(c), 32u);
    return max(1.0 - q * albedo_table_corners(load_frame_albedo_more_at().y, 31u, row, column), 0.0);
}

// 1 / max(1, A_o, A_i) for fibres of this roughness; smooth ones alone exceed 1.
fn under_sheen_kept(roughness: f32, cos_o: f32, cos_i: f32) -> f32 {
    if (roughness > 0.3) {
        return 1.0;
    }
    let table = load_frame_albedo_more_at().y + 465u;
    let row = under_sheen_row(roughness);
    let o = albedo_table_corners(table, 31u, row, albedo_table_cell(sqrt(cos_o), 32u));
    return min(o, albedo_table_corners(table, 31u, row, albedo_table_cell(sqrt(cos_i), 32u)));
}

// The means of E, E B, E M and F, of fibres and of the lobe in `below`, its row by roughness.
fn under_sheen_means(roughness: f32, below: AlbedoCell) -> vec4f {
    let table = load_frame_albedo_more_at().y + 930u;
    let row = under_sheen_row(under_sheen_roughness(roughness));
    let low = albedo_table_mix(table, row.node * 16u + below.node, 1u, below.part);
    let high = albedo_table_mix(table, row.node * 16u + 16u + below.node, 1u, below.part);
    return low + (high - low) * row.part;
}

// Words before the cells of what a lobe loses.
const UNDER_SHEEN_FLATTENED_AT: u32 = 1186u;

// What the lobe `g` under the sheen loses at cosine `c` because it sends light out flatter than it came in, where the
// fibres hold back more: as `gloss_albedo_flattened`.
fn under_sheen_flattened(sheen: vec4f, g: GlossAlbedo, c: f32) -> f32 {
    let q = vector_max(sheen.xyz);
    if (q <= 0.0 || !g.rough) {
        return 0.0;
    }
    let x = (under_sheen_roughness(sheen.w) - UNDER_SHEEN_SMOOTHEST) / (1.0 - UNDER_SHEEN_SMOOTHEST);
    let fibres = albedo_table_cell(x, 8u);
    let column = albedo_table_cell(sqrt(c), 16u);
    let table = load_frame_albedo_more_at().y + UNDER_SHEEN_FLATTENED_AT + fibres.node * 225u;
    let low = albedo_table_corners(table, 15u, g.row, column);
    let high = albedo_table_corners(table + 225u, 15u, g.row, column);
    return q * (low + (high - low) * fibres.part);
}

// How much sheen takes off the mean of what enters a lobe `g` with Fresnel's term from `entry.x` to `entry.y`.
fn under_sheen_kept_mean(sheen: vec4f, g: GlossAlbedo, entry: vec2f) -> f32 {
    let q = vector_max(sheen.xyz);
    if (q <= 0.0) {
        return 0.0;
    }
    let m = under_sheen_means(sheen.w, g.row);
    let missing = select(0.0, m.z, g.rough);
    let reflected = entry.x * (m.x - missing - m.y) + entry.y * m.y;
    // Fresnel's term has 0.04 of its rise where the lobe loses most, within 0.0013 of the whole.
    let lost = select(0.0, m.w * (entry.x + 0.04 * (entry.y - entry.x)), g.rough);
    return q * (m.x - reflected - lost);
}

// What it adds to the mean of what the lobe does not give back: what is flattened, less what it holds back of the rest.
fn under_sheen_missing(sheen: vec4f, g: GlossAlbedo) -> f32 {
    let q = vector_max(sheen.xyz);
    if (q <= 0.0 || !g.rough) {
        return 0.0;
    }
    let m = under_sheen_means(sheen.w, g.row);
    // Something is left, whatever the errors of the table.
    return max(q * (m.w - m.z), 1e-6 - g.mean_missing);
}
