// Metallic-roughness: a GGX lobe over a Lambert base.
//   f = F(wo.h) D G2 / (4 cos_o cos_i) + (1 - t) (1 - metallic) color / pi (1 - E(cos_o)) (1 - E(cos_i))
// with Schlick's F from f0 = color for a metal, w c ((ior - 1) / (ior + 1))^2 for a dielectric, to 1 and w: w and c
// are the specular factor and colour, 1 unless a material says otherwise. E is F with the largest channel
// of c, so that what a tinted interface does not reflect does not tint the base. t, the share that goes
// through a thin sheet, is what `thin.wgsl` adds on the other side.
// Reciprocal: both terms are symmetric in wo and wi.
// Energy: let s = (1 - cos_o)^5 and A the mean of (1 - wo.h)^5 over the visible normals. For w = 1 the base reflects
// (1 - f0)^2 (20 / 21) (1 - s) at most, the lobe G (f0 + (1 - f0) A) with G <= 1 the unmasked share; their sum
// is at most 1 where G A <= 1/21 + (20/21) s. That holds at both ends: A = s for a mirror, G A <= E / 10 with
// E = 1 - ln 2 at normal incidence for alpha = 1. In between it was measured: 1,320 combinations of roughness
// 0 ..= 1, metallic 0 ..= 1, ior 1 ..= 4 and cosine 0.005 ..= 1, white, reflect at most 1 within three standard errors.
// For other w the sum is 1 + w (L - a - b) + w^2 a b with L, a, b that do not depend on w: convex, and at most 1
// at both ends.

#import "bsdf/diffuse.wgsl"
#import "bsdf/fresnel.wgsl"
#import "bsdf/gloss.wgsl"
#import "bsdf/scatter.wgsl"
#import "math/vector.wgsl"
#import "scene/layers.wgsl"

// What a surface is made of, textures applied.
struct Principled {
    // Reflectance of the interface at normal incidence.
    f0: vec3f,
    // At grazing incidence.
    f90: f32,
    // `f0` of the interface where it lets light in: without the hue of the specular colour.
    entry: vec3f,
    // Width of the lobe.
    alpha: f32,
    // Colour of the base, less what is metal or goes through.
    base: vec3f,
    // Colour of what goes through, less what is metal or scattered.
    clear: vec3f,
    // Share under a clear coat, and the width of its lobe.
    coat: vec2f,
}

// What the surface at `s` is made of.
fn principled_at(s: Scatter) -> Principled {
    let r = s.ior_minus_1 / (s.ior + 1.0);
    let dielectric = 1.0 - s.metallic;
    let specular = dispatch_specular(s);
    let metal = s.color * s.metallic;
    let f0 = min(specular.xyz * (r * r), vec3f(1.0)) * (specular.w * dielectric) + metal;
    let entry = min(vector_max(specular.xyz) * (r * r), 1.0) * (specular.w * dielectric);
    let through = dispatch_transmission(s);
    let inside = s.color * dielectric;
    return Principled(
        f0, specular.w * dielectric + s.metallic, vec3f(entry) + metal,
        gloss_alpha(s.roughness), inside * (1.0 - through), inside * through, dispatch_coat(s),
    );
}

// Share of light that the interface reflects at cosine `c`.
fn principled_fresnel(p: Principled, c: f32) -> vec3f {
    return fresnel_schlick_to(p.f0, p.f90, c);
}

// Share of light that the interface keeps from entering at cosine `c`.
fn principled_entry(p: Principled, c: f32) -> vec3f {
    return fresnel_schlick_to(p.entry, p.f90, c);
}

// Share of the base that gets through the interface at cosine `c`, times its colour.
fn principled_base(p: Principled, c: f32) -> vec3f {
    return p.base * (vec3f(1.0) - principled_entry(p, c));
}

// Probability of sampling the lobe rather than the base. A function of wo alone, so that both sides of
// multiple importance sampling see the same density.
fn principled_lobe_share(p: Principled, cos_o: f32) -> f32 {
    let lobe = vector_max(principled_fresnel(p, cos_o));
    let base = vector_max(principled_base(p, cos_o));
    if (base <= 0.0) {
        return 1.0;
    }
    return clamp(lobe / (lobe + base), 0.1, 0.9);
}

// A direction to scatter into. `u`: direction, `v`: which lobe; all in [0, 1 - 2^-24]. Deltas have their weight;
// for others, whose `pdf` is 1 here, value and density are worked out behind all layers.
fn principled_direction(s: Scatter, p: Principled, wo: vec3f, u: vec2f, v: f32) -> Scattered {
    let cos_o = dot(s.ns, wo);
    if (cos_o <= 0.0) {
        return scatter_absorb();
    }
    let share = principled_lobe_share(p, cos_o);
    var wi: vec3f;
    if (v >= share) {
        wi = diffuse_direction(s.ns, u);
    } else if (p.alpha < GLOSS_SMOOTH) {
        return Scattered(scatter_mirror(s, wo), 0.0, principled_fresnel(p, cos_o) / share, 1.0);
    } else {
        wi = gloss_sample(s.ns, wo, p.alpha, u);
    }
    if (!scatter_above(s, wi)) {
        return scatter_absorb();
    }
    return scatter_toward(wi);
}

// f |cos|, the mirror part left out.
fn principled_eval(s: Scatter, p: Principled, wo: vec3f, wi: vec3f) -> vec3f {
    if (dot(s.ns, wo) <= 0.0 || !scatter_above(s, wi)) {
        return vec3f(0.0);
    }
    return principled_value(s, p, wo, wi);
}

// Density of `wi` over both lobes, per steradian, the mirror part left out.
fn principled_pdf(s: Scatter, p: Principled, wo: vec3f, wi: vec3f) -> f32 {
    if (dot(s.ns, wo) <= 0.0 || dot(s.ns, wi) <= 0.0) {
        return 0.0;
    }
    return principled_density(s, p, wo, wi);
}

// `principled_eval` for directions above the surface.
fn principled_value(s: Scatter, p: Principled, wo: vec3f, wi: vec3f) -> vec3f {
    let cos_i = dot(s.ns, wi);
    let in_and_out = principled_base(p, dot(s.ns, wo)) * (vec3f(1.0) - principled_entry(p, cos_i));
    let base = in_and_out * (cos_i * INV_PI);
    if (p.alpha < GLOSS_SMOOTH) {
        return base;
    }
    return base + principled_fresnel(p, gloss_cosine(wo, wi)) * gloss_eval(s.ns, wo, wi, p.alpha);
}

// `principled_pdf` where `wo` is above the surface.
fn principled_density(s: Scatter, p: Principled, wo: vec3f, wi: vec3f) -> f32 {
    let cos_i = dot(s.ns, wi);
    if (cos_i <= 0.0) {
        return 0.0;
    }
    let share = principled_lobe_share(p, dot(s.ns, wo));
    let base = (1.0 - share) * (cos_i * INV_PI);
    if (p.alpha < GLOSS_SMOOTH) {
        return base;
    }
    return base + share * gloss_pdf(s.ns, wo, wi, p.alpha);
}
