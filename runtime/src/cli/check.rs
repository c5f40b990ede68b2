//! `rtr check scene.pack`: where single precision is not enough, and the path of one sample.

use super::args::{CheckArgs, Verify};
use super::console::Console;
use super::exit::Exit;
use super::guard::Guard;
use super::open::{How, open};
use super::outputs::{Claim, Use, prove, save};
use crate::check::{self, Report, Sample, Step, Verdict};
use crate::control::Control;
use crate::film::BadSample;
use crate::job::Job;
use crate::region::SampleRange;
use crate::scene::Scene;

pub(super) fn command(args: &CheckArgs) -> Exit {
    let console = Console::new(args.quiet);
    let scene = match open(&args.pack, How::of(args.no_mmap)) {
        Ok(pack) => Scene::new(pack),
        Err(error) => return console.fail_about(&args.pack, &error, Exit::World),
    };
    let guard = match Guard::new(&console, &args.pack, scene.pack(), Verify::First) {
        Ok(guard) => guard,
        Err(exit) => return exit,
    };
    let mut job = Job::of_scene(&scene);
    if let Some(size) = args.size {
        job.resize(size);
    }
    job.seed = args.seed.unwrap_or(job.seed);
    job.threads = args.threads;
    job.samples = SampleRange { start: 0, end: args.spp };
    if let Err(error) = job.check() {
        return console.fail(&error, Exit::Usage);
    }
    if let Some([x, y]) = args.pixel {
        if x >= job.image_size[0] || y >= job.image_size[1] {
            console.warn(&format!("error: pixel {x},{y} is not in the image"));
            return Exit::Usage;
        }
        let at = BadSample { x, y, sample: args.sample };
        return match guard.during(&Control::default(), || check::replay(&scene, &job, at)) {
            Ok(Ok(pair)) => replayed(args, &console, &scene, (&job, at), &pair),
            Ok(Err(error)) => console.fail(&error, Exit::World),
            Err(exit) => exit,
        };
    }
    let inputs = [Use { path: &args.pack, what: "the pack" }];
    let room = 3 * job.crop.pixels();
    let heat = args.heat.iter().map(|path| Claim::new(path, "the picture of --heat", room));
    if let Err(exit) = prove(&console, &inputs, &heat.collect::<Vec<_>>()) {
        return exit;
    }
    let report = match guard.during(&Control::default(), || check::compare(&scene, &job)) {
        Ok(Ok(report)) => report,
        Ok(Err(error)) => return console.fail(&error, Exit::World),
        Err(exit) => return exit,
    };
    tell(&console, &report);
    if let Some(path) = &args.heat {
        let bytes = match check::encode_heat(&report) {
            Ok(bytes) => bytes,
            Err(error) => return console.fail(&error, Exit::Bug),
        };
        if let Err(exit) = save(&console, path, &bytes) {
            return exit;
        }
    }
    let verdict = Verdict::of(&report, args.strict);
    if verdict.is_stable() {
        console.result("verdict: stable, single precision is enough");
        return Exit::Done;
    }
    for reason in &verdict.reasons {
        console.result(&format!("  {reason}"));
    }
    console.result("verdict: not stable, single precision shows");
    Exit::NotFinite
}

fn tell(console: &Console, report: &Report) {
    let [width, height] = report.size;
    console.result(&format!("{width}x{height}, {} spp, in f32 and in f64", report.samples));
    console.result(&format!(
        "pixels: relative difference {:.1e} in the mean, {:.1e} at most; {:.3} % above {:.0e}",
        report.mean(),
        report.largest(),
        100.0 * report.share_of_pixels(),
        check::PARTED,
    ));
    console.result(&format!("image: the mean differs by {:.1e}", report.brightness()));
    let paths = 100.0 * report.share_of_paths();
    console.result(&format!("paths: {paths:.3} % diverge: other rays, or other hits"));
    for (name, (counters, bad)) in
        ["f32", "f64"].into_iter().zip(report.counters.iter().zip(report.bad))
    {
        console.result(&format!(
            "{name}: {} rays, longest path {}, not finite {} (NaN {}, infinite {}), medium overflows {}, leaks {}",
            counters.rays,
            counters.depth,
            counters.bad,
            bad[0],
            bad[1],
            counters.overflows,
            counters.leaks,
        ));
        if let Some(first) = counters.first_bad {
            console.result(&format!("{name}: first sample that is not finite: {first}"));
        }
    }
    let worst = report.worst();
    if !worst.is_empty() {
        console.result("worst pixels; replay with --pixel X,Y --sample N --trace:");
    }
    for (at, pixel) in worst {
        let BadSample { x, y, sample } = at;
        console.result(&format!(
            "  --pixel {x},{y} --sample {sample}  off by {:.1e}, {} of {} paths part",
            pixel.off, pixel.parted, report.samples
        ));
    }
}

