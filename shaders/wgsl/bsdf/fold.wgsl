// Directions that a shading normal sends to the wrong side of the surface. A model knows its shading normal only: what
// it reflects is above that, and may be below the surface, where it would be lost: black rims, dark normal maps. Such
// a direction is folded back: mirrored at the plane of the surface, as by a second bounce off it.
//   f'(wi) = f(wi) [wi on its side] + f(m) [m on its side],   m = wi - 2 (wi . ng) ng
// with a direction on its side where it is on the same side of the surface as of the shading normal, and m where it
// is on that side of the shading normal on which wi is of the surface. No energy is lost or made: the mirroring keeps
// solid angles, so f' has the integral of f, and the sum of both densities is that of the sample. Continuous where wi
// meets the surface. Where both normals are the same, nothing is folded.

#import "bsdf/scatter.wgsl"
#import "math/vector.wgsl"
#import "sampler/key.wgsl"
#import "scene/model.wgsl"

// Whether the shading normal is not that of the surface.
fn fold_is_tilted(s: Scatter) -> bool {
    return any(s.ns != s.ng);
}

// The surface as a model is to see it: there is nothing but its shading normal.
fn fold_seen(s: Scatter) -> Scatter {
    var seen = s;
    seen.ng = s.ns;
    return seen;
}

// `wi` mirrored at the surface, unit.
fn fold_mirrored(s: Scatter, wi: vec3f) -> vec3f {
    return vector_unit(wi - s.ng * (2.0 * dot(s.ng, wi)));
}

// Whether `from_dir`, sampled by a model, leaves on the side of `wi`: on that side of the shading normal on which `wi`
// is of the surface.
fn fold_leads(s: Scatter, from_dir: vec3f, wi: vec3f) -> bool {
    return dot(s.ns, from_dir) * dot(s.ng, wi) > 0.0;
}

// Samples `wi`. The weight is that of the direction before it was folded: its mean over both is right.
fn fold_sample(s: Scatter, wo: vec3f, key: SampleKey) -> Scattered {
    let seen = fold_seen(s);
    var next = model_sample(seen, wo, key);
    if (!fold_is_tilted(s)) {
        return next;
    }
    let mirrored = fold_mirrored(s, next.wi);
    var other = mirrored;
    if (dot(s.ns, next.wi) * dot(s.ng, next.wi) < 0.0) {
        other = next.wi;
        next.wi = mirrored;
    }
    if (next.pdf > 0.0 && fold_leads(s, other, next.wi)) {
        next.pdf += model_eval(seen, wo, other).pdf;
    }
    return next;
}

// f |cos| and the density of `fold_sample`, delta lobes left out. A loop, because compilers for GPUs copy a model to
// every place that calls it.
fn fold_eval(s: Scatter, wo: vec3f, wi: vec3f) -> Evaluated {
    let seen = fold_seen(s);
    let tilted = fold_is_tilted(s);
    var sum = scatter_nothing();
    var from_dir = wi;
    var k = 0u;
    loop {
        if (!tilted || fold_leads(s, from_dir, wi)) {
            let e = model_eval(seen, wo, from_dir);
            sum.f += e.f;
            sum.pdf += e.pdf;
        }
        k += 1u;
        if (!tilted || k == 2u) { break; }
        from_dir = fold_mirrored(s, wi);
    }
    return sum;
}
