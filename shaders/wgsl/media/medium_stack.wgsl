// The medium stack: the nested materials that a path is inside of, at most four, the one that counts first, then
// `NONE`. The greatest priority counts; of equal ones the one entered last, so that things wholly inside each
// other need none. Schmidt & Budge 2002, "Simple Nested Dielectrics in Ray Traced Images", JGT 7(2).

#import "scene/constants.wgsl"
#import "scene/records.wgsl"

// The stack with material `i` put in its place by priority. A fifth entry is lost.
fn medium_stack_push(media: vec4u, i: u32) -> vec4u {
    let priority = load_material_priority(i);
    if (medium_stack_yields(media.x, priority)) {
        return vec4u(i, media.x, media.y, media.z);
    }
    if (medium_stack_yields(media.y, priority)) {
        return vec4u(media.x, i, media.y, media.z);
    }
    if (medium_stack_yields(media.z, priority)) {
        return vec4u(media.x, media.y, i, media.z);
    }
    if (medium_stack_yields(media.w, priority)) {
        return vec4u(media.x, media.y, media.z, i);
    }
    return media;
}

// Whether something of this priority goes before `entry`.
fn medium_stack_yields(entry: u32, priority: u32) -> bool {
    if (entry == NONE) {
        return true;
    }
    return load_material_priority(entry) <= priority;
}

// The stack without the first entry of material `i`; unchanged if there is none.
fn medium_stack_remove(media: vec4u, i: u32) -> vec4u {
    if (media.x == i) {
        return vec4u(media.y, media.z, media.w, NONE);
    }
    if (media.y == i) {
        return vec4u(media.x, media.z, media.w, NONE);
    }
    if (media.z == i) {
        return vec4u(media.x, media.y, media.w, NONE);
    }
    if (media.w == i) {
        return vec4u(media.x, media.y, media.z, NONE);
    }
    return media;
}

// Whether material `i` is in the stack.
fn medium_stack_contains(media: vec4u, i: u32) -> bool {
    return media.x == i || media.y == i || media.z == i || media.w == i;
}
