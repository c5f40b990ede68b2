// Names that Rust or the generated module keeps for itself.

struct Kernel { match_: u32, type_: u32, box: f32, dyn: vec2<f32> }
struct Vec3 { gen: u32 }

const limit = 4u;
const e1 = 3u;

var<private> self_: u32;
var<private> bindings: u32 = 2u;

fn try_new(in: u32, box: u32) -> u32 {
    let dyn = in + box;
    var gen = dyn * 2u;
    return gen;
}

fn box(f64: u32) -> Kernel {
    let first_chunk = min(f64, limit);
    return Kernel(first_chunk, e1, f32(e1), vec2<f32>(0.0));
}

fn shadows_constant(x: u32) -> u32 {
    let limit = x + 1u;
    let e1 = limit * 2u;
    return limit + e1;
}

fn vec3_of(gen: u32) -> Vec3 {
    self_ = bindings;
    return Vec3(gen + self_);
}

fn none() -> u32 {
    var None = 1u;
    None += 1u;
    let Ok = None + 1u;
    return None * Ok;
}

fn render_(at: vec3<u32>) -> u32 { return try_new(at.x, at.y); }
