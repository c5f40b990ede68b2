// A surface that emits and does not scatter: black. What it emits is `emission.wgsl`'s.

#import "bsdf/scatter.wgsl"

// No direction is sampled.
fn emissive_sample() -> Scattered {
    return scatter_absorb();
}

// f |cos|: 0.
fn emissive_eval() -> vec3f {
    return vec3f(0.0);
}

// Density of `emissive_sample`: 0.
fn emissive_pdf() -> f32 {
    return 0.0;
}
