// Which media a path is in, and what a surface between two of them is.

#import "media/medium_stack.wgsl"
#import "scene/constants.wgsl"
#import "scene/records.wgsl"
#import "trace/ray.wgsl"

struct Volume {
    // The medium stack of the path.
    media: vec4u,
    // Index of the `Medium` there, or `NONE`.
    medium: u32,
    // The same of the shadow ray.
    shadow_media: vec4u,
    shadow_medium: u32,
    // How far the path comes along its next segment before the medium scatters it, if nothing else is in its way.
    free_path: f32,
    // As `FilmPixel::stack_errors`.
    stack_errors: u32,
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
    let media = load_frame_inside();
    let medium = volume_medium(media);
    return Volume(media, medium, media, medium, RAY_FAR, 0u);
}

// The medium at the top of the stack `media`, or the atmosphere.
fn volume_medium(media: vec4u) -> u32 {
    if (media.x == NONE) {
        return load_frame_air();
    }
    return load_material_medium(media.x);
}

// The surface of material `i` for a path in `media` that comes from its `front` side, or from inside.
// A surface inside of what has a greater priority is not there; nor is one between equal indices.
fn volume_interface(media: vec4u, i: u32, front: bool) -> Interface {
    let first = !front && media.x == i;
    let outer = select(media.x, media.y, first);
    var outer_minus_1 = 0.0;
    if (outer != NONE) {
        let buried = !front && !first && medium_stack_contains(media, i);
        if (buried || (!first && load_material_priority(outer) > load_material_priority(i))) {
            return Interface(true, 1.0, 0.0);
        }
        outer_minus_1 = load_material_ior_minus_1(outer);
    }
    let minus_1 = (load_material_ior_minus_1(i) - outer_minus_1) / (1.0 + outer_minus_1);
    return Interface(minus_1 == 0.0, 1.0 + minus_1, minus_1);
}

// The medium stack behind the surface of material `i`.
fn volume_behind(media: vec4u, i: u32, front: bool) -> vec4u {
    if (front) {
        return medium_stack_push(media, i);
    }
    return medium_stack_remove(media, i);
}

// What crossing that surface adds to `Volume::stack_errors`.
fn volume_stack_error(media: vec4u, i: u32, front: bool) -> u32 {
    if (front) {
        return select(0u, 1u, media.w != NONE);
    }
    return select(0x10000u, 0u, medium_stack_contains(media, i));
}
