// Where rays start off a mesh that stands for a smooth surface. A ray above the plane of its triangle starts there, by
// the ray offset, as everywhere. One that leaves below that plane, but above the smooth surface, would meet its own
// mesh at once: black pixels where the smooth surface is lit. It starts on the smooth surface instead (Hanika 2021,
// "Hacking the Shadow Terminator"), once nothing has been found between the two: so no light gets past what lies there.

#import "scene/constants.wgsl"
#import "trace/ray_offset.wgsl"

// Every ray starts at the ray offset.
const SMOOTH_START_PLAIN: u32 = 0u;
// The next ray to trace is the probe from the triangle to the smooth surface.
const SMOOTH_START_PROBE: u32 = 1u;
// Nothing is in between.
const SMOOTH_START_FREE: u32 = 2u;

struct SmoothStart {
    // From the ray offset to the smooth surface.
    bulge: vec3f,
    // One of `SMOOTH_START_...`.
    state: u32,
}

// Rays start at the ray offset.
fn smooth_start_plain() -> SmoothStart {
    return SmoothStart(vec3f(0.0), SMOOTH_START_PLAIN);
}

// Whether a ray along `dir` starts on the smooth surface. `ray_offset`: as in `Path`.
fn smooth_start_applies(start: SmoothStart, ray_offset: vec3f, dir: vec3f) -> bool {
    return start.state == SMOOTH_START_FREE && dot(ray_offset, dir) < 0.0;
}

// Where a ray along `dir` starts that leaves `point`.
fn smooth_start_origin(point: vec3f, ray_offset: vec3f, start: SmoothStart, dir: vec3f) -> vec3f {
    if (smooth_start_applies(start, ray_offset, dir)) {
        return (point + ray_offset) + start.bulge;
    }
    return ray_offset_origin(point, ray_offset, dir);
}

// What a ray along `dir` must not meet, as `Ray::skip`: its own triangle hides what is behind it from the smooth
// surface.
fn smooth_start_skip(skip: vec2u, ray_offset: vec3f, start: SmoothStart, dir: vec3f) -> vec2u {
    return select(skip, vec2u(NONE), smooth_start_applies(start, ray_offset, dir));
}
