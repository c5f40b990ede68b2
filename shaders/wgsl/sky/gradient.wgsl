// Three bands of colour by elevation, and a glow and a disc around one direction.

#import "math/exp_log.wgsl"
#import "scene/records.wgsl"

// Radiance seen along `dir`, unit, world frame; y is up.
// The bands are cubic ramps in the sine of the elevation: ground to horizon over blend_ground ..=
// blend_low, horizon to middle over blend_low ..= blend_high, middle to zenith over blend_high ..= 1. Each is
// 3t^2 - 2t^3, so colours join without a kink.
fn gradient_radiance(dir: vec3f) -> vec3f {
    let sky = load_sky();
    let y = clamp(dir.y, -1.0, 1.0);
    var base: vec3f;
    if (y >= sky.blend_high) {
        base = gradient_ramp(sky.middle, sky.zenith, sky.blend_high, 1.0, y);
    } else if (y >= sky.blend_low) {
        base = gradient_ramp(sky.horizon, sky.middle, sky.blend_low, sky.blend_high, y);
    } else {
        base = gradient_ramp(sky.ground, sky.horizon, sky.blend_ground, sky.blend_low, y);
    }
    let c = clamp(dot(dir, sky.sun_direction), 0.0, 1.0);
    return base + sky.glow * exp_log_pow(c, sky.glow_power) + sky.disc * exp_log_pow(c, sky.disc_power);
}

// From `a` at `y0` to `b` at `y1`; a band without height is `b`.
fn gradient_ramp(a: vec3f, b: vec3f, y0: f32, y1: f32, y: f32) -> vec3f {
    if (y1 <= y0) {
        return b;
    }
    let t = clamp((y - y0) / (y1 - y0), 0.0, 1.0);
    let k = t * t * (3.0 - 2.0 * t);
    return a * (1.0 - k) + b * k;
}
