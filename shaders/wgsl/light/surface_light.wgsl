// Radiance of a light that is a surface.

#import "abi/light.wgsl"
#import "light/emission.wgsl"
#import "light/light_sample.wgsl"
#import "scene/dispatch_light.wgsl"
#import "scene/dispatch_tint.wgsl"
#import "scene/records.wgsl"

// Radiance of `light` at its sample `to` from `p`.
fn surface_light_radiance(light: Light, p: vec3f, to: LightSample) -> vec3f {
    let i = light.material;
    let at = dispatch_light_texture_point(light, p + to.wi * to.t);
    if (!dispatch_light_exists(i, at)) {
        return vec3f(0.0);
    }
    let image = load_material_emission_texture(i);
    let flags = load_material_flags(i);
    let radiance = emission_radiance(load_material_emission(i), flags, image, at, to.front);
    return dispatch_light_tint(radiance, flags, light, to.wi);
}
