// Which media a path is in, and what a surface between two of them is.

#import "media/nest.wgsl"
#import "scene/constants.wgsl"
#import "scene/records.wgsl"

struct Volume {
    // Materials inside of which the path is, as in `nest_enter`.
    nest: vec4u,
    // Index of the `Medium` there, or `NONE`.
    medium: u32,
    // The same for the shadow ray.
    shadow_nest: vec4u,
    shadow_medium: u32,
    // As `FilmPixel::strays`.
    strays: u32,
}

// A surface as it is for a path between two media.
struct Interface {
    // The path goes straight on, as if nothing were there.
    passes: bool,
    // Refractive index of the inside over the outside, and the same less one, exact near 1.
    ior: f32,
    ior_minus_1: f32,
}

// What a path that leaves the camera is in.
fn volume_begin() -> Volume {
    let nest = load_frame_inside();
    let medium = volume_medium(nest);
    return Volume(nest, medium, nest, medium, 0u);
}

// The medium inside of `nest`: that of its first entry, or the atmosphere.
fn volume_medium(nest: vec4u) -> u32 {
    if (nest.x == NONE) {
        return load_frame_air();
    }
    return load_material_medium(nest.x);
}

// The surface of material `i` for a path in `nest` that comes from its `front` side, or from inside.
// A surface inside of what has a greater priority is not there; nor is one between equal indices.
fn volume_interface(nest: vec4u, i: u32, front: bool) -> Interface {
    let first = !front && nest.x == i;
    let outer = select(nest.x, nest.y, first);
    var outer_minus_1 = 0.0;
    if (outer != NONE) {
        let buried = !front && !first && nest_holds(nest, i);
        if (buried || (!first && load_material_priority(outer) > load_material_priority(i))) {
            return Interface(true, 1.0, 0.0);
        }
        outer_minus_1 = load_material_ior_minus_1(outer);
    }
    let minus_1 = (load_material_ior_minus_1(i) - outer_minus_1) / (1.0 + outer_minus_1);
    return Interface(minus_1 == 0.0, 1.0 + minus_1, minus_1);
}

// The nest behind the surface of material `i`.
fn volume_behind(nest: vec4u, i: u32, front: bool) -> vec4u {
    if (front) {
        return nest_enter(nest, i);
    }
    return nest_leave(nest, i);
}

// What crossing that surface adds to `Volume::strays`.
fn volume_stray(nest: vec4u, i: u32, front: bool) -> u32 {
    if (front) {
        return select(0u, 1u, nest.w != NONE);
    }
    return select(0x10000u, 0u, nest_holds(nest, i));
}
