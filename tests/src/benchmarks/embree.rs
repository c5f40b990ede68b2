//! The rays of pictures, traced by the CPU kernel and by Embree.

use std::collections::BTreeSet;
use std::fmt::Write as _;

use compiler::bvh::Layout;
use cpu_time::ProcessTime;
use pack::abi::{NONE, Sphere, Triangle};
use runtime::kernel::f32::{Hit, Ray};
use runtime::profile::Profile;
use runtime::{Job, SampleRange, Scene};

use super::devices::SIZE;
use super::packs::Packs;
use super::{Outcome, ROUNDS, median};
use crate::embree::{self, Embree, Quality};

/// Samples of a pixel whose rays are traced.
const SAMPLES: u32 = 4;

/// Examples of which nothing moves and nothing is an instance.
const SCENES: [&str; 7] =
    ["cornell", "cornell_sphere", "weekend", "materials", "gltf", "terrace", "mesh"];

/// What Embree does not leave out by itself: the surface that a ray starts on, and the light that a shadow ray goes to.
/// The scene lies in a ball of radius 1.
const START: f32 = 1e-5;
const BEFORE_LIGHT: f32 = 1.0 - 1e-4;

const THEIRS: [Quality; 2] = [Quality::High, Quality::Robust];

/// A row for each scene.
pub(super) fn table(packs: &mut Packs, text: &mut String) -> Outcome {
    let [width, height] = SIZE;
    let embree = Embree::compile()?;
    let _ = writeln!(
        text,
        "\n## Rays beside Embree's: {width} x {height}, {SAMPLES} samples a pixel, one thread\n\n\
        Every ray of a picture in the order of its paths, one by one: as pictures trace a ray that has no others \
        beside it, and by Embree 3 through a tree of high quality (`rtcIntersect1`, for shadow rays `rtcOccluded1`), as \
        it is and with `RTC_SCENE_FLAG_ROBUST`, with which its intersections are watertight, as ours always are. It \
        knows triangles and spheres and no materials: what alpha cuts out is there, and what is see-through ends \
        shadow rays. `others`: rays to which that, or rounding, gives another hit.\n\n\
        | scene | rays | ours, ns | Embree, ns | robust, ns | our rays a second, of Embree's | of robust ones | others |\n\
        |---|---|---|---|---|---|---|---|"
    );
    for name in SCENES {
        row(&packs.scene(name, Layout::Wide)?, (name, &embree), text)?;
    }
    Ok(())
}

fn row(scene: &Scene, (name, embree): (&str, &Embree), text: &mut String) -> Outcome {
    let mut job = Job::of_scene(scene);
    job.resize(SIZE);
    job.samples = SampleRange { start: 0, end: SAMPLES };
    let profile = Profile::record(scene, &job, SAMPLES)?;
    let asked: Vec<embree::Ray> = profile.rays().iter().map(asked).collect();
    let there = embree.scene(&triangles(scene), &spheres(scene))?;
    let mut ours = Vec::new();
    let mut theirs = THEIRS.map(|_| Vec::new());
    let mut others = 0;
    for _ in 0..ROUNDS {
        let start = ProcessTime::now();
        let hits = profile.trace();
        ours.push(start.elapsed().as_secs_f64());
        for (quality, theirs) in THEIRS.into_iter().zip(&mut theirs) {
            let (cpu, found) = there.trace(quality, &asked)?;
            theirs.push(cpu);
            others = hits
                .iter()
                .zip(&asked)
                .zip(found)
                .filter(|(our, there)| !same(*our, *there))
                .count();
        }
    }
    let n = asked.len() as f64;
    let ns = |took: Vec<f64>| median(took) / n * 1e9;
    let (ours, [high, robust]) = (ns(ours), theirs.map(ns));
    let _ = writeln!(
        text,
        "| `{name}` | {n} | {ours:.0} | {high:.0} | {robust:.0} | {:.2} | {:.2} | {:.2} % |",
        high / ours,
        robust / ours,
        100.0 * others as f64 / n,
    );
    Ok(())
}

/// Each once, where it lies in several leaves.
fn triangles(scene: &Scene) -> Vec<embree::Triangle> {
    let mut known = BTreeSet::new();
    let all = scene.pack().records::<Triangle>().iter().map(|t| [t.v0, t.v1, t.v2]);
    all.filter(|corners| known.insert(corners.map(|corner| corner.map(f32::to_bits)))).collect()
}

fn spheres(scene: &Scene) -> Vec<[f32; 4]> {
    let all = scene.pack().records::<Sphere>().iter();
    all.map(|Sphere { center: [x, y, z], radius, .. }| [*x, *y, *z, *radius]).collect()
}

fn asked(ray: &Ray) -> embree::Ray {
    let any = ray.light != NONE;
    embree::Ray {
        origin: ray.origin.to_array(),
        t_min: if ray.skip.x == NONE { ray.t_min } else { ray.t_min.max(START) },
        dir: ray.dir.to_array(),
        t_max: if any { ray.t_max * BEFORE_LIGHT } else { ray.t_max },
        any,
    }
}

/// Whether `there`, as Embree gives it, is what our ray hit.
fn same((ours, asked): (&Hit, &embree::Ray), there: f32) -> bool {
    let ours = (ours.prim != NONE).then_some(ours.t);
    if asked.any { ours.is_some() == (there >= 0.0) } else { embree::is_same_hit(ours, there) }
}
