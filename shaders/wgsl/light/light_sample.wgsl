// What sampling a light answers.

// A point of a light as seen from the shaded point. World frame.
struct LightSample {
    // Unit, towards the light.
    wi: vec3f,
    // Distance to the light's surface along `wi`.
    t: f32,
    // Density of `wi` per steradian, given that this light was chosen; 0: there is no sample.
    pdf: f32,
    // The front side of the light faces the shaded point.
    front: bool,
}

// No sample: the light cannot be sampled from here, and its density is 0 in every direction.
fn light_sample_none() -> LightSample {
    return LightSample(vec3f(0.0, 0.0, 1.0), 0.0, 0.0, false);
}
