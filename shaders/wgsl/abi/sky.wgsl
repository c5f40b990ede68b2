// Radiance by direction, linear Rec. 709, W/(m2 sr) up to the scene's own scale.
struct Sky {
    // Radiance straight up; the only colour of a constant sky.
    zenith: vec3<f32>,
    // `SkyKind`.
    kind: u32,
    // Radiance at elevation sine `blend_high`.
    middle: vec3<f32>,
    // Sine of the elevation where zenith and middle bands meet.
    blend_high: f32,
    // Radiance at the horizon.
    horizon: vec3<f32>,
    // Sine of the elevation where horizon and ground bands meet (negative).
    blend_low: f32,
    // Radiance straight down.
    ground: vec3<f32>,
    // Exponent of the wide glow around the sun, `cos^glow_power`.
    glow_power: f32,
    // Unit direction towards the sun; glow and disc are centred here.
    sun_direction: vec3<f32>,
    // Exponent of the narrow disc, `cos^disc_power`.
    disc_power: f32,
    // Radiance added at the centre of the glow.
    glow: vec3<f32>,
    _pad0: u32,
    // Radiance added at the centre of the disc.
    disc: vec3<f32>,
    _pad1: u32,
}
