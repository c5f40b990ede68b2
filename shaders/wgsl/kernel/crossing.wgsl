// How a path crosses the surfaces between media.

#import "bsdf/scatter.wgsl"
#import "kernel/state.wgsl"
#import "kernel/straight_on.wgsl"
#import "media/volume.wgsl"
#import "scene/constants.wgsl"
#import "surface/surface.wgsl"

// Moves the path straight through the surface `s`, on the primitive `skip`, if it is not there for a path in
// these media.
fn crossing_pass(path: ptr<function, Path>, s: Surface, flags: u32, skip: vec2u) -> bool {
    if ((flags & FLAG_INTERIOR) == 0u) {
        return false;
    }
    let media = (*path).inside.media;
    if (!volume_interface(media, s.material, s.front).passes) {
        return false;
    }
    crossing_move(path, s);
    straight_on(path, s, skip);
    return true;
}

// Gives `scatter` the refractive index against what is really around it.
fn crossing_bend(path: ptr<function, Path>, scatter: ptr<function, Scatter>, flags: u32) {
    if ((flags & FLAG_INTERIOR) == 0u) {
        return;
    }
    let surface = volume_interface((*path).inside.media, (*scatter).material, (*scatter).front);
    (*scatter).ior = surface.ior;
    (*scatter).ior_minus_1 = surface.ior_minus_1;
}

// The path leaves the surface `s` along `wi`, and its shadow ray, if it has one, on its own side.
fn crossing_cross(path: ptr<function, Path>, s: Surface, flags: u32, wi: vec3f) {
    (*path).inside.shadow_media = (*path).inside.media;
    (*path).inside.shadow_medium = (*path).inside.medium;
    if ((flags & FLAG_INTERIOR) == 0u) {
        return;
    }
    if (dot((*path).shadow_dir, s.ng) < 0.0) {
        let behind = volume_behind((*path).inside.media, s.material, s.front);
        (*path).inside.shadow_media = behind;
        (*path).inside.shadow_medium = volume_medium(behind);
    }
    if (dot(wi, s.ng) < 0.0) {
        crossing_move(path, s);
    }
}

// The path is behind the surface `s` now.
fn crossing_move(path: ptr<function, Path>, s: Surface) {
    let media = (*path).inside.media;
    let behind = volume_behind(media, s.material, s.front);
    (*path).inside.stack_errors += volume_stack_error(media, s.material, s.front);
    (*path).inside.media = behind;
    (*path).inside.medium = volume_medium(behind);
}

// What a shadow ray keeps at the surface `s` of a material with an inside: all where that is not there.
// The ray is behind the surface afterwards.
fn crossing_through(path: ptr<function, Path>, s: Surface) -> vec3f {
    let media = (*path).inside.shadow_media;
    if (!volume_interface(media, s.material, s.front).passes) {
        return vec3f(0.0);
    }
    let behind = volume_behind(media, s.material, s.front);
    (*path).inside.shadow_media = behind;
    (*path).inside.shadow_medium = volume_medium(behind);
    return vec3f(1.0);
}
