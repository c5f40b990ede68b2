// The same radiance from everywhere.

#import "scene/records.wgsl"

// Radiance seen in any direction.
fn constant_radiance() -> vec3f {
    return load_sky_zenith();
}
