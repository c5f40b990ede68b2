// A clear coat over Lambert's model. The coat reflects like a dielectric, into the mirror direction moved by a
// ball of radius `fuzz`, and what falls below the surface is folded back. The base is lit through the coat and seen
// through it, light that the coat holds back being reflected by the base again and again:
//   f = (1 - F(cos_o)) (1 - F(cos_i)) color / (pi eta^2 (1 - color B))
// B: mean reflectance of the coat from within, `Material::specular`. As 1 - B = (1 - mean F) / eta^2, a white
// base under a coat returns everything. The base is reciprocal; the ball is not, as the metal's.

#import "bsdf/diffuse.wgsl"
#import "bsdf/fresnel.wgsl"
#import "bsdf/metal.wgsl"
#import "bsdf/scatter.wgsl"
#import "math/vector.wgsl"
#import "scene/records.wgsl"

// Share of light from cosine `c` that the coat reflects.
fn clearcoat_fresnel(s: Scatter, c: f32) -> f32 {
    return fresnel_dielectric(clamp(c, 0.0, 1.0), s.ior, s.ior_minus_1);
}

// Albedo of the base once light is inside, over 1 - B: color / (1 - color B).
fn clearcoat_base(s: Scatter) -> vec3f {
    return s.color / max(vec3f(1.0) - s.color * load_material_specular(s.material), vec3f(1e-4));
}

// Probability of sampling the coat. A function of `wo` alone; `f`: share that the coat reflects.
fn clearcoat_share(s: Scatter, f: f32) -> f32 {
    let coat = f * vector_max(load_material_tint(s.material));
    let below = (1.0 - f) * (1.0 - load_material_specular(s.material)) * vector_max(clearcoat_base(s));
    if (coat <= 0.0) {
        return 0.0;
    }
    if (below <= 0.0) {
        return 1.0;
    }
    return clamp(coat / (coat + below), 0.1, 0.9);
}

// Samples `wi`. `u`: direction, `v`: radius in the ball, `w`: which lobe; all in [0, 1 - 2^-24].
fn clearcoat_sample(s: Scatter, wo: vec3f, u: vec2f, v: f32, w: f32) -> Scattered {
    let cos_o = dot(s.ns, wo);
    if (cos_o <= 0.0) {
        return scatter_absorb();
    }
    let f = clearcoat_fresnel(s, cos_o);
    let share = clearcoat_share(s, f);
    var wi: vec3f;
    if (w < share) {
        wi = scatter_mirror(s, wo);
        if (s.fuzz < METAL_SMOOTH) {
            return Scattered(wi, 0.0, load_material_tint(s.material) * (f / share), 1.0);
        }
        wi = metal_folded(metal_direction(wi, s.fuzz, u, v), s.ns);
    } else {
        wi = diffuse_direction(s.ns, u);
    }
    let to = clearcoat_eval(s, wo, wi);
    if (to.pdf <= 0.0 || !scatter_above(s, wi)) {
        return scatter_absorb();
    }
    return Scattered(wi, to.pdf, to.f / to.pdf, 1.0);
}

// f |cos| and the density of `clearcoat_sample` over both lobes, the mirror's part left out.
fn clearcoat_eval(s: Scatter, wo: vec3f, wi: vec3f) -> Evaluated {
    let cos_o = dot(s.ns, wo);
    let cos_i = dot(s.ns, wi);
    if (cos_o <= 0.0 || cos_i <= 0.0) {
        return scatter_nothing();
    }
    let f = clearcoat_fresnel(s, cos_o);
    let share = clearcoat_share(s, f);
    let even = cos_i * INV_PI;
    let through = (1.0 - f) * (1.0 - clearcoat_fresnel(s, cos_i)) / (s.ior * s.ior);
    let base = Evaluated(clearcoat_base(s) * (through * even), (1.0 - share) * even);
    if (s.fuzz < METAL_SMOOTH) {
        return scatter_only(base, scatter_above(s, wi));
    }
    let coat = metal_folded_density(wi, scatter_mirror(s, wo), s.ns, s.fuzz);
    let value = base.f + load_material_tint(s.material) * (f * coat);
    return scatter_only(Evaluated(value, base.pdf + share * coat), scatter_above(s, wi));
}
