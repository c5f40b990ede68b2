// Gradient noise: a smooth random field of mean 1/2 whose features are about one lattice cell wide.
// Perlin 2002, "Improving Noise": slopes from the cell's corners, blended by a quintic so that the second
// derivative has no seams. A hash of the corner stands in for the table of permutations, so that the field
// does not repeat within 2^32 cells.

// Half over the largest value of the blend of slopes, 1.0363538, so that the noise stays in 0 ..= 1.
const NOISE_HALF_RANGE: f32 = 0.48245993;

// Noise in 0 ..= 1 at the point `at` of lattice cell `cell`; `at` in [0, 1]^3. Every seed is a field of its own.
fn noise_value(cell: vec3i, at: vec3f, seed: u32) -> f32 {
    let c = bitcast<vec3u>(cell);
    let x = noise_round(vec4u(c.x, c.x + 1u, c.x, c.x + 1u) ^ vec4u(seed));
    let column = noise_round(x + vec4u(c.y, c.y, c.y + 1u, c.y + 1u));
    let low = noise_round(column + vec4u(c.z)) * 0x2c1b3c6du;
    let high = noise_round(column + vec4u(c.z + 1u)) * 0x2c1b3c6du;
    // From the far corners.
    let far = at - vec3f(1.0);
    let low_slopes = vec4f(
        noise_slope(low.x, at), noise_slope(low.y, vec3f(far.x, at.yz)),
        noise_slope(low.z, vec3f(at.x, far.y, at.z)), noise_slope(low.w, vec3f(far.xy, at.z)),
    );
    let high_slopes = vec4f(
        noise_slope(high.x, vec3f(at.xy, far.z)), noise_slope(high.y, vec3f(far.x, at.y, far.z)),
        noise_slope(high.z, vec3f(at.x, far.yz)), noise_slope(high.w, far),
    );
    let s = at * at * at * (at * (at * 6.0 - vec3f(15.0)) + vec3f(10.0));
    let face = low_slopes + (high_slopes - low_slopes) * s.z;
    let edge = face.xy + (face.zw - face.xy) * s.y;
    return 0.5 + (edge.x + (edge.y - edge.x) * s.x) * NOISE_HALF_RANGE;
}

// One round of a multiplicative hash, four at a time.
fn noise_round(v: vec4u) -> vec4u {
    let product = v * 0x9e3779b1u;
    return product ^ (product >> vec4u(15u));
}

// Slope times `d`, the slope chosen by the top four bits of `h` from the twelve edges of a cube, four of them
// twice: as in Perlin's reference.
fn noise_slope(h: u32, d: vec3f) -> f32 {
    let i = h >> 28u;
    let u = select(d.y, d.x, i < 8u);
    let v = select(select(d.z, d.x, (i & 13u) == 12u), d.y, i < 4u);
    return noise_sign(u, i << 31u) + noise_sign(v, (i << 30u) & 0x80000000u);
}

// `x`, negated where `bit` is the sign bit.
fn noise_sign(x: f32, bit: u32) -> f32 {
    return bitcast<f32>(bitcast<u32>(x) ^ bit);
}
