// A homogeneous medium, 48 bytes. Coefficients per normalised unit of length, linear Rec. 709.
struct Medium {
    // Absorption.
    sigma_a: vec3<f32>,
    // Mean cosine of scattering, -1 ..= 1 (Henyey & Greenstein 1941).
    g: f32,
    // Scattering.
    sigma_s: vec3<f32>,
    // Length of a segment that leaves the scene inside the medium, normalised units.
    reach: f32,
    // Radiance that takes the place of what a segment loses: of every segment in fog, of those
    // that leave the scene in other media.
    color: vec3<f32>,
    _pad0: u32,
}
