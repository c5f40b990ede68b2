// What one reflection at a rough surface does not give back: of white microfacets without Fresnel, the
// share M = 1 - E of light from a direction that leaves them only after several reflections, fitted.
//
// With Smith's g = cos / sqrt(cos^2 + alpha^2 sin^2) and b = 1.4 alpha^2 / (alpha^2 + 0.4), t = 2 g - 1:
//   M = g ((1 - g) (P(t) + sqrt(1 - g^2) Q(t)) + b (R(t, b) + L(b) log2 g))
// P, Q, R, L: polynomials, least maximum error over g in 0.002 ..= 1 and alpha in 1e-3 ..= 1: 7.6e-4 against
// quadrature in double precision over the visible normals. M is 0 at grazing and, for alpha -> 0, off it.
//
// The light that is missing is spread as Kelemen & Szirmay-Kalos 2001 do: f = M_o M_i / (pi mean M),
// reciprocal, and with the lobe itself 1 in total for a white surface (Kulla & Conty 2017).

#import "math/exp_log.wgsl"
#import "math/disk.wgsl"

// The fit at one width.
struct GgxAlbedo {
    // Coefficients of t^0 .. t^3.
    low: vec4f,
    // Coefficients of t^4, t^5 and of the logarithm.
    high: vec3f,
    b: f32,
    // Mean of M over the hemisphere, weighted by the cosine.
    mean: f32,
}

// The fit at width alpha, 1e-3 ..= 1, of which `a2` is the square. The error of the mean, relative, times the
// largest M of that width is at most 1.4e-4.
fn ggx_albedo_at(a2: f32) -> GgxAlbedo {
    let alpha = sqrt(a2);
    // `min` keeps the product that a caller gives from being regrouped.
    let square = min(a2, 1.0);
    let b = 1.4 * square / (square + 0.4);
    let w = 2.0 * b - 1.0;
    let low = vec4f(0.1580581, 0.2857064, -0.03933863, -0.03842512)
        + w * (vec4f(-0.0284624, 0.232191, -0.0019093, 0.01241983)
        + w * (vec4f(0.474915, -0.6283062, 0.06101184, 0.06732101)
        + w * vec4f(-0.4333711, 0.5825494, -0.0925646, -0.04238164)));
    let high = vec3f(-0.02351717, 0.2264903, -0.4101942)
        + w * (vec3f(-0.1869984, 0.1344352, -0.2372931)
        + w * (vec3f(0.6793752, -0.7053922, 0.3629814)
        + w * vec3f(-0.4907835, 0.4901718, -0.4654481)));
    let rough = 16.370597 + alpha * (-9.517109 + alpha * 2.3273757);
    let p = 0.091950407 + alpha * (7.9544519 + alpha * (-16.636172 + alpha * rough));
    let q = exp_log_log2(alpha) * (-0.85024642 + alpha * 2.170417);
    return GgxAlbedo(low, high, b, square * (p + q));
}

// M for the direction whose `x`, `y` are scaled by the widths already: (alpha_x x, alpha_y y, cosine > 0).
fn ggx_albedo_missing(fit: GgxAlbedo, w: vec3f) -> f32 {
    let flat2 = dot(w.xy, w.xy);
    let length = sqrt(flat2 + w.z * w.z);
    let g = w.z / length;
    let s = sqrt(flat2) / length;
    let t = 2.0 * g - 1.0;
    let smooth_part = -10.58952 + t * (13.48175 + t * (-0.5359917 - t * 1.12297)) + s * (12.63598 - t * 11.05785);
    let r = fit.low.x + t * (fit.low.y + t * (fit.low.z + t * (fit.low.w + t * (fit.high.x + t * fit.high.y))));
    let rough_part = r + fit.high.z * exp_log_log2(max(g, 1e-6));
    // 1 - g without cancellation.
    let drop = s * s / (1.0 + g);
    return max(g * (drop * smooth_part + fit.b * rough_part), 0.0);
}

// A direction with density proportional to cos / (cos^2 + a2), which is about M_i cos: narrow surfaces
// send most of what is missing to grazing directions. `a2`: square of the width. `u` in [0, 1 - 2^-24]^2.
fn ggx_albedo_sample(a2: f32, u: vec2f) -> vec3f {
    let at = disk_concentric(u);
    // In the middle of the disk 1.
    let cos2 = a2 * (exp_log_exp2((1.0 - at.r * at.r) * exp_log_log2(1.0 + 1.0 / a2)) - 1.0);
    // At least 2^-12 above the surface.
    let c2 = clamp(cos2, 5.9604645e-8, 1.0);
    return vec3f(at.turn * sqrt(1.0 - c2), sqrt(c2));
}

// Density of `ggx_albedo_sample`, per steradian, at cosine `c` > 0.
fn ggx_albedo_pdf(a2: f32, c: f32) -> f32 {
    // pi times ln 2: the logarithm has base 2.
    return c / ((c * c + a2) * (2.1775860 * exp_log_log2(1.0 + 1.0 / a2)));
}
