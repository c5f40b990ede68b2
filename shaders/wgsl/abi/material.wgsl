// A material, 96 bytes. Colours are linear Rec. 709.
struct Material {
    // Reflectance (diffuse, metal), base colour (principled), 0 ..= 1; factor on `color_texture`.
    color: vec3<f32>,
    // `MaterialKind`.
    kind: u32,
    // Emitted radiance, W/(m2 sr) up to the scene's scale; factor on `emission_texture`.
    emission: vec3<f32>,
    // `material_flag` bits.
    flags: u32,
    // Metal: radius of the ball, 0 ..= 1.
    fuzz: f32,
    // Principled: perceptual roughness, 0 ..= 1 (alpha is its square); factor on the green channel.
    roughness: f32,
    // Principled: 0 dielectric, 1 metal; factor on the blue channel.
    metallic: f32,
    // Refractive index relative to the outside, >= 1.
    ior: f32,
    // `ior - 1` rounded once from `f64`: keeps Fresnel exact near 1.
    ior_minus_1: f32,
    // Alpha below this is not there.
    alpha_cutoff: f32,
    // Factor on the alpha texture.
    alpha: f32,
    _pad0: u32,
    // `Texture` id or `NONE`.
    color_texture: u32,
    // `Texture` id or `NONE`.
    emission_texture: u32,
    // `Texture` id or `NONE`; roughness in green, metallic in blue.
    metallic_roughness_texture: u32,
    // `Texture` id or `NONE`; alpha is read from its fourth channel.
    alpha_texture: u32,
    _pad1: vec4<u32>,
}
