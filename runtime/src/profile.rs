//! A scene → the rays of its picture on a CPU, to be timed without what is shaded, and how well lanes share them.
//!
//! It drives the functions of the scalar kernel in the order of its main loop. It measures no time and does not print.

use crate::cpu::{self, CpuError};
use crate::job::{CpuWay, Job};
use crate::kernel::f32::{Kernel, NONE, Ray};
use crate::scene::Scene;
use crate::setup::Setup;
use glam::UVec2;
use pack::abi::Frame;

/// Columns of the pixels that are rendered together, as in `runtime/kernel/wide/render.rs`.
const COLUMNS: usize = 4;

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
        let [width, height] = job.image_size;
        let rows = lanes.count as usize / COLUMNS;
        for top in (0..height).step_by(rows) {
            for left in (0..width).step_by(COLUMNS) {
                let columns = || (left..width).take(COLUMNS);
                let pixels = (top..height).take(rows).flat_map(|y| columns().map(move |x| [x, y]));
                let mut segments = |at| pixel(&mut kernel, at, job, (rays, recorded));
                let group: Vec<Vec<Segment>> = pixels.map(&mut segments).collect();
                lanes.add(&group);
            }
        }
    }

    /// How many rays were recorded.
    #[must_use]
    pub fn n_rays(&self) -> usize {
        self.rays.len()
    }

    /// How the lanes share the work.
    #[must_use]
    pub fn lanes(&self) -> Lanes {
        self.lanes
    }

    /// Traces these rays again, on one thread: how many of them hit something.
    #[must_use]
    pub fn trace(&self) -> usize {
        let mut kernel = cpu::kernel(&self.setup, &self.frame);
        self.rays.iter().filter(|ray| kernel.trace(**ray).prim != NONE).count()
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

impl Lanes {
    /// Adds the turns of a group: a lane whose path has ended begins the next sample at once.
    fn add(&mut self, group: &[Vec<Segment>]) {
        let longest = group.iter().map(Vec::len).max().unwrap_or(0);
        for turn in 0..longest {
            let mut materials: Vec<u32> =
                group.iter().filter_map(|lane| lane.get(turn)).map(|s| s.material).collect();
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
    fn a_lane_that_has_no_sample_left_is_idle() {
        let segments = |materials: &[u32]| -> Vec<Segment> {
            materials.iter().map(|m| Segment { material: *m }).collect()
        };
        let mut lanes = Lanes { count: 8, ..Lanes::default() };
        lanes.add(&[segments(&[1, 2, NONE]), segments(&[1]), segments(&[3, 3])]);
        assert_eq!(lanes, Lanes { count: 8, turns: 3, busy: 6, materials: 2 + 2 + 1 });
        assert!((lanes.share() - 0.25).abs() < 1e-9);
        assert_eq!(Lanes::default().share().to_bits(), 0.0_f64.to_bits());
    }
}
