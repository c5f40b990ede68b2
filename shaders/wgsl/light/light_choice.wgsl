// What choosing a light answers.

#import "sampler/key.wgsl"
#import "scene/sampler.wgsl"

// A light and the probability with which it was chosen; 0: there is no choice.
struct LightChoice {
    index: u32,
    pmf: f32,
    // Where in its share of [0, 1) the number was that chose the light, in [0, 1 - 2^-24].
    rest: f32,
}

// Below this probability too few digits of the number are left.
const LIGHT_CHOICE_REUSED: f32 = 0.00390625; // 2^-8

// The pair for a point of the light that the first number of `point` chose. What is left of that number serves again:
// so the samples of each light are spread as evenly as those of all (Shirley, Wang & Zimmerman 1996, "Monte Carlo
// Techniques for Direct Lighting Calculations").
fn light_choice_point(choice: LightChoice, point: vec2f, key: SampleKey) -> vec2f {
    if (choice.pmf < LIGHT_CHOICE_REUSED) {
        return vec2f(sample_1d(key, PURPOSE_LIGHT_CHOICE), point.y);
    }
    return vec2f(choice.rest, point.y);
}

// `x` as a number in [0, 1 - 2^-24].
fn light_choice_unit(x: f32) -> f32 {
    return clamp(x, 0.0, 0.99999994);
}
