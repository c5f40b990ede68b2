// Water: a smooth dielectric whose normal three trains of sine waves tilt, each the product of two.
// The object's x and z, in metres, say where on a wave a point is; only faces that look up have waves.

#import "bsdf/dielectric.wgsl"
#import "bsdf/scatter.wgsl"
#import "math/sincos.wgsl"
#import "math/vector.wgsl"
#import "scene/records.wgsl"
#import "surface/surface.wgsl"

// Samples `wi`, as `dielectric_sample` does: reflection stays above the geometric surface.
fn water_sample(s: Scatter, wo: vec3f, u: f32) -> Scattered {
    var waved = s;
    waved.ns = water_normal(s, wo);
    return dielectric_sample(waved, wo, u);
}

// Nothing, as for any delta.
fn water_eval() -> Evaluated {
    return scatter_nothing();
}

// Normal of the waves on the side of `wo`, unit.
fn water_normal(s: Scatter, wo: vec3f) -> vec3f {
    let height = load_material_bump_height(s.material);
    let up = select(-s.ns, s.ns, s.front);
    // All of it up to 41 degrees of slope, none from 60 degrees.
    let share = clamp(4.0 * up.y - 2.0, 0.0, 1.0);
    if (height <= 0.0 || share <= 0.0) {
        return s.ns;
    }
    let slope = water_slope(s.place.q.xz * load_material_pattern_scale(s.material)) * (height * share);
    // The directions of the surface along x and z: `up` is far from both.
    let t = vector_unit(vec3f(up.y, -up.x, 0.0));
    let b = vector_unit(vec3f(0.0, -up.z, up.y));
    let n = vector_unit(up + t * slope.x + b * slope.y);
    return surface_shading_normal(s.ng, n, -wo);
}

// How far the normal leans along x and along z, both at most 0.034, at `p`: long waves lean most.
fn water_slope(p: vec2f) -> vec2f {
    let low = water_train(p, vec4f(0.58887321, 0.36605634, 0.65253523, -0.27056340), vec2f(0.0));
    let middle = water_train(p, vec4f(1.1300000, 0.84352114, 1.3050705, -0.62070421), vec2f(0.11140846, 0.17507043));
    let high = water_train(p, vec4f(2.1326762, 1.5438029, 1.8780283, -1.1459156), vec2f(0.20690143, 0.063661977));
    return vec2f(
        low.x * (low.y * 0.022) + middle.x * (middle.y * 0.009) + high.x * (high.y * 0.003),
        low.x * (low.y * 0.0154) + middle.x * (middle.y * 0.0072) + high.x * (high.y * 0.0027),
    );
}

// (sine, cosine) of a train's two phases. `k`: turns per unit of `p`, x and z of the sine, z and x of the
// cosine; `begin`: turns at the origin. Whole turns are taken off first, so that far from the origin the
// waves are still waves.
fn water_train(p: vec2f, k: vec4f, begin: vec2f) -> vec2f {
    let sine = (begin.x + p.x * k.x) + p.y * k.y;
    let cosine = (begin.y + p.y * k.z) + p.x * k.w;
    return vec2f(sincos_2pi(water_fraction(sine)).x, sincos_2pi(water_fraction(cosine)).y);
}

// The part of `turns` that is not whole, 0 ..= 1.
fn water_fraction(turns: f32) -> f32 {
    return clamp(turns - floor(turns), 0.0, 1.0);
}
