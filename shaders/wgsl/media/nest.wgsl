// Materials inside of which a path is, and that are inside each other: at most four, the one that counts first,
// then `NONE`. The greatest priority counts; of equal ones the one entered last, so that things wholly inside each
// other need none. Schmidt & Budge 2002, "Simple Nested Dielectrics in Ray Traced Images", JGT 7(2).

#import "scene/constants.wgsl"
#import "scene/records.wgsl"

// The nest inside of material `i` too. A fifth entry is lost.
fn nest_enter(nest: vec4u, i: u32) -> vec4u {
    let priority = load_material_priority(i);
    if (nest_yields(nest.x, priority)) {
        return vec4u(i, nest.x, nest.y, nest.z);
    }
    if (nest_yields(nest.y, priority)) {
        return vec4u(nest.x, i, nest.y, nest.z);
    }
    if (nest_yields(nest.z, priority)) {
        return vec4u(nest.x, nest.y, i, nest.z);
    }
    if (nest_yields(nest.w, priority)) {
        return vec4u(nest.x, nest.y, nest.z, i);
    }
    return nest;
}

// Whether something of this priority goes before `entry`.
fn nest_yields(entry: u32, priority: u32) -> bool {
    if (entry == NONE) {
        return true;
    }
    return load_material_priority(entry) <= priority;
}

// The nest without the first entry of material `i`; itself if there is none.
fn nest_leave(nest: vec4u, i: u32) -> vec4u {
    if (nest.x == i) {
        return vec4u(nest.y, nest.z, nest.w, NONE);
    }
    if (nest.y == i) {
        return vec4u(nest.x, nest.z, nest.w, NONE);
    }
    if (nest.z == i) {
        return vec4u(nest.x, nest.y, nest.w, NONE);
    }
    if (nest.w == i) {
        return vec4u(nest.x, nest.y, nest.z, NONE);
    }
    return nest;
}

// Whether material `i` is in the nest.
fn nest_holds(nest: vec4u, i: u32) -> bool {
    return nest.x == i || nest.y == i || nest.z == i || nest.w == i;
}
