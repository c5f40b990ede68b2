// What it means that a surface is not there for a path.

#import "kernel/state.wgsl"
#import "scene/start.wgsl"
#import "surface/surface.wgsl"

// Moves the path straight on behind the surface `s`, on the primitive `skip`. That is no vertex: density and point of
// the last one stay, for the weight of a light that the path may find.
fn straight_on(path: ptr<function, Path>, s: Surface, skip: vec2u) {
    // Other random numbers for the next segment, which does not count as one.
    (*path).key.bounce += 1u;
    (*path).segments -= 1u;
    (*path).point = s.p;
    (*path).ray_offset = s.ng * s.ray_offset;
    (*path).skip = skip;
    (*path).start = dispatch_start_plain();
}
