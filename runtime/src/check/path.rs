//! A sample → its path, ray by ray, in either precision: the kernel's main loop, with a witness.

/// One ray and what it met.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step {
    /// Towards a light, rather than the path's next segment.
    pub shadow: bool,
    /// Where it starts, metres, world space.
    pub origin: [f64; 3],
    /// Its direction, unit.
    pub dir: [f64; 3],
    /// Distance to what it met, metres; that of the light where a shadow ray met nothing, infinite where
    /// there is nothing.
    pub t: f64,
    /// What it met: primitive and instance, as the kernel numbers them; `None`: nothing.
    pub hit: Option<[u32; 2]>,
    /// Material of that.
    pub material: Option<u32>,
    /// Density per steradian with which the material or medium chose `dir`; 0 for the camera, for delta lobes
    /// and for shadow rays.
    pub pdf: f64,
    /// Product of weights up to this ray.
    pub throughput: [f64; 3],
    /// Radiance of the path after this ray.
    pub radiance: [f64; 3],
}

/// One sample.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Sample {
    /// What it adds to its pixel; may be not finite.
    pub radiance: [f64; 3],
    /// Rays traced.
    pub rays: u32,
    /// Segments of the path.
    pub segments: u32,
    /// As in the film: overflows in bits 0-15, leaks in bits 16-31.
    pub stack_errors: u32,
    /// A number that is another where another ray was traced, or met another thing.
    pub way: u64,
    /// Every ray, when they were asked for.
    pub steps: Vec<Step>,
}

impl Step {
    /// In the world, of which the kernel's space shows `scale` times what is around `center`.
    fn in_world(self, (scale, center): (f64, [f64; 3])) -> Self {
        // The kernel's own number for a ray that meets nothing.
        let t = if self.t < 1e29 { self.t / scale } else { f64::INFINITY };
        let [x, y, z] = self.origin;
        let origin = [x / scale + center[0], y / scale + center[1], z / scale + center[2]];
        Self { origin, t, ..self }
    }
}

impl Sample {
    /// With its rays in the world, of which the kernel's space shows `scale` times what is around `center`.
    pub(super) fn in_world(mut self, space: (f64, [f64; 3])) -> Self {
        for step in &mut self.steps {
            *step = step.in_world(space);
        }
        self
    }

    /// What counts in the film: black where it is not finite.
    #[must_use]
    pub fn finite(&self) -> [f64; 3] {
        if self.radiance.iter().all(|x| x.is_finite()) { self.radiance } else { [0.0; 3] }
    }

    fn turn(&mut self, words: [u32; 3]) {
        // Fowler, Noll & Vo's hash, a word at a time.
        for word in words {
            self.way = (self.way ^ u64::from(word)).wrapping_mul(0x0000_0100_0000_01b3);
        }
    }
}

macro_rules! precision {
    ($real:ident, $module:ident, $wide:expr) => {
        pub(crate) mod $module {
            use super::{Sample, Step};
            use crate::kernel::$real as k;
            use crate::setup::Setup;
            use glam::{UVec2, UVec4};
            use pack::Kind;
            use pack::abi::{Frame, NONE};

            /// The kernel of a scene.
            pub(crate) fn open<'a>(setup: &'a Setup<'_>, frame: &'a Frame) -> k::Kernel<'a> {
                let frame_words: &[UVec4] = bytemuck::cast_slice(std::slice::from_ref(frame));
                k::Kernel::new(k::Bindings {
                    frame_words,
                    film_words: &mut [],
                    heap_words: setup.heap(),
                    node_words: setup.nodes(),
                    tri_words: setup.section(Kind::TRIANGLE),
                    shade_words: setup.section(Kind::TRISHADE),
                    sphere_words: setup.section(Kind::SPHERE),
                    texel_words: setup.section(Kind::TEXEL),
                })
            }

            /// One sample; its rays are kept if `keep`.
            pub(in crate::check) fn sample(
                kernel: &mut k::Kernel<'_>,
                pixel: [u32; 2],
                sample: u32,
                seed: u32,
                keep: bool,
            ) -> Sample {
                let pixel = UVec2::from(pixel);
                let key = kernel.sample_key(pixel, sample, seed);
                let mut path = kernel.path_begin(key, pixel);
                let mut found = Sample::default();
                while !kernel.path_ended(path) {
                    let ray = kernel.path_ray(&mut path);
                    let shadow = path.shadow_light != NONE;
                    let pdf = if shadow { 0.0 } else { f64::from(path.pdf) };
                    let throughput = path.throughput;
                    found.rays += kernel.dispatch_counted_rays(&mut path);
                    let hit = kernel.trace(ray);
                    found.turn([hit.prim, hit.instance, u32::from(shadow)]);
                    kernel.path_advance(&mut path, hit);
                    if keep {
                        let met = hit.prim != NONE;
                        found.steps.push(Step {
                            shadow,
                            origin: $wide(ray.origin),
                            dir: $wide(ray.dir),
                            t: f64::from(hit.t),
                            hit: met.then_some([hit.prim, hit.instance]),
                            material: met.then(|| kernel.dispatch_material(hit)),
                            pdf,
                            throughput: $wide(throughput),
                            radiance: $wide(path.radiance),
                        });
                    }
                }
                found.radiance = $wide(path.radiance);
                found.segments = path.segments;
                found.stack_errors = kernel.dispatch_stack_errors(&mut path);
                found
            }
        }
    };
}

precision!(f32, single, (|v: glam::Vec3| v.as_dvec3().to_array()));
precision!(f64, double, (|v: glam::DVec3| v.to_array()));
