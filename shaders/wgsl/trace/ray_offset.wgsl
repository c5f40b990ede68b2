// The ray offset: how far off its surface a ray starts, so that rounding does not let it hit that surface again
// (pbrt: OffsetRayOrigin). Its length is `Surface::ray_offset`.

// Where a ray along `dir` starts that leaves `point`: off the surface by `ray_offset`, which is along the geometric
// normal, on the side that the ray goes to.
fn ray_offset_origin(point: vec3f, ray_offset: vec3f, dir: vec3f) -> vec3f {
    return point + select(ray_offset, -ray_offset, dot(ray_offset, dir) < 0.0);
}
