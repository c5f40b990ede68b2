// The start of a path's next ray, put aside while its shadow ray is traced from somewhere else.

#import "scene/constants.wgsl"

struct Aside {
    // There is something put aside: `point`, `gap` and `skip` of the path.
    used: bool,
    point: vec3f,
    gap: vec3f,
    skip: u32,
}

// Nothing yet.
fn aside_empty() -> Aside {
    return Aside(false, vec3f(0.0), vec3f(0.0), NONE);
}
