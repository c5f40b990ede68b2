// A parallelogram that emits, sampled uniformly by area.

#import "abi/light.wgsl"
#import "light/flat.wgsl"
#import "light/light_sample.wgsl"

// A direction from `p` to a uniform point of the parallelogram; `u` in [0, 1 - 2^-24]^2.
fn rectangle_light_sample(light: Light, p: vec3f, u: vec2f) -> LightSample {
    return flat_light_sample(light, p, light.origin + light.edge1 * u.x + light.edge2 * u.y);
}

// Density of `rectangle_light_sample` towards the light's point at `x` from `p`, per steradian.
fn rectangle_light_pdf(light: Light, p: vec3f, x: vec3f, cos_l: f32) -> f32 {
    return flat_light_pdf(light, p, x, cos_l);
}
