// Surfaces that are cut out by an alpha texture: a point below the cutoff does not exist, for any ray.

#import "scene/constants.wgsl"
#import "scene/records.wgsl"
#import "scene/texture.wgsl"
#import "texture/texture_point.wgsl"

// Whether a surface of material `i` exists at a point.
fn alpha_exists(i: u32, at: TexturePoint) -> bool {
    if ((load_material_flags(i) & FLAG_ALPHA_CLIP) == 0u) {
        return true;
    }
    let alpha = load_material_alpha(i) * texture_alpha(load_material_alpha_texture(i), at);
    return alpha >= load_material_alpha_cutoff(i);
}

// Whether a surface of material `i` is the same everywhere, so that texture coordinates are not needed.
fn alpha_is_plain(i: u32) -> bool {
    return (load_material_flags(i) & FLAG_ALPHA_CLIP) == 0u;
}
