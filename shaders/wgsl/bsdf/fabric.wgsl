// Fabric: folds and weave are bumps of a rough thin sheet that lets a share of the light through.
// Coordinates are metres of the object times the pattern's scale.

#import "bsdf/matte.wgsl"
#import "bsdf/scatter.wgsl"
#import "math/basis.wgsl"
#import "pattern/bump.wgsl"
#import "pattern/fbm.wgsl"
#import "scene/records.wgsl"
#import "surface/surface.wgsl"

// Heights of the bumps, 0 ..= 2: folds of decimetres, weave of centimetres.
fn fabric_field(q: vec3f, scale: f32, key: u32) -> f32 {
    let folds = fbm_value(q * (scale * 2.5), 2u, key);
    return folds + fbm_value(q * (scale * 15.0) + vec3f(0.7, 1.3, 0.3), 2u, key ^ 0x4be98134u);
}

// Gives the surface point its bumps.
fn fabric_pattern(scatter: ptr<function, Scatter>, s: Surface, wo: vec3f) {
    if (load_material_bump_height(s.material) == 0.0) {
        return;
    }
    let scale = load_material_pattern_scale(s.material);
    let step = load_material_bump_step(s.material);
    let place = (*scatter).place;
    var values = vec4f(0.0);
    var k = 0u;
    loop {
        if (k == 4u) { break; }
        values = bump_put(values, k, fabric_field(bump_point(place.q, step, k), scale, place.key));
        k += 1u;
    }
    bump_tilt(scatter, s.object, values, wo);
}

// The rough sheet: what is not gloss is reflected or, by the share `weight`, transmitted.
fn fabric_matte(s: Scatter) -> Matte {
    let gloss = load_material_gloss(s.material);
    let share = load_material_weight(s.material);
    let alpha = max(s.roughness * s.roughness, 1e-3);
    let color = s.color * (1.0 - gloss);
    return Matte(basis_around(s.ns), vec2f(alpha), s.roughness, 0.0, gloss, color * (1.0 - share), color * share);
}

// Samples `wi`. `u`: direction, `v`: which lobe; all in [0, 1 - 2^-24].
fn fabric_sample(s: Scatter, wo: vec3f, u: vec2f, v: f32) -> Scattered {
    return matte_sample(s, fabric_matte(s), wo, u, v);
}

// f |cos|, on both sides, and the density of `fabric_sample`.
fn fabric_eval(s: Scatter, wo: vec3f, wi: vec3f) -> Evaluated {
    return matte_eval(s, fabric_matte(s), wo, wi);
}
