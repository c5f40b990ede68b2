// A spherical light, sampled uniformly over the cone in which it is visible.
// Whole-sphere sampling is twice too bright or 90 times noisier; see Shirley, Wang & Zimmerman 1996.

#import "abi/light.wgsl"
#import "light/light_sample.wgsl"
#import "math/basis.wgsl"
#import "math/disk.wgsl"
#import "math/vector.wgsl"

// 1 - cos of the cone's half angle from `p`; 0 inside or on the light, where it is not sampled: there every
// direction hits it. 1 - sqrt(1 - x) would be 7 % wrong at 1e-3 rad.
fn sphere_light_cone(light: Light, p: vec3f) -> f32 {
    let v = light.origin - p;
    let d2 = dot(v, v);
    let r2 = light.edge1.x * light.edge1.x;
    if (d2 * 0.99999 <= r2) {
        return 0.0;
    }
    let s2 = r2 / d2;
    return s2 / (1.0 + sqrt(1.0 - s2));
}

// A direction from `p` to the light; `u` in [0, 1 - 2^-24]^2.
fn sphere_light_sample(light: Light, p: vec3f, u: vec2f) -> LightSample {
    let omc = sphere_light_cone(light, p);
    if (omc <= 0.0) {
        return light_sample_none();
    }
    let at = disk_concentric(u);
    let x = at.r * at.r * omc;
    let cos_t = 1.0 - x;
    let sin2_t = x * (2.0 - x);
    let v = light.origin - p;
    let d2 = dot(v, v);
    let distance = sqrt(d2);
    let wi = vector_unit(basis_world_from_local(basis_around(v / distance), vec3f(at.turn * sqrt(sin2_t), cos_t)));
    let chord = light.edge1.x * light.edge1.x - d2 * sin2_t;
    let t = distance * cos_t - sqrt(max(chord, 0.0));
    return LightSample(wi, t, 1.0 / (2.0 * PI * omc), true);
}

// Density of `sphere_light_sample` in any direction from `p` that hits the light, per steradian.
fn sphere_light_pdf(light: Light, p: vec3f) -> f32 {
    let omc = sphere_light_cone(light, p);
    if (omc <= 0.0) {
        return 0.0;
    }
    return 1.0 / (2.0 * PI * omc);
}
