// What one scattering at a rough dielectric does not give back, reflected and transmitted together, and how it is
// spread: diffusely to both sides (Kulla & Conty 2017, "Revisiting Physically Based Shading at Imageworks").
//
// Seen from side a (outside, index 1) or b (inside, index n): M_a = M + D_a, with M of white microfacets that reflect
// all (`ggx_albedo.wgsl`) and D from a table of 16 cosines x 16 roughnesses, uniform in their square roots, x 12
// indices, uniform in z = (sqrt(2 s) - 0.2204) / 0.7796 with s = (n - 1) / (n + 1): n from 1.05 to 3. A word holds
// D_a, D_b, and their means over the hemisphere. Error at most 0.01.
//
// Of what side a misses, of which the mean is m_a, the share 1 - rho_a is transmitted. That both ways carry the same
// light asks for
//   (1 - rho_a) m_a = n^2 (1 - rho_b) m_b,
// and rough glass transmits most of it: both are min(m_a, n^2 m_b).

#import "bsdf/albedo_table.wgsl"
#import "bsdf/ggx_albedo.wgsl"
#import "scene/records.wgsl"

// The rows of one surface.
struct GlassAlbedo {
    alpha: f32,
    fit: GgxAlbedo,
    roughness: AlbedoCell,
    index: AlbedoCell,
    // m of the outside and of the inside, > 0.
    mean: vec2f,
}

// The rows for perceptual `roughness`, of which `alpha` is the width, and the index `ior` >= 1.
fn glass_albedo_at(roughness: f32, alpha: f32, ior: f32, ior_minus_1: f32) -> GlassAlbedo {
    let z = (sqrt(2.0 * ior_minus_1 / (ior + 1.0)) - 0.2204) / 0.7796;
    let rows = albedo_table_cell(sqrt(roughness), 16u);
    let pages = albedo_table_cell(z, 12u);
    let fit = ggx_albedo_at(alpha * alpha);
    let mean = vec2f(fit.mean) + glass_albedo_between(AlbedoCell(0u, 0.0), rows, pages).zw;
    return GlassAlbedo(alpha, fit, rows, pages, max(mean, vec2f(1e-7)));
}

// M of outside and inside at cosine `c` > 0 to the normal of that side.
fn glass_albedo_missing(g: GlassAlbedo, c: f32) -> vec2f {
    let cosine = min(c, 1.0);
    let sine = sqrt((1.0 - cosine) * (1.0 + cosine));
    let metal = ggx_albedo_missing(g.fit, vec3f(g.alpha * sine, 0.0, cosine));
    let rest = glass_albedo_between(albedo_table_cell(sqrt(cosine), 16u), g.roughness, g.index).xy;
    return clamp(vec2f(metal) + rest, vec2f(0.0), vec2f(1.0));
}

// The shares 1 - rho of outside and inside.
fn glass_albedo_transmitted(g: GlassAlbedo, ior: f32) -> vec2f {
    let inside = (ior * ior) * g.mean.y;
    let both = min(g.mean.x, inside);
    return vec2f(both / g.mean.x, both / inside);
}

// The word between the nodes of three axes.
fn glass_albedo_between(cosine: AlbedoCell, roughness: AlbedoCell, index: AlbedoCell) -> vec4f {
    let first = load_frame_albedo_at().z;
    let at = (index.node * 16u + roughness.node) * 16u + cosine.node;
    let a = albedo_table_mix(first, at, 1u, cosine.part);
    let b = albedo_table_mix(first, at + 16u, 1u, cosine.part);
    let c = albedo_table_mix(first, at + 256u, 1u, cosine.part);
    let d = albedo_table_mix(first, at + 272u, 1u, cosine.part);
    let low = a + (b - a) * roughness.part;
    let high = c + (d - c) * roughness.part;
    return low + (high - low) * index.part;
}
