// Parameters of a principled surface that few scenes use, textures applied: read from the record where they
// are needed, so that the others do not carry them.

#import "bsdf/scatter.wgsl"
#import "math/vector.wgsl"
#import "scene/records.wgsl"
#import "scene/texture.wgsl"

// Colour and factor of the reflectance of the dielectric part.
fn layers_specular(s: Scatter) -> vec4f {
    let texel = texture_fetch(load_material_specular_texture(s.material), s.at);
    return vec4f(load_material_tint(s.material), load_material_specular(s.material)) * texel;
}

// Share of the light entering that goes through.
fn layers_transmission(s: Scatter) -> f32 {
    let share = load_material_transmission(s.material);
    if (share <= 0.0) {
        return 0.0;
    }
    return share * texture_fetch(load_material_transmission_texture(s.material), s.at).x;
}

// Colour of the sheen, and the perceptual roughness of its fibres.
fn layers_sheen(s: Scatter) -> vec4f {
    let color = load_material_sheen(s.material);
    if (vector_max(color) <= 0.0) {
        return vec4f(0.0);
    }
    let texel = texture_fetch(load_material_sheen_texture(s.material), s.at);
    return vec4f(color, load_material_sheen_roughness(s.material)) * texel;
}

// Share under a clear coat, and the perceptual roughness of that coat.
fn layers_coat(s: Scatter) -> vec2f {
    let share = load_material_coat(s.material);
    if (share <= 0.0) {
        return vec2f(0.0, 1.0);
    }
    let texel = texture_fetch(load_material_coat_texture(s.material), s.at);
    return vec2f(share * texel.x, load_material_coat_roughness(s.material) * texel.y);
}
