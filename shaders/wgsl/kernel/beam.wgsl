// Shadow rays that go on behind what they hit, with less light. Such a ray takes one turn of the kernel's loop for
// each surface, and the start of the path's own ray is put aside for that time.

#import "kernel/aside.wgsl"
#import "kernel/state.wgsl"
#import "math/vector.wgsl"
#import "scene/constants.wgsl"
#import "scene/dispatch.wgsl"
#import "scene/records.wgsl"
#import "scene/through.wgsl"
#import "trace/ray.wgsl"

// Moves the shadow ray behind its hit; false if nothing gets there. The hit is the nearest one, as no
// surface of an opaque material was on the way.
fn beam_advance(path: ptr<function, Path>, hit: Hit) -> bool {
    let origin = state_origin((*path).point, (*path).gap, (*path).shadow_dir);
    let s = dispatch_surface(hit, origin, (*path).shadow_dir, (*path).time);
    let flags = load_material_flags(s.material);
    if ((flags & FLAG_THROUGH) == 0u) {
        return false;
    }
    (*path).shadow_radiance *= dispatch_through(path, s, flags, hit);
    if (vector_max((*path).shadow_radiance) <= 0.0) {
        return false;
    }
    if (!(*path).beam.used) {
        (*path).beam = Aside(true, (*path).point, (*path).gap, (*path).skip, (*path).beam.vertex);
    }
    (*path).point = s.p;
    (*path).gap = s.ng * s.gap;
    (*path).skip = ray_skip(hit);
    (*path).shadow_t -= hit.t;
    return true;
}

// The shadow ray has come to its end: the path goes on where it was.
fn beam_end(path: ptr<function, Path>) {
    if ((*path).beam.used) {
        (*path).point = (*path).beam.point;
        (*path).gap = (*path).beam.gap;
        (*path).skip = (*path).beam.skip;
        (*path).beam.used = false;
    }
}
