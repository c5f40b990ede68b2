// Radiance from a lat-long image.

#import "scene/records.wgsl"
#import "scene/texture.wgsl"
#import "sky/lat_long.wgsl"

// Radiance seen along `dir`, unit, world frame; bilinear.
fn image_radiance(dir: vec3f) -> vec3f {
    let place = lat_long_place(dir, load_sky_rotation());
    return load_sky_zenith() * texture_fetch_at(load_sky_texture(), place).xyz;
}
