//! Work items → pixels with the generated kernel: blocks of 32 × 32 pixels on every core.
//!
//! A panic in a block is a bug, but never a lost picture: it is caught, reported with the block's
//! coordinates, and the run ends with everything else.

use crate::job::{Job, Precision};
use crate::kernel;
use crate::kernel::walk::{Companion, Tree};
use crate::run::Run;
use crate::schedule::WorkItem;
use crate::setup::Setup;
use crate::signals::Event;
#[cfg(target_arch = "x86_64")]
use crate::wide::Wide;
use glam::{UVec3, UVec4};
use pack::Kind;
use pack::abi::{AovSample, FilmPixel, Frame};
use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};
use thiserror::Error;
#[cfg(feature = "gpu")]
use {crate::region::Rect, rayon::prelude::*};

/// Pixels of a block: 32 × 32.
pub(crate) const BLOCK: u64 = 32 * 32;

/// Pixels of the first block of each thread, which is rendered without the tree.
const FIRST_BLOCK: u64 = 16 * 16;

/// The CPU kernel cannot render.
#[derive(Debug, Error)]
pub(crate) enum CpuError {
    /// No threads.
    #[error("cannot start the threads of the CPU kernel: {0}")]
    Threads(#[from] rayon::ThreadPoolBuildError),
    /// The tree of the scene is too deep.
    #[error("the scene needs a traversal stack of {need} entries, the CPU kernel has {available}")]
    Stack {
        /// Entries that are needed.
        need: u32,
        /// Entries that there are.
        available: u32,
    },
}

/// What the kernel reads: one slice for each binding, empty where the scene has nothing.
#[derive(Clone, Copy)]
pub(crate) struct Inputs<'a> {
    frame: &'a [UVec4],
    heap: &'a [UVec4],
    nodes: &'a [UVec4],
    triangles: &'a [UVec4],
    shades: &'a [UVec4],
    spheres: &'a [UVec4],
    texels: &'a [UVec4],
    tree: Option<&'a Tree>,
    #[cfg(target_arch = "x86_64")]
    wide: Option<Wide>,
}

impl<'a> Inputs<'a> {
    fn new(setup: &'a Setup<'_>, frame: &'a Frame) -> Self {
        Self {
            frame: bytemuck::cast_slice(std::slice::from_ref(frame)),
            heap: setup.heap(),
            nodes: setup.nodes(),
            triangles: setup.section(Kind::TRIANGLE),
            shades: setup.section(Kind::TRISHADE),
            spheres: setup.section(Kind::SPHERE),
            texels: setup.section(Kind::TEXEL),
            tree: setup.finished_tree(),
            #[cfg(target_arch = "x86_64")]
            wide: setup.wide(),
        }
    }
}

/// The kernel of the tile of the frame, which writes one `FilmPixel`, two words, for each pixel of `film`.
macro_rules! bound {
    ($kernel:ident, $inputs:expr, $film:expr) => {{
        let inputs: Inputs<'_> = $inputs;
        kernel::$kernel::Kernel::new(kernel::$kernel::Bindings {
            frame_words: inputs.frame,
            film_words: $film,
            heap_words: inputs.heap,
            node_words: inputs.nodes,
            tri_words: inputs.triangles,
            shade_words: inputs.shades,
            sphere_words: inputs.spheres,
            texel_words: inputs.texels,
        })
    }};
}

/// The kernel of the frame in single precision, without a film; it walks the scene's tree if that has been made.
pub(crate) fn kernel<'a>(setup: &'a Setup<'_>, frame: &'a Frame) -> kernel::f32::Kernel<'a> {
    scalar(Inputs::new(setup, frame))
}

/// The same in double precision, through the nodes of the pack.
pub(crate) fn kernel_f64<'a>(setup: &'a Setup<'_>, frame: &'a Frame) -> kernel::f64::Kernel<'a> {
    bound!(f64, Inputs::new(setup, frame), &mut [])
}

fn scalar(inputs: Inputs<'_>) -> kernel::f32::Kernel<'_> {
    let mut kernel = bound!(f32, inputs, &mut []);
    kernel.companion = Companion::new(inputs.tree);
    kernel
}

/// Renders the tile of the frame. Whether it came to the end of it, which it does unless `is_over` says so after some
/// pixels.
fn render_f32<'a>(
    inputs: Inputs<'a>,
    size: [u32; 2],
    film: &'a mut [UVec4],
    is_over: &dyn Fn() -> bool,
) -> bool {
    #[cfg(target_arch = "x86_64")]
    if let Some(wide) = inputs.wide {
        return wide.render(scalar(inputs), film, size, is_over);
    }
    let mut kernel = bound!(f32, inputs, film);
    kernel.companion = Companion::new(inputs.tree);
    each_pixel(size, is_over, |pixel| kernel.render(pixel))
}

/// As `render_f32`, in double precision.
fn render_f64<'a>(
    inputs: Inputs<'a>,
    size: [u32; 2],
    film: &'a mut [UVec4],
    is_over: &dyn Fn() -> bool,
) -> bool {
    let mut kernel = bound!(f64, inputs, film);
    each_pixel(size, is_over, |pixel| kernel.render(pixel))
}

fn each_pixel(size: [u32; 2], is_over: &dyn Fn() -> bool, mut render: impl FnMut(UVec3)) -> bool {
    for y in 0..size[1] {
        for x in 0..size[0] {
            if is_over() {
                return false;
            }
            render(UVec3::new(x, y, 0));
        }
    }
    true
}

type RenderTile = for<'a> fn(Inputs<'a>, [u32; 2], &'a mut [UVec4], &dyn Fn() -> bool) -> bool;

