// What a clear coat of index 1.5 lets through to the surface under it, and what that does to the surface's means.
//
// T = 1 - c E, with c the share under the coat and E the directional albedo of its lobe: whatever the coat does not
// reflect goes on. Light that comes back is let out by the same law; what depends on one direction only is taken
// times T of each, and divided by the mean (`principled.wgsl`).

#import "bsdf/gloss.wgsl"
#import "bsdf/gloss_albedo.wgsl"

// ((1.5 - 1) / (1.5 + 1))^2
const UNDER_COAT_F0: f32 = 0.04;

// The lobe of a coat. `coat`: share under it, and its perceptual roughness; `on`: as in `gloss_albedo_at`.
fn under_coat_albedo(coat: vec2f, on: bool) -> GlossAlbedo {
    return gloss_albedo_at(coat.y, gloss_alpha(coat.y), on);
}

// T at cosine `c`, 0 ..= 1.
fn under_coat_through(coat: vec2f, on: bool, c: f32) -> f32 {
    if (coat.x <= 0.0) {
        return 1.0;
    }
    let shares = gloss_albedo_shares(under_coat_albedo(coat, on), c);
    // `max` keeps 1 - T from being simplified.
    return max(1.0 - coat.x * gloss_albedo_reflected(shares, UNDER_COAT_F0, 1.0), 0.0);
}

// How much the coat takes off the mean of what enters a lobe `g` with Fresnel's term from `entry.x` to `entry.y`:
// the mean of T (1 - E) is that of 1 - E, less this. The mean of B B' of two lobes is k k', k the root of the mean
// of B^2: k = B (1.69 + 18.8 B) with the mean B, within 2e-4; all else is uncorrelated within 0.013 `entry.x`.
// `flattened`: mean of what the lobe, of perceptual `roughness`, loses under a smooth coat.
fn under_coat_kept(coat: vec2f, g: GlossAlbedo, roughness: f32, flattened: f32, entry: vec2f) -> f32 {
    if (coat.x <= 0.0) {
        return 0.0;
    }
    let over = under_coat_albedo(coat, true);
    let both = (entry.y * under_coat_root(g)) * under_coat_root(over);
    let f0 = entry.x * (1.0 - g.mean_missing - g.mean_schlick);
    let own = gloss_albedo_mean(over, UNDER_COAT_F0, 1.0);
    // Of what the lobe loses, that is what Fresnel's term has of it where it counts.
    let lost = under_coat_mean_steepness(coat, roughness) * (entry.x + 0.2 * (entry.y - entry.x));
    return coat.x * (own * (1.0 - f0) - both) - lost * flattened;
}

// What the lobe `g` under the coat loses at cosine `c` because it sends light out flatter than it came in, where the
// coat holds back more.
fn under_coat_flattened(coat: vec2f, g: GlossAlbedo, c: f32) -> f32 {
    if (coat.x <= 0.0 || !g.rough) {
        return 0.0;
    }
    return under_coat_steepness(coat, c) * gloss_albedo_flattened(g, c);
}

// How much more the coat holds back of what leaves flatter than cosine `c`, over what a smooth coat does: as much as at
// 0.4 `c`, whatever the lobe. What is lost is right within 0.0045 down to cosine 0.02, and within 0.008 at 0.01.
fn under_coat_steepness(coat: vec2f, c: f32) -> f32 {
    let rise = under_coat_through(coat, true, c) - under_coat_through(coat, true, 0.4 * c);
    // (1 - 0.4 c)^5 - (1 - c)^5 times 1 - `UNDER_COAT_F0`.
    let high = 8.9856 + c * (-4.67712 + c * 0.9501696);
    let smooth_rise = c * (2.88 + c * (-8.064 + c * high));
    return max(rise, 0.0) / max(smooth_rise, 1e-6);
}

// The mean over the hemisphere, weighted by the cosine, of T M and of what is flattened, for a lobe `g` of perceptual
// `roughness`. Where M counts, its correlation with B of the coat depends on that roughness alone, within 0.01.
fn under_coat_missing(coat: vec2f, g: GlossAlbedo, roughness: f32, flattened: f32) -> f32 {
    if (coat.x <= 0.0) {
        return g.mean_missing;
    }
    let over = under_coat_albedo(coat, true);
    let smooth_part = 1.0 - roughness;
    // 1 - `UNDER_COAT_F0` times 0.6 and 2.3.
    let schlick = over.mean_schlick * (0.576 + 2.208 * smooth_part * smooth_part);
    let held = coat.x * (UNDER_COAT_F0 * (1.0 - over.mean_missing) + schlick);
    return g.mean_missing * (1.0 - held) + under_coat_mean_steepness(coat, roughness) * flattened;
}

// The mean of that over the hemisphere, weighted by the cosine and by what a lobe of perceptual `roughness` loses:
// fitted within 0.02, for brushed lobes within 0.045.
fn under_coat_mean_steepness(coat: vec2f, roughness: f32) -> f32 {
    let r = coat.y;
    let high = -8.516928 + r * (13.469123 - r * 6.044023);
    let off = roughness - 0.65;
    let lobe = 1.0 + min(3.3 * r, 1.0) * (0.055 - 0.43 * off * off);
    return coat.x * (min(1.038591 + r * (0.134982 + r * high), 1.0) * lobe);
}

// The root of the mean of B^2.
fn under_coat_root(g: GlossAlbedo) -> f32 {
    return g.mean_schlick * (1.69 + 18.8 * g.mean_schlick);
}
