// The lobe of `gloss.wgsl` with two widths, for a surface that is brushed along its tangent or in a direction turned
// from it, and its albedo: E = f0 (1 - M - B) + f90 B as in `gloss_albedo.wgsl`, with M of `brushed_albedo.wgsl` and
//   B = (1 - M) ((1 - cos)^5 + D + R)
// where D is that of a round lobe which is as wide as this one in the plane of direction and normal, and R what that is
// off by, from a table like that of M. A surface that is not brushed is that of `gloss.wgsl`, to the bit.

#import "bsdf/albedo_table.wgsl"
#import "bsdf/brushed_albedo.wgsl"
#import "bsdf/ggx_anisotropic.wgsl"
#import "bsdf/gloss.wgsl"
#import "bsdf/gloss_albedo.wgsl"
#import "bsdf/scatter.wgsl"
#import "math/basis.wgsl"
#import "math/vector.wgsl"
#import "scene/records.wgsl"

// How a surface is brushed.
struct BrushedGloss {
    // Its x axis is the direction of brushing.
    basis: Basis,
    // Widths along x and y.
    alpha: vec2f,
    anisotropy: f32,
}

// The surface at `s` is not brushed.
fn brushed_gloss_none(s: Scatter) -> bool {
    return s.anisotropy <= 0.0;
}

// How the surface at `s` is brushed.
fn brushed_gloss_at(s: Scatter) -> BrushedGloss {
    return BrushedGloss(basis_along(s.ns, s.tangent), ggx_anisotropic_alpha(s.roughness, s.anisotropy), s.anisotropy);
}

// As `gloss_sample`.
fn brushed_gloss_sample(s: Scatter, alpha: f32, wo: vec3f, u: vec2f) -> vec3f {
    if (brushed_gloss_none(s)) {
        return gloss_sample(s.ns, wo, alpha, u);
    }
    let b = brushed_gloss_at(s);
    let i = ggx_anisotropic_sample(basis_local_from_world(b.basis, wo), b.alpha, u);
    return vector_unit(basis_world_from_local(b.basis, i));
}

// As `gloss_eval`.
fn brushed_gloss_eval(s: Scatter, alpha: f32, wo: vec3f, wi: vec3f) -> vec2f {
    if (brushed_gloss_none(s)) {
        return gloss_eval(s.ns, wo, wi, alpha);
    }
    let b = brushed_gloss_at(s);
    let o = basis_local_from_world(b.basis, wo);
    let i = basis_local_from_world(b.basis, wi);
    return vec2f(ggx_anisotropic_eval(o, i, b.alpha), ggx_anisotropic_pdf(o, i, b.alpha));
}

// As `gloss_albedo_at`.
fn brushed_gloss_albedo(s: Scatter, on: bool) -> GlossAlbedo {
    let g = gloss_albedo_at(s.roughness, gloss_alpha(s.roughness), on);
    if (brushed_gloss_none(s) || !g.rough) {
        return g;
    }
    let b = brushed_gloss_at(s);
    let a = brushed_albedo_at(s.roughness, b.anisotropy, b.alpha);
    if (a.round) {
        return g;
    }
    let rise = brushed_albedo_mean(load_frame_albedo_more_at().x, a.roughness, a.anisotropy);
    return GlossAlbedo(true, g.alpha, g.row, g.fit, a.mean, g.mean_schlick + rise);
}

// The lobe `g` as it is towards `w`, at cosine `c`: in the row of its width there.
fn brushed_gloss_along(s: Scatter, g: GlossAlbedo, w: vec3f, c: f32) -> GlossAlbedo {
    if (brushed_gloss_none(s) || !g.rough) {
        return g;
    }
    let b = brushed_gloss_at(s);
    let row = brushed_gloss_row(b.alpha, brushed_gloss_scaled(b, w, c));
    return GlossAlbedo(true, g.alpha, row, g.fit, g.mean_missing, g.mean_schlick);
}

// As `gloss_albedo_shares` of the lobe `g` towards `w`, at cosine `c`.
fn brushed_gloss_shares(s: Scatter, g: GlossAlbedo, w: vec3f, c: f32) -> GlossShares {
    if (brushed_gloss_none(s) || !g.rough) {
        return gloss_albedo_shares(g, c);
    }
    let b = brushed_gloss_at(s);
    let a = brushed_albedo_at(s.roughness, b.anisotropy, b.alpha);
    if (a.round) {
        return gloss_albedo_shares(g, c);
    }
    let scaled = brushed_gloss_scaled(b, w, c);
    let missing = brushed_albedo_missing(a, scaled);
    let m = clamp(1.0 - c, 0.0, 1.0);
    let m2 = m * m;
    let more = brushed_albedo_added(a, load_frame_albedo_more_at().x, scaled, gloss_albedo_rise(g.row, c));
    return GlossShares(missing, max((1.0 - missing) * (m2 * m2 * m + more), 0.0));
}

// `w` in the frame of brushing, its x and y times the widths.
fn brushed_gloss_scaled(b: BrushedGloss, w: vec3f, c: f32) -> vec3f {
    let i = basis_local_from_world(b.basis, w);
    return vec3f(i.xy * b.alpha, max(c, 1e-6));
}

// The row of the effective width of a direction whose x and y are `scaled` by the widths `alpha`; at the normal, where
// all are the same, the narrower.
fn brushed_gloss_row(alpha: vec2f, scaled: vec3f) -> AlbedoCell {
    let cosine = min(scaled.z, 1.0);
    let sine2 = max((1.0 - cosine) * (1.0 + cosine), 1e-6);
    let width2 = max(dot(scaled.xy, scaled.xy) / sine2, alpha.y * alpha.y);
    // The eighth root: the root of the perceptual roughness.
    return albedo_table_cell(sqrt(sqrt(sqrt(width2))), 16u);
}
