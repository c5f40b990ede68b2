// Evenly spread numbers: the first two dimensions of Sobol's sequence, Owen-scrambled, once for every
// pixel and purpose, each time with its samples in another order.
//
// In any aligned block of 2^k sample indices a pair of numbers puts one point into every box of area
// 2^-k whose sides are aligned powers of two: a (0,2)-sequence. Pairs are independent of each other, and
// so are pixels and seeds, because each has its own scrambles; every single point is uniform.
// Burley 2020, "Practical Hash-based Owen Scrambling", JCGT 9(4).
//
// The pair for a point on a light is the exception: it is stratified jointly with the pair that led to the vertex,
// see `sobol_light`.

#import "sampler/key.wgsl"
#import "sampler/pcg.wgsl"

// The pairs of binary digits whose number is 0, 1 and 2 modulo 3.
const SOBOL_PAIRS_0: u32 = 0xc30c30c3u;
const SOBOL_PAIRS_1: u32 = 0x0c30c30cu;
const SOBOL_PAIRS_2: u32 = 0x30c30c30u;

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

// Two numbers in [0, 1 - 2^-24] for a point on a light, stratified jointly with those for the direction that was
// sampled at the last vertex, or at the first vertex with those for the position in the pixel.
//
// In an aligned block of 4^k sample indices the four numbers put one point into every box of volume 4^-k whose
// sides are aligned powers of four: a (0,4)-sequence in base 4. It is Faure's over the field of four elements
// 0, 1, w and w^2, with pairs of binary digits as the elements: Pascal's triangle modulo 2 with element i, j times
// a^(j - i), where a is 0 and 1 in the pair before and w^2 and w in this one. In each pair the second number has
// its digits mixed, so that the pair is a (0,2)-sequence in base 2 as well: the first one is Sobol's.
// Faure 1982, Acta Arithmetica 41(4), for prime bases; Niederreiter 1987, "Point Sets and Sequences with Small
// Discrepancy", Monatsh. Math. 104(4), for their powers; Ahmed et al. 2025, "SZ Sequences: Binary-Based
// (0, 2^q)-Sequences", ACM TOG 44(6), for such pairs of pairs.
fn sobol_light(key: SampleKey) -> vec2f {
    let index = sobol_index(key, sobol_light_order(key));
    let seeds = sobol_seeds(key, PURPOSE_LIGHT_POINT);
    let first = sobol_scramble(sobol_third(index), seeds.y);
    let second = sobol_scramble(sobol_fourth(index), seeds.z);
    return vec2f(sobol_unit(first), sobol_unit(second));
}

// Seed that orders the samples of the pair before the light's, and so the light's.
fn sobol_light_order(key: SampleKey) -> u32 {
    if (key.bounce == 0u) {
        return sobol_seeds(key, PURPOSE_PIXEL).x;
    }
    var last = key;
    last.bounce -= 1u;
    return sobol_seeds(last, PURPOSE_DIRECTION).x;
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
// (1 1; 0 1), whose factors are the four of `sobol_pascal_4` and the one here. The matrix of the first
// coordinate is 1.
fn sobol_pascal(index: u32) -> u32 {
    return sobol_mixed(sobol_pascal_4(index));
}

// Digits of the third coordinate, as `sobol_pascal`: a = w^2.
fn sobol_third(index: u32) -> u32 {
    return sobol_times_w(sobol_pascal_4(sobol_times_w2(index)));
}

// Digits of the fourth coordinate: a = w.
fn sobol_fourth(index: u32) -> u32 {
    return sobol_mixed(sobol_times_w2(sobol_pascal_4(sobol_times_w(index))));
}

// Pascal's triangle modulo 2 on pairs of digits.
fn sobol_pascal_4(pairs: u32) -> u32 {
    var x = pairs;
    x ^= (x >> 2u) & 0x33333333u;
    x ^= (x >> 4u) & 0x0f0f0f0fu;
    x ^= (x >> 8u) & 0x00ff00ffu;
    x ^= x >> 16u;
    return x;
}

// Each pair with its second digit added to the first.
fn sobol_mixed(pairs: u32) -> u32 {
    return pairs ^ ((pairs >> 1u) & 0x55555555u);
}

// Pair j times w^j.
fn sobol_times_w(pairs: u32) -> u32 {
    return sobol_times(pairs, SOBOL_PAIRS_1, SOBOL_PAIRS_2);
}

// Pair j times w^(2 j).
fn sobol_times_w2(pairs: u32) -> u32 {
    return sobol_times(pairs, SOBOL_PAIRS_2, SOBOL_PAIRS_1);
}

// The pairs in `once` times w = (1 1; 1 0), those in `twice` times w^2 = (0 1; 1 1).
fn sobol_times(pairs: u32, once: u32, twice: u32) -> u32 {
    let a = pairs & 0x55555555u;
    let b = (pairs >> 1u) & 0x55555555u;
    let sum = a ^ b;
    return (pairs & SOBOL_PAIRS_0) | ((sum | (a << 1u)) & once) | ((b | (sum << 1u)) & twice);
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
