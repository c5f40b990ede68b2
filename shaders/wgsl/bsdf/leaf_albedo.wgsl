// What the forward lobe of a thin sheet (`leaf.wgsl`) does not let through: light that it would send back to the side
// it came from, or take from flat directions,
//   L(c, g) = 1 - integral of p_hg(-wo . wi) min(1, |cos_i / c|) over the far side,
// from a table of 16 cosines, uniform in their square roots, x 16 mean cosines from 1 to 0, uniform in the cube root of
// 1 - |g|, and the same for g < 0. A word holds L and its mean over the hemisphere, weighted by the cosine. Error at
// most 0.005, for g < 0 0.011.

#import "bsdf/albedo_table.wgsl"
#import "math/exp_log.wgsl"
#import "scene/records.wgsl"

// L at cosine `c`, 0 ..= 1, and its mean, for the mean cosine `g`.
fn leaf_albedo(c: f32, g: f32) -> vec2f {
    let first = load_frame_albedo_at().w + select(0u, 256u, g < 0.0);
    let column = albedo_table_cell(sqrt(c), 16u);
    let row = albedo_table_cell(exp_log_cbrt(1.0 - abs(g)), 16u);
    let at = row.node * 16u + column.node;
    let low = albedo_table_mix(first, at, 1u, column.part);
    let high = albedo_table_mix(first, at + 16u, 1u, column.part);
    return (low + (high - low) * row.part).xy;
}
