// A petal: fuzz on the surface, a waxy skin, and a thin slab that scatters light under it.
//   fuzz   q ball(radius fuzz)                     q: share of the fuzz
//   wax    (1 - q) (F(cos_o) + (1 - F(cos_o)) color back) ball(radius roughness)
//   slab   (1 - q) (1 - F(cos_o)) color (through + scattered)
// `through` and `back` cross the slab unscattered; what its far side mirrors comes back by the same skin as what
// the near side does, and is as blurred. As a mirror it would be light that no shadow ray finds.
// A ball is the lobe of `metal.wgsl`, and what would go below the horizon is mirrored at it: each lobe integrates to
// its share, and a white petal reflects and lets through all it gets.
// Light that goes through the slab unscattered keeps its direction: a delta lobe, and what a shadow ray finds.
// The value of `petal_eval` is an unbiased estimate. `petal_sample` leaves the slab as a random walk does, with a
// density that nobody knows; `petal_density` stands in for it where light samples and directions share their weights,
// which sum to 1 for any function of the direction. The weight of a sample is what the walk brings, not that value
// over the density.
// Only the slab is reciprocal: the lobes of fuzz and wax are not.

#import "bsdf/fresnel.wgsl"
#import "bsdf/hg.wgsl"
#import "bsdf/metal.wgsl"
#import "bsdf/scatter.wgsl"
#import "bsdf/slab.wgsl"
#import "bsdf/slab_exit.wgsl"
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
    let d = s.at.uv * 2.0 - vec2f(1.0);
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
    if (v >= skin) {
        let first = clamp((v - (skin + p.through)) / max(p.slab, 1e-7), 0.0, 0.99999994);
        return petal_sample_slab(s, slab, p, wo, u, vec2f(first, w));
    }
    let fuzzy = v < p.fuzz;
    let wi = petal_ball_direction(s, wo, petal_radius(select(s.roughness, s.fuzz, fuzzy)), u, w);
    let pdf = petal_density(s, slab, p, wo, wi);
    if (pdf <= 0.0 || !scatter_above(s, wi)) {
        return scatter_absorb();
    }
    if (fuzzy) {
        return Scattered(wi, pdf, vec3f(1.0), 1.0);
    }
    return Scattered(wi, pdf, petal_wax(s, slab, wo) / p.wax, 1.0);
}

// The same for the share of the slab. `u`: how light scatters first, `v`: where.
fn petal_sample_slab(s: Scatter, slab: Slab, p: PetalShares, wo: vec3f, u: vec2f, v: vec2f) -> Scattered {
    let basis = basis_around(-s.ns);
    let exit = slab_exit_sample(slab, basis_local_from_world(basis, wo), u, v, s.key);
    if (vector_max(exit.share) <= 0.0) {
        return scatter_absorb();
    }
    let wi = vector_unit(basis_world_from_local(basis, exit.dir));
    let pdf = petal_density(s, slab, p, wo, wi);
    if (pdf <= 0.0 || !(scatter_above(s, wi) || scatter_below(s, wi))) {
        return scatter_absorb();
    }
    let inner = (1.0 - load_material_weight(s.material)) * (1.0 - petal_fresnel(s, wo));
    // The share is what all others leave; where that is next to nothing, rounding is in it.
    let least = inner * vector_max(slab_entry(slab, min(dot(s.ns, wo), 1.0)).share);
    return Scattered(wi, pdf, s.color * exit.share * (inner / max(p.slab, least)), 1.0);
}

// f |cos|, an unbiased estimate, and the density that stands for that of `petal_sample`; what goes through unscattered
// left out.
fn petal_eval(s: Scatter, wo: vec3f, wi: vec3f) -> Evaluated {
    let slab = petal_slab(s);
    let p = petal_shares(s, slab, wo);
    let pdf = petal_density(s, slab, p, wo, wi);
    let above = scatter_above(s, wi);
    var sum = vec3f(0.0);
    if (above) {
        let wax = petal_wax(s, slab, wo) * petal_ball(s, wo, wi, petal_radius(s.roughness));
        sum = vec3f(p.fuzz * petal_ball(s, wo, wi, petal_radius(s.fuzz))) + wax;
    }
    if (above || scatter_below(s, wi)) {
        let basis = basis_around(-s.ns);
        let o = basis_local_from_world(basis, wo);
        let i = basis_local_from_world(basis, wi);
        let inner = (1.0 - p.fuzz) * (1.0 - petal_fresnel(s, wo));
        sum += s.color * slab_scattered(slab, o, i, s.key) * inner;
    }
    return Evaluated(sum, pdf);
}

// Density that stands for that of `petal_sample`, per steradian of `wi`, the delta left out: exact for fuzz and wax;
// for the slab half of it as even as Lambert's on both sides, and half forward.
fn petal_density(s: Scatter, slab: Slab, p: PetalShares, wo: vec3f, wi: vec3f) -> f32 {
    var skin = 0.0;
    if (dot(s.ns, wi) > 0.0) {
        skin = p.fuzz * petal_ball(s, wo, wi, petal_radius(s.fuzz))
            + p.wax * petal_ball(s, wo, wi, petal_radius(s.roughness));
    }
    let even = abs(dot(s.ns, wi)) * (0.5 * INV_PI);
    return skin + 0.5 * p.slab * (hg_pdf(-wo, slab.g, wi) + even);
}

// What the skin reflects, and the far side of the slab.
fn petal_wax(s: Scatter, slab: Slab, wo: vec3f) -> vec3f {
    let f = petal_fresnel(s, wo);
    let back = s.color * slab_passage(slab, min(dot(s.ns, wo), 1.0)).back;
    return (vec3f(f) + back * (1.0 - f)) * (1.0 - load_material_weight(s.material));
}

// A direction of the lobe of radius `radius`, above the shading normal. `u`, `v`: as in `metal_sample`.
fn petal_ball_direction(s: Scatter, wo: vec3f, radius: f32, u: vec2f, v: f32) -> vec3f {
    let d = metal_direction(scatter_mirror(s, wo), radius, u, v);
    return metal_folded(d, s.ns);
}

// Density of `petal_ball_direction` for `wi` above the shading normal: that of `wi` and of its image below.
fn petal_ball(s: Scatter, wo: vec3f, wi: vec3f, radius: f32) -> f32 {
    return metal_folded_density(wi, scatter_mirror(s, wo), s.ns, radius);
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
