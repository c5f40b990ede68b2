//! The tile of a frame, a pixel a lane.
//!
//! Turns a tile into the pixels that the scalar kernel makes of it, bit for bit: the wide form of the same WGSL, with
//! rays traced one by one, or together if the tree is small. Only where the processor has the instructions.

use crate::kernel::{self, v};
use crate::pixels::Pixels;
use crate::{Instructions, lone, packet, target};
use glam::UVec4;
use kernel_f32::{
    kernel as scalar,
    walk::{Lanes, Tree},
};

/// Camera rays are traced together if there are this many or more.
const COHERENT: u32 = 4;

/// What the wide kernel needs beside it: the scalar one, which traces.
pub struct Companion<'a> {
    pub(crate) scalar: scalar::Kernel<'a>,
    /// What a lone ray is walked with.
    pub(crate) instructions: Instructions,
    /// The tree, if there is one.
    tree: Option<&'a Tree>,
    /// All rays are to be traced together, and not only those of the camera.
    together: bool,
    pub(crate) scratch: packet::Scratch,
}

/// What a tile is rendered with.
pub struct Tile<'a> {
    /// The scalar kernel of the tile, without its film.
    pub scalar: scalar::Kernel<'a>,
    /// Two words a pixel.
    pub film: &'a mut [UVec4],
    /// Columns and rows of pixels.
    pub size: [u32; 2],
}

/// The hits of a ray a lane.
#[target]
pub(crate) fn trace(kernel: &mut kernel::Kernel<'_>, mask: v::B, ray: &kernel::Ray) -> kernel::Hit {
    let Companion { tree, together, .. } = kernel.companion;
    let Some(tree) = tree else { return lone::trace(kernel, mask, ray) };
    if together {
        return packet::trace(kernel, tree, mask, ray);
    }
    let first = v::eq_u(ray.key.bounce, v::u(0));
    let camera = v::and_b(v::and_b(mask, first), v::eq_u(ray.light, v::u(scalar::NONE)));
    if v::bits(camera).count_ones() < COHERENT {
        return lone::trace(kernel, mask, ray);
    }
    let hits = packet::trace(kernel, tree, camera, ray);
    let others = v::but_b(mask, camera);
    if v::any(others) {
        let other_hits = lone::trace(kernel, others, ray);
        return kernel::Hit::select(others, &other_hits, &hits);
    }
    hits
}

/// Renders the tile. Whether it came to the end of it, which it does unless `is_over` says so after some pixels.
#[expect(unsafe_code, reason = "who has the first argument has the instructions")]
pub fn render(instructions: Instructions, tile: Tile<'_>, is_over: &dyn Fn() -> bool) -> bool {
    // SAFETY: `Instructions` are made only where the processor has all that `render_tile` is compiled for.
    unsafe { render_tile(instructions, tile, is_over) }
}

#[target]
fn render_tile(instructions: Instructions, tile: Tile<'_>, is_over: &dyn Fn() -> bool) -> bool {
    let Tile { scalar, film, size } = tile;
    let tree = scalar.companion.tree().filter(|tree| instructions.nodes(tree).is_some());
    let together = tree.is_some_and(Tree::is_small);
    let mut kernel = kernel::Kernel {
        frame_words: scalar.frame_words,
        film_words: film,
        heap_words: scalar.heap_words,
        node_words: scalar.node_words,
        tri_words: scalar.tri_words,
        shade_words: scalar.shade_words,
        sphere_words: scalar.sphere_words,
        texel_words: scalar.texel_words,
        companion: Companion {
            scalar,
            instructions,
            tree,
            together,
            scratch: packet::Scratch::default(),
        },
    };
    let frame = kernel.companion.scalar.load_frame();
    let inside =
        [0, 1].map(|k| size[k].min(frame.image_size[k].saturating_sub(frame.tile_origin[k])));
    render_pixels(&mut kernel, &mut Pixels::of_tile(inside), is_over)
}

