// Integers: wrapping, shifts, quotients, bits, conversions.

fn add(a: u32, b: u32) -> u32 { return a + b; }
fn sub(a: u32, b: u32) -> u32 { return a - b; }
fn mul(a: i32, b: i32) -> i32 { return a * b; }
fn neg(a: i32) -> i32 { return -a; }
fn abs_i(a: i32) -> i32 { return abs(a); }
fn div_u(a: u32, b: u32) -> u32 { return a / b; }
fn rem_u(a: u32, b: u32) -> u32 { return a % b; }
fn div_i(a: i32, b: i32) -> i32 { return a / b; }
fn rem_i(a: i32, b: i32) -> i32 { return a % b; }
fn div_v(a: vec3<i32>, b: vec3<i32>) -> vec3<i32> { return a / b; }
fn rem_v(a: vec2<u32>, b: vec2<u32>) -> vec2<u32> { return a % b; }
fn mul_v(a: vec3<u32>, s: u32) -> vec3<u32> { return a * s + 1u; }
fn sub_v(s: u32, a: vec3<u32>) -> vec3<u32> { return s - a; }
fn neg_v(a: vec2<i32>) -> vec2<i32> { return -a; }
fn shl(a: u32, n: u32) -> u32 { return a << n; }
fn shr(a: u32, n: u32) -> u32 { return a >> n; }
fn shr_i(a: i32, n: u32) -> i32 { return a >> n; }
fn shl_v(a: vec2<u32>, n: vec2<u32>) -> vec2<u32> { return a << n; }
fn masks(a: u32, b: u32) -> u32 { return (a & b) | (a ^ ~b); }
fn masks_v(a: vec4<u32>, b: vec4<u32>) -> vec4<u32> { return (a & b) | (a ^ ~b); }
fn limits(a: i32) -> i32 { return clamp(max(min(a, 50), -50), -7, 9); }
fn clamp_crossed(a: i32) -> i32 { var low = 5; var high = 3; return clamp(a, low, high); }
fn sign_i(a: i32) -> i32 { return sign(a); }
fn most_negative() -> i32 { return -2147483648; }

fn to_u32(x: f32) -> u32 { return u32(x); }
fn to_i32(x: f32) -> i32 { return i32(x); }
fn to_u32_v(x: vec3<f32>) -> vec3<u32> { return vec3<u32>(x); }
fn from_u32(x: u32) -> f32 { return f32(x); }
fn from_i32(x: vec2<i32>) -> vec2<f32> { return vec2<f32>(x); }
fn from_bool(x: bool) -> vec3<f32> { return vec3<f32>(f32(x), f32(u32(x)), f32(i32(x))); }
fn to_bool(x: f32, y: u32, z: i32) -> vec3<bool> { return vec3<bool>(bool(x), bool(y), bool(z)); }
fn sign_change(x: u32) -> i32 { return i32(x) + bitcast<i32>(x); }
fn to_bits(x: f32) -> u32 { return bitcast<u32>(x); }
fn to_bits_i(x: vec2<f32>) -> vec2<i32> { return bitcast<vec2<i32>>(x); }
fn from_bits(x: u32) -> f32 { return bitcast<f32>(x); }
fn from_bits_v(x: vec4<u32>) -> vec4<f32> { return bitcast<vec4<f32>>(x); }
fn from_bits_i(x: i32) -> f32 { return bitcast<f32>(x); }
fn infinity() -> f32 { let bits = 0x7f800000u; return bitcast<f32>(bits); }
fn words_to_ints(x: vec3<u32>) -> vec3<i32> { return bitcast<vec3<i32>>(x); }

fn reverse(x: u32) -> u32 { return reverseBits(x); }
fn ones(x: u32) -> u32 { return countOneBits(x); }
fn ones_i(x: i32) -> i32 { return countOneBits(x); }
fn leading(x: u32) -> u32 { return countLeadingZeros(x); }
fn trailing(x: vec2<u32>) -> vec2<u32> { return countTrailingZeros(x); }
fn first_leading(x: u32) -> u32 { return firstLeadingBit(x); }
fn first_leading_i(x: i32) -> i32 { return firstLeadingBit(x); }
fn first_trailing(x: u32) -> u32 { return firstTrailingBit(x); }
fn extract(x: u32, o: u32, c: u32) -> u32 { return extractBits(x, o, c); }
fn extract_i(x: i32, o: u32, c: u32) -> i32 { return extractBits(x, o, c); }
fn extract_v(x: vec2<u32>, o: u32, c: u32) -> vec2<u32> { return extractBits(x, o, c); }
fn insert(x: u32, n: u32, o: u32, c: u32) -> u32 { return insertBits(x, n, o, c); }
fn dot_u(a: vec3<u32>, b: vec3<u32>) -> u32 { return dot(a, b); }

fn pcg4d(seed: vec4<u32>) -> vec4<u32> {
    var v = seed * 1664525u + 1013904223u;
    v.x += v.y * v.w;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v.w += v.y * v.z;
    v = v ^ (v >> vec4<u32>(16u));
    v.x += v.y * v.w;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v.w += v.y * v.z;
    return v;
}

fn pack_half(v: vec2<f32>) -> u32 { return pack2x16float(v); }
fn unpack_half(x: u32) -> vec2<f32> { return unpack2x16float(x); }
fn pack_snorm2(v: vec2<f32>) -> u32 { return pack2x16snorm(v); }
fn unpack_snorm2(x: u32) -> vec2<f32> { return unpack2x16snorm(x); }
fn pack_unorm2(v: vec2<f32>) -> u32 { return pack2x16unorm(v); }
fn unpack_unorm2(x: u32) -> vec2<f32> { return unpack2x16unorm(x); }
fn pack_snorm4(v: vec4<f32>) -> u32 { return pack4x8snorm(v); }
fn unpack_snorm4(x: u32) -> vec4<f32> { return unpack4x8snorm(x); }
fn pack_unorm4(v: vec4<f32>) -> u32 { return pack4x8unorm(v); }
fn unpack_unorm4(x: u32) -> vec4<f32> { return unpack4x8unorm(x); }
fn bytes(x: u32) -> vec4<u32> { return unpack4xU8(x); }
fn bytes_i(x: u32) -> vec4<i32> { return unpack4xI8(x); }
fn join(v: vec4<u32>) -> u32 { return pack4xU8(v); }
fn join_clamped(v: vec4<i32>) -> u32 { return pack4xI8Clamp(v); }
fn packed_dot(a: u32, b: u32) -> i32 { return dot4I8Packed(a, b); }