/// Renders until the run has nothing left.
pub(crate) fn render(setup: &Setup<'_>, job: &Job, run: &Run<'_>) -> Result<(), CpuError> {
    let tile = match job.precision {
        Precision::F32 => render_f32,
        Precision::F64 => render_f64,
    };
    render_with(tile, setup, job, run)
}

fn render_with(
    tile: RenderTile,
    setup: &Setup<'_>,
    job: &Job,
    run: &Run<'_>,
) -> Result<(), CpuError> {
    let pool = pool(setup, job)?;
    // A first block each shows something before the tree is made, which takes all threads a moment, and may be all.
    let rendered = pool.broadcast(|_| next_block(tile, setup, run, FIRST_BLOCK, &mut Vec::new()));
    if rendered.into_iter().all(|rendered| rendered) {
        pool.install(|| setup.tree());
        pool.broadcast(|_| worker(tile, setup, run));
    }
    Ok(())
}

/// The threads of the job, for a scene that the kernel can render.
pub(crate) fn pool(setup: &Setup<'_>, job: &Job) -> Result<rayon::ThreadPool, CpuError> {
    check_stack(setup)?;
    Ok(rayon::ThreadPoolBuilder::new()
        .num_threads(job.threads.unwrap_or(0))
        .thread_name(|i| format!("rtr-{i}"))
        .build()?)
}

/// What each sample of the item shows beside radiance, pixel by pixel, in single precision.
pub(crate) fn aovs(setup: &Setup<'_>, item: &WorkItem) -> Vec<AovSample> {
    let n = usize::try_from(item.cost()).expect("an item is small");
    let mut samples = vec![AovSample::default(); n];
    let frame = setup.frame(item);
    let inputs = Inputs::new(setup, &frame);
    let mut kernel = bound!(f32, inputs, bytemuck::cast_slice_mut(&mut samples));
    kernel.companion = Companion::new(inputs.tree);
    each_pixel([item.tile.w, item.tile.h], &|| false, |pixel| kernel.aov(pixel));
    samples
}

pub(crate) fn check_stack(setup: &Setup<'_>) -> Result<(), CpuError> {
    let (need, available) = (setup.stack_need(), kernel::f32::STACK_SIZE);
    if need > available { Err(CpuError::Stack { need, available }) } else { Ok(()) }
}

/// Renders one item of the run in place of a device, on every core and in `f32`: the same pixels, bit for bit where
/// the device rounds as we do.
///
/// # Errors
/// When the scene's tree is too deep; then the item is still the caller's.
#[cfg(feature = "gpu")]
pub(crate) fn render_item(
    setup: &Setup<'_>,
    run: &Run<'_>,
    item: &WorkItem,
) -> Result<(), CpuError> {
    check_stack(setup)?;
    setup.tree();
    let Rect { y, w, h, .. } = item.tile;
    let mut pixels = vec![FilmPixel::default(); w as usize * h as usize];
    let is_over = || run.is_broken_off();
    let render = || {
        // Rows that lanes share.
        let strips = (y..y + h).into_par_iter().step_by(4);
        pixels.par_chunks_mut(4 * w as usize).zip(strips).all(|(pixels, top)| {
            let size = [w, (y + h - top).min(4)];
            let tile = Rect { y: top, h: size[1], ..item.tile };
            let frame = setup.picture_frame(&WorkItem { tile, ..*item });
            let film = bytemuck::cast_slice_mut(pixels);
            render_f32(Inputs::new(setup, &frame), size, film, &is_over)
        })
    };
    // As in `worker`.
    match catch_unwind(AssertUnwindSafe(render)) {
        Ok(true) => run.deposit(item, &pixels),
        Ok(false) => run.give_back(*item),
        Err(panic) => run.fail(item, panic_text(panic.as_ref())),
    }
    Ok(())
}

/// Claims block after block. Blocks are claimed in order, so batches are completed in order.
fn worker(tile: RenderTile, setup: &Setup<'_>, run: &Run<'_>) {
    let mut pixels = Vec::new();
    while next_block(tile, setup, run, BLOCK, &mut pixels) {}
}

/// Claims and renders a block, in a place for its pixels that is used again; false if none is left.
fn next_block(
    tile: RenderTile,
    setup: &Setup<'_>,
    run: &Run<'_>,
    size: u64,
    pixels: &mut Vec<FilmPixel>,
) -> bool {
    let Some(item) = run.claim_blocking(size) else { return false };
    let n = usize::try_from(item.tile.pixels()).expect("a block is small");
    pixels.clear();
    pixels.resize(n, FilmPixel::default());
    let frame = setup.picture_frame(&item);
    let inputs = Inputs::new(setup, &frame);
    let film = bytemuck::cast_slice_mut(pixels);
    let size = [item.tile.w, item.tile.h];
    let is_over = || run.is_broken_off();
    let render = || {
        run.signals().tell(Event::Block);
        tile(inputs, size, film, &is_over)
    };
    // Only `pixels` is written, and a failed block is not read.
    match catch_unwind(AssertUnwindSafe(render)) {
        Ok(true) => run.deposit(&item, pixels),
        Ok(false) => run.give_back(item),
        Err(panic) => run.fail(&item, panic_text(panic.as_ref())),
    }
    true
}

/// The message of a caught panic.
pub(crate) fn panic_text(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<&str>().map(|text| (*text).to_owned());
    text.or_else(|| panic.downcast_ref::<String>().cloned())
        .unwrap_or_else(|| "panic without a message".to_owned())
}

/// One line for the user.
pub(crate) fn name(job: &Job) -> String {
    let threads = job.threads.filter(|n| *n > 0).unwrap_or_else(host::threads);
    let plural = if threads == 1 { "" } else { "s" };
    format!("CPU kernel ({}, {threads} thread{plural})", job.precision.name())
}
