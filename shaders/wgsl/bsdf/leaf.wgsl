// A thin sheet that scatters light back and lets light through: a leaf, paper, thin cloth.
//   reflected    color (1 - t) cos_i / pi
//   transmitted  color t tint ((1 - s) |cos_i| / pi + s p_hg(-wo . wi) min(1, |cos_i / cos_o|))
// with t the translucency, tint what the sheet leaves of the light that crosses it, and s the share that
// goes on forward, blurred by Henyey & Greenstein's phase function. Divided by |cos_i| both terms are symmetric
// in wo and wi: reciprocal. Their integrals are color (1 - t) and at most color t: never more than it gets.

#import "bsdf/diffuse.wgsl"
#import "bsdf/hg.wgsl"
#import "bsdf/scatter.wgsl"
#import "math/beer.wgsl"
#import "math/vector.wgsl"
#import "scene/records.wgsl"

// Colour of light that has crossed the sheet, Lambert & Beer.
fn leaf_tint(s: Scatter) -> vec3f {
    let depth = load_material_sigma_a(s.material) * load_material_thickness_middle(s.material);
    return s.color * beer_transmittance(depth);
}

// The forward lobe without its colour, times |cos_i|.
fn leaf_forward(s: Scatter, wo: vec3f, wi: vec3f) -> f32 {
    let ratio = abs(dot(s.ns, wi)) / max(dot(s.ns, wo), 1e-6);
    return hg_pdf(-wo, load_material_g(s.material), wi) * min(ratio, 1.0);
}

// Samples `wi`. `u`: direction, `v`: which lobe; all in [0, 1 - 2^-24].
fn leaf_sample(s: Scatter, wo: vec3f, u: vec2f, v: f32) -> Scattered {
    let t = load_material_weight(s.material);
    var wi: vec3f;
    if (v >= t) {
        wi = diffuse_direction(s.ns, u);
    } else if (v < t * load_material_forward(s.material)) {
        wi = hg_sample(-wo, load_material_g(s.material), u);
    } else {
        wi = diffuse_direction(-s.ns, u);
    }
    let pdf = leaf_pdf(s, wo, wi);
    if (pdf <= 0.0) {
        return scatter_absorb();
    }
    return Scattered(wi, pdf, leaf_eval(s, wo, wi) / pdf, 1.0);
}

// f |cos|.
fn leaf_eval(s: Scatter, wo: vec3f, wi: vec3f) -> vec3f {
    let t = load_material_weight(s.material);
    if (scatter_above(s, wi)) {
        return s.color * ((1.0 - t) * (dot(s.ns, wi) * INV_PI));
    }
    if (!scatter_below(s, wi)) {
        return vec3f(0.0);
    }
    let forward = load_material_forward(s.material);
    let even = (1.0 - forward) * (-dot(s.ns, wi) * INV_PI);
    return leaf_tint(s) * (t * (even + forward * leaf_forward(s, wo, wi)));
}

// Density of `leaf_sample`, per steradian of `wi`.
fn leaf_pdf(s: Scatter, wo: vec3f, wi: vec3f) -> f32 {
    let t = load_material_weight(s.material);
    let forward = load_material_forward(s.material);
    let c = dot(s.ns, wi) * INV_PI;
    let even = select(t * (1.0 - forward) * -c, (1.0 - t) * c, c >= 0.0);
    return even + t * forward * hg_pdf(-wo, load_material_g(s.material), wi);
}
