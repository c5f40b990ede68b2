// Bumps: a field of heights over the surface tilts the shading normal,
//   n' = unit(n - (height / step) (I - n n^T) d),   d_k = f(q) - f(q - step e_k),
// with the axes e_k of the object (Blinn 1978, "Simulation of Wrinkled Surfaces", with differences for the
// gradient). `height`: metres between field values 0 and 1; `step`: metres.

#import "bsdf/scatter.wgsl"
#import "math/vector.wgsl"
#import "scene/motion.wgsl"
#import "scene/records.wgsl"
#import "surface/surface.wgsl"

// Least cosine between a bumped normal and the geometric one.
const BUMP_LEAST: f32 = 1e-3;

// Where the field is needed: at a step back along axis 0, 1, 2 from `q`, and at `q` itself for `k` = 3.
fn bump_point(q: vec3f, step: f32, k: u32) -> vec3f {
    return q - select(vec3f(0.0), vec3f(step), vec3u(0u, 1u, 2u) == vec3u(k));
}

// `values` with value `k` replaced.
fn bump_put(values: vec4f, k: u32, value: f32) -> vec4f {
    return select(values, vec4f(value), vec4u(0u, 1u, 2u, 3u) == vec4u(k));
}

// Tilts the shading normal of `scatter` by the field's values at the four points of `bump_point`. The bumps rise
// on the front side and are the same bumps from behind. The normal stays above the geometric surface and
// towards `wo`.
fn bump_tilt(scatter: ptr<function, Scatter>, object: u32, values: vec4f, wo: vec3f) {
    let i = (*scatter).material;
    let steepness = load_material_bump_height(i) / load_material_bump_step(i);
    let d = (vec3f(values.w) - values.xyz) * select(-steepness, steepness, (*scatter).front);
    // The rows of the object are its axes in the world, all of one length.
    let x = load_object_row_x(object);
    let turned = x * d.x + load_object_row_y(object) * d.y + load_object_row_z(object) * d.z;
    let slope = dispatch_turn_of(object, turned, (*scatter).key) / sqrt(dot(x, x));
    let n = (*scatter).ns;
    let ng = (*scatter).ng;
    let tilted = vector_unit_or(n - (slope - n * dot(n, slope)), n);
    let lift = max(BUMP_LEAST - dot(tilted, ng), 0.0);
    (*scatter).ns = surface_shading_normal(ng, vector_unit_or(tilted + ng * lift, ng), -wo);
}
