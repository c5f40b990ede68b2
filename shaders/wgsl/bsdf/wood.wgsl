// Wood: a field that changes quickly across the grain and slowly along it gives it bumps, roughness and growth
// rings; the gloss is stretched along the grain. Coordinates are metres of the object times the pattern's scale.

#import "bsdf/ggx_anisotropic.wgsl"
#import "bsdf/matte.wgsl"
#import "bsdf/scatter.wgsl"
#import "math/basis.wgsl"
#import "math/vector.wgsl"
#import "pattern/bump.wgsl"
#import "pattern/fbm.wgsl"
#import "scene/motion.wgsl"
#import "scene/records.wgsl"
#import "surface/surface.wgsl"

// How much slower the pattern changes along the grain.
const WOOD_ALONG: f32 = 0.12;

// Growth rings between field values 0 and 1.
const WOOD_RINGS: f32 = 22.0;

// At `q`, metres, squeezed along the grain. Frequencies per metre across the grain: figure, grain, pores. Each in
// 0 ..= 1.
fn wood_bands(q: vec3f, scale: f32, key: u32) -> vec3f {
    return vec3f(
        fbm_value(q * (scale * 2.5), 3u, key),
        fbm_value(q * (scale * 8.0) + vec3f(1.7, 2.3, 3.1), 3u, key ^ 0x967a889bu),
        fbm_value(q * (scale * 22.0) + vec3f(5.1, 1.3, 4.7), 2u, key ^ 0x368cc8b7u),
    );
}

// The field: heights of the bumps and roughness, 0 ..= 1.
fn wood_field(bands: vec3f) -> f32 {
    return dot(bands, vec3f(0.35, 0.4, 0.25));
}

// 1 for the axis of the object along which the grain runs, else 0; `code` is `Material::fuzz`.
fn wood_axis(code: f32) -> vec3f {
    if (code < 0.33) {
        return vec3f(0.0, 1.0, 0.0);
    }
    return select(vec3f(0.0, 0.0, 1.0), vec3f(1.0, 0.0, 0.0), code < 0.66);
}

// Gives the surface point its colour, roughness (perceptual, 0.45 ..= 0.85), bumps, and the grain as its tangent.
fn wood_pattern(scatter: ptr<function, Scatter>, s: Surface, wo: vec3f) {
    let axis = wood_axis((*scatter).fuzz);
    let squeeze = select(vec3f(1.0), vec3f(WOOD_ALONG), axis == vec3f(1.0));
    let scale = load_material_pattern_scale(s.material);
    let step = load_material_bump_step(s.material);
    let place = (*scatter).place;
    var bands = vec3f(0.0);
    var values = vec4f(0.0);
    // Without bumps only the point itself.
    var k = select(0u, 3u, load_material_bump_height(s.material) == 0.0);
    loop {
        if (k == 4u) { break; }
        bands = wood_bands(bump_point(place.q, step, k) * squeeze, scale, place.key);
        values = bump_put(values, k, wood_field(bands));
        k += 1u;
    }
    if (load_material_bump_height(s.material) > 0.0) {
        bump_tilt(scatter, s.object, values, wo);
    }
    (*scatter).roughness = 0.45 + 0.4 * values.w;
    let late = load_material_tint(s.material);
    (*scatter).color += (late - (*scatter).color) * wood_late(bands);
    let x = load_object_row_x(s.object);
    let grain = x * axis.x + load_object_row_y(s.object) * axis.y + load_object_row_z(s.object) * axis.z;
    let along = dispatch_turn_of(s.object, grain, (*scatter).key) / sqrt(dot(x, x));
    let n = (*scatter).ns;
    (*scatter).tangent = along - n * dot(n, along);
}

// How much of the colour is late wood's, 0 ..= 1: each ring grows darker to its end, where the next begins
// pale; pores draw fine lines.
fn wood_late(bands: vec3f) -> f32 {
    let ring = bands.x * WOOD_RINGS + bands.y * 1.5;
    let at = ring - floor(ring);
    let rise = at * at * (1.0 - clamp((at - 0.9) * 10.0, 0.0, 1.0));
    return clamp(rise + (bands.z - 0.5) * 1.2 + (bands.y - 0.5) * 0.6, 0.0, 1.0);
}

// The rough surface with what the pattern found. Across the grain the lobe is narrower by `anisotropy`; end grain,
// where the grain leaves the surface, has no direction.
fn wood_matte(s: Scatter) -> Matte {
    let gloss = load_material_gloss(s.material);
    // Square of the sine between grain and normal.
    let lies = min(dot(s.tangent, s.tangent), 1.0);
    let anisotropy = load_material_anisotropy(s.material) * lies;
    let around = basis_around(s.ns);
    let t = vector_unit_or(s.tangent, around.t);
    let basis = Basis(t, vector_cross(s.ns, t), s.ns);
    let widths = ggx_anisotropic_alpha(s.roughness, anisotropy);
    return Matte(basis, widths, s.roughness, anisotropy, gloss, s.color * (1.0 - gloss), vec3f(0.0));
}

// Samples `wi`. `u`: direction, `v`: which lobe; all in [0, 1 - 2^-24].
fn wood_sample(s: Scatter, wo: vec3f, u: vec2f, v: f32) -> Scattered {
    return matte_sample(s, wood_matte(s), wo, u, v);
}

// f |cos|, and the density of `wood_sample`.
fn wood_eval(s: Scatter, wo: vec3f, wi: vec3f) -> Evaluated {
    return matte_eval(s, wood_matte(s), wo, wi);
}
