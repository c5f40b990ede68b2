// The phase function of Henyey & Greenstein 1941: how a small particle scatters, by one number, the mean
// cosine g. Cosines are measured from the direction in which the light goes on:
//   p = (1 - g^2) / (4 pi (1 + g^2 - 2 g cos)^1.5).
// The usual inverse, (1 + g^2 - ((1 - g^2) / (1 - g + 2 g u))^2) / 2g, loses everything near g = 0 and half of its
// digits near 1. With D = 1 - a + 2 a u, a = |g|, both 1 - cos and 1 + cos are products of positive
// factors: 3.4e-7 absolute for every a in 0 ..= 0.999999, as `tests/tests/functions` checks.

#import "math/basis.wgsl"
#import "math/disk.wgsl"
#import "math/vector.wgsl"

// A direction with density `hg_pdf` around the unit vector `forward`. `g` in -0.999999 ..= 0.999999, `u` in
// [0, 1 - 2^-24]^2.
fn hg_sample(forward: vec3f, g: f32, u: vec2f) -> vec3f {
    let at = disk_concentric(u);
    let axis = select(forward, -forward, g < 0.0);
    let local = hg_local(abs(g), at.r * at.r, at.turn);
    return vector_unit(basis_world_from_local(basis_around(axis), local));
}

// The direction than which a share `v` of all are more forward, 0 <= v <= 1, turned around z by (cos, sin) `turn`.
// `a`: as above.
fn hg_local(a: f32, v: f32, turn: vec2f) -> vec3f {
    let u = 1.0 - v;
    let om = 1.0 - a;
    let d = om + 2.0 * a * u;
    let k = om / d;
    // 1 - cos and 1 + cos.
    let omc = 2.0 * k * k * v * (1.0 + a * u);
    let j = (1.0 + a) / d;
    let opc = 2.0 * j * j * u * (om + a * u);
    let c = select(opc - 1.0, 1.0 - omc, omc < 1.0);
    return vec3f(turn * sqrt(max(omc * opc, 0.0)), c);
}

// Density of `hg_sample` towards the unit vector `wi`, per steradian.
// 1 + g^2 - 2 g cos = (1 - a)^2 + 2 a (1 - cos), and 1 - cos = |wi - axis|^2 / 2 keeps its digits where the peak is.
fn hg_pdf(forward: vec3f, g: f32, wi: vec3f) -> f32 {
    let a = abs(g);
    let om = 1.0 - a;
    let e = wi - select(forward, -forward, g < 0.0);
    let d2 = om * om + a * dot(e, e);
    // 4 pi d2^1.5.
    return om * (1.0 + a) / (d2 * (12.566371 * sqrt(d2)));
}
