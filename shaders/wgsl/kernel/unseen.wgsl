// Lights that the camera does not see. They light the scene, cast shadows and are seen in mirrors and through glass;
// only rays that come straight from the camera pass them by.

#import "kernel/state.wgsl"
#import "kernel/straight_on.wgsl"
#import "scene/constants.wgsl"
#import "surface/surface.wgsl"

// Moves the path straight through the surface `s`, on the primitive `skip`, of a material with these flags, if it comes
// from the camera and is not to see that.
fn unseen_pass(path: ptr<function, Path>, s: Surface, flags: u32, skip: vec2u) -> bool {
    if ((flags & FLAG_UNSEEN) == 0u || (*path).scattered != 0u) {
        return false;
    }
    straight_on(path, s, skip);
    return true;
}
