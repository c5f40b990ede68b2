// A medium that is the same everywhere: where it scatters.
//
// A channel k is chosen, its free path sampled, and the result weighted by the one-sample balance heuristic over the
// channels (Veach 1997, 9.2.4), with e = exp(-sigma_t t):
//   scattered:  sigma_s e / sum P_k sigma_t,k e_k       passed:  e / sum P_k e_k
// The part of e that is common to all channels cancels. In a grey medium the weight is the albedo, and 1.

#import "abi/medium.wgsl"
#import "math/beer.wgsl"

// How far a path of weight `throughput` comes in the medium if nothing else is in its way; `u` in [0, 1 - 2^-24]^2.
fn homogeneous_free_path(m: Medium, throughput: vec3f, u: vec2f) -> f32 {
    let sigma_t = m.sigma_a + m.sigma_s;
    var chosen = sigma_t.x;
    if (!homogeneous_is_grey(sigma_t)) {
        let p = homogeneous_shares(m, sigma_t, throughput);
        chosen = select(select(sigma_t.z, sigma_t.y, u.x < p.x + p.y), sigma_t.x, u.x < p.x);
    }
    // At least 1e-30: the channel is clear, and its free path longer than any segment.
    return beer_depth(u.y) / max(chosen, 1e-30);
}

// What the throughput is multiplied with where that path, whose free path is `t`, has come to the end of a segment of
// length `t_max`, or has been scattered before it.
fn homogeneous_weight(m: Medium, throughput: vec3f, t: f32, t_max: f32) -> vec3f {
    let sigma_t = m.sigma_a + m.sigma_s;
    let scatters = t < t_max;
    if (homogeneous_is_grey(sigma_t)) {
        return select(vec3f(1.0), m.sigma_s / sigma_t.x, scatters);
    }
    let p = homogeneous_shares(m, sigma_t, throughput);
    let least = min(min(sigma_t.x, sigma_t.y), sigma_t.z);
    let fade = beer_transmittance((sigma_t - least) * min(t, t_max));
    let density = select(fade, sigma_t * fade, scatters);
    let all = dot(p, density);
    if (all <= 0.0) {
        // Only where rounding has chosen a channel without a share.
        return vec3f(0.0);
    }
    return select(fade, m.sigma_s * fade, scatters) / all;
}

// Whether all channels lose the same.
fn homogeneous_is_grey(sigma_t: vec3f) -> bool {
    return sigma_t.x == sigma_t.y && sigma_t.y == sigma_t.z;
}

// Probability of each channel: by what it carries, and by how much of that would be scattered. The least
// factor keeps the weight of a channel that only absorbs below 20.
fn homogeneous_shares(m: Medium, sigma_t: vec3f, throughput: vec3f) -> vec3f {
    let albedo = vec3f(
        homogeneous_albedo(m.sigma_s.x, sigma_t.x),
        homogeneous_albedo(m.sigma_s.y, sigma_t.y),
        homogeneous_albedo(m.sigma_s.z, sigma_t.z),
    );
    let weight = max(albedo, vec3f(0.05));
    let sum = dot(throughput, weight);
    if (sum <= 0.0) {
        return vec3f(0.33333334);
    }
    return throughput * weight / sum;
}

// Share of the lost light that is scattered; a clear channel loses none.
fn homogeneous_albedo(sigma_s: f32, sigma_t: f32) -> f32 {
    if (sigma_t <= 0.0) {
        return 1.0;
    }
    return sigma_s / sigma_t;
}
