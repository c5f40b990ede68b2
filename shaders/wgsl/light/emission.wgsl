// The radiance that a material sends out, seen directly or through a light sample.

#import "scene/constants.wgsl"
#import "scene/texture.wgsl"
#import "texture/texture_point.wgsl"

// Radiance of a surface with emission `emission`, material flags `flags` and emission texture `image` at
// a point, on its front or back side. W/(m2 sr) up to the scene's scale.
fn emission_radiance(emission: vec3f, flags: u32, image: u32, at: TexturePoint, front: bool) -> vec3f {
    if (!front && (flags & FLAG_EMIT_BOTH_SIDES) == 0u) {
        return vec3f(0.0);
    }
    return emission * texture_fetch(image, at).xyz;
}
