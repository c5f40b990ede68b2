//! `rtr --ablate scene.pack`: what a kernel without superfluous features is worth, as a table and as JSON.

use super::args::RenderArgs;
use super::console::Console;
use super::exit::Exit;

#[cfg(not(feature = "gpu"))]
pub(super) fn command(args: &RenderArgs) -> Exit {
    Console::new(args.quiet).warn(
        "error: this rtr was built without GPU support, and the CPU kernel always has all features: nothing to compare",
    );
    Exit::World
}

#[cfg(feature = "gpu")]
pub(super) use with_gpu::command;

#[cfg(feature = "gpu")]
mod with_gpu {
    use super::super::args::{AblateArg, Verify};
    use super::super::console::reset_interrupts;
    use super::super::guard::Guard;
    use super::super::open::{How, open};
    use super::super::outputs::{Claim, Use, prove, save};
    use super::{Console, Exit, RenderArgs};
    use crate::ablation::{Ablation, AblationError, Event, Measured, Plan, Row, ablate};
    use crate::control::Control;
    use crate::job::Job;
    use crate::region::SampleRange;
    use crate::render::DeviceChoice;
    use crate::scene::Scene;
    use files::ShowPath as _;
    use std::path::Path;
    use std::sync::atomic::{AtomicBool, Ordering};

    /// Samples of a round where `--spp` does not say: one batch.
    const SAMPLES: u32 = pack::abi::BATCH;
    /// Timed renders of each kernel; odd, so that the median is a measured value.
    const ROUNDS: u32 = 3;

    pub(in super::super) fn command(args: &RenderArgs) -> Exit {
        let console = Console::new(args.quiet);
        let Some(path) = &args.pack else {
            console.warn("error: no pack was named");
            return Exit::Usage;
        };
        if let Some(report) = args.error.report.iter().find(|path| !is_json(path)) {
            let report = report.shown();
            console.warn(&format!("error: cannot write {report}: --ablate writes .json"));
            return Exit::Usage;
        }
        let scene = match open(path, How::of(args.no_mmap)) {
            Ok(pack) => Scene::new(pack),
            Err(error) => return console.fail_about(path, &error, Exit::World),
        };
        let inputs = [Use { path, what: "the pack" }];
        let reports = args.error.report.iter();
        let reports: Vec<_> = reports.map(|path| Claim::new(path, "the report", 0)).collect();
        if let Err(exit) = prove(&console, &inputs, &reports) {
            return exit;
        }
        let job = job(args, &scene);
        if let Err(error) = job.check() {
            return console.fail(&error, Exit::Usage);
        }
        // What is timed is not to wait for hashes.
        let verify = if args.verify == Verify::Off { Verify::Off } else { Verify::First };
        let guard = match Guard::new(&console, path, scene.pack(), verify) {
            Ok(guard) => guard,
            Err(exit) => return exit,
        };
        let control = Control::default();
        match guard.during(&control, || compare(args, &console, (&scene, &job), &control)) {
            Ok(Ok(ablation)) => conclude(args, &console, &ablation),
            Ok(Err(error)) => console.fail(&error, Exit::World),
            Err(exit) => exit,
        }
    }

