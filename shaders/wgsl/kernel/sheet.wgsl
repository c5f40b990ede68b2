// Thin sheets that let some light straight through, such as petals and panes. Shadow rays go through them, so
// the straight part of a path must count as if nothing had been there: the vertex before the sheet stays the
// one that lights are weighted against. Both ways of finding a light then have densities of the same vertex,
// and their weights sum to one.

#import "bsdf/scatter.wgsl"
#import "kernel/state.wgsl"
#import "scene/constants.wgsl"
#import "scene/dispatch.wgsl"
#import "scene/projection.wgsl"
#import "scene/records.wgsl"
#import "scene/straight.wgsl"
#import "surface/surface.wgsl"
#import "trace/ray.wgsl"

// What the path's shadow ray keeps behind the sheet with surface `at`, which it has met in `hit`.
fn sheet_through(path: ptr<function, Path>, at: Surface, hit: Hit) -> vec3f {
    var s = at;
    let m = load_material_head(s.material);
    let dir = (*path).shadow_dir;
    dispatch_tangent(&s, hit, m.flags, (*path).time);
    dispatch_projection(&s, m.flags, (*path).key, (*path).time);
    dispatch_shading_normal(&s, m, dir);
    return dispatch_straight(scatter_at(m, s, (*path).key), -dir);
}

// Whether a surface with these flags is a sheet.
fn sheet_is(flags: u32) -> bool {
    return (flags & (FLAG_THROUGH | FLAG_INTERIOR)) == FLAG_THROUGH;
}

// Whether `next` goes on as the path came, through a sheet with these flags.
fn sheet_passes(path: ptr<function, Path>, flags: u32, next: Scattered) -> bool {
    if (!sheet_is(flags) || next.pdf > 0.0) {
        return false;
    }
    // The same bits: sheets do not bend light.
    let turn = next.wi - (*path).dir;
    return dot(turn, turn) == 0.0;
}
