// A petal: fuzz on the surface, a waxy skin, and a thin slab that scatters light under it.
//   fuzz   q metal_density(radius fuzz)                     q: share of the fuzz
//   wax    (1 - q) (F(cos_o) + (1 - F(cos_o)) color back) metal_density(radius roughness)
//   slab   (1 - q) (1 - F(cos_o)) color (through + scattered)
// `through` and `back` cross the slab unscattered; what its far side mirrors comes back by the same skin as what
// the near side does, and is as blurred. As a mirror it would be light that no shadow ray finds.
// Each lobe integrates to its share at most, so a white petal reflects and lets through all it gets, less what
// the first two lobes lose at the horizon. The slab is found by a random walk (`slab.wgsl`), so `petal_eval` is
// an unbiased estimate; the density of `petal_sample` is exact. Light that goes through the slab unscattered keeps
// its direction: a delta lobe, and what a shadow ray finds.
// Only the slab is reciprocal: the lobes of fuzz and wax are those of `metal.wgsl`.

#import "bsdf/diffuse.wgsl"
#import "bsdf/fresnel.wgsl"
#import "bsdf/hg.wgsl"
#import "bsdf/metal.wgsl"
#import "bsdf/scatter.wgsl"
#import "bsdf/slab.wgsl"
#import "math/basis.wgsl"
#import "math/vector.wgsl"
#import "scene/records.wgsl"

// How a petal divides the light from one direction. All are shares; their sum is 1.
struct PetalShares {
    fuzz: f32,
    // Both sides of the slab.
    wax: f32,
    // Through the slab, unscattered.
    through: f32,
    // Scattered in the slab, or absorbed.
    slab: f32,
}

// The slab under the point: thin at the rim of the texture's square, thicker in its middle.
fn petal_slab(s: Scatter) -> Slab {
    // -1 ..= 1 in the square; the rim begins at 0.9.
    let d = s.uv * 2.0 - vec2f(1.0);
    let r = clamp(sqrt(dot(d, d)) / 0.9, 0.0, 1.0);
    let rim = r * r * (3.0 - 2.0 * r);
    let edge = load_material_thickness_edge(s.material);
    let thickness = edge * rim + load_material_thickness_middle(s.material) * (1.0 - rim);
    let sigma_s = load_material_sigma_s(s.material);
    let tau = (load_material_sigma_a(s.material) + vec3f(sigma_s)) * thickness;
    return Slab(tau, sigma_s * thickness, load_material_g(s.material), s.ior, s.ior_minus_1);
}

// Share that the skin reflects.
fn petal_fresnel(s: Scatter, wo: vec3f) -> f32 {
    return fresnel_dielectric(min(dot(s.ns, wo), 1.0), s.ior, s.ior_minus_1);
}

// The shares for light from `wo`.
fn petal_shares(s: Scatter, slab: Slab, wo: vec3f) -> PetalShares {
    let fuzz = load_material_weight(s.material);
    let f = petal_fresnel(s, wo);
    let passage = slab_passage(slab, min(dot(s.ns, wo), 1.0));
    let inner = (1.0 - fuzz) * (1.0 - f);
    let through = inner * vector_max(passage.through);
    // `min` keeps the sum of the shares from being regrouped.
    let back = min(inner * vector_max(passage.back), inner);
    return PetalShares(fuzz, (1.0 - fuzz) * f + back, through, max(inner - back - through, 0.0));
}

// Samples `wi`. `u`: direction, `v`: which lobe, `w`: radius in the ball; all in [0, 1 - 2^-24].
fn petal_sample(s: Scatter, wo: vec3f, u: vec2f, v: f32, w: f32) -> Scattered {
    let slab = petal_slab(s);
    let p = petal_shares(s, slab, wo);
    let skin = p.fuzz + p.wax;
    if (v >= skin && v < skin + p.through) {
        return Scattered(-wo, 0.0, petal_through(s, wo) / p.through, 1.0);
    }
    var wi: vec3f;
    if (v < skin) {
        let radius = select(s.roughness, s.fuzz, v < p.fuzz);
        wi = metal_direction(scatter_mirror(s, wo), petal_radius(radius), u, w);
    } else if (w < 0.5) {
        wi = hg_sample(-wo, slab.g, u);
    } else {
        let side = select(s.ns, -s.ns, w < 0.75);
        wi = diffuse_direction(side, u);
    }
    let pdf = petal_pdf(s, wo, wi);
    if (pdf <= 0.0) {
        return scatter_absorb();
    }
    return Scattered(wi, pdf, petal_eval(s, wo, wi) / pdf, 1.0);
}

// f |cos|, what goes through unscattered left out; an unbiased estimate.
fn petal_eval(s: Scatter, wo: vec3f, wi: vec3f) -> vec3f {
    let slab = petal_slab(s);
    let fuzz = load_material_weight(s.material);
    let f = petal_fresnel(s, wo);
    let above = scatter_above(s, wi);
    let basis = basis_around(-s.ns);
    let o = basis_local_from_world(basis, wo);
    let i = basis_local_from_world(basis, wi);
    var sum = vec3f(0.0);
    if (above) {
        let r = scatter_mirror(s, wo);
        let back = s.color * slab_passage(slab, min(dot(s.ns, wo), 1.0)).back;
        let wax = (vec3f(f) + back * (1.0 - f)) * ((1.0 - fuzz) * metal_density(wi, r, petal_radius(s.roughness)));
        sum = vec3f(fuzz * metal_density(wi, r, petal_radius(s.fuzz))) + wax;
    }
    if (above || (i.z > 0.0 && dot(wi, s.ng) < 0.0)) {
        sum += s.color * slab_scattered(slab, o, i, s.key) * ((1.0 - fuzz) * (1.0 - f));
    }
    return sum;
}

// Density of `petal_sample`, per steradian of `wi`, the delta left out.
fn petal_pdf(s: Scatter, wo: vec3f, wi: vec3f) -> f32 {
    let slab = petal_slab(s);
    let p = petal_shares(s, slab, wo);
    let r = scatter_mirror(s, wo);
    let fuzz = p.fuzz * metal_density(wi, r, petal_radius(s.fuzz));
    let wax = p.wax * metal_density(wi, r, petal_radius(s.roughness));
    let even = abs(dot(s.ns, wi)) * (0.5 * INV_PI);
    return fuzz + wax + 0.5 * p.slab * (hg_pdf(-wo, slab.g, wi) + even);
}

// What a ray keeps that goes straight through, from either side.
fn petal_through(s: Scatter, wo: vec3f) -> vec3f {
    let passage = slab_passage(petal_slab(s), min(dot(s.ns, wo), 1.0));
    let inner = (1.0 - load_material_weight(s.material)) * (1.0 - petal_fresnel(s, wo));
    return s.color * passage.through * inner;
}

// The ball's radius: not so small that the lobe would be a delta.
fn petal_radius(radius: f32) -> f32 {
    return max(radius, METAL_SMOOTH);
}
