// Metallic-roughness: a GGX lobe, with two widths if it is brushed, over a Lambert base, both under what coat there is.
//   f = min(T_o, T_i) F(wo.h) D G2 / (4 cos_o cos_i)
//     + (1 - t) (1 - metallic) color e_o e_i / (pi mean e)            e = T (1 - E)
//     + metallic K n_o n_i / (pi mean n)                              n = T - (what white facets give back)
// with Schlick's F from f0 = color for a metal, w c ((ior - 1) / (ior + 1))^2 for a dielectric, to 1 and w: w and c
// are the specular factor and colour, 1 unless a material says otherwise. E is the directional albedo of the lobe
// with the largest channel of c, so that what a tinted interface does not reflect does not tint the base
// (`gloss_albedo.wgsl`): the base gets what the lobe does not give back, and a white surface returns everything.
// A metal returns what white microfacets do not give back tinted by K, as `conductor.wgsl` does. T is what the coat
// lets through, 1 without one. t, the share that goes through a thin sheet, is what `thin.wgsl` adds on the other side.
// Without compensation M = 0, E = F at the normal, mean e = 1: the textbook's base, which is too dark.
// Reciprocal: every term is symmetric in wo and wi.
// Energy: min(T_o, T_i) loses what goes out flatter than it came in, which is part of n, and with the share that F
// has of it of e.

#import "bsdf/diffuse.wgsl"
#import "bsdf/fresnel.wgsl"
#import "bsdf/gloss.wgsl"
#import "bsdf/gloss_albedo.wgsl"
#import "bsdf/scatter.wgsl"
#import "math/vector.wgsl"
#import "scene/layers.wgsl"
#import "scene/records.wgsl"

// What a surface is made of, textures applied, and how it looks from `wo`.
struct Principled {
    // Reflectance of the interface at normal incidence.
    f0: vec3f,
    // At grazing incidence.
    f90: f32,
    // The same of its dielectric part, without the hue of the specular colour.
    entry: vec2f,
    // The lobe.
    gloss: GlossAlbedo,
    // Colour of the base, over pi times the mean of e.
    base: vec3f,
    // Colour of what goes through, less what is metal or scattered.
    clear: vec3f,
    // Colour of what a metal returns after several reflections, over pi times the mean of n.
    metal: vec3f,
    // 1 over pi times the mean of n.
    several: f32,
    // Share under a clear coat, and its perceptual roughness.
    coat: vec2f,
    // Colour of the sheen, and its perceptual roughness.
    sheen: vec4f,
    // Several reflections count.
    on: bool,
    // T, e and n at `wo`.
    o: PrincipledSide,
    // Albedos at `wo`: of the lobe, of what is diffuse, of what goes through. The largest channel of each.
    albedo: vec3f,
}

// The shares of one direction.
struct PrincipledSide {
    through: f32,
    enters: f32,
    missing: f32,
}

// What the surface at `s` is made of, seen from `wo`.
fn principled_at(s: Scatter, wo: vec3f) -> Principled {
    let on = load_material_compensation(s.material) > 0.0;
    let r = s.ior_minus_1 / (s.ior + 1.0);
    let dielectric = 1.0 - s.metallic;
    let specular = dispatch_specular(s);
    let metal = s.color * s.metallic;
    let f0 = min(specular.xyz * (r * r), vec3f(1.0)) * (specular.w * dielectric) + metal;
    let f90 = specular.w * dielectric + s.metallic;
    let entry = vec2f(min(vector_max(specular.xyz) * (r * r), 1.0) * specular.w, specular.w);
    let through = dispatch_transmission(s);
    let inside = s.color * dielectric;
    let coat = dispatch_coat(s);
    let sheen = dispatch_sheen(s);
    let gloss = dispatch_gloss_albedo(s, on);
    let cos_o = clamp(dot(s.ns, wo), 0.0, 1.0);
    let along = dispatch_gloss_along(s, gloss, wo, cos_o);
    let shares = dispatch_gloss_shares(s, along, wo, cos_o);
    let flattened = dispatch_coat_flattened(s, coat, along, wo, cos_o) + dispatch_sheen_flattened(sheen, along, cos_o);
    let open = dispatch_under_coat(coat, on, cos_o) * dispatch_under_sheen(sheen, cos_o);
    let o = principled_shares(shares, entry, open, flattened);
    var entering = 1.0;
    var several = 0.0;
    var tint = vec3f(0.0);
    if (on) {
        let kept = dispatch_coat_keeps(s, coat, gloss, entry);
        let under = dispatch_sheen_keeps(sheen, gloss, entry);
        // Where nothing enters, e is 0 everywhere.
        entering = max(1.0 - gloss_albedo_mean(gloss, entry.x, entry.y) - kept - under, 1e-3);
    }
    if (gloss.rough) {
        several = INV_PI / (dispatch_coat_missing(s, coat, gloss) + dispatch_sheen_missing(sheen, gloss));
        // The mean of Schlick's term: the integral of 2 c (1 - c)^5 is 1/21.
        let mean = s.color + (vec3f(1.0) - s.color) * 0.047619048;
        tint = mean * mean * ((1.0 - gloss.mean_missing) * s.metallic) / (vec3f(1.0) - mean * gloss.mean_missing);
    }
    let base = inside * (1.0 - through);
    let clear = inside * through;
    let lobe = o.through * vector_max(f0 * (1.0 - shares.missing) + (vec3f(f90) - f0) * shares.schlick);
    let albedo = vec3f(
        lobe,
        vector_max(base) * o.enters + vector_max(tint) * o.missing,
        vector_max(clear) * o.enters,
    );
    return Principled(
        f0, f90, entry, gloss, base * (INV_PI / entering), clear, tint * several, several, coat, sheen, on, o, albedo,
    );
}

