// Shadow rays through transmissive surfaces: thin sheets, and boundaries of media that do not refract. Such a ray
// takes one turn of the kernel's loop for each surface, while the path's own next ray is pending.

#import "kernel/pending_ray.wgsl"
#import "kernel/state.wgsl"
#import "math/vector.wgsl"
#import "scene/constants.wgsl"
#import "scene/dispatch.wgsl"
#import "scene/records.wgsl"
#import "scene/start.wgsl"
#import "scene/through.wgsl"
#import "trace/ray.wgsl"

// Moves the shadow ray through the surface it hit; false if that lets no light through. The hit is the nearest
// one, as no surface of an opaque material was on the way.
fn shadow_ray_advance(path: ptr<function, Path>, hit: Hit) -> bool {
    let origin = dispatch_origin((*path).point, (*path).ray_offset, (*path).start, (*path).shadow_dir);
    let s = dispatch_surface(hit, origin, (*path).shadow_dir, (*path).time);
    let flags = load_material_flags(s.material);
    if ((flags & FLAG_THROUGH) == 0u) {
        return false;
    }
    (*path).shadow_radiance *= dispatch_through(path, s, flags, hit);
    if (vector_max((*path).shadow_radiance) <= 0.0) {
        return false;
    }
    if (!(*path).pending.used) {
        (*path).pending = PendingRay(true, (*path).point, (*path).ray_offset, (*path).skip, (*path).pending.vertex);
    }
    (*path).point = s.p;
    (*path).ray_offset = s.ng * s.ray_offset;
    (*path).skip = ray_skip(hit);
    (*path).start = dispatch_start_held((*path).start);
    (*path).shadow_t -= hit.t;
    return true;
}

// The shadow ray has ended: the pending ray is the path's next one again.
fn shadow_ray_end(path: ptr<function, Path>) {
    if ((*path).pending.used) {
        (*path).point = (*path).pending.point;
        (*path).ray_offset = (*path).pending.ray_offset;
        (*path).skip = (*path).pending.skip;
        (*path).pending.used = false;
        (*path).start = dispatch_start_resumed((*path).start);
    }
}
