// Sums of one pixel over the samples of a dispatch.

#import "abi/film.wgsl"

// Rays of a pixel whose loops were cut short; `FilmPixel::CUT` of the host.
const FILM_CUT: u32 = 0xffffffffu;

// No sample yet.
fn film_empty() -> FilmPixel {
    return FilmPixel(vec3f(0.0), 0u, 0u, 0.0, 0u, 0u);
}

// Adds sample number `sample` of the dispatch. A sample that is not finite adds 0, still counts, and is remembered:
// leaving it out of the count would weigh the rest more.
fn film_add(film: ptr<function, FilmPixel>, radiance: vec3f, sample: u32, segments: u32) {
    if (film_finite(radiance.x) && film_finite(radiance.y) && film_finite(radiance.z)) {
        (*film).sum += radiance;
    } else {
        if ((*film).bad == 0u) {
            (*film).bad = sample << 16u;
        }
        (*film).bad += 1u;
    }
    (*film).depth = max((*film).depth, segments);
}

// Counts light that was taken away from a sample.
fn film_remove(film: ptr<function, FilmPixel>, radiance: vec3f) {
    let luminance = dot(radiance, vec3f(0.2126, 0.7152, 0.0722));
    if (film_finite(luminance)) {
        (*film).removed += luminance;
    }
}

// Says that nothing of the pixel is true where the driver has stopped running its loops.
fn film_watch(film: ptr<function, FilmPixel>, turns: u32) {
    if (film_is_cut(turns)) {
        (*film).rays = FILM_CUT;
    }
}

// Whether the driver has stopped running loops. Mesa's llvmpipe gives all loops of an invocation 65,535 turns together
// (LP_MAX_TGSI_LOOP_ITERATIONS); from then on each loop takes one turn, whatever its condition says, and so does this
// one, which should take `turns`, more than one.
fn film_is_cut(turns: u32) -> bool {
    var taken = 0u;
    loop {
        if (taken >= turns) { break; }
        taken += 1u;
    }
    return taken < turns;
}

// By the bits: a compiler may assume that no number is infinite and fold a comparison away.
fn film_finite(x: f32) -> bool {
    return (bitcast<u32>(x) & 0x7f800000u) != 0x7f800000u;
}
