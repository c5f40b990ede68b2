// One of two materials at each vertex, by chance: on average the sum of both, each with its share. One of the two is
// evaluated and not both, as in pbrt-v4 (Pharr, Jakob, Humphreys 2023, 10.5, "MixMaterial").

#import "abi/material_head.wgsl"
#import "bsdf/scatter.wgsl"
#import "sampler/key.wgsl"
#import "scene/constants.wgsl"
#import "scene/projection.wgsl"
#import "scene/records.wgsl"
#import "scene/sampler.wgsl"
#import "scene/texture.wgsl"
#import "surface/surface.wgsl"

// Gives `s` and `m` the material that scatters there. Parts of a mix come before it in the table: the loop ends.
fn mix_choose(s: ptr<function, Surface>, m: ptr<function, MaterialHead>, key: SampleKey, time: f32) {
    var u = sample_1d(key, PURPOSE_MIX);
    loop {
        if ((*m).kind != MATERIAL_MIX) { break; }
        let at = dispatch_projected(*s, (*m).flags, key, time);
        let amount = texture_fetch((*m).color_texture, at).x;
        let share = min(load_material_weight((*s).material) * amount, 1.0);
        // The same number again, stretched over the part that it fell into.
        if (u < share) {
            u = u / share;
            (*s).material = (*m).priority >> 16u;
        } else {
            u = (u - share) / (1.0 - share);
            (*s).material = (*m).priority & 0xffffu;
        }
        *m = load_material_head((*s).material);
    }
}

// Never asked: what scatters is one of the parts.
fn mix_sample() -> Scattered {
    return scatter_absorb();
}

// As `mix_sample`.
fn mix_eval() -> Evaluated {
    return scatter_nothing();
}
