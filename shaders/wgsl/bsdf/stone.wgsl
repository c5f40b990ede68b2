// Stone: a field of three bands (blocks, grain, cracks) gives it bumps, roughness, and veins of a second colour.
// Coordinates are metres of the object times the pattern's scale.

#import "bsdf/matte.wgsl"
#import "bsdf/scatter.wgsl"
#import "math/basis.wgsl"
#import "pattern/bump.wgsl"
#import "pattern/fbm.wgsl"
#import "scene/records.wgsl"
#import "surface/surface.wgsl"

// Frequencies per metre: blocks a third of a metre wide, grain of centimetres, cracks of millimetres. The offsets
// keep the bands' lattices apart. Each in 0 ..= 1.
fn stone_bands(q: vec3f, scale: f32, key: u32) -> vec3f {
    return vec3f(
        fbm_value(q * (scale * 3.0), 3u, key),
        fbm_value(q * (scale * 11.0) + vec3f(1.7), 3u, key ^ 0x68bc21ebu),
        fbm_value(q * (scale * 25.0) + vec3f(3.1), 2u, key ^ 0x02e5be93u),
    );
}

// The field: heights of the bumps and roughness, 0 ..= 1.
fn stone_field(bands: vec3f) -> f32 {
    return dot(bands, vec3f(0.5, 0.3, 0.2));
}

// Gives the surface point its colour, roughness (perceptual, 0.4 ..= 0.75) and bumps.
fn stone_pattern(scatter: ptr<function, Scatter>, s: Surface, wo: vec3f) {
    let scale = load_material_pattern_scale(s.material);
    let step = load_material_bump_step(s.material);
    let place = (*scatter).place;
    var bands = vec3f(0.0);
    var values = vec4f(0.0);
    // Without bumps only the point itself.
    var k = select(0u, 3u, load_material_bump_height(s.material) == 0.0);
    loop {
        if (k == 4u) { break; }
        bands = stone_bands(bump_point(place.q, step, k), scale, place.key);
        values = bump_put(values, k, stone_field(bands));
        k += 1u;
    }
    if (load_material_bump_height(s.material) > 0.0) {
        bump_tilt(scatter, s.object, values, wo);
    }
    (*scatter).roughness = 0.4 + 0.35 * values.w;
    let vein = load_material_tint(s.material);
    (*scatter).color = vein + ((*scatter).color - vein) * stone_body(bands);
}

// How much of the colour is the stone's own and not its veins', 0 ..= 1: veins run where the blocks meet, and
// the grain speckles all of it.
fn stone_body(bands: vec3f) -> f32 {
    let vein = clamp(abs(bands.x - 0.5) * 16.0, 0.0, 1.0);
    let speckle = clamp(0.62 + (bands.y - 0.5) * 1.8 + (bands.z - 0.5) * 1.6, 0.0, 1.0);
    return speckle * (0.3 + vein * (1.4 - 0.7 * vein));
}

// The rough surface with what the pattern found.
fn stone_matte(s: Scatter) -> Matte {
    let gloss = load_material_gloss(s.material);
    let alpha = s.roughness * s.roughness;
    return Matte(basis_around(s.ns), vec2f(alpha), s.roughness, 0.0, gloss, s.color * (1.0 - gloss), vec3f(0.0));
}

// Samples `wi`. `u`: direction, `v`: which lobe; all in [0, 1 - 2^-24].
fn stone_sample(s: Scatter, wo: vec3f, u: vec2f, v: f32) -> Scattered {
    return matte_sample(s, stone_matte(s), wo, u, v);
}

// f |cos|, and the density of `stone_sample`.
fn stone_eval(s: Scatter, wo: vec3f, wi: vec3f) -> Evaluated {
    return matte_eval(s, stone_matte(s), wo, wi);
}
