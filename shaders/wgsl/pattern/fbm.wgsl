// Fractal Brownian motion: octaves of noise, each of twice the frequency and half the weight of the one before,
//   fbm(p, N) = sum 2^-i n_i(2^i p + o_i) / sum 2^-i,   i < N,   in 0 ..= 1.
// The octaves are different fields, and the lattice of each is moved by a part of a cell against the one
// before: otherwise all their lattices meet at the integers, and there the sum has visible knots.

#import "pattern/noise.wgsl"

// Beyond this the lattice cells are no integers of 32 bits, and the field is constant.
const FBM_FAR: f32 = 1e9;

// How far the lattice of an octave is moved against twice the one before, in its own cells.
const FBM_SHIFT: vec3f = vec3f(0.3711, 0.6137, 0.2273);

// The sum of `n_octaves` >= 1 at `p`. Cell and place in it are doubled apart from each other, which is exact:
// the octaves keep all the digits that `p` has.
fn fbm_value(p: vec3f, n_octaves: u32, seed: u32) -> f32 {
    let q = clamp(p, vec3f(-FBM_FAR), vec3f(FBM_FAR));
    let first = floor(q);
    var cell = vec3i(first);
    var at = q - first;
    var weight = 1.0;
    var total = 0.0;
    var sum = 0.0;
    var i = 0u;
    loop {
        if (i == n_octaves) { break; }
        sum += noise_value(cell, at, seed + i * 0x9e3779b9u) * weight;
        total += weight;
        weight *= 0.5;
        let next = at * 2.0 + FBM_SHIFT;
        let whole = floor(next);
        cell = cell * 2 + vec3i(whole);
        at = next - whole;
        i += 1u;
    }
    return sum / total;
}
