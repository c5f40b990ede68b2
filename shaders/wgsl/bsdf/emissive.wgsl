// A surface that emits and does not scatter: black. What it emits is `emission.wgsl`'s.

#import "bsdf/scatter.wgsl"

// No direction is sampled.
fn emissive_sample() -> Scattered {
    return scatter_absorb();
}

// Nothing is scattered.
fn emissive_eval() -> Evaluated {
    return scatter_nothing();
}
