// Radiance by direction, linear Rec. 709, W/(m2 sr) up to the scene's own scale.
struct Sky {
    // Radiance straight up; the only colour of a constant sky; the factor on an image.
    zenith: vec3<f32>,
    // `SkyKind`.
    kind: u32,
    // Radiance at elevation sine `blend_high`.
    middle: vec3<f32>,
    // Sine of the elevation where zenith and middle bands meet.
    blend_high: f32,
    // Radiance at the horizon.
    horizon: vec3<f32>,
    // Sine of the elevation where horizon and ground bands meet.
    blend_low: f32,
    // Radiance at elevation sine `blend_ground` and below.
    ground: vec3<f32>,
    // Exponent of the wide glow around the sun, `cos^glow_power`.
    glow_power: f32,
    // Unit direction towards the sun; glow and disc are centred here.
    sun_direction: vec3<f32>,
    // Exponent of the narrow disc, `cos^disc_power`.
    disc_power: f32,
    // Radiance added at the centre of the glow.
    glow: vec3<f32>,
    // Sine of the elevation where the ground band ends; less than -1 if it does not.
    blend_ground: f32,
    // Radiance added at the centre of the disc.
    disc: vec3<f32>,
    // Turns from azimuth to the column of image and table: u = azimuth + rotation, azimuth from -z to +x.
    rotation: f32,
    // Image of an image sky, wrapped along u; `NONE` for other kinds.
    texture: u32,
    // Index of the sky in the light table; `NONE`: it is found by chance only, and there is no SKYTABLE.
    light: u32,
    // Rows and columns of SKYTABLE; 0 without.
    rows: u32,
    // See `rows`.
    columns: u32,
}
