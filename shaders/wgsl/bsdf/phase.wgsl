// Scattering inside a medium: the phase function of Henyey & Greenstein 1941,
//   p = (1 - g^2) / (4 pi (1 + g^2 - 2 g cos)^1.5),   cos between the directions of travel before and after.
// `Scatter::material` is the index of the `Medium`. Beyond |g| = 1 - 1e-6 light goes straight on, or back.

#import "bsdf/scatter.wgsl"
#import "math/basis.wgsl"
#import "math/sincos.wgsl"
#import "math/vector.wgsl"
#import "sampler/key.wgsl"
#import "scene/records.wgsl"
#import "surface/place.wgsl"

// `Scatter::kind` of a point in a medium.
const PHASE_KIND: u32 = 0xffffffffu;

// From here on scattering is a delta.
const PHASE_DELTA: f32 = 0.999999;

// A point in medium `i`: without normals.
fn phase_scatter(i: u32, key: SampleKey) -> Scatter {
    let none = vec3f(0.0);
    return Scatter(
        none, none, none, PHASE_KIND, i,
        none, 1.0, vec2f(0.0), Place(none, 0u), 0.0,
        0.0, 0.0,
        1.0, 0.0, true, key,
    );
}

// Samples `wi`; `u` in [0, 1 - 2^-24]^2. With D = 1 - |g| + 2 |g| u, for the cosine c to the likelier side,
// 1 - c = 2 (1 - |g|)^2 (1 - u) (1 + |g| u) / D^2 and 1 + c = 2 (1 + |g|)^2 u (1 - |g| + |g| u) / D^2: nothing
// is divided by g, and nothing cancels.
fn phase_sample(s: Scatter, wo: vec3f, u: vec2f) -> Scattered {
    let g = load_medium_g(s.material);
    let a = abs(g);
    let likely = select(-wo, wo, g < 0.0);
    if (a >= PHASE_DELTA) {
        return Scattered(likely, 0.0, vec3f(1.0), 1.0);
    }
    let om = 1.0 - a;
    let op = 1.0 + a;
    let au = a * u.x;
    let d = om + 2.0 * au;
    let near = om / d;
    let far = op / d;
    let omc = 2.0 * (near * near) * ((1.0 - u.x) * (1.0 + au));
    let opc = 2.0 * (far * far) * (u.x * (om + au));
    let c = select(opc - 1.0, 1.0 - omc, omc < 1.0);
    let sc = sincos_2pi(u.y) * sqrt(omc * opc);
    let wi = vector_unit(basis_world_from_local(basis_around(likely), vec3f(sc.y, sc.x, c)));
    return Scattered(wi, phase_pdf(s, wo, wi), vec3f(1.0), 1.0);
}

// The phase function, per steradian; 0 where it is a delta.
fn phase_eval(s: Scatter, wo: vec3f, wi: vec3f) -> vec3f {
    return vec3f(phase_pdf(s, wo, wi));
}

// Density of `phase_sample`: the phase function itself. 1 - c is taken from the difference of the
// directions, which is exact where they are close.
fn phase_pdf(s: Scatter, wo: vec3f, wi: vec3f) -> f32 {
    let g = load_medium_g(s.material);
    let a = abs(g);
    if (a >= PHASE_DELTA) {
        return 0.0;
    }
    let e = wi + select(wo, -wo, g < 0.0);
    let om = 1.0 - a;
    // (1 - |g|)^2 + 2 |g| (1 - c)
    let d2 = om * om + a * dot(e, e);
    return (om / d2) * ((1.0 + a) * 0.07957747) / sqrt(d2); // 1 / (4 pi)
}
