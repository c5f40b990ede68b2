//! What a sample costs on a CPU, tracing and shading apart, and how busy the lanes of the wide kernel are.

use std::fmt::Write as _;
use std::hint::black_box;

use compiler::bvh::Layout;
use cpu_time::ProcessTime;
use runtime::profile::Profile;
use runtime::{DeviceChoice, Job, SampleRange};

use super::devices::{SAMPLES, SIZE, cost};
use super::packs::Packs;
use super::{Outcome, ROUNDS, median};

/// Samples of a pixel whose rays are traced again.
const TRACED: u32 = 4;

/// A row for each scene.
pub(super) fn table(packs: &mut Packs, text: &mut String) -> Outcome {
    let [width, height] = SIZE;
    let _ = writeln!(
        text,
        "\n## Tracing and shading: {width} x {height}, {SAMPLES} samples a pixel, the CPU kernel, one thread\n\n\
        `trace`: every ray of {TRACED} samples a pixel, traced again in the order of the paths, one by one. \
        `shading`: the rest of a sample's time. `busy`: lanes with a segment, of all, in a turn of the wide kernel; \
        `materials`: different ones that these meet, on average.\n\n\
        | scene | ns a sample | rays a sample | trace, ns a ray | Mrays per CPU s | trace, share | shading, ns a sample | busy | materials |\n\
        |---|---|---|---|---|---|---|---|---|"
    );
    for name in ["cornell", "cornell_sphere", "weekend", "materials", "gltf", "mesh", "shrine"] {
        let scene = packs.scene(name, Layout::Wide)?;
        let mut job = Job::of_scene(&scene);
        job.resize(SIZE);
        job.samples = SampleRange { start: 0, end: SAMPLES };
        let profile = Profile::record(&scene, &job, TRACED)?;
        let (mut traced, mut rendered) = (Vec::new(), Vec::new());
        for _ in 0..ROUNDS {
            let start = ProcessTime::now();
            black_box(profile.trace());
            traced.push(start.elapsed().as_secs_f64());
            let one = |job: &mut Job| job.threads = Some(1);
            rendered.push(cost(&scene, &DeviceChoice::Cpu, SAMPLES, one)?.cpu);
        }
        let pixels = f64::from(width) * f64::from(height);
        let rays = profile.rays().len() as f64 / (pixels * f64::from(TRACED));
        let ray = median(traced) / profile.rays().len() as f64 * 1e9;
        let sample = median(rendered) / (pixels * f64::from(SAMPLES)) * 1e9;
        let lanes = profile.lanes();
        let _ = writeln!(
            text,
            "| `{name}` | {sample:.0} | {rays:.2} | {ray:.0} | {:.2} | {:.0} % | {:.0} | {:.2} of {} | {:.2} |",
            1e3 / ray,
            100.0 * rays * ray / sample,
            sample - rays * ray,
            lanes.share() * f64::from(lanes.count),
            lanes.count,
            lanes.materials_a_turn(),
        );
    }
    Ok(())
}
