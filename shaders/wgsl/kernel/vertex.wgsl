// One vertex of a path: what it emits, what light reaches it directly, where the path goes on.

#import "abi/material_head.wgsl"
#import "bsdf/phase.wgsl"
#import "bsdf/scatter.wgsl"
#import "kernel/indirect.wgsl"
#import "kernel/state.wgsl"
#import "light/emission.wgsl"
#import "math/vector.wgsl"
#import "sampler/key.wgsl"
#import "scene/constants.wgsl"
#import "scene/crossing.wgsl"
#import "scene/dispatch.wgsl"
#import "scene/dispatch_bsdf.wgsl"
#import "scene/dispatch_mix.wgsl"
#import "scene/dispatch_pattern.wgsl"
#import "scene/dispatch_tint.wgsl"
#import "scene/links.wgsl"
#import "scene/receiver.wgsl"
#import "scene/records.wgsl"
#import "scene/probe.wgsl"
#import "scene/projection.wgsl"
#import "scene/sampler.wgsl"
#import "scene/start.wgsl"
#import "scene/survival.wgsl"
#import "scene/unseen.wgsl"
#import "surface/surface.wgsl"
#import "trace/ray.wgsl"

// Where light is scattered: a surface, or a point in a medium.
struct Vertex {
    scatter: Scatter,
    // In a medium it has the point, no extent and no object.
    s: Surface,
    // Flags of its `Material`; 0 in a medium.
    flags: u32,
    // As `Path::skip`.
    skip: vec2u,
}

// The vertex at `hit`: false if the path goes straight on there, or ends.
fn vertex_surface(path: ptr<function, Path>, hit: Hit, v: ptr<function, Vertex>) -> bool {
    let origin = dispatch_origin((*path).point, (*path).ray_offset, (*path).start, (*path).dir);
    var s = dispatch_surface(hit, origin, (*path).dir, (*path).time);
    var m = load_material_head(s.material);
    dispatch_mix(&s, &m, (*path).key, (*path).time);
    if (dispatch_pass(path, s, m.flags, ray_skip(hit))) {
        return false;
    }
    if (dispatch_unseen(path, s, m.flags, ray_skip(hit))) {
        return false;
    }
    dispatch_tangent(&s, hit, m.flags, (*path).time);
    dispatch_projection(&s, m.flags, (*path).key, (*path).time);
    dispatch_horizon(&s, m.kind, m.flags);
    dispatch_shading_normal(&s, m, (*path).dir);
    vertex_emit(path, s, m);
    // The longest path has come to its end, unless it goes straight through.
    if (vertex_is_last(path) && !dispatch_sheet(m.flags)) {
        (*path).open = false;
        return false;
    }
    var scatter = scatter_at(m, s, (*path).key);
    dispatch_pattern(&scatter, s, -(*path).dir);
    dispatch_bend(path, &scatter, m.flags);
    *v = Vertex(scatter, s, m.flags, ray_skip(hit));
    return true;
}

// The vertex at point `p` of the medium with index `i`, unless the path ends there.
fn vertex_medium(path: ptr<function, Path>, p: vec3f, i: u32, v: ptr<function, Vertex>) {
    if (vertex_is_last(path)) {
        (*path).open = false;
        return;
    }
    var s = surface_new(p, -(*path).dir, (*path).dir, 0.0);
    s.object = NONE;
    *v = Vertex(phase_scatter(i, (*path).key), s, 0u, vec2u(NONE));
}

// Whether no segment may follow.
fn vertex_is_last(path: ptr<function, Path>) -> bool {
    return (*path).segments >= load_frame_max_depth();
}

// Moves the path on at `v`. The only place where light is scattered: compilers for GPUs copy what is called into
// each place that calls it.
fn vertex_scatter(path: ptr<function, Path>, v: Vertex) {
    let wo = -(*path).dir;
    let key = (*path).key;
    let ray_offset = v.s.ng * v.s.ray_offset;
    let receiver = receiver_at(v.scatter, v.s.object);
    if (!vertex_is_last(path)) {
        dispatch_direct(path, v.s.p, ray_offset, receiver, v.scatter, wo);
    }
    let next = dispatch_sample(v.scatter, wo, key);
    dispatch_cross(path, v.s, v.flags, next.wi);
    if (!dispatch_passes(path, v.flags, next)) {
        (*path).receiver = receiver;
        indirect_scattered(path);
    }
    let pdf = dispatch_depart(path, v.s.p, v.flags, next);
    (*path).point = v.s.p;
    (*path).ray_offset = ray_offset;
    (*path).skip = v.skip;
    vertex_leave(path, next, pdf);
    (*path).open = (*path).open && !vertex_is_last(path);
    dispatch_probe_begin(path, v.s);
}

// The path goes on as `next` says; lights that it finds are weighted with the density `pdf`.
fn vertex_leave(path: ptr<function, Path>, next: Scattered, pdf: f32) {
    let key = (*path).key;
    (*path).key.bounce = key.bounce + 1u;
    (*path).throughput *= next.weight;
    if (key.bounce == 0u) {
        // A dark pixel needs its paths as much as a bright one.
        (*path).roulette_scale = 1.0 / max(vector_max((*path).throughput), 1.1754944e-38);
    } else {
        (*path).roulette_scale *= next.eta2;
    }
    (*path).dir = next.wi;
    (*path).pdf = pdf;
    (*path).open = vertex_roulette(path, key);
}

// Adds what the surface emits towards the path, weighted against the chance that the previous vertex had
// to sample it as a light.
fn vertex_emit(path: ptr<function, Path>, s: Surface, m: MaterialHead) {
    let radiance = emission_radiance(m.emission, m.flags, m.emission_texture, s.at, s.front);
    if (vector_max(radiance) > 0.0 && links_glow(s.object, receiver_links((*path).receiver))) {
        let seen = dispatch_tint(radiance, s.material, m.flags, s.light, (*path).dir);
        let from_point = dispatch_vertex(path);
        let receiver = (*path).receiver;
        let weight = dispatch_emission_weight(from_point, receiver, (*path).dir, (*path).pdf, s, (*path).time);
        (*path).radiance += (*path).throughput * seen * weight;
    }
}

// A path is certain to survive Russian roulette until its throughput has fallen to one over this. Ending paths sooner
// makes more noise than it saves time: docs/cpu.md has other factors. A power of two, so that no driver's order of the
// product changes its bits.
const ROULETTE_SURVIVAL: f32 = 2.0;

// Russian roulette: from the bounce that the frame says, the path survives with a probability in proportion to its
// largest throughput over that after the first bounce, the factor 1/eta^2 of refraction taken out of both. No cap below
// 1: capped roulette has infinite variance where albedo^2 exceeds the cap. False if the path ends; otherwise the
// throughput makes up for those that did.
fn vertex_roulette(path: ptr<function, Path>, key: SampleKey) -> bool {
    let largest = vector_max((*path).throughput);
    if (largest <= 0.0) {
        return false;
    }
    if (key.bounce < load_frame_roulette_depth()) {
        return true;
    }
    let asked = largest * (*path).roulette_scale * ROULETTE_SURVIVAL;
    let q = dispatch_survival(key.bounce, min(asked, 1.0));
    if (sample_1d(key, PURPOSE_ROULETTE) >= q) {
        return false;
    }
    (*path).throughput /= q;
    return true;
}