fn replayed(
    args: &CheckArgs,
    console: &Console,
    scene: &Scene,
    (job, at): (&Job, BadSample),
    [single, double]: &[Sample; 2],
) -> Exit {
    console.result(&format!("pixel {},{}, sample {}, seed {}", at.x, at.y, at.sample, job.seed));
    if args.trace {
        let names = Names::new(scene);
        console.result(
            "rays start in metres, world space; distances are metres, directions unit vectors",
        );
        let n = single.steps.len().max(double.steps.len());
        for i in 0..n {
            let pair = [single, double].map(|sample| sample.steps.get(i));
            let parts = pair[0].map(|step| step.hit) != pair[1].map(|step| step.hit);
            console.result(&format!("ray {i}{}", if parts { ": they diverge here" } else { "" }));
            for (name, step) in ["f32", "f64"].into_iter().zip(pair) {
                let text = step.map_or("has ended".to_owned(), |step| names.step(step));
                console.result(&format!("  {name} {text}"));
            }
        }
    }
    for (name, sample) in [("f32", single), ("f64", double)] {
        let Sample { radiance: [r, g, b], segments, rays, .. } = sample;
        console.result(&format!(
            "{name}: radiance {r:?} {g:?} {b:?}, {segments} segments, {rays} rays"
        ));
    }
    console.result(if single.way == double.way { "the same way" } else { "another way" });
    Exit::Done
}

/// Names of materials, as the pack's manifest knows them, and how exactly its places are told.
struct Names {
    manifest: Option<pack::Manifest>,
    /// Decimals of a metre; seven in the kernel's space, where everything is smaller than 1.
    decimals: usize,
}

impl Names {
    fn new(scene: &Scene) -> Self {
        let digits = (7.0 + scene.settings().scale().log10()).ceil();
        #[expect(clippy::cast_possible_truncation, reason = "at most 17")]
        let decimals = digits.clamp(0.0, 17.0) as usize;
        Self { manifest: scene.pack().manifest().ok(), decimals }
    }

    /// `clay (scene.rts:12)`, or the number where there is no name.
    fn material(&self, index: u32) -> String {
        let named = self
            .manifest
            .as_ref()
            .and_then(|manifest| Some((manifest, manifest.materials.get(index as usize)?)));
        let Some((manifest, named)) = named else { return format!("material {index}") };
        match manifest.file(named.file) {
            Some(file) if named.line > 0 => format!("{} ({file}:{})", named.name, named.line),
            _ => named.name.clone(),
        }
    }

    fn step(&self, step: &Step) -> String {
        let kind = if step.shadow { "to a light" } else { "path" };
        let met = step.material.map_or("nothing".to_owned(), |index| self.material(index));
        let part = step.hit.map_or(String::new(), |[prim, _]| match prim >> 31 {
            0 => format!(", triangle {prim}"),
            _ => format!(", sphere {}", prim & 0x7fff_ffff),
        });
        let vector = |[x, y, z]: [f64; 3]| format!("({x:.7} {y:.7} {z:.7})");
        let n = self.decimals;
        let [x, y, z] = step.origin;
        let far = if step.t.is_finite() { format!(" at {:.n$} m", step.t) } else { String::new() };
        format!(
            "{kind} from ({x:.n$} {y:.n$} {z:.n$}) along {} meets {met}{part}{far}; throughput {}, radiance {}",
            vector(step.dir),
            vector(step.throughput),
            vector(step.radiance),
        )
    }
}
