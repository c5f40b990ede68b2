// Indirect light of a path: what reaches the camera after two scatterings or more. Light that is seen directly and
// the direct light of the first vertex, whichever way it was found, are no part of it. Going straight on, through
// sheets and boundaries, is no scattering.

#import "kernel/state.wgsl"
#import "math/vector.wgsl"
#import "scene/records.wgsl"

// The path is scattered. At its second vertex it has found all of its direct light; the light that is sampled there
// comes later.
fn indirect_scattered(path: ptr<function, Path>) {
    (*path).scattered += 1u;
    if ((*path).scattered == 2u) {
        (*path).direct = (*path).radiance;
    }
}

// Radiance of a path that has ended, its indirect light scaled so that no channel exceeds what the frame says: 0
// leaves it alone, to the bit. What is not finite stays so.
fn indirect_clamped(path: ptr<function, Path>) -> vec3f {
    let scale = indirect_scale(path);
    if (scale < 0.0) {
        return (*path).radiance;
    }
    return (*path).direct + ((*path).radiance - (*path).direct) * scale;
}

// The factor on the path's indirect light; negative: it is left alone.
fn indirect_scale(path: ptr<function, Path>) -> f32 {
    let most = load_frame_clamp_indirect();
    if (most <= 0.0 || (*path).scattered < 2u) {
        return -1.0;
    }
    let largest = vector_max((*path).radiance - (*path).direct);
    if (largest <= most) {
        return -1.0;
    }
    return most / largest;
}
