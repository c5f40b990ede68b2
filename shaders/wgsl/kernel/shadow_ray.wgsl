// Shadow rays through transmissive surfaces: thin sheets, and boundaries of media that do not refract. Such a ray
// takes one turn of the kernel's loop for each surface. It stays the same ray: behind a surface it meets what it would
// have met without it, in whatever order a tree is walked.

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
    (*path).passage.t = hit.t;
    (*path).passage.last = ray_skip(hit);
    return true;
}

// The part of the shadow ray that is left.
fn shadow_ray_rest(path: ptr<function, Path>, whole: Ray) -> Ray {
    var ray = whole;
    ray.t_min = (*path).passage.t;
    ray.last = (*path).passage.last;
    return ray;
}

// The shadow ray has ended.
fn shadow_ray_end(path: ptr<function, Path>) {
    (*path).passage.t = 0.0;
    (*path).passage.last = vec2u(NONE);
}
