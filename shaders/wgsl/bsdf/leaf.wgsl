// A thin sheet that scatters light back and lets light through: a leaf, paper, thin cloth.
//   reflected    color (1 - t) cos_i / pi
//   transmitted  color t tint ((1 - s) |cos_i| / pi + s forward)
//   forward      p_hg(-wo . wi) min(1, |cos_i / cos_o|) + L_o L_i |cos_i| / (pi mean L)
// with t the translucency, tint what the sheet leaves of the light that crosses it, and s the share that
// goes on forward, blurred by Henyey & Greenstein's phase function; L is what that lobe does not let through
// (`leaf_albedo.wgsl`). Divided by |cos_i| all terms are symmetric in wo and wi: reciprocal. Their integrals are
// color (1 - t) and color t: a white sheet that does not absorb keeps all light.

#import "bsdf/diffuse.wgsl"
#import "bsdf/hg.wgsl"
#import "bsdf/leaf_albedo.wgsl"
#import "bsdf/scatter.wgsl"
#import "math/beer.wgsl"
#import "math/vector.wgsl"
#import "scene/records.wgsl"

// Colour of light that has crossed the sheet, Lambert & Beer.
fn leaf_tint(s: Scatter) -> vec3f {
    let depth = load_material_sigma_a(s.material) * load_material_thickness_middle(s.material);
    return s.color * beer_transmittance(depth);
}

// What is spread evenly on the far side, seen from `wo`.
struct LeafEven {
    // Share of all light.
    share: f32,
    // L_o and its mean; 0 and 1 where nothing goes on forward.
    missing: f32,
    mean: f32,
}

// The even part for the share `t` of light through.
fn leaf_even(s: Scatter, wo: vec3f, t: f32) -> LeafEven {
    let forward = load_material_forward(s.material);
    if (t * forward <= 0.0) {
        return LeafEven(t, 0.0, 1.0);
    }
    let found = leaf_albedo(clamp(dot(s.ns, wo), 0.0, 1.0), load_material_g(s.material));
    let missing = clamp(found.x, 0.0, 1.0);
    return LeafEven(t * ((1.0 - forward) + forward * missing), missing, max(found.y, 1e-6));
}

// The forward lobe without its colour, times |cos_i|; `phase`: the phase function.
fn leaf_forward(s: Scatter, wo: vec3f, wi: vec3f, even: LeafEven, phase: f32) -> f32 {
    let cos_i = abs(dot(s.ns, wi));
    let ratio = cos_i / max(dot(s.ns, wo), 1e-6);
    let lobe = phase * min(ratio, 1.0);
    if (even.missing <= 0.0) {
        return lobe;
    }
    let there = clamp(leaf_albedo(min(cos_i, 1.0), load_material_g(s.material)).x, 0.0, 1.0);
    return lobe + even.missing * there / even.mean * (cos_i * INV_PI);
}

// Samples `wi`. `u`: direction, `v`: which lobe; all in [0, 1 - 2^-24].
fn leaf_sample(s: Scatter, wo: vec3f, u: vec2f, v: f32) -> Scattered {
    let t = load_material_weight(s.material);
    let even = leaf_even(s, wo, t);
    var wi: vec3f;
    if (v >= t) {
        wi = diffuse_direction(s.ns, u);
    } else if (v < even.share) {
        wi = diffuse_direction(-s.ns, u);
    } else {
        wi = hg_sample(-wo, load_material_g(s.material), u);
    }
    let to = leaf_toward(s, wo, wi, even);
    if (to.pdf <= 0.0) {
        return scatter_absorb();
    }
    return Scattered(wi, to.pdf, to.f / to.pdf, 1.0);
}

// f |cos|, and the density of `leaf_sample`.
fn leaf_eval(s: Scatter, wo: vec3f, wi: vec3f) -> Evaluated {
    return leaf_toward(s, wo, wi, leaf_even(s, wo, load_material_weight(s.material)));
}

// `leaf_eval` for the even part seen from `wo`.
fn leaf_toward(s: Scatter, wo: vec3f, wi: vec3f, even: LeafEven) -> Evaluated {
    let t = load_material_weight(s.material);
    let c = dot(s.ns, wi) * INV_PI;
    let phase = hg_pdf(-wo, load_material_g(s.material), wi);
    let flat_pdf = select(even.share * -c, (1.0 - t) * c, c >= 0.0);
    let pdf = flat_pdf + max(t - even.share, 0.0) * phase;
    if (scatter_above(s, wi)) {
        return Evaluated(s.color * ((1.0 - t) * c), pdf);
    }
    if (!scatter_below(s, wi)) {
        return Evaluated(vec3f(0.0), pdf);
    }
    let forward = load_material_forward(s.material);
    var lobes = (1.0 - forward) * -c;
    if (t * forward > 0.0) {
        lobes += forward * leaf_forward(s, wo, wi, even, phase);
    }
    return Evaluated(leaf_tint(s) * (t * lobes), pdf);
}
