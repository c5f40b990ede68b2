// Floats: rounding, built-ins, literals.

const PI = 3.14159265358979;
const INV_PI: f32 = 1.0 / PI;
const THIRD = 1.0 / 3.0;
const TINY: f32 = 1e-7;
const MIX = vec3<f32>(0.1, 0.7, 1e-3);
override gamma: f32 = 2.2;

fn tenth() -> f32 { return 0.1; }
fn pi_times(x: f32) -> f32 { return x * PI; }
fn inv_pi() -> f32 { return INV_PI; }
fn third(x: f32) -> f32 { return x * THIRD; }
fn long_decimal() -> f32 { return 0.123456789012345; }
fn negative() -> f32 { return -0.7; }
fn suffixed() -> f32 { return 0.3f + TINY; }
fn folded() -> f32 { return 2.0 * PI - 0.1; }
fn whole_number() -> f32 { return 3; }
fn hexadecimal() -> f32 { return 0x1.8p1; }
fn constant_vector() -> vec3<f32> { return MIX; }
fn overridden(x: f32) -> f32 { return x * gamma; }
fn largest() -> f32 { return 3.4028235e38; }

fn floor_ceil(x: f32) -> vec2<f32> { return vec2<f32>(floor(x), ceil(x)); }
fn rounded(x: f32) -> f32 { return round(x); }
fn truncated(x: f32) -> f32 { return trunc(x); }
fn fraction(x: f32) -> f32 { return fract(x); }
fn sign_f(x: f32) -> f32 { return sign(x); }
fn smaller(a: f32, b: f32) -> f32 { return min(a, b); }
fn larger(a: vec3<f32>, b: vec3<f32>) -> vec3<f32> { return max(a, b); }
fn clamped(x: f32) -> f32 { return clamp(x, -1.5, 2.5); }
fn saturated(x: vec2<f32>) -> vec2<f32> { return saturate(x); }
fn root(x: f32) -> f32 { return sqrt(x); }
fn inverse_root(x: f32) -> f32 { return inverseSqrt(x); }
fn absolute(x: vec4<f32>) -> vec4<f32> { return abs(x); }
fn stepped(e: f32, x: f32) -> f32 { return step(e, x); }
fn smooth_ramp(x: f32) -> f32 { return smoothstep(1.0, 3.0, x); }
fn mixed(a: vec2<f32>, b: vec2<f32>, t: f32) -> vec2<f32> { return mix(a, b, t); }
fn fused(a: f32, b: f32, c: f32) -> f32 { return fma(a, b, c); }
fn waves(x: f32) -> vec3<f32> { return vec3<f32>(sin(x), cos(x), tan(x)); }
fn arcs(x: f32) -> vec4<f32> { return vec4<f32>(asin(x), acos(x), atan(x), atan2(x, 2.0)); }
fn growth(x: f32) -> vec4<f32> { return vec4<f32>(exp(x), exp2(x), log(x), log2(x)); }
fn power(x: f32, y: f32) -> f32 { return pow(x, y); }
fn angles(x: f32) -> vec2<f32> { return vec2<f32>(radians(x), degrees(x)); }
fn scaled(x: f32, e: i32) -> f32 { return ldexp(x, e); }
fn parts(x: f32) -> vec2<f32> { let p = modf(x); return vec2<f32>(p.fract, p.whole); }
fn mantissa(x: f32) -> f32 { return frexp(x).fract; }
fn exponent(x: f32) -> i32 { return frexp(x).exp; }
fn halved(x: f32) -> f32 { return quantizeToF16(x); }
fn polynomial(x: f32) -> f32 { return ((0.2 * x + 0.3) * x - 0.4) * x + 0.5; }