/// What `render` of `kernel/render.wgsl` does with the pixels of the tile, in another order: the rays that cost no
/// shading (shadow rays and probes) of all lanes first, then a segment of each. So all lanes shade together. A lane
/// whose pixel has all its samples takes the next pixel at once.
#[target]
fn render_pixels(
    kernel: &mut kernel::Kernel<'_>,
    pixels: &mut Pixels,
    is_over: &dyn Fn() -> bool,
) -> bool {
    let frame = kernel.companion.scalar.load_frame();
    let first = v::u(frame.sample_first);
    let end = v::u(frame.sample_first.wrapping_add(frame.sample_count));
    let seed = v::u(frame.seed);
    let on_film = |at: v::V2<v::U>| v::V2 {
        x: v::add_u(v::u(frame.tile_origin.x), at.x),
        y: v::add_u(v::u(frame.tile_origin.y), at.y),
    };
    let (mut left, mut at) = pixels.take(v::b(true), v::V2 { x: v::u(0), y: v::u(0) });
    if frame.sample_count == 0 || !v::any(left) {
        return true;
    }
    let mut film = kernel.film_empty(left);
    let key = kernel.sample_key(left, on_film(at), first, seed);
    let mut path = kernel.path_begin(left, &key, on_film(at));
    loop {
        let ended = connect(kernel, left, &mut film, &mut path);
        if v::any(ended) {
            let sample = path.key.sample;
            add_sample(kernel, ended, &mut film, &mut path, v::sub_u(sample, first));
            let mut next = v::add_u(sample, v::u(1));
            let done = v::and_b(ended, v::eq_u(next, end));
            let mut begun = ended;
            if v::any(done) {
                let place = v::add_u(v::mul_u(at.y, v::u(frame.tile_size.x)), at.x);
                kernel.film_store(done, place, &film);
                let (fresh, new) = pixels.take(done, at);
                let none = v::but_b(done, fresh);
                (left, begun) = (v::but_b(left, none), v::but_b(begun, none));
                if !v::any(left) {
                    return true;
                }
                if is_over() {
                    return false;
                }
                at = new;
                next = v::select_u(fresh, first, next);
                let empty = kernel.film_empty(fresh);
                film = kernel::FilmPixel::select(fresh, &empty, &film);
            }
            let key = kernel.sample_key(begun, on_film(at), next, seed);
            let new = kernel.path_begin(begun, &key, on_film(at));
            path = kernel::Path::select(begun, &new, &path);
        }
        let hit = next_hit(kernel, left, &mut film, &mut path);
        kernel.path_extend(left, &mut path, &hit);
    }
}

/// Traces the rays of the lanes of `left` that cost no shading. Gives those whose paths have ended.
#[target]
#[inline]
fn connect(
    kernel: &mut kernel::Kernel<'_>,
    left: v::B,
    film: &mut kernel::FilmPixel,
    path: &mut kernel::Path,
) -> v::B {
    loop {
        let shadow = v::ne_u(path.shadow_light, v::u(scalar::NONE));
        let probe = v::eq_u(path.start.state, v::u(scalar::SMOOTH_START_PROBE));
        let short = v::and_b(left, v::or_b(shadow, probe));
        if !v::any(short) {
            return v::but_b(left, path.open);
        }
        let hit = next_hit(kernel, short, film, path);
        kernel.path_connect(short, path, &hit);
    }
}

/// Adds the paths of the lanes of `ended`, each the sample `number` of its pixel.
#[target]
#[inline]
fn add_sample(
    kernel: &mut kernel::Kernel<'_>,
    ended: v::B,
    film: &mut kernel::FilmPixel,
    path: &mut kernel::Path,
    number: v::U,
) {
    let kept = kernel.indirect_clamped(ended, path);
    kernel.film_add(ended, film, kept, number, path.segments);
    let radiance = path.radiance;
    let lost = v::V3 {
        x: v::sub_f(radiance.x, kept.x),
        y: v::sub_f(radiance.y, kept.y),
        z: v::sub_f(radiance.z, kept.z),
    };
    kernel.film_remove(ended, film, lost);
    let errors = kernel.dispatch_stack_errors(ended, path);
    film.stack_errors = v::select_u(ended, v::add_u(film.stack_errors, errors), film.stack_errors);
}

/// What the next ray of the lanes of `mask` hits.
#[target]
fn next_hit(
    kernel: &mut kernel::Kernel<'_>,
    mask: v::B,
    film: &mut kernel::FilmPixel,
    path: &mut kernel::Path,
) -> kernel::Hit {
    let counted = kernel.dispatch_counted_rays(mask, path);
    film.rays = v::select_u(mask, v::add_u(film.rays, counted), film.rays);
    let ray = kernel.path_ray(mask, path);
    trace(kernel, mask, &ray)
}
