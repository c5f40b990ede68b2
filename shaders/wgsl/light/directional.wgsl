// A light at infinity: the same radiance from every direction of a cone, sampled uniformly by solid angle.
// `origin`: unit, towards its middle. `edge1`: radiance, W/(m2 sr). `edge2.x`: 1 less the cosine of the cone's half
// angle, which a cosine in single precision would not tell from 0 for narrow ones.

#import "abi/light.wgsl"
#import "light/light_sample.wgsl"
#import "math/basis.wgsl"
#import "math/disk.wgsl"
#import "math/vector.wgsl"
#import "scene/constants.wgsl"
#import "scene/records.wgsl"
#import "scene/seen.wgsl"
#import "trace/ray.wgsl"

// A direction to the light; `u` in [0, 1 - 2^-24]^2.
fn directional_light_sample(light: Light, u: vec2f) -> LightSample {
    let at = disk_concentric(u);
    let x = at.r * at.r * light.edge2.x;
    let local = vec3f(at.turn * sqrt(x * (2.0 - x)), 1.0 - x);
    let wi = vector_unit(basis_world_from_local(basis_around(light.origin), local));
    return LightSample(wi, RAY_FAR, directional_light_pdf(light), true);
}

// Density of `directional_light_sample` in any direction of the cone, per steradian.
fn directional_light_pdf(light: Light) -> f32 {
    return 1.0 / (2.0 * PI * light.edge2.x);
}

// Radiance of the light along the unit vector `dir`: by the chord between it and the middle, whose square is twice
// `1 - cos` and exact to a few bits of narrow cones.
fn directional_light_radiance(light: Light, dir: vec3f) -> vec3f {
    let chord = dir - light.origin;
    return select(vec3f(0.0), light.edge1, dot(chord, chord) <= 2.0 * light.edge2.x);
}

// Number of directional lights: those that come first in the table.
fn directional_count() -> u32 {
    let n_lights = load_frame_n_lights();
    var n = 0u;
    loop {
        if (n == n_lights) { break; }
        if (load_light_kind(n) != LIGHT_DIRECTIONAL) { break; }
        n += 1u;
    }
    return n;
}

// Sum of their probabilities in the table.
fn directional_share() -> f32 {
    let n = directional_count();
    if (n == 0u) {
        return 0.0;
    }
    return load_light_cdf(n - 1u);
}

// What a camera ray along `dir` sees of all of them.
fn directional_backdrop(dir: vec3f) -> vec3f {
    let n = directional_count();
    var radiance = vec3f(0.0);
    for (var i = 0u; i < n; i += 1u) {
        let light = load_light(i);
        if (dispatch_directional_seen(light, true)) {
            radiance += directional_light_radiance(light, dir);
        }
    }
    return radiance;
}
