//! A scene → the rays of its picture on a CPU, to be timed without what is shaded, and how well lanes share them.
//!
//! It drives the functions of the scalar kernel in the order of its main loop. It measures no time and does not print.

use crate::cpu::{self, CpuError};
use crate::job::{CpuWay, Job};
use crate::kernel::f32::{Hit, Kernel, NONE, Ray};
use crate::kernel::trace_each;
use crate::region::{Rect, Tiler};
use crate::scene::Scene;
use crate::setup::Setup;
use glam::UVec2;
use pack::abi::Frame;

/// Columns of the pixels that are rendered together, as in `runtime/kernel/wide/pixels.rs`.
const COLUMNS: u32 = 4;

/// Every ray of a picture.
pub struct Profile<'a> {
    setup: Setup<'a>,
    frame: Frame,
    rays: Vec<Ray>,
    lanes: Lanes,
}

/// How lanes share the segments of the paths of as many neighbours.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Lanes {
    /// How many there are: those of the widest kernel that the processor can run, or eight.
    pub count: u32,
    /// Turns in which segments were shaded.
    pub turns: u64,
    /// Lanes that had a segment in them; at most all of a turn.
    pub busy: u64,
    /// Different materials, one of which may be none, among the busy lanes of a turn.
    pub materials: u64,
}

/// What a path does next in the wide kernel's loop.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Segment {
    /// `NONE`: it met nothing.
    material: u32,
}

impl<'a> Profile<'a> {
    /// Follows the samples of the job's image on one thread, and records the rays of the first `recorded` of each pixel.
    ///
    /// # Errors
    /// When the CPU kernel cannot run the scene.
    pub fn record(
        scene: &'a Scene,
        job: &Job,
        recorded: u32,
    ) -> Result<Self, Box<dyn std::error::Error>> {
        let setup = scene.setup(job);
        cpu::check_stack(&setup).map_err(|error: CpuError| error.to_string())?;
        setup.tree();
        let frame = setup.frame_of(job);
        let lanes = Lanes { count: CpuWay::most_lanes().max(8), ..Lanes::default() };
        let mut profile = Self { setup, frame, rays: Vec::new(), lanes };
        profile.record_rows(job, recorded);
        Ok(profile)
    }

    fn record_rows(&mut self, job: &Job, recorded: u32) {
        let Self { setup, frame, rays, lanes } = self;
        let mut kernel = cpu::kernel(setup, frame);
        let [w, h] = job.image_size;
        let mut tiler = Tiler::new(Rect { x: 0, y: 0, w, h });
        while let Some(tile) = tiler.next(cpu::BLOCK) {
            let mut segments = |at| pixel(&mut kernel, at, job, (rays, recorded));
            let pixels: Vec<Vec<Segment>> =
                in_squares(tile, lanes.count).map(&mut segments).collect();
            lanes.add(&pixels);
        }
    }

    /// The rays that were recorded, in the normalised world.
    #[must_use]
    pub fn rays(&self) -> &[Ray] {
        &self.rays
    }

    /// How the lanes share the work.
    #[must_use]
    pub fn lanes(&self) -> Lanes {
        self.lanes
    }

    /// Traces these rays again, one after another on one thread: what each hits.
    #[must_use]
    pub fn trace(&self) -> Vec<Hit> {
        let mut kernel = cpu::kernel(&self.setup, &self.frame);
        trace_each(&mut kernel, &self.rays)
    }
}

