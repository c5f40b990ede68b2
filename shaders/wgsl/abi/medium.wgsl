// A homogeneous medium, 32 bytes. Coefficients per normalised unit of length, linear Rec. 709.
struct Medium {
    // Absorption.
    sigma_a: vec3<f32>,
    // Mean cosine of scattering, -1 ..= 1 (Henyey & Greenstein 1941).
    g: f32,
    // Scattering.
    sigma_s: vec3<f32>,
    _pad0: u32,
}
