// One light out of the selection table, by its share of the power.

#import "light/light_choice.wgsl"
#import "scene/records.wgsl"

// Index of the light whose stretch of the cumulative table holds `u` in [0, 1 - 2^-24]: the first with
// cdf > u. The last entry is exactly 1.
fn choose_light(n_lights: u32, u: f32) -> u32 {
    var first = 0u;
    var last = n_lights - 1u;
    loop {
        if (first >= last) { break; }
        let middle = (first + last) / 2u;
        if (load_light_cdf(middle) > u) {
            last = middle;
        } else {
            first = middle + 1u;
        }
    }
    return first;
}

// The light whose stretch holds `u`, and where in the stretch.
fn choose_from_table(n_lights: u32, u: f32) -> LightChoice {
    let index = choose_light(n_lights, u);
    let pmf = load_light_pmf(index);
    return LightChoice(index, pmf, light_choice_unit(1.0 - (load_light_cdf(index) - u) / pmf));
}
