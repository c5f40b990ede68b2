// Sheen: upright fibres over the surface that the rest of a principled material makes, which reflect most where light
// grazes them.
//   f = color min(C_o, C_i) D G / (4 cos_o cos_i max(1, A_o, A_i)) + f_plain
// with D ~ sin(h)^(1 / alpha), alpha the square of the roughness, and G of Estevez & Kulla 2017, "Production Friendly
// Microfacet Sheen BRDF", as `KHR_materials_sheen` of glTF has it. Where fibres are smooth that gives back more than it
// gets at grazing: A, its own albedo (`under_sheen.wgsl`), is divided out where it exceeds 1. C is what the coat lets
// through, 1 without one. The surface below knows of the sheen. Reciprocal.
// Energy: what the lobe below sends out flatter than it came in, where fibres hold back more, is part of what enters
// the base and of what metal returns after several reflections.

#import "bsdf/principled.wgsl"
#import "bsdf/scatter.wgsl"
#import "bsdf/under_sheen.wgsl"
#import "math/basis.wgsl"
#import "math/exp_log.wgsl"
#import "math/disk.wgsl"
#import "math/vector.wgsl"
#import "scene/layers.wgsl"
#import "scene/plain.wgsl"

// One over the area of the hemisphere.
const SHEEN_EVEN: f32 = 0.15915494;

// Probability of sampling the sheen. A function of wo alone.
fn sheen_probability(s: Scatter, p: Principled, cos_o: f32) -> f32 {
    let lost = 1.0 - under_sheen_through(p.sheen, min(cos_o, 1.0));
    let below = p.albedo.x + p.albedo.y + p.albedo.z;
    if (lost <= 0.0) {
        return 0.0;
    }
    return select(clamp(lost / (lost + below), 0.1, 0.9), 1.0, below <= 0.0);
}

// As `principled_direction`.
fn sheen_direction(s: Scatter, p: Principled, wo: vec3f, u: vec2f, v: f32) -> Scattered {
    let cos_o = dot(s.ns, wo);
    let share = select(0.0, sheen_probability(s, p, cos_o), cos_o > 0.0);
    if (v >= share) {
        // v is uniform beyond the share; the least number below 1 is what rounding may not pass.
        let plain = dispatch_plain_direction(s, p, wo, u, min((v - share) / (1.0 - share), 0.99999994));
        return Scattered(plain.wi, plain.pdf, plain.weight / (1.0 - share), plain.eta2);
    }
    let at = disk_concentric(u);
    let z = 1.0 - at.r * at.r;
    let flat = at.turn * sqrt(max(1.0 - z * z, 0.0));
    let wi = vector_unit(basis_world_from_local(basis_around(s.ns), vec3f(flat, z)));
    if (!scatter_above(s, wi)) {
        return scatter_absorb();
    }
    return scatter_toward(wi);
}

// What a ray keeps that goes straight through sheen and sheet.
fn sheen_straight(s: Scatter, p: Principled, wo: vec3f) -> vec3f {
    return dispatch_plain_straight(s, p, wo);
}

// f |cos| and the density over all lobes, the mirror parts left out.
fn sheen_eval(s: Scatter, p: Principled, wo: vec3f, wi: vec3f) -> Evaluated {
    let plain = dispatch_plain_eval(s, p, wo, wi);
    let cos_o = dot(s.ns, wo);
    let cos_i = dot(s.ns, wi);
    if (cos_o <= 0.0 || vector_max(p.sheen.xyz) <= 0.0) {
        return plain;
    }
    let share = sheen_probability(s, p, cos_o);
    let rest = (1.0 - share) * plain.pdf;
    if (cos_i <= 0.0) {
        return Evaluated(plain.f, rest);
    }
    let coat_o = dispatch_under_coat(p.coat, p.on, min(cos_o, 1.0));
    let coat_i = dispatch_under_coat(p.coat, p.on, min(cos_i, 1.0));
    let fibres = sheen_fibres(s, p, wo, wi) * min(coat_o, coat_i);
    let value = plain.f + p.sheen.xyz * fibres;
    return scatter_only(Evaluated(value, rest + share * SHEEN_EVEN), scatter_above(s, wi));
}

// The lobe of white fibres, times the cosine of `wi`; both directions are above the surface.
fn sheen_fibres(s: Scatter, p: Principled, wo: vec3f, wi: vec3f) -> f32 {
    let cos_o = min(dot(s.ns, wo), 1.0);
    let cos_i = min(dot(s.ns, wi), 1.0);
    let roughness = under_sheen_roughness(p.sheen.w);
    let alpha = roughness * roughness;
    let once = sheen_once(alpha, vec3f(cos_o, cos_i, dot(s.ns, vector_unit(wo + wi))));
    return once * cos_i * under_sheen_kept(roughness, cos_o, cos_i);
}

// D G / (4 cos_o cos_i) at the cosines `c` of `wo`, `wi` and the half vector.
fn sheen_once(alpha: f32, c: vec3f) -> f32 {
    let h = clamp(c.z, 0.0, 1.0);
    let sine2 = max((1.0 - h) * (1.0 + h), 0.0);
    let spread = 1.0 / alpha;
    // (2 + 1 / alpha) / (2 pi) times the power of the sine.
    let d = (2.0 + spread) * SHEEN_EVEN * exp_log_pow(sine2, 0.5 * spread);
    let seen = 1.0 + sheen_masking(alpha, c.x) + sheen_masking(alpha, c.y);
    return d / (4.0 * max(c.x * c.y, 1e-9) * seen);
}

// Lambda of the fibres at cosine `c`: a fit of two halves that mirror each other in the logarithm.
fn sheen_masking(alpha: f32, c: f32) -> f32 {
    if (c < 0.5) {
        return exp_log_exp2(sheen_masking_log2(alpha, c));
    }
    // `max` keeps 1 - c from being compared as c.
    return exp_log_exp2(2.0 * sheen_masking_log2(alpha, 0.5) - sheen_masking_log2(alpha, max(1.0 - c, 0.0)));
}

// Its logarithm at cosine `c` at most one half: a / (1 + b c^k) + d c + e, times the logarithm of e to base 2.
fn sheen_masking_log2(alpha: f32, c: f32) -> f32 {
    let q = (1.0 - alpha) * (1.0 - alpha);
    let a = 21.5473 + q * 3.7772;
    let b = 3.82987 - q * 0.50552;
    let k = 0.19823 - q * 0.03022;
    let d = -1.9776 + q * 0.70367;
    let e = -4.32054 - q * 0.53913;
    return 1.4426950 * (a / (1.0 + b * exp_log_pow(c, k)) + d * c + e);
}
