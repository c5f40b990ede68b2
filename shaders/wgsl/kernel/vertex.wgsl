// One vertex of a path: what it emits, what light reaches it directly, where the path goes on.

#import "abi/material.wgsl"
#import "bsdf/scatter.wgsl"
#import "kernel/state.wgsl"
#import "light/emission.wgsl"
#import "math/vector.wgsl"
#import "sampler/pcg.wgsl"
#import "scene/dispatch.wgsl"
#import "scene/dispatch_bsdf.wgsl"
#import "scene/dispatch_pattern.wgsl"
#import "scene/records.wgsl"
#import "surface/surface.wgsl"
#import "trace/ray.wgsl"

// Moves the path on at `hit`.
fn vertex_scatter(path: ptr<function, Path>, hit: Hit) {
    let origin = state_origin((*path).point, (*path).gap, (*path).dir);
    var s = dispatch_surface(hit, origin, (*path).dir);
    let m = load_material(s.material);
    dispatch_tangent(&s, hit, m.flags);
    dispatch_shading_normal(&s, m, (*path).dir);
    vertex_emit(path, s, m);
    if ((*path).segments >= load_frame_max_depth()) {
        (*path).open = false;
        return;
    }
    let wo = -(*path).dir;
    var scatter = scatter_at(m, s);
    dispatch_pattern(&scatter, s, wo);
    let key = (*path).key;
    dispatch_direct(path, s, scatter, wo);
    let next = dispatch_sample(scatter, wo, key);
    (*path).key.bounce = key.bounce + 1u;
    (*path).throughput *= next.weight;
    (*path).eta_scale *= next.eta2;
    (*path).point = s.p;
    (*path).gap = s.ng * s.gap;
    (*path).skip = hit.prim;
    (*path).dir = next.wi;
    (*path).pdf = next.pdf;
    (*path).open = vertex_survives(path, key);
}

// Adds what the surface emits towards the path, weighted against the chance that the previous vertex had
// to sample it as a light.
fn vertex_emit(path: ptr<function, Path>, s: Surface, m: Material) {
    let radiance = emission_radiance(m.emission, m.flags, m.emission_texture, s.uv, s.front);
    if (vector_max(radiance) > 0.0) {
        let weight = dispatch_emission_weight((*path).point, (*path).dir, (*path).pdf, s);
        (*path).radiance += (*path).throughput * radiance * weight;
    }
}

// Russian roulette: from the bounce that the frame says, the path survives with the probability of its
// largest throughput, refraction's own factor taken out. No cap below 1: capped roulette has infinite
// variance where albedo^2 exceeds the cap. False if the path ends; otherwise the throughput makes up for
// those that did.
fn vertex_survives(path: ptr<function, Path>, key: SampleKey) -> bool {
    let largest = vector_max((*path).throughput);
    if (largest <= 0.0) {
        return false;
    }
    if (key.bounce < load_frame_roulette_depth()) {
        return true;
    }
    let q = min(largest * (*path).eta_scale, 1.0);
    if (sample_1d(key, PURPOSE_ROULETTE) >= q) {
        return false;
    }
    (*path).throughput /= q;
    return true;
}
