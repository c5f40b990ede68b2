// A triangle that emits, sampled uniformly by area.

#import "abi/light.wgsl"
#import "light/flat.wgsl"
#import "light/light_sample.wgsl"

// A direction from `p` to a uniform point of the triangle; `u` in [0, 1 - 2^-24]^2.
// Heitz 2019, "A Low-Distortion Map Between Triangle and Square": strata stay compact, no root.
fn triangle_light_sample(light: Light, p: vec3f, u: vec2f) -> LightSample {
    let half_u = 0.5 * u;
    let b = select(vec2f(u.x - half_u.y, half_u.y), vec2f(half_u.x, u.y - half_u.x), u.y > u.x);
    return flat_light_sample(light, p, light.origin + light.edge1 * b.x + light.edge2 * b.y);
}

// Density of `triangle_light_sample` towards the light's point at `x` from `p`, per steradian.
fn triangle_light_pdf(light: Light, p: vec3f, x: vec3f, cos_l: f32) -> f32 {
    return flat_light_pdf(light, p, x, cos_l);
}
