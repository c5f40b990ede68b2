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
    let most = load_frame_clamp_indirect();
    if (most <= 0.0 || (*path).scattered < 2u) {
        return (*path).radiance;
    }
    let indirect = (*path).radiance - (*path).direct;
    let largest = vector_max(indirect);
    if (largest <= most) {
        return (*path).radiance;
    }
    return (*path).direct + indirect * (most / largest);
}
