// Directional albedo of the isotropic GGX reflection lobe under Schlick's Fresnel term: with f0 and f90 the term at
// normal and at grazing incidence a direction gets back
//   E = f0 (1 - M - B) + f90 B
// where M is what white microfacets do not give back (`ggx_albedo.wgsl`) and B the mean of (1 - wo.h)^5 over what
// they do. B = (1 - M) ((1 - cos)^5 + D), with D from a table of 16 x 16 nodes uniform in the square roots of
// cosine and roughness; a word of the table is a cell, the values at its corners. The error of E is at most 0.009.
// A surface under several such lobes keeps its energy when what is below gets the share 1 - E (Kulla & Conty 2017,
// "Revisiting Physically Based Shading at Imageworks"; OpenPBR 1.1, "Layering").

#import "bsdf/albedo_table.wgsl"
#import "bsdf/ggx.wgsl"
#import "bsdf/ggx_albedo.wgsl"
#import "scene/records.wgsl"

// The lobe at one roughness.
struct GlossAlbedo {
    // Wide enough for a lobe, and its several reflections count.
    rough: bool,
    alpha: f32,
    row: AlbedoCell,
    fit: GgxAlbedo,
    // Means of M and B over the hemisphere, weighted by the cosine.
    mean_missing: f32,
    mean_schlick: f32,
}

// What a direction does not get back.
struct GlossShares {
    // M; 0 for a mirror, and where several reflections are left out.
    missing: f32,
    // B.
    schlick: f32,
}

// The lobe of perceptual `roughness`, of which `alpha` is the width; `on`: several reflections count.
fn gloss_albedo_at(roughness: f32, alpha: f32, on: bool) -> GlossAlbedo {
    let fit = ggx_albedo_at(alpha * alpha);
    let row = albedo_table_cell(sqrt(roughness), 16u);
    if (!on || alpha < GGX_SMOOTH) {
        // The mean of (1 - c)^5: the integral of 2 c (1 - c)^5 is 1/21.
        return GlossAlbedo(false, alpha, row, fit, 0.0, 0.047619048);
    }
    // A polynomial fit of the mean of B: error 7e-4.
    let r = roughness;
    let high = -0.545372 + r * (0.82984 + r * (-0.488308 + r * 0.093647));
    return GlossAlbedo(true, alpha, row, fit, fit.mean, 0.045411 + r * (0.067308 + r * high));
}

// M and B at cosine `c`, 0 ..= 1.
fn gloss_albedo_shares(g: GlossAlbedo, c: f32) -> GlossShares {
    let m = clamp(1.0 - c, 0.0, 1.0);
    let m2 = m * m;
    let smooth_schlick = m2 * m2 * m;
    if (!g.rough) {
        return GlossShares(0.0, smooth_schlick);
    }
    let sine = sqrt(m * (1.0 + c));
    let missing = ggx_albedo_missing(g.fit, vec3f(g.alpha * sine, 0.0, max(c, 1e-6)));
    return GlossShares(missing, max((1.0 - missing) * (smooth_schlick + gloss_albedo_rise(g.row, c)), 0.0));
}

// D in the row of a roughness, at cosine `c`.
fn gloss_albedo_rise(row: AlbedoCell, c: f32) -> f32 {
    return albedo_table_corners(load_frame_albedo_at().x, 15u, row, albedo_table_cell(sqrt(c), 16u));
}

// E at shares `x`, for a Fresnel term from `f0` to `f90`.
fn gloss_albedo_reflected(x: GlossShares, f0: f32, f90: f32) -> f32 {
    return f0 * (1.0 - x.missing) + (f90 - f0) * x.schlick;
}

// The mean of E over the hemisphere, weighted by the cosine.
fn gloss_albedo_mean(g: GlossAlbedo, f0: f32, f90: f32) -> f32 {
    return f0 * (1.0 - g.mean_missing) + (f90 - f0) * g.mean_schlick;
}

// What the lobe loses under a smooth coat at cosine `c`, of white microfacets: they send light out flatter than it came
// in, where the coat holds back more. From a second table like the first. 0 for a mirror.
fn gloss_albedo_flattened(g: GlossAlbedo, c: f32) -> f32 {
    if (!g.rough) {
        return 0.0;
    }
    return albedo_table_corners(load_frame_albedo_at().x + 225u, 15u, g.row, albedo_table_cell(sqrt(c), 16u));
}

// Its mean over the hemisphere, weighted by the cosine: a polynomial fit, error 2e-4.
fn gloss_albedo_mean_flattened(roughness: f32) -> f32 {
    let r = roughness;
    let high = -1.19050111 + r * (1.03806578 - r * 0.3240843);
    return max(r * (-0.01080554 + r * (0.50888311 + r * high)), 0.0);
}
