// The mirror direction moved by a uniform point of a ball of radius `fuzz`.
// The lobe is not reciprocal, and what falls below the horizon is absorbed: with cos m of the mirror
// direction and t = min(1, m / fuzz), the share 1/2 + 3t/4 - t^3/4 is reflected.

#import "bsdf/scatter.wgsl"
#import "math/exp_log.wgsl"
#import "math/disk.wgsl"
#import "math/vector.wgsl"

// Below this radius the lobe is a mirror: narrower than a thousandth of a radian.
const METAL_SMOOTH: f32 = 1e-3;

// Samples `wi`. `u`: point on the sphere, `v`: radius in the ball; all in [0, 1 - 2^-24].
fn metal_sample(s: Scatter, wo: vec3f, u: vec2f, v: f32) -> Scattered {
    let r = scatter_mirror(s, wo);
    if (s.fuzz < METAL_SMOOTH) {
        return Scattered(r, 0.0, s.color, 1.0);
    }
    let wi = metal_direction(r, s.fuzz, u, v);
    if (!scatter_above(s, wi)) {
        return scatter_absorb();
    }
    return Scattered(wi, metal_density(wi, r, s.fuzz), s.color, 1.0);
}

// The direction `r` moved by a point of a ball of radius `fuzz`, unit. `u`, `v`: as in `metal_sample`.
fn metal_direction(r: vec3f, fuzz: f32, u: vec2f, v: f32) -> vec3f {
    let at = disk_concentric(u);
    let z = 1.0 - 2.0 * at.r * at.r;
    let on_sphere = vec3f(at.turn * sqrt(max(1.0 - z * z, 0.0)), z);
    let d = r + on_sphere * (fuzz * exp_log_cbrt(v));
    // With a ball that reaches the surface point the sum may vanish.
    return select(vector_unit(d), r, dot(d, d) < 1e-12);
}

// `d`, or where it is below the plane of the normal `n` its mirror image: what the ball sends below the surface
// comes out again.
fn metal_folded(d: vec3f, n: vec3f) -> vec3f {
    return d - n * (2.0 * min(dot(d, n), 0.0));
}

// Density of `metal_folded` directions around `r`, per steradian of `wi` above the plane.
fn metal_folded_density(wi: vec3f, r: vec3f, n: vec3f, fuzz: f32) -> f32 {
    let below = vector_unit(wi - n * (2.0 * dot(wi, n)));
    return metal_density(wi, r, fuzz) + metal_density(below, r, fuzz);
}

// f |cos|, the colour times the density, 0 below the surface; and the density of `metal_sample`. Nothing for a mirror.
fn metal_eval(s: Scatter, wo: vec3f, wi: vec3f) -> Evaluated {
    if (s.fuzz < METAL_SMOOTH) {
        return scatter_nothing();
    }
    let density = metal_density(wi, scatter_mirror(s, wo), s.fuzz);
    return scatter_only(Evaluated(s.color * density, density), scatter_above(s, wi));
}

// Density per steradian of d = unit(r + a xi), xi uniform in the unit ball. With c = cos(d, r) the ray
// from 0 along d is inside the ball for c - q < t < c + q, q^2 = a^2 - sin^2, and the density is the
// integral of t^2 over it, over the volume 4 pi a^3 / 3.
// |d - r|^2 = 2 (1 - c) keeps narrow lobes exact: 7e-8 where 1 - c^2 is 6 % off.
fn metal_density(d: vec3f, r: vec3f, a: f32) -> f32 {
    let e = d - r;
    let h = dot(e, e);
    let c = 1.0 - 0.5 * h;
    let q2 = a * a - h * (1.0 - 0.25 * h);
    if (q2 <= 0.0 || (a < 1.0 && c <= 0.0)) {
        return 0.0;
    }
    let q = sqrt(q2);
    if (a < 1.0) {
        return q * (3.0 * c * c + q2) / (2.0 * PI * a * a * a);
    }
    let t = max(c + q, 0.0);
    return t * t * t / (4.0 * PI * a * a * a);
}
