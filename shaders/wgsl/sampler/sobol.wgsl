// Evenly spread numbers: the first two dimensions of Sobol's sequence, Owen-scrambled, once for every
// pixel and purpose, each time with its samples in another order.
//
// In any aligned block of 2^k sample indices a pair of numbers puts one point into every box of area
// 2^-k whose sides are aligned powers of two: a (0,2)-sequence. Pairs are independent of each other, and
// so are pixels and seeds, because each has its own scrambles; every single point is uniform.
// Burley 2020, "Practical Hash-based Owen Scrambling", JCGT 9(4).

#import "sampler/key.wgsl"
#import "sampler/pcg.wgsl"

// One number in [0, 1 - 2^-24]: the first of the pair.
fn sobol_1d(key: SampleKey, purpose: u32) -> f32 {
    let seeds = sobol_seeds(key, purpose);
    return sobol_unit(sobol_scramble(sobol_index(key, seeds.x), seeds.y));
}

// Two numbers in [0, 1 - 2^-24].
fn sobol_2d(key: SampleKey, purpose: u32) -> vec2f {
    let seeds = sobol_seeds(key, purpose);
    let index = sobol_index(key, seeds.x);
    let first = sobol_scramble(index, seeds.y);
    let second = sobol_scramble(sobol_pascal(index), seeds.z);
    return vec2f(sobol_unit(first), sobol_unit(second));
}

// One number in [0, 1 - 2^-24] of a sequence of its own for each `id`.
fn sobol_of(key: SampleKey, purpose: u32, id: u32) -> f32 {
    let seeds = pcg_hash(vec4u(key.pixel, sample_dimension(key, purpose), key.seed, id));
    return sobol_unit(sobol_scramble(sobol_index(key, seeds.x), seeds.y));
}

// The three scrambles of a pair. The sample is no part of them: they make one sequence of it.
fn sobol_seeds(key: SampleKey, purpose: u32) -> vec3u {
    return pcg_hash(vec4u(key.pixel, sample_dimension(key, purpose), key.seed, 0u)).xyz;
}

// Which point of the sequence the sample is: a scramble too, so that aligned blocks of 2^k samples
// remain aligned blocks of 2^k points.
fn sobol_index(key: SampleKey, seed: u32) -> u32 {
    return reverseBits(sobol_scramble(reverseBits(key.sample), seed));
}

// Digits of the second coordinate of point `index`; bit 0 is the first binary digit. The generating
// matrix is Pascal's triangle modulo 2. By Lucas's theorem that is the fivefold Kronecker power of
// (1 1; 0 1), which has the five factors below. The matrix of the first coordinate is 1.
fn sobol_pascal(index: u32) -> u32 {
    var x = index;
    x ^= (x >> 1u) & 0x55555555u;
    x ^= (x >> 2u) & 0x33333333u;
    x ^= (x >> 4u) & 0x0f0f0f0fu;
    x ^= (x >> 8u) & 0x00ff00ffu;
    x ^= x >> 16u;
    return x;
}

// Owen's scrambling of binary digits, bit 0 the first: whether a digit flips depends on all digits
// before it. Laine & Karras 2011, "Stratified Sampling for Stochastic Transparency", CGF 30(4), with
// the constants of Vegdahl 2021, "Building a Better LK Hash".
fn sobol_scramble(digits: u32, seed: u32) -> u32 {
    var x = digits;
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16u) | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return x;
}

// The number with these digits, bit 0 the first.
fn sobol_unit(digits: u32) -> f32 {
    return f32(reverseBits(digits) >> 8u) * 5.9604645e-8; // 2^-24
}
