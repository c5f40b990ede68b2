// The probe of `smooth_start.wgsl`: a ray from a triangle to the smooth surface over it, traced before the rays that
// need to start there. It takes one turn of the kernel's loop.

#import "kernel/smooth_start.wgsl"
#import "kernel/state.wgsl"
#import "math/vector.wgsl"
#import "scene/constants.wgsl"
#import "scene/receiver.wgsl"
#import "surface/surface.wgsl"
#import "trace/ray.wgsl"

// Says above which plane the surface of a material of this kind and these flags reflects; its shading normal is that of
// the mesh. Where light may go through, both sides of the triangle are what they are.
fn smooth_probe_horizon(s: ptr<function, Surface>, kind: u32, flags: u32) {
    let opaque = ((RECEIVER_OPAQUE >> min(kind, 31u)) & 1u) != 0u || kind == MATERIAL_PRINCIPLED;
    let bulges = dot((*s).bulge, (*s).ng) > 0.0;
    if (bulges && opaque && (flags & (FLAG_THROUGH | FLAG_INTERIOR)) == 0u) {
        (*s).horizon = (*s).ns;
    } else {
        (*s).bulge = vec3f(0.0);
    }
}

// Makes the probe the path's next ray, if the shadow ray or the next segment leaves the vertex at `s` below its
// triangle.
fn smooth_probe_begin(path: ptr<function, Path>, s: Surface) {
    (*path).start = smooth_start_plain();
    if (dot(s.bulge, s.ng) <= 0.0) {
        return;
    }
    let lights = (*path).shadow_light != NONE && dot((*path).ray_offset, (*path).shadow_dir) < 0.0;
    let goes = (*path).open && dot((*path).ray_offset, (*path).dir) < 0.0;
    if (lights) {
        smooth_probe_aim(path, s.bulge);
    }
    if (lights || goes) {
        (*path).start = SmoothStart(s.bulge, SMOOTH_START_PROBE);
    }
}

// Turns the shadow ray, which was aimed from the far side of the triangle, so that it ends at the same point.
fn smooth_probe_aim(path: ptr<function, Path>, bulge: vec3f) {
    let sides = (*path).ray_offset + (*path).ray_offset;
    let v = ((*path).shadow_dir * (*path).shadow_t - bulge) - sides;
    let d2 = dot(v, v);
    // Too far to be missed, as the sky is; or no distance at all.
    if ((*path).shadow_t >= 1e5 || d2 < 1.1754944e-38) {
        return;
    }
    let t = sqrt(d2);
    (*path).shadow_dir = v / t;
    (*path).shadow_t = t;
}

// The ray to trace next: the probe, or else `ray`.
fn smooth_probe_ray(path: ptr<function, Path>, ray: Ray) -> Ray {
    if ((*path).start.state != SMOOTH_START_PROBE) {
        return ray;
    }
    let length = sqrt(dot((*path).start.bulge, (*path).start.bulge));
    let dir = vector_unit_or((*path).start.bulge, ray.dir);
    return ray_new((*path).point + (*path).ray_offset, dir, length, (*path).skip, NONE, (*path).time);
}

// Takes the probe's answer, if the ray was the probe. What it has met hides all that is below the triangle.
fn smooth_probe_advance(path: ptr<function, Path>, hit: Hit) -> bool {
    if ((*path).start.state != SMOOTH_START_PROBE) {
        return false;
    }
    if (hit.prim == NONE) {
        (*path).start.state = SMOOTH_START_FREE;
        return true;
    }
    (*path).start = smooth_start_plain();
    if (dot((*path).ray_offset, (*path).shadow_dir) < 0.0) {
        (*path).shadow_light = NONE;
    }
    (*path).open = (*path).open && dot((*path).ray_offset, (*path).dir) >= 0.0;
    return true;
}
