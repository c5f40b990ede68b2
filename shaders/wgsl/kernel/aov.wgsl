// Arbitrary output variables (AOVs): what a pixel shows beside radiance. One record for each sample of a pixel, along
// the camera ray and the random numbers that `render` has for it, so that layers and picture show the same points.
// Scattering is sampled, light is not: no shadow rays.

#import "abi/aov.wgsl"
#import "bsdf/scatter.wgsl"
#import "kernel/film.wgsl"
#import "kernel/path.wgsl"
#import "kernel/state.wgsl"
#import "kernel/vertex.wgsl"
#import "light/emission.wgsl"
#import "math/vector.wgsl"
#import "sampler/key.wgsl"
#import "scene/constants.wgsl"
#import "scene/crossing.wgsl"
#import "scene/dispatch.wgsl"
#import "scene/dispatch_bsdf.wgsl"
#import "scene/dispatch_mix.wgsl"
#import "scene/dispatch_pattern.wgsl"
#import "scene/probe.wgsl"
#import "scene/projection.wgsl"
#import "scene/records.wgsl"
#import "scene/segment.wgsl"
#import "scene/start.wgsl"
#import "scene/unseen.wgsl"
#import "trace/bvh.wgsl"
#import "trace/ray.wgsl"

@compute @workgroup_size(8, 8, 1)
fn aov(@builtin(global_invocation_id) gid: vec3<u32>) {
    let frame = load_frame();
    let pixel = frame.tile_origin + gid.xy;
    if (any(gid.xy >= frame.tile_size) || any(pixel >= frame.image_size) || frame.sample_count == 0u) {
        return;
    }
    let end = frame.sample_first + frame.sample_count;
    let first = (gid.y * frame.tile_size.x + gid.x) * frame.sample_count;
    var place = first;
    var found = aov_nothing();
    var path = path_begin(sample_key(pixel, frame.sample_first, frame.seed), pixel);
    loop {
        if (path.key.sample == end) { break; }
        aov_advance(&path, &found, trace(path_ray(&path)));
        if (!path.open) {
            found.rays = path.segments;
            aov_store(place, found);
            place += 1u;
            found = aov_nothing();
            path = path_begin(sample_key(pixel, path.key.sample + 1u, frame.seed), pixel);
        }
    }
    if (film_is_cut(frame.sample_count + 1u)) {
        found.rays = FILM_CUT;
        aov_store(first, found);
    }
}

// Nothing was met.
fn aov_nothing() -> AovSample {
    return AovSample(vec3f(0.0), NONE, vec3f(0.0), NONE, vec3f(0.0), 0.0, vec3f(0.0), 0u, vec2f(0.0), 0u, 0u);
}

// Moves the path on by what its ray has hit, as `path_advance` does. It stays open while it goes on specularly.
fn aov_advance(path: ptr<function, Path>, found: ptr<function, AovSample>, hit: Hit) {
    (*path).segments += 1u;
    var v: Vertex;
    if (dispatch_segment(path, hit, &v)) {
        // In a medium: its albedo is in the throughput, and it has no normal.
        (*found).alpha = 1.0;
        (*found).albedo = aov_albedo(path, vec3f(1.0));
        (*path).open = false;
    } else if (hit.prim == NONE) {
        if ((*found).alpha == 0.0) {
            let sky = dispatch_miss((*path).dir, (*path).pdf, (*path).receiver, (*path).scattered == 0u);
            (*found).backdrop = (*path).radiance + (*path).throughput * sky;
        }
        (*path).open = false;
    } else {
        aov_surface(path, found, hit);
    }
}

// The surface at `hit`: what of it is seen, and where the path goes on, if it does.
fn aov_surface(path: ptr<function, Path>, found: ptr<function, AovSample>, hit: Hit) {
    let wo = -(*path).dir;
    let origin = dispatch_origin((*path).point, (*path).ray_offset, (*path).start, (*path).dir);
    var s = dispatch_surface(hit, origin, (*path).dir, (*path).time);
    let declared = s.material;
    var m = load_material_head(declared);
    dispatch_mix(&s, &m, (*path).key, (*path).time);
    if (dispatch_pass(path, s, m.flags, ray_skip(hit))) {
        return;
    }
    if (dispatch_unseen(path, s, m.flags, ray_skip(hit))) {
        return;
    }
    dispatch_tangent(&s, hit, m.flags, (*path).time);
    let uv = s.at.uv;
    dispatch_projection(&s, m.flags, (*path).key, (*path).time);
    dispatch_horizon(&s, m.kind, m.flags);
    dispatch_shading_normal(&s, m, (*path).dir);
    var scatter = scatter_at(m, s, (*path).key);
    dispatch_pattern(&scatter, s, wo);
    dispatch_bend(path, &scatter, m.flags);
    if ((*found).alpha == 0.0) {
        (*found).alpha = 1.0;
        (*found).material = declared;
        (*found).object = s.object;
        (*found).position = s.p;
        (*found).uv = uv;
    }
    let next = dispatch_sample(scatter, wo, (*path).key);
    let mirrors = next.pdf == 0.0 && vector_max(next.weight) > 0.0;
    if (!mirrors || vertex_is_last(path)) {
        let emission = emission_radiance(m.emission, m.flags, m.emission_texture, s.at, s.front);
        (*found).albedo = aov_albedo(path, scatter.color + emission);
        (*found).normal = scatter.ns;
        (*path).open = false;
        return;
    }
    dispatch_cross(path, s, m.flags, next.wi);
    if (!dispatch_passes(path, m.flags, next)) {
        (*path).scattered += 1u;
    }
    (*path).point = s.p;
    (*path).ray_offset = s.ng * s.ray_offset;
    (*path).skip = ray_skip(hit);
    (*path).start = dispatch_start_plain();
    (*path).key.bounce += 1u;
    (*path).throughput *= next.weight;
    (*path).roulette_scale *= next.eta2;
    (*path).dir = next.wi;
}

// `color` as the camera sees it, over what is specular; 0 ..= 1. What refraction takes until the path comes out again
// is given back.
fn aov_albedo(path: ptr<function, Path>, color: vec3f) -> vec3f {
    return clamp((*path).throughput * (*path).roulette_scale * color, vec3f(0.0), vec3f(1.0));
}
