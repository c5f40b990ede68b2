// Vectors and matrices.

const AXIS = vec3<f32>(0.1, 0.2, 0.3);

fn zxy(v: vec3<f32>) -> vec3<f32> { return v.zxy; }
fn xxz(v: vec3<f32>) -> vec3<f32> { return v.xxz; }
fn wzyx(v: vec4<f32>) -> vec4<f32> { return v.wzyx; }
fn yzw(v: vec4<u32>) -> vec3<u32> { return v.yzw; }
fn zw(v: vec4<i32>) -> vec2<i32> { return v.zw; }
fn yy(v: vec2<bool>) -> vec4<bool> { return v.yyxx; }
fn chained(v: vec4<f32>) -> vec2<f32> { return v.wzyx.yx.yx; }
fn of_sum(v: vec4<f32>) -> vec2<f32> { return (v + v.wzyx).wx; }
fn constant_swizzle() -> vec3<f32> { return AXIS.zyx; }

fn composed(a: vec2<f32>, b: f32) -> vec4<f32> { return vec4<f32>(b, a, b); }
fn from_pairs(a: vec2<u32>, b: vec2<u32>) -> vec4<u32> { return vec4<u32>(a.yx, b); }
fn splat(a: f32) -> vec3<f32> { return vec3<f32>(a); }

fn select_scalar(f: f32, t: f32, c: bool) -> f32 { return select(f, t, c); }
fn select_whole(f: vec3<f32>, t: vec3<f32>, c: bool) -> vec3<f32> { return select(f, t, c); }
fn select_lanes(f: vec3<f32>, t: vec3<f32>, c: vec3<bool>) -> vec3<f32> { return select(f, t, c); }
fn select_less(a: vec4<u32>, b: vec4<u32>) -> vec4<u32> { return select(b, a, a < b); }

fn less(a: vec3<f32>, b: vec3<f32>) -> vec3<bool> { return a < b; }
fn equal(a: vec4<f32>, b: vec4<f32>) -> vec4<bool> { return a == b; }
fn any_all(v: vec3<bool>) -> u32 {
    return select(0u, 1u, any(v)) + select(0u, 2u, all(v)) + select(0u, 4u, any(v.x)) + select(0u, 8u, all(!v));
}
fn bools(a: vec2<bool>, b: vec2<bool>) -> vec2<bool> { return (a & b) | !a; }

fn arithmetic(a: vec3<f32>, b: vec3<f32>, s: f32) -> vec3<f32> {
    return (a + b * s) / (s - b) - s * a / s;
}
fn negated(a: vec4<f32>) -> vec4<f32> { return -a; }
fn remainder(a: f32, b: f32) -> f32 { return a % b; }
fn remainder_v(a: vec2<f32>, b: f32) -> vec2<f32> { return a % b; }

fn dot3(a: vec3<f32>, b: vec3<f32>) -> f32 { return dot(a, b); }
fn dot4(a: vec4<f32>, b: vec4<f32>) -> f32 { return dot(a, b); }
fn cross3(a: vec3<f32>, b: vec3<f32>) -> vec3<f32> { return cross(a, b); }
fn length3(a: vec3<f32>) -> f32 { return length(a); }
fn length1(a: f32) -> f32 { return length(a); }
fn distance3(a: vec3<f32>, b: vec3<f32>) -> f32 { return distance(a, b); }
fn normalize3(a: vec3<f32>) -> vec3<f32> { return normalize(a); }
fn reflected(a: vec3<f32>, n: vec3<f32>) -> vec3<f32> { return reflect(a, n); }
fn refracted(a: vec3<f32>, n: vec3<f32>, eta: f32) -> vec3<f32> { return refract(a, n, eta); }
fn facing(n: vec3<f32>, i: vec3<f32>, r: vec3<f32>) -> vec3<f32> { return faceForward(n, i, r); }

fn mat_vec(v: vec3<f32>) -> vec3<f32> {
    let m = mat3x3<f32>(vec3(1.0, 2.0, 3.0), vec3(4.0, 5.0, 6.0), vec3(7.0, 8.0, 9.5));
    return m * v;
}
fn vec_mat(v: vec2<f32>) -> vec2<f32> {
    let m = mat2x2<f32>(1.0, 2.0, 3.0, 4.0);
    return v * m;
}
fn mat_mat(a: mat2x2<f32>, b: mat2x2<f32>) -> mat2x2<f32> { return a * b; }
fn mat_scaled(a: mat4x4<f32>, s: f32) -> mat4x4<f32> { return s * a + a - a * s; }
fn mat_column(a: mat4x4<f32>, i: u32) -> vec4<f32> { return a[i]; }
fn mat_entry(a: mat3x3<f32>) -> f32 { return a[2][0] * 10.0 + a[0].z; }
fn affine(p: vec3<f32>) -> vec3<f32> {
    let m = mat4x3<f32>(1.0, 0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 3.0, 10.0, 20.0, 30.0);
    return m * vec4<f32>(p, 1.0);
}
fn affine_transposed(p: vec3<f32>) -> vec4<f32> {
    var m = transpose(mat4x3<f32>(1.0, 0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 3.0, 10.0, 20.0, 30.0));
    m[1][3] = 25.0;
    return m * p;
}
fn determinant3(m: mat3x3<f32>) -> f32 { return determinant(m); }
fn transposed(m: mat3x3<f32>) -> mat3x3<f32> { return transpose(m); }
