// A material, 192 bytes: one record for all kinds; a field that a kind does not name is not
// read by it. Colours are linear Rec. 709, lengths and coefficients in normalised units.
struct Material {
    // Reflectance (diffuse, metal), reflectance at normal incidence (conductor), base colour (principled,
    // clearcoat), 0 ..= 1; factor on `color_texture`.
    color: vec3<f32>,
    // `MaterialKind`.
    kind: u32,
    // Emitted radiance, W/(m2 sr) up to the scene's scale; factor on `emission_texture`.
    emission: vec3<f32>,
    // `material_flag` bits.
    flags: u32,
    // Radius of the ball of a mirror direction, 0 ..= 1. Wood: the grain, 1/6 y, 1/2 x, 5/6 z.
    fuzz: f32,
    // Perceptual roughness, 0 ..= 1 (alpha is its square); factor on the green channel.
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
    // How much narrower the lobe is along the tangent than across it, 0 ..= 1. Wood: across the
    // grain than along it.
    anisotropy: f32,
    // `Texture` id or `NONE`.
    color_texture: u32,
    // `Texture` id or `NONE`.
    emission_texture: u32,
    // `Texture` id or `NONE`; roughness in green, metallic in blue.
    metallic_roughness_texture: u32,
    // `Texture` id or `NONE`; alpha is read from its fourth channel.
    alpha_texture: u32,
    // `Texture` id or `NONE`; a tangent-space normal in red, green, blue.
    normal_texture: u32,
    // Factor on the x and y of `normal_texture`.
    normal_strength: f32,
    // Index of the `Medium` inside, or `NONE`.
    medium: u32,
    // Which of two overlapping media counts: the greater.
    priority: u32,
    // Second colour: what a coat reflects, the specular colour, veins of stone, late wood.
    tint: vec3<f32>,
    // Share of a second lobe: surface fuzz, translucency. Conductor: 1 with the light of several
    // reflections, 0 without.
    weight: f32,
    // Stretches a pattern: pattern coordinates are metres of the object times this.
    pattern_scale: f32,
    // Step of the differences that tilt the normal, metres of the object.
    bump_step: f32,
    // Height of the bumps, metres of the object. Water: factor on the slopes of the waves.
    bump_height: f32,
    // Share of light that a rough surface reflects as gloss.
    gloss: f32,
    // Absorption inside a sheet, per unit of `thickness`.
    sigma_a: vec3<f32>,
    // Scattering inside a sheet, per unit of `thickness`.
    sigma_s: f32,
    // Mean cosine of scattering inside a sheet, -1 ..= 1.
    g: f32,
    // Thickness of a sheet at its edge.
    thickness_edge: f32,
    // Thickness of a sheet in its middle.
    thickness_middle: f32,
    // Share of the light through a sheet that goes on forward.
    forward: f32,
    // Principled: factor on the reflectance of the dielectric part. Clearcoat: mean reflectance of the
    // coat for diffuse light from within.
    specular: f32,
    // Principled: share of the surface under a clear coat.
    coat: f32,
    // Principled: perceptual roughness of that coat.
    coat_roughness: f32,
    // Principled: share of the light entering that is refracted, not diffused.
    transmission: f32,
    // `Texture` id or `NONE`; specular colour in red, green, blue, factor in alpha.
    specular_texture: u32,
    // `Texture` id or `NONE`; coat in red, its roughness in green.
    coat_texture: u32,
    // `Texture` id or `NONE`; transmission in red.
    transmission_texture: u32,
    _pad0: u32,
}
