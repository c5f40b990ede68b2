// Lights of which a share is there. A ray that was sampled by scattering meets the share alpha of them by chance; a
// light sample counts that share of the radiance.

#import "abi/light.wgsl"
#import "light/light_sample.wgsl"
#import "scene/dispatch_light.wgsl"
#import "trace/coverage.wgsl"

// The share of `light`, which is flat, at its sample `to` from `p`, 0 ..= 1. Spheres of partial coverage are no lights.
fn light_coverage(light: Light, p: vec3f, to: LightSample) -> f32 {
    if (!coverage_is_partial(light.material)) {
        return 1.0;
    }
    return coverage_at(light.material, dispatch_light_texture_point(light, p + to.wi * to.t));
}
