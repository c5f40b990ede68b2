// Multiple scattering inside a thin parallel slab, which knows only depth: where on the slab light comes out does not
// matter, because the slab is thin.
// Guo, Hasan & Zhao 2018, "Position-Free Monte Carlo Simulation for Arbitrary Layered BSDFs", ACM TOG 37(6).
// What the two sides throw back and forth unscattered is a geometric series, and is summed. So is light that scatters
// once, a closed form; light that scatters more often is found by a random walk. At every point of the walk but the
// first the light is joined to the wanted direction outside, through both ways in which it can reach it: straight to
// its side, or off the other side first. `slab_exit.wgsl` walks until the light has left.

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

// Where light that crosses the slab scatters first.
struct SlabPoint {
    // 0 ..= 1.
    depth: f32,
    // Inside, before it scatters.
    dir: vec3f,
    // 1 for each channel where all scatter alike; the mean of the channels is 1.
    thr: vec3f,
}

// What the two sides do to unscattered light on its way in along `o`, the viewer's direction in the frame of the slab.
struct SlabEntry {
    // Cosine inside.
    z: f32,
    // Optical depth across along it, and the transmittance of that.
    tau: vec3f,
    left: vec3f,
    // What is left after a crossing and the mirror at its end.
    bounce: vec3f,
    // Share that scatters, on this crossing or a later one.
    share: vec3f,
}

// The way in for a cosine `c` > 0 outside.
fn slab_entry(slab: Slab, c: f32) -> SlabEntry {
    let z = max(slab_inside(slab, c), 1e-6);
    let tau = slab.tau / z;
    let left = beer_transmittance(tau);
    let bounce = left * slab_mirror(slab, z);
    let share = slab_mean(tau, left) * (slab.tau_s / z) / max(vec3f(1.0) - bounce, vec3f(1e-6));
    return SlabEntry(z, tau, left, bounce, share);
}

// (1 - e^-tau) / tau, the mean transmittance of depths up to `tau` >= 0; `left`: e^-tau.
fn slab_mean(tau: vec3f, left: vec3f) -> vec3f {
    let mean = beer_absorptance(tau, left) / max(tau, vec3f(1e-6));
    return select(mean, vec3f(1.0), tau < vec3f(1e-6));
}

