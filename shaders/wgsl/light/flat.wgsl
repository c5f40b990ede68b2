// What flat lights share: area density turned into density per steradian. The front side is that of
// cross(edge1, edge2).

#import "abi/light.wgsl"
#import "light/light_sample.wgsl"
#import "math/vector.wgsl"

// The sample at the light's point `x` seen from `p`.
fn flat_light_sample(light: Light, p: vec3f, x: vec3f) -> LightSample {
    let v = x - p;
    let d2 = dot(v, v);
    if (d2 < 1.1754944e-38) {
        return light_sample_none();
    }
    let t = sqrt(d2);
    let wi = v / t;
    let n = vector_unit_or(vector_cross(light.edge1, light.edge2), -wi);
    let cos_l = -dot(n, wi);
    return LightSample(wi, t, flat_light_pdf(light, p, x, cos_l), cos_l > 0.0);
}

// Distance squared over area and cosine; 0 edge-on, where the light is not visible. `cos_l`: of either sign.
fn flat_light_pdf(light: Light, p: vec3f, x: vec3f, cos_l: f32) -> f32 {
    let v = x - p;
    let seen = light.area * abs(cos_l);
    if (seen <= 0.0) {
        return 0.0;
    }
    return dot(v, v) / seen;
}
