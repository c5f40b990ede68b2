// What a brushed lobe (`brushed_gloss.wgsl`) under a clear coat loses because it sends light out flatter than it came
// in: what a round lobe loses that is as wide in the plane of direction and normal, and what that is off by, from a
// second table behind that of the lobe. A surface that is not brushed is that of `under_coat.wgsl`, to the bit.

#import "bsdf/brushed_albedo.wgsl"
#import "bsdf/brushed_gloss.wgsl"
#import "bsdf/gloss_albedo.wgsl"
#import "bsdf/scatter.wgsl"
#import "bsdf/under_coat.wgsl"
#import "scene/records.wgsl"

// First word of the table behind that of the lobe: 2 * 12 * 6 * 16 and 11 * 5 words.
const BRUSHED_COAT_AT: u32 = 2359u;

// As `under_coat_flattened`, of the lobe `g` as it is towards `w`.
fn brushed_coat_flattened(s: Scatter, coat: vec2f, g: GlossAlbedo, w: vec3f, c: f32) -> f32 {
    let round = under_coat_flattened(coat, g, c);
    if (coat.x <= 0.0 || !g.rough || brushed_gloss_none(s)) {
        return round;
    }
    let b = brushed_gloss_at(s);
    let a = brushed_albedo_at(s.roughness, b.anisotropy, b.alpha);
    if (a.round) {
        return round;
    }
    let table = load_frame_albedo_more_at().x + BRUSHED_COAT_AT;
    let lost = brushed_albedo_added(a, table, brushed_gloss_scaled(b, w, c), gloss_albedo_flattened(g, c));
    return under_coat_steepness(coat, c) * max(lost, 0.0);
}

// As `gloss_albedo_mean_flattened`. The table makes `under_coat_missing` right under a smooth coat: it also holds what
// the correlation of M with the coat differs by from that of a round lobe.
fn brushed_coat_mean_flattened(s: Scatter) -> f32 {
    let round = gloss_albedo_mean_flattened(s.roughness);
    if (brushed_gloss_none(s)) {
        return round;
    }
    let b = brushed_gloss_at(s);
    let a = brushed_albedo_at(s.roughness, b.anisotropy, b.alpha);
    if (a.round) {
        return round;
    }
    return round + brushed_albedo_mean(load_frame_albedo_more_at().x + BRUSHED_COAT_AT, a.roughness, a.anisotropy);
}