// Where light along `o` scatters first, if it does. `v`: the channel that chooses and how often the sides have thrown
// the light back, and the depth; in [0, 1 - 2^-24].
fn slab_first(slab: Slab, o: vec3f, entry: SlabEntry, v: vec2f) -> SlabPoint {
    // In each channel, crossings away from the viewer's side and back to it.
    let away = entry.share / (vec3f(1.0) + entry.bounce);
    var rest = v.x * (entry.share.x + entry.share.y + entry.share.z);
    var c = 0u;
    if (rest >= entry.share.x) {
        rest = max(rest - entry.share.x, 0.0);
        c = select(1u, 2u, rest >= entry.share.y);
        rest = max(rest - select(0.0, entry.share.y, c == 2u), 0.0);
    }
    let back = rest >= away[c];
    let tau = entry.tau[c];
    let lost = beer_absorptance(entry.tau, entry.left)[c];
    let way = min(beer_depth(v.y * lost) / max(tau, 1e-30), 1.0);
    let density = slab_left(slab, way / entry.z) * select(vec3f(1.0), entry.bounce, vec3<bool>(back))
        / max(vec3f(1.0) - entry.bounce * entry.bounce, vec3f(1e-6));
    let thr = density * (3.0 / max(density.x + density.y + density.z, 1e-37));
    let xy = -o.xy / slab.ior;
    return SlabPoint(select(way, 1.0 - way, back), vec3f(xy, select(entry.z, -entry.z, back)), thr);
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
    let leave = vec3f(1.0 - f_out) / max(vec3f(1.0) - bounce * bounce, vec3f(1e-6))
        * (cos_i / (slab.ior * slab.ior * out_z));
    let entry = slab_entry(slab, -o.z);
    var sum = slab_once(slab, o, entry, towards, slab.tau / out_z, bounce);
    var at = slab_next(key);
    let first = slab_first(slab, o, entry, sample_2d(at, PURPOSE_SLAB));
    var depth = first.depth;
    var thr = first.thr;
    var dir = hg_sample(first.dir, slab.g, sample_2d(at, PURPOSE_SLAB_TURN));
    let share = (entry.share.x + entry.share.y + entry.share.z) / 3.0;
    var survives = select(0.0, 1.0, share > 0.0);
    loop {
        // The only exit stands first, as Mesa's llvmpipe needs it (see `kernel/render.wgsl`).
        if (survives <= 0.0) { break; }
        thr /= survives;
        at = slab_next(at);
        let step = slab_free_path(slab, thr, sample_2d(at, PURPOSE_SLAB));
        let rest = select(1.0 - depth, depth, dir.z < 0.0) / max(abs(dir.z), 1e-6);
        let f = slab_mirror(slab, abs(dir.z));
        if (step >= rest && f < 1.0) {
            // To the side unscattered: what leaves there was counted before.
            thr *= slab_unscattered(slab, thr, rest) * f;
            depth = select(1.0, 0.0, dir.z < 0.0);
            dir.z = -dir.z;
        } else {
            thr *= slab_scatters(slab, thr, step);
            let reached = slab_fold(depth, dir.z, step);
            depth = reached.x;
            dir.z = reached.y;
            let near = beer_transmittance(slab.tau * (select(1.0 - depth, depth, i.z < 0.0) / out_z));
            let far = beer_transmittance(slab.tau * (select(depth, 1.0 - depth, i.z < 0.0) / out_z)) * bounce;
            sum += thr * (near * hg_pdf(dir, slab.g, towards) + far * hg_pdf(dir, slab.g, against)) * share;
            dir = hg_sample(dir, slab.g, sample_2d(at, PURPOSE_SLAB_TURN));
        }
        survives = min(vector_max(thr), 1.0);
        survives = select(0.0, survives, sample_1d(at, PURPOSE_SLAB_END) < survives);
    }
    return sum * leave;
}

// The light scattered once towards `towards` inside, what the side does to it on its way out left out. `tau_out`:
// optical depth across on the way out; `bounce`: what is left after that and a mirror.
// Beams from both sides, each scattered to either side; a pair whose ways are mirror images has the same phase.
fn slab_once(slab: Slab, o: vec3f, entry: SlabEntry, towards: vec3f, tau_out: vec3f, bounce: vec3f) -> vec3f {
    let dir = vec3f(-o.xy / slab.ior, entry.z);
    let straight = hg_pdf(dir, slab.g, towards);
    let mirrored = hg_pdf(dir, slab.g, vec3f(towards.xy, -towards.z));
    // Means over the depth, of ways in and out that grow together, and of ways of which one grows as the other shrinks.
    let sum = entry.tau + tau_out;
    let together = slab_mean(sum, beer_transmittance(sum));
    let apart = abs(entry.tau - tau_out);
    let opposed = beer_transmittance(min(entry.tau, tau_out)) * slab_mean(apart, beer_transmittance(apart));
    let reflects = towards.z < 0.0;
    let same = select(opposed, together, vec3<bool>(reflects));
    let other = select(together, opposed, vec3<bool>(reflects));
    let both = same * (vec3f(1.0) + entry.bounce * bounce) * straight + other * (entry.bounce + bounce) * mirrored;
    return both * (slab.tau_s / entry.z) / max(vec3f(1.0) - entry.bounce * entry.bounce, vec3f(1e-6));
}

// Another seed: as many independent numbers as a walk needs.
fn slab_next(key: SampleKey) -> SampleKey {
    return SampleKey(key.pixel, key.sample, key.bounce, key.seed * 0x9e3779b1u + 0x7f4a7c15u);
}

// Depth and z of the direction after `step` from `depth` along `z`, thrown back at both sides as often as it takes.
fn slab_fold(depth: f32, z: f32, step: f32) -> vec2f {
    let far = depth + z * step;
    let turn = far - 2.0 * floor(0.5 * far);
    let back = turn > 1.0;
    return vec2f(select(turn, 2.0 - turn, back), select(z, -z, back));
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
