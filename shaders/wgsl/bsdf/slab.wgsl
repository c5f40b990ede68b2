// Multiple scattering inside a thin parallel slab, found by a random walk that knows only its depth: where
// on the slab light comes out does not matter, because the slab is thin.
// Guo, Hasan & Zhao 2018, "Position-Free Monte Carlo Simulation for Arbitrary Layered BSDFs", ACM TOG 37(6).
// At every point of the walk the light is joined to the wanted direction outside, through both ways in
// which it can reach it: straight to its side, or off the other side first. What the two sides throw back and
// forth unscattered is a geometric series, and is summed.

#import "bsdf/fresnel.wgsl"
#import "bsdf/hg.wgsl"
#import "math/beer.wgsl"
#import "math/vector.wgsl"
#import "sampler/key.wgsl"
#import "scene/sampler.wgsl"

// A slab and its frame. z points into it from the side of the viewer; 0 is that side.
struct Slab {
    // Extinction and scattering times the thickness: optical depths across the slab.
    tau: vec3f,
    tau_s: f32,
    // Mean cosine of scattering.
    g: f32,
    // Refractive index over the outside, and the same less one.
    ior: f32,
    ior_minus_1: f32,
}

// The cosine inside for a cosine `c` >= 0 outside. 1 - (1 - c^2) / n^2 would lose grazing directions near n = 1.
fn slab_inside(slab: Slab, c: f32) -> f32 {
    return sqrt(slab.ior_minus_1 * (slab.ior + 1.0) + c * c) / slab.ior;
}

// Share that a side reflects of light inside at cosine `c`.
fn slab_mirror(slab: Slab, c: f32) -> f32 {
    return fresnel_dielectric(min(c, 1.0), 1.0 / slab.ior, -slab.ior_minus_1 / slab.ior);
}

// What goes through the slab without scattering, straight through and back, the first crossing of the side
// left out.
struct SlabPassage {
    through: vec3f,
    back: vec3f,
}

// The passages for a cosine `c` > 0 outside.
fn slab_passage(slab: Slab, c: f32) -> SlabPassage {
    let inside = max(slab_inside(slab, c), 1e-6);
    let f = slab_mirror(slab, inside);
    let left = beer_transmittance(slab.tau / inside);
    let series = vec3f(1.0) - left * left * (f * f);
    return SlabPassage(left * (1.0 - f) / series, left * left * ((1.0 - f) * f) / series);
}

// The light scattered at least once: an estimate of f |cos_i| for unit directions `o` and `i` in the frame of the
// slab (o.z < 0 is the viewer's side; i.z < 0 reflects, i.z > 0 goes through), the first crossing of the side
// left out. Unbiased; the walk ends by roulette, never by a count. `key` chooses its random numbers.
fn slab_scattered(slab: Slab, o: vec3f, i: vec3f, key: SampleKey) -> vec3f {
    let cos_i = abs(i.z);
    let out_z = max(slab_inside(slab, cos_i), 1e-6);
    let f_out = slab_mirror(slab, out_z);
    // Inside, towards the side it leaves by; the other way round, off the opposite side.
    let towards = vec3f(i.xy / slab.ior, select(out_z, -out_z, i.z < 0.0));
    let against = vec3f(towards.xy, -towards.z);
    let across = beer_transmittance(slab.tau / out_z);
    let bounce = across * f_out;
    // The solid angle shrinks by cos_i / (ior^2 out_z) on the way in.
    let leave = vec3f(1.0 - f_out) / (vec3f(1.0) - bounce * bounce) * (cos_i / (slab.ior * slab.ior * out_z));
    var dir = vec3f(-o.xy / slab.ior, slab_inside(slab, -o.z));
    var depth = 0.0;
    var thr = vec3f(1.0);
    var sum = vec3f(0.0);
    var at = key;
    var survives = 1.0;
    loop {
        // The only exit stands first, as Mesa's llvmpipe needs it (see `kernel/render.wgsl`).
        if (survives <= 0.0) { break; }
        thr /= survives;
        // Another seed: as many independent numbers as the walk needs.
        at.seed = at.seed * 0x9e3779b1u + 0x7f4a7c15u;
        let v = sample_2d(at, PURPOSE_SLAB);
        let step = slab_free_path(slab, thr, v);
        let rest = select(1.0 - depth, depth, dir.z < 0.0) / max(abs(dir.z), 1e-6);
        if (step >= rest) {
            // To the side unscattered: what leaves there was counted before.
            let f = slab_mirror(slab, abs(dir.z));
            thr *= slab_unscattered(slab, thr, rest) * f;
            depth = select(1.0, 0.0, dir.z < 0.0);
            dir.z = -dir.z;
        } else {
            thr *= slab_scatters(slab, thr, step);
            depth = clamp(depth + dir.z * step, 0.0, 1.0);
            let near = beer_transmittance(slab.tau * (select(1.0 - depth, depth, i.z < 0.0) / out_z));
            let far = beer_transmittance(slab.tau * (select(depth, 1.0 - depth, i.z < 0.0) / out_z)) * bounce;
            sum += thr * (near * hg_pdf(dir, slab.g, towards) + far * hg_pdf(dir, slab.g, against)) * leave;
            dir = hg_sample(dir, slab.g, sample_2d(at, PURPOSE_SLAB_TURN));
        }
        survives = min(vector_max(thr), 1.0);
        survives = select(0.0, survives, sample_1d(at, PURPOSE_SLAB_END) < survives);
    }
    return sum;
}

// A free path in thicknesses: `v.x` chooses the channel in proportion to `thr`, `v.y` the depth.
fn slab_free_path(slab: Slab, thr: vec3f, v: vec2f) -> f32 {
    let chosen = v.x * (thr.x + thr.y + thr.z);
    let last = select(slab.tau.z, slab.tau.y, chosen < thr.x + thr.y);
    let tau = select(last, slab.tau.x, chosen < thr.x);
    return beer_depth(v.y) / max(tau, 1e-30);
}

// Throughput for scattering after `step`, over the density with which any of the channels chooses it.
fn slab_scatters(slab: Slab, thr: vec3f, step: f32) -> vec3f {
    let left = slab_left(slab, step);
    let density = dot(thr, slab.tau * left) / (thr.x + thr.y + thr.z);
    return left * slab.tau_s / max(density, 1e-37);
}

// Throughput for reaching a side at `rest`, over the probability of it.
fn slab_unscattered(slab: Slab, thr: vec3f, rest: f32) -> vec3f {
    let left = slab_left(slab, rest);
    return left * (thr.x + thr.y + thr.z) / max(dot(thr, left), 1e-37);
}

// Transmittance up to a factor common to all channels, which cancels above: nothing underflows.
fn slab_left(slab: Slab, path: f32) -> vec3f {
    let least = min(min(slab.tau.x, slab.tau.y), slab.tau.z);
    return beer_transmittance((slab.tau - vec3f(least)) * path);
}