    fn is_json(path: &Path) -> bool {
        path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("json"))
    }

    fn job(args: &RenderArgs, scene: &Scene) -> Job {
        let mut job = Job::of_scene(scene);
        if let Some(size) = args.size {
            job.resize(size);
        }
        job.crop = args.crop.unwrap_or(job.crop);
        job.samples = SampleRange { start: 0, end: args.spp.unwrap_or(SAMPLES) };
        job.seed = args.seed.unwrap_or(job.seed);
        job.threads = args.threads;
        job.submission = args.submission;
        job
    }

    fn compare(
        args: &RenderArgs,
        console: &Console,
        (scene, job): (&Scene, &Job),
        control: &Control,
    ) -> Result<Ablation, AblationError> {
        reset_interrupts();
        let over = AtomicBool::new(false);
        let plan = Plan { rounds: ROUNDS, full: true, each: args.ablate == Some(AblateArg::Each) };
        let mut first: Option<Row> = None;
        let mut tell = |event: Event<'_>| {
            let row = match event {
                Event::Begin(name) => return console.note(&format!("building and timing: {name}")),
                Event::End(row) => row,
            };
            if first.is_none() {
                console.result(HEAD);
            }
            let base = first.get_or_insert_with(|| row.clone());
            console.result(&line(row, base));
        };
        std::thread::scope(|scope| {
            let watcher = scope.spawn(|| console.pass_interrupts(control, &over));
            let choice = DeviceChoice::parse(&args.device);
            let ablation = ablate(scene, job, &choice, plan, control, &mut tell);
            over.store(true, Ordering::Relaxed);
            watcher.thread().unpark();
            ablation
        })
    }

    const HEAD: &str = "kernel                      lines         words         build s  ms/sample    against  same picture";

    /// A row; `base`: the specialised kernel.
    fn line(row: &Row, base: &Row) -> String {
        let more = |n: u32, base: u32| format!("{n:>7} {:>+6}", i64::from(n) - i64::from(base));
        let words = match (row.spirv_words, base.spirv_words) {
            (Some(n), Some(base)) => more(n, base),
            _ => format!("{:>14}", "-"),
        };
        let lines = more(row.wgsl_lines, base.wgsl_lines);
        let measured = row.measured.map_or(String::new(), |measured| {
            let Measured { build_s, ms, .. } = measured;
            let ratio = measured.ratio();
            format!("{build_s:>9.2} {ms:>10.3} {ratio:>9.3}x  {}", same(&measured))
        });
        format!("{:<24} {lines} {words} {measured}", row.kernel).trim_end().to_owned()
    }

    fn same(measured: &Measured) -> String {
        match (measured.differ, measured.differ_cpu, measured.z) {
            (0, 0, _) => "bit for bit, and on the CPU".to_owned(),
            (0, _, _) => "bit for bit".to_owned(),
            (n, _, Some(z)) => format!("{n} pixels round differently, z = {z:.1}"),
            (n, _, None) => format!("no: {n} pixels differ"),
        }
    }

    fn conclude(args: &RenderArgs, console: &Console, ablation: &Ablation) -> Exit {
        let cpu = ablation.cpu_ms;
        console.result(&format!("CPU kernel, which has all features: {cpu:.3} ms/sample"));
        let full = ablation.rows.iter().find(|row| row.kernel == "full");
        match (&ablation.device, full.and_then(|row| row.measured)) {
            (None, _) => console.result(
                "no adapter: only texts were compared; the CPU kernel has every feature and leaves out none",
            ),
            (Some(device), Some(full)) => console.result(&format!("{device}: {}", verdict(&full))),
            (Some(device), None) => console.result(&format!("{device}: the full kernel was not run")),
        }
        let text = serde_json::to_string_pretty(ablation).expect("numbers and texts") + "\n";
        for path in &args.error.report {
            if let Err(exit) = save(console, path, text.as_bytes()) {
                return exit;
            }
        }
        let wrong = ablation.wrong();
        for row in &wrong {
            console.warn(&format!("error: the kernel `{}` shows another picture", row.kernel));
        }
        if ablation.interrupted {
            Exit::Interrupted
        } else if wrong.is_empty() {
            Exit::Done
        } else {
            Exit::NotFinite
        }
    }

    /// What specialising is worth.
    fn verdict(full: &Measured) -> String {
        let ratio = full.ratio();
        let worth = if ratio > 1.02 {
            "specialising pays"
        } else if ratio < 0.98 {
            "specialising costs time here"
        } else {
            "specialising makes no difference beyond 2 %"
        };
        format!(
            "{worth}: the full kernel takes {ratio:.2} times as long a sample, {:.2} s to build",
            full.build_s
        )
    }
}