/// The segments of all samples of a pixel; the rays of the first `recorded` are added to `rays`.
fn pixel(
    kernel: &mut Kernel<'_>,
    at: [u32; 2],
    job: &Job,
    (rays, recorded): (&mut Vec<Ray>, u32),
) -> Vec<Segment> {
    let pixel = UVec2::from(at);
    let mut segments = Vec::new();
    for sample in job.samples.start..job.samples.end {
        let key = kernel.sample_key(pixel, sample, job.seed);
        let mut path = kernel.path_begin(key, pixel);
        while !kernel.path_ended(path) {
            let ray = kernel.path_ray(&mut path);
            let before = path.segments;
            let hit = kernel.trace(ray);
            if sample < job.samples.start + recorded {
                rays.push(ray);
            }
            kernel.path_advance(&mut path, hit);
            if path.segments > before {
                let met = hit.prim != NONE;
                let material = if met { kernel.dispatch_material(hit) } else { NONE };
                segments.push(Segment { material });
            }
        }
    }
    segments
}

/// The pixels of a tile, those of a square of as many as there are lanes after those of another.
fn in_squares(tile: Rect, lanes: u32) -> impl Iterator<Item = [u32; 2]> {
    let rows = lanes / COLUMNS;
    let across = move |x: u32, y: u32| {
        let ys = y..(y + rows).min(tile.y + tile.h);
        let xs = x..(x + COLUMNS).min(tile.x + tile.w);
        ys.flat_map(move |y| xs.clone().map(move |x| [x, y]))
    };
    let tops = (tile.y..tile.y + tile.h).step_by(rows as usize);
    let lefts = move || (tile.x..tile.x + tile.w).step_by(COLUMNS as usize);
    tops.flat_map(move |y| lefts().flat_map(move |x| across(x, y)))
}

impl Lanes {
    /// Adds the turns of a tile. A lane whose path has ended begins the next sample at once, and with the last one of its
    /// pixel the first one of the next pixel.
    fn add(&mut self, pixels: &[Vec<Segment>]) {
        let mut rest = pixels.iter();
        let mut lanes = vec![[].iter(); self.count as usize];
        loop {
            let mut materials = Vec::new();
            for lane in &mut lanes {
                let mut segment = lane.next();
                while segment.is_none()
                    && let Some(pixel) = rest.next()
                {
                    *lane = pixel.iter();
                    segment = lane.next();
                }
                materials.extend(segment.map(|segment| segment.material));
            }
            if materials.is_empty() {
                return;
            }
            self.turns += 1;
            self.busy += materials.len() as u64;
            materials.sort_unstable();
            materials.dedup();
            self.materials += materials.len() as u64;
        }
    }

    /// Mean share of the lanes that are busy.
    #[must_use]
    pub fn share(&self) -> f64 {
        self.busy as f64 / (self.turns * u64::from(self.count)).max(1) as f64
    }

    /// Mean number of different materials in a turn.
    #[must_use]
    pub fn materials_a_turn(&self) -> f64 {
        self.materials as f64 / self.turns.max(1) as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_lane_that_has_no_sample_left_takes_the_next_pixel() {
        let segments = |materials: &[u32]| -> Vec<Segment> {
            materials.iter().map(|m| Segment { material: *m }).collect()
        };
        let mut lanes = Lanes { count: 2, ..Lanes::default() };
        lanes.add(&[segments(&[1, 2, NONE]), segments(&[1]), segments(&[3, 2, 3])]);
        assert_eq!(lanes, Lanes { count: 2, turns: 4, busy: 7, materials: 1 + 2 + 2 + 1 });
        assert!((lanes.share() - 0.875).abs() < 1e-9);
        assert_eq!(Lanes::default().share().to_bits(), 0.0_f64.to_bits());
    }

    #[test]
    fn squares_cover_a_tile_once() {
        let tile = Rect { x: 3, y: 5, w: 9, h: 6 };
        let mut pixels: Vec<[u32; 2]> = in_squares(tile, 16).collect();
        assert_eq!(pixels[..5], [[3, 5], [4, 5], [5, 5], [6, 5], [3, 6]]);
        assert_eq!(pixels[16], [7, 5]);
        pixels.sort_unstable();
        let all = (3..12).flat_map(|x| (5..11).map(move |y| [x, y]));
        assert!(pixels.into_iter().eq(all));
    }
}
