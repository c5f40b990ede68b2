// Half floats, decoded exactly: `unpack2x16float` may flush subnormals.

// The value of the binary16 in the low 16 bits of `bits`. Infinities and NaN give +-65536, and a
// texture that holds them is refused before it gets here.
fn half_decode(bits: u32) -> f32 {
    let magnitude = bits & 0x7fffu;
    let normal = bitcast<f32>((magnitude << 13u) + 0x38000000u);
    let tiny = f32(magnitude) * 5.9604645e-8; // 2^-24
    let value = select(tiny, normal, magnitude >= 0x400u);
    return select(value, -value, (bits & 0x8000u) != 0u);
}