// T, e and n from the lobe's shares, from T, and from what the lobe loses under the coat.
fn principled_shares(shares: GlossShares, entry: vec2f, through: f32, flattened: f32) -> PrincipledSide {
    let reflected = gloss_albedo_reflected(shares, entry.x, entry.y);
    let mean_fresnel = reflected / max(1.0 - shares.missing, 1e-6);
    let enters = max(through * (1.0 - reflected) + flattened * mean_fresnel, 0.0);
    return PrincipledSide(through, enters, through * shares.missing + flattened);
}

// T, e and n at `w`, above the surface.
fn principled_side(s: Scatter, p: Principled, w: vec3f) -> PrincipledSide {
    let cosine = min(dot(s.ns, w), 1.0);
    let along = dispatch_gloss_along(s, p.gloss, w, cosine);
    let through = dispatch_under_coat(p.coat, p.on, cosine) * dispatch_under_sheen(p.sheen, cosine);
    let coat_flattened = dispatch_coat_flattened(s, p.coat, along, w, cosine);
    let flattened = coat_flattened + dispatch_sheen_flattened(p.sheen, along, cosine);
    return principled_shares(dispatch_gloss_shares(s, along, w, cosine), p.entry, through, flattened);
}

// Share of light that the interface reflects at cosine `c`.
fn principled_fresnel(p: Principled, c: f32) -> vec3f {
    return fresnel_schlick_to(p.f0, p.f90, c);
}

// Probability of sampling the lobe rather than what is diffuse. A function of wo alone, so that both sides of
// multiple importance sampling see the same density.
fn principled_lobe_share(p: Principled) -> f32 {
    if (p.albedo.y <= 0.0) {
        return 1.0;
    }
    return max(p.albedo.x / (p.albedo.x + p.albedo.y), 0.1);
}

// A direction to scatter into. `u`: direction, `v`: which lobe; all in [0, 1 - 2^-24]. Deltas have their weight;
// for others, whose `pdf` is 1 here, value and density are worked out behind all layers.
fn principled_direction(s: Scatter, p: Principled, wo: vec3f, u: vec2f, v: f32) -> Scattered {
    let cos_o = dot(s.ns, wo);
    if (cos_o <= 0.0) {
        return scatter_absorb();
    }
    let share = principled_lobe_share(p);
    var wi: vec3f;
    if (v >= share) {
        wi = diffuse_direction(s.ns, u);
    } else if (p.gloss.alpha < GLOSS_SMOOTH) {
        return Scattered(scatter_mirror(s, wo), 0.0, principled_fresnel(p, cos_o) * (p.o.through / share), 1.0);
    } else {
        wi = dispatch_gloss_sample(s, p.gloss.alpha, wo, u);
    }
    if (!scatter_above(s, wi)) {
        return scatter_absorb();
    }
    return scatter_toward(wi);
}

// f |cos| and the density over both lobes, the mirror part left out.
fn principled_eval(s: Scatter, p: Principled, wo: vec3f, wi: vec3f) -> Evaluated {
    let cos_i = dot(s.ns, wi);
    if (dot(s.ns, wo) <= 0.0 || cos_i <= 0.0) {
        return scatter_nothing();
    }
    let above = scatter_above(s, wi);
    let i = principled_side(s, p, wi);
    let diffuse = (p.base * (p.o.enters * i.enters) + p.metal * (p.o.missing * i.missing)) * cos_i;
    let share = principled_lobe_share(p);
    let base = (1.0 - share) * (cos_i * INV_PI);
    if (p.gloss.alpha < GLOSS_SMOOTH) {
        return scatter_only(Evaluated(diffuse, base), above);
    }
    let lobe = dispatch_gloss_eval(s, p.gloss.alpha, wo, wi);
    let value = diffuse + principled_fresnel(p, gloss_cosine(wo, wi)) * (lobe.x * min(p.o.through, i.through));
    return scatter_only(Evaluated(value, base + share * lobe.y), above);
}
