// Directional lights found by rays that leave the scene, weighted against their being sampled.

#import "abi/light.wgsl"
#import "kernel/direct.wgsl"
#import "light/directional.wgsl"
#import "math/vector.wgsl"
#import "scene/dispatch_choice.wgsl"
#import "scene/links.wgsl"
#import "scene/receiver.wgsl"
#import "scene/records.wgsl"
#import "scene/seen.wgsl"

// Radiance of all directional lights along `dir` from a `receiver`, which sampled it with density `pb` per steradian,
// 0 for the camera and delta lobes. `straight`: it comes from the camera.
fn directional_miss(dir: vec3f, pb: f32, receiver: Receiver, straight: bool) -> vec3f {
    let n = directional_count();
    var radiance = vec3f(0.0);
    for (var i = 0u; i < n; i += 1u) {
        radiance += directional_found(i, dir, pb, receiver, straight);
    }
    return radiance;
}

// The same of light `index` alone.
fn directional_found(index: u32, dir: vec3f, pb: f32, receiver: Receiver, straight: bool) -> vec3f {
    let light = load_light(index);
    if (!dispatch_directional_seen(light, straight)) {
        return vec3f(0.0);
    }
    let radiance = directional_light_radiance(light, dir);
    if (vector_max(radiance) <= 0.0) {
        return radiance;
    }
    if (!links_joined(index, receiver_links(receiver))) {
        return vec3f(0.0);
    }
    return radiance * directional_weight(index, light, pb);
}

// As `direct_sky_weight`, for directional light `index`, which `dir` has found.
fn directional_weight(index: u32, light: Light, pb: f32) -> f32 {
    if (pb <= 0.0 || load_frame_estimator() == DIRECT_BSDF_ONLY) {
        return 1.0;
    }
    if (load_frame_estimator() == DIRECT_LIGHT_ONLY) {
        return 0.0;
    }
    return pb / direct_divisor(pb, dispatch_sky_pmf(index) * directional_light_pdf(light));
}
