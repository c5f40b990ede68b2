// Vector helpers whose rounding is the same on every device: the built-ins `normalize`, `cross` and
// `length` may be contracted or approximated, these are plain products, sums, quotients and roots.

const PI: f32 = 3.1415927410125732;
const INV_PI: f32 = 0.31830987334251404;

// `v / |v|`; the caller knows that `|v|` is neither 0 nor outside 1e-18 .. 1e18.
fn vector_unit(v: vec3f) -> vec3f {
    return v / sqrt(dot(v, v));
}

// `v / |v|` for any finite `v`, or `fallback` where `v` is 0 or subnormal. Dividing by the largest
// component first keeps the square inside f32 for triangles of any size.
fn vector_unit_or(v: vec3f, fallback: vec3f) -> vec3f {
    let largest = vector_max(abs(v));
    if (largest < 1.1754944e-38) {
        return fallback;
    }
    return vector_unit(v / largest);
}

// Cross product, one product rounded before the other is subtracted.
fn vector_cross(a: vec3f, b: vec3f) -> vec3f {
    return a.yzx * b.zxy - a.zxy * b.yzx;
}

// The largest component.
fn vector_max(v: vec3f) -> f32 {
    return max(max(v.x, v.y), v.z);
}
