// What choosing a light answers.

// A light and the probability with which it was chosen; 0: there is no choice.
struct LightChoice {
    index: u32,
    pmf: f32,
}
