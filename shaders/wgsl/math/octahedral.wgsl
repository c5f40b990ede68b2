// Unit vectors folded onto an octahedron, two 16-bit signed normalised integers a word.
// Cigolle et al. 2014, "A Survey of Efficient Representations for Independent Unit Vectors", JCGT 3(2).

#import "math/vector.wgsl"

// The unit vector of `word`: x in the low half, y in the high half. -32768 means -1, as -32767 does.
fn octahedral_decode(word: u32) -> vec3f {
    let x = octahedral_snorm(word << 16u);
    let y = octahedral_snorm(word);
    let z = 1.0 - abs(x) - abs(y);
    // Below the equator the corners are folded outwards.
    let fold = max(-z, 0.0);
    let v = vec3f(x + select(fold, -fold, x >= 0.0), y + select(fold, -fold, y >= 0.0), z);
    // |x| + |y| + |z| = 1, so the length is at least 1 / sqrt(3).
    return vector_unit(v);
}

// The number in the high half of `word`, -1 ..= 1.
fn octahedral_snorm(word: u32) -> f32 {
    let i = bitcast<i32>(word) >> 16u;
    return max(f32(i) * 3.0518509e-5, -1.0); // 1 / 32767
}
