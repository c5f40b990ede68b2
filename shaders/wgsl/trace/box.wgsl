// Ray against box: the interval in which the ray is inside all three slabs.

// One over each component, which is first moved away from 0 to +-1e-20: finite, and 0 times it is 0.
fn box_inverse(dir: vec3f) -> vec3f {
    let tiny = select(vec3f(-1e-20), vec3f(1e-20), dir >= vec3f(0.0));
    return vec3f(1.0) / select(dir, tiny, abs(dir) < vec3f(1e-20));
}

// Distance at which the ray enters the box, >= `t_min`, or 2e30 if it misses the box, leaves it before `t_min` >= 0 or
// reaches it beyond `t_max`. (corner - origin) * inverse does not cancel far from the origin; the far end grows by
// 2^-20 for the quotient's 2.5 ulp, so that no ray slips through the seam between two boxes (Ize 2013, "Robust BVH Ray
// Traversal", JCGT 2(2)).
fn box_enter(lo: vec3f, hi: vec3f, origin: vec3f, inverse: vec3f, t_min: f32, t_max: f32) -> f32 {
    let a = (lo - origin) * inverse;
    let b = (hi - origin) * inverse;
    let near = min(a, b);
    let far = max(a, b);
    let enter = max(max(near.x, near.y), max(near.z, t_min));
    let leave = min(min(far.x, far.y), min(far.z, t_max)) * 1.00000095;
    return select(2e30, enter, enter <= leave);
}
