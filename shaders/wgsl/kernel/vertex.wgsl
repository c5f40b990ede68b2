// One vertex of a path: what it emits, what light reaches it directly, where the path goes on.

#import "abi/material.wgsl"
#import "bsdf/phase.wgsl"
#import "bsdf/scatter.wgsl"
#import "kernel/state.wgsl"
#import "light/emission.wgsl"
#import "math/vector.wgsl"
#import "sampler/key.wgsl"
#import "scene/constants.wgsl"
#import "scene/crossing.wgsl"
#import "scene/dispatch.wgsl"
#import "scene/dispatch_bsdf.wgsl"
#import "scene/dispatch_pattern.wgsl"
#import "scene/records.wgsl"
#import "scene/sampler.wgsl"
#import "surface/surface.wgsl"
#import "trace/ray.wgsl"

// Moves the path on at `hit`.
fn vertex_scatter(path: ptr<function, Path>, hit: Hit) {
    let origin = state_origin((*path).point, (*path).gap, (*path).dir);
    var s = dispatch_surface(hit, origin, (*path).dir);
    let m = load_material(s.material);
    if (dispatch_pass(path, s, m.flags, hit.prim)) {
        return;
    }
    dispatch_tangent(&s, hit, m.flags);
    dispatch_shading_normal(&s, m, (*path).dir);
    vertex_emit(path, s, m);
    if ((*path).segments >= load_frame_max_depth()) {
        (*path).open = false;
        return;
    }
    let wo = -(*path).dir;
    let key = (*path).key;
    var scatter = scatter_at(m, s, key);
    dispatch_pattern(&scatter, s, wo);
    dispatch_bend(path, &scatter, m.flags);
    dispatch_direct(path, s.p, scatter, wo);
    let next = dispatch_sample(scatter, wo, key);
    dispatch_cross(path, s, m.flags, next.wi);
    (*path).point = s.p;
    (*path).gap = s.ng * s.gap;
    (*path).skip = hit.prim;
    vertex_leave(path, next);
}

// Moves the path on at point `p` of the medium with index `i`, which scatters it.
fn vertex_medium(path: ptr<function, Path>, p: vec3f, i: u32) {
    if ((*path).segments >= load_frame_max_depth()) {
        (*path).open = false;
        return;
    }
    let wo = -(*path).dir;
    let scatter = phase_scatter(i, (*path).key);
    dispatch_direct(path, p, scatter, wo);
    let next = dispatch_sample(scatter, wo, (*path).key);
    (*path).inside.vertex = p;
    (*path).inside.shadow_nest = (*path).inside.nest;
    (*path).inside.shadow_medium = i;
    (*path).point = p;
    (*path).gap = vec3f(0.0);
    (*path).skip = NONE;
    vertex_leave(path, next);
}

// The path goes on as `next` says.
fn vertex_leave(path: ptr<function, Path>, next: Scattered) {
    let key = (*path).key;
    (*path).key.bounce = key.bounce + 1u;
    (*path).throughput *= next.weight;
    (*path).eta_scale *= next.eta2;
    (*path).dir = next.wi;
    (*path).pdf = next.pdf;
    (*path).open = vertex_survives(path, key);
}

// Adds what the surface emits towards the path, weighted against the chance that the previous vertex had
// to sample it as a light.
fn vertex_emit(path: ptr<function, Path>, s: Surface, m: Material) {
    let radiance = emission_radiance(m.emission, m.flags, m.emission_texture, s.uv, s.front);
    if (vector_max(radiance) > 0.0) {
        let weight = dispatch_emission_weight(dispatch_vertex(path), (*path).dir, (*path).pdf, s);
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
