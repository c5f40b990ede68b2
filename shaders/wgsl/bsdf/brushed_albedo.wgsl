// What one reflection at a surface with two widths (`ggx_anisotropic.wgsl`) does not give back of white microfacets: M
// of `ggx_albedo.wgsl` for the geometric mean of the widths, with the direction scaled by both, and D from a table of
//   12 roughnesses x 6 anisotropies a, uniform in -log10(1 - 0.9 a), x 16 cosines, uniform in their square roots,
// each with D for seven effective widths, the length of the scaled direction over its sine, from the narrower width
// to the wider, uniform in the logarithm: a word for the first four, one for the last four. Behind them the means of
// D over the hemisphere, as cells of roughness and anisotropy. Error at most 0.011; with equal widths D is 0.

#import "bsdf/albedo_table.wgsl"
#import "bsdf/ggx_albedo.wgsl"
#import "math/exp_log.wgsl"
#import "scene/records.wgsl"

// The rows of one surface.
struct BrushedAlbedo {
    fit: GgxAlbedo,
    // Both widths are the same, and no table is read.
    round: bool,
    roughness: AlbedoCell,
    anisotropy: AlbedoCell,
    // 1 over the square of the narrower width, and over the logarithm of the ratio of the squares.
    narrow: f32,
    spread: f32,
    // Mean of M over the hemisphere, weighted by the cosine.
    mean: f32,
}

// The rows for perceptual `roughness` and `anisotropy`, both 0 ..= 1, whose widths are `alpha`.
fn brushed_albedo_at(roughness: f32, anisotropy: f32, alpha: vec2f) -> BrushedAlbedo {
    let fit = ggx_albedo_at(alpha.x * alpha.y);
    let rows = albedo_table_cell(roughness, 12u);
    if (anisotropy <= 0.0) {
        return BrushedAlbedo(fit, true, rows, rows, 0.0, 0.0, fit.mean);
    }
    let ratio = exp_log_log2(alpha.x / alpha.y);
    // log10 of 2 is 0.30103.
    let columns = albedo_table_cell(-0.30103 * exp_log_log2(1.0 - 0.9 * anisotropy), 6u);
    let mean = fit.mean + brushed_albedo_mean(load_frame_albedo_at().y, rows, columns);
    let narrow = 1.0 / (alpha.y * alpha.y);
    return BrushedAlbedo(fit, false, rows, columns, narrow, 0.5 / max(ratio, 1e-6), max(mean, 1e-6));
}

// The mean over the hemisphere that the table at heap word `table` holds for a roughness and an anisotropy.
fn brushed_albedo_mean(table: u32, roughness: AlbedoCell, anisotropy: AlbedoCell) -> f32 {
    return albedo_table_corners(table + 12u * 6u * 16u * 2u, 5u, roughness, anisotropy);
}

// M for the direction whose `x`, `y` are scaled by the widths already: (alpha_x x, alpha_y y, cosine > 0).
fn brushed_albedo_missing(b: BrushedAlbedo, w: vec3f) -> f32 {
    let missing = ggx_albedo_missing(b.fit, w);
    if (b.round) {
        return missing;
    }
    return clamp(brushed_albedo_added(b, load_frame_albedo_at().y, w, missing), 0.0, 1.0);
}

// `sum` and what the table at heap word `table` holds for that direction, where the widths differ.
fn brushed_albedo_added(b: BrushedAlbedo, table: u32, w: vec3f, sum: f32) -> f32 {
    let cosine = min(w.z, 1.0);
    // At the normal all widths are the same.
    let sine2 = max((1.0 - cosine) * (1.0 + cosine), 1e-6);
    let width = exp_log_log2(max(dot(w.xy, w.xy) / sine2 * b.narrow, 1.0)) * b.spread;
    let place = albedo_table_cell(width, 7u);
    let upper = place.node >= 3u;
    let found = brushed_albedo_between(b, table + select(0u, 1u, upper), albedo_table_cell(sqrt(cosine), 16u));
    let node = place.node - select(0u, 3u, upper);
    let low = select(select(found.x, found.y, node == 1u), found.z, node == 2u);
    let high = select(select(found.y, found.z, node == 1u), found.w, node == 2u);
    return sum + low + (high - low) * place.part;
}

// The word between the nodes of three axes; `row`: the first word of the table, or the second.
fn brushed_albedo_between(b: BrushedAlbedo, row: u32, cosine: AlbedoCell) -> vec4f {
    let at = ((b.roughness.node * 6u + b.anisotropy.node) * 16u + cosine.node) * 2u;
    let near = albedo_table_mix(row, at, 2u, cosine.part);
    let brushed = albedo_table_mix(row, at + 32u, 2u, cosine.part);
    let rough = albedo_table_mix(row, at + 192u, 2u, cosine.part);
    let both = albedo_table_mix(row, at + 224u, 2u, cosine.part);
    let low = near + (brushed - near) * b.anisotropy.part;
    let high = rough + (both - rough) * b.anisotropy.part;
    return low + (high - low) * b.roughness.part;
}
