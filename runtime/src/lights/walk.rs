//! A row of pixels → its light by group, in either precision: the kernel's main loop, with each ray's light told apart.

use super::owner::{Emitter, LightGroups};
use super::row::{Row, Sample};

macro_rules! precision {
    ($module:ident, $real:ident, $kernel:path, $double:expr) => {
        pub(super) mod $module {
            use super::{Emitter, LightGroups, Row, Sample};
            use crate::kernel::$real as k;
            use crate::layers::Group;
            use crate::schedule::WorkItem;
            use glam::UVec2;
            use pack::abi::NONE;

            pub(in crate::lights) fn add(
                lights: &LightGroups<'_>,
                row: &Row<'_>,
                groups: &mut [Group],
            ) {
                let Row { tile, samples, replicate, .. } = *row;
                let frame = row.setup.frame(&WorkItem { tile, samples, replicate, probe: false });
                let mut kernel = $kernel(row.setup, &frame);
                let mut sample = Sample::default();
                for (i, x) in (tile.x..tile.x + tile.w).enumerate() {
                    if row.counts.get(i) == Some(&0) {
                        continue;
                    }
                    for index in samples.start..samples.end {
                        let pixel = UVec2::new(x, tile.y);
                        let key = kernel.sample_key(pixel, index, frame.seed);
                        let mut path = kernel.path_begin(key, pixel);
                        sample.begin(lights.names.len());
                        let of_sky = walk(&mut kernel, &mut path, lights, &mut sample);
                        let kept = kernel.indirect_clamped(&mut path);
                        if kept.is_finite() && !(of_sky && row.job.wanted.transparent) {
                            let scale = f64::from(kernel.indirect_scale(&mut path));
                            sample.put(groups, i, (scale >= 0.0).then_some(scale));
                        }
                    }
                }
            }

            /// Light of a ray that has left the scene, which may come from the sky and from lights at infinity at once.
            fn outside(
                kernel: &mut k::Kernel<'_>,
                path: &k::Path,
                lights: &LightGroups<'_>,
                sample: &mut Sample,
                emitted: [f64; 3],
            ) {
                let n = kernel.directional_count();
                if n == 0 {
                    return sample.take(lights.of_emitter(Emitter::Sky), emitted);
                }
                // The camera looks past some.
                let straight = path.scattered == 0;
                for i in 0..n {
                    let found = path.throughput
                        * kernel.directional_found(i, path.dir, path.pdf, path.receiver, straight);
                    sample.take(lights.of_emitter(Emitter::Light(i)), $double(found));
                }
                let sky = path.throughput * kernel.dispatch_sky_miss(path.dir, path.pdf, straight);
                sample.take(lights.of_emitter(Emitter::Sky), $double(sky));
            }

            /// Takes a path to its end. Whether it has met nothing but the sky.
            fn walk(
                kernel: &mut k::Kernel<'_>,
                path: &mut k::Path,
                lights: &LightGroups<'_>,
                sample: &mut Sample,
            ) -> bool {
                let (mut met, mut of_sky) = (false, false);
                while !kernel.path_ended(*path) {
                    let (light, scattered) = (path.shadow_light, path.scattered);
                    let ray = kernel.path_ray(path);
                    let hit = kernel.trace(ray);
                    let found = kernel.lights_advance(path, hit);
                    let emitter = match (light, hit.prim, hit.prim & k::PRIM_SPHERE) {
                        (NONE, NONE, _) => Emitter::Sky,
                        (NONE, prim, 0) => Emitter::Triangle(prim, hit.instance),
                        (NONE, prim, _) => Emitter::Sphere(prim & !k::PRIM_SPHERE),
                        (light, ..) => Emitter::Light(light),
                    };
                    let (emitted, glow) = ($double(found.emitted), $double(found.glow));
                    if emitted.iter().any(|x| *x != 0.0) {
                        match emitter {
                            Emitter::Sky => outside(kernel, path, lights, sample, emitted),
                            _ => sample.take(lights.of_emitter(emitter), emitted),
                        }
                    }
                    sample.take(lights.rest, glow);
                    met |= found.met;
                    of_sky = matches!(emitter, Emitter::Sky) && !met;
                    if scattered < 2 && path.scattered >= 2 {
                        sample.direct.clone_from(&sample.sums);
                    }
                }
                of_sky
            }
        }
    };
}

precision!(single, f32, crate::cpu::kernel, (|v: glam::Vec3| v.as_dvec3().to_array()));
precision!(double, f64, crate::cpu::kernel_f64, (|v: glam::DVec3| v.to_array()));
