//! The tables of `docs/benchmarks.md` about kernels: what each scene leaves out and what that is worth, on
//! every adapter of the machine; and what each feature costs a scene that does not need it.

use std::error::Error;
use std::fmt::Write as _;

use pack::Pack;
use runtime::ablation::{Ablation, Measured, Plan, ablate};
use runtime::{Control, DeviceChoice, Job, SampleRange, Scene};
use scenes::catalog::EXAMPLES;

use crate::scene::{bytes, example};

/// How much is measured.
#[derive(Clone, Copy, Debug)]
struct Effort {
    /// Pixels.
    size: [u32; 2],
    /// Samples a pixel in each round.
    samples: u32,
    /// Timed rounds of each kernel.
    rounds: u32,
}

/// The effort where devices are quick.
const PAGE: Effort = Effort { size: [640, 360], samples: 16, rounds: 3 };
/// The effort where software adapters count, whose full kernel is slow.
const ON_SOFTWARE: Effort = Effort { size: [120, 68], samples: 4, rounds: 3 };

/// The scene whose absent features are measured one by one: it has few.
const EACH: &str = "cornell";

/// Environment variable that asks for the table on software adapters, too.
const SOFTWARE: &str = "ABLATION_SOFTWARE";

/// Mesa's software adapter, as tables call it.
const LLVMPIPE: &str = "llvmpipe";

/// What there is to know of the times of [`LLVMPIPE`]. Seen with `MESA_SHADER_CACHE_DISABLE=true`.
const COMPILED_AGAIN: &str = "\nllvmpipe as Mesa 22.3.6 has it recompiles a kernel for every submission, or takes it from its cache on disk: \
    it puts numbers of the frame into the code. Its times have that in them, those of long kernels most of \
    all, and so single rows differ several-fold from run to run of this program.\n";

/// Below this share of the time a difference is not told from chance.
const MARGIN: f64 = 0.02;

/// Whether software adapters count.
fn software() -> bool {
    std::env::var_os(SOFTWARE).is_some()
}

/// Adds the tables to `text`; `names`: the scenes.
///
/// # Errors
/// When a device fails.
pub fn tables(text: &mut String, names: &[&str]) -> Result<(), Box<dyn Error>> {
    let effort = if software() { ON_SOFTWARE } else { PAGE };
    let [width, height] = effort.size;
    let _ = writeln!(
        text,
        "\n## What is left out: {width} x {height}, {} samples a pixel\n\n\
        The kernel of each scene (examples with reduced assets) against the one with all features, \
        `rtr --ablate=full`: medians of {} rounds in turns. The CPU kernel is one for all scenes and has \
        all features, so it has no second column, and its time is of one run. Build: the pipeline and its first workgroup; a driver \
        that keeps compiled kernels on disk is quick from the second scene on, because the full kernel is \
        the same for all.\n\n\
        | scene | device | features | WGSL lines | SPIR-V words | build s | full | ms a sample | full | full / own | same picture |\n\
        |---|---|---|---|---|---|---|---|---|---|---|",
        effort.samples, effort.rounds,
    );
    let devices = devices();
    let mut verdicts: Vec<String> = Vec::new();
    let mut any_llvmpipe = false;
    for name in names {
        let scene = scene_of(name)?;
        for choice in &devices {
            match compared(&scene, choice, effort, false) {
                Ok(found) => {
                    any_llvmpipe |= device(&found) == LLVMPIPE;
                    let _ = writeln!(text, "{}", row(name, &scene, &found));
                    verdicts.extend(verdict(name, &found));
                }
                // One scene that is too much for a device is no reason to lose the others.
                Err(error) => {
                    verdicts.push(format!("`{name}` was not measured on {choice:?}: {error}."));
                }
            }
        }
    }
    if devices == [DeviceChoice::Cpu] {
        text.push_str(
            "\nNo GPU was found: only texts were compared. Software adapters are measured where the \
            environment has `ABLATION_SOFTWARE=1`; they take minutes for the full kernel.\n",
        );
    }
    if any_llvmpipe {
        text.push_str(COMPILED_AGAIN);
    }
    for verdict in verdicts {
        let _ = writeln!(text, "\n{verdict}");
    }
    each(text, effort, &devices)
}

/// Names of all examples.
#[must_use]
pub fn all_scenes() -> Vec<&'static str> {
    EXAMPLES.iter().map(|example| example.name).collect()
}

fn scene_of(name: &str) -> Result<Scene, Box<dyn Error>> {
    let found = scenes::catalog::find(name).ok_or("there is no such example")?;
    Ok(Scene::new(Pack::from_bytes(bytes(&example(found, &[])))?))
}

/// Every adapter; without any, the CPU. Software adapters translate the full kernel for many minutes: they count
/// only where [`SOFTWARE`] is set.
fn devices() -> Vec<DeviceChoice> {
    let software = software();
    let mut adapters = runtime::gpu::adapters();
    adapters.retain(|adapter| software || !adapter.is_software());
    let named = adapters.iter().map(|adapter| DeviceChoice::Named(adapter.name().to_owned()));
    let all: Vec<DeviceChoice> = named.collect();
    if all.is_empty() { vec![DeviceChoice::Cpu] } else { all }
}

fn compared(
    scene: &Scene,
    device: &DeviceChoice,
    effort: Effort,
    each: bool,
) -> Result<Ablation, Box<dyn Error>> {
    let mut job = Job::of_scene(scene);
    job.resize(effort.size);
    job.samples = SampleRange { start: 0, end: effort.samples };
    let plan = Plan { rounds: effort.rounds, full: true, each };
    Ok(ablate(scene, &job, device, plan, &Control::default(), &mut |_| {})?)
}

fn row(name: &str, scene: &Scene, found: &Ablation) -> String {
    let features = pack::features::names(scene.pack().features()).len();
    let of = |kernel: &str| found.rows.iter().find(|row| row.kernel == kernel);
    let share = |own: Option<u32>, full: Option<u32>| match (own, full) {
        (Some(own), Some(full)) => {
            format!("{own} of {full} ({:.0} %)", 100.0 * f64::from(own) / f64::from(full.max(1)))
        }
        (Some(own), None) => own.to_string(),
        _ => "-".to_owned(),
    };
    let (own, full) = (of("specialised"), of("full"));
    let lines = share(own.map(|row| row.wgsl_lines), full.map(|row| row.wgsl_lines));
    let words = share(own.and_then(|row| row.spirv_words), full.and_then(|row| row.spirv_words));
    let all = pack::features::NAMES.len();
    let head = format!("| `{name}` | {} | {features} of {all} | {lines} | {words}", device(found));
    match (own.and_then(|row| row.measured), full.and_then(|row| row.measured)) {
        (Some(own), Some(full)) => format!(
            "{head} | {:.2} | {:.2} | {:.2} | {:.2} | {:.2}x | {} |",
            own.build_s,
            full.build_s,
            full.specialised_ms,
            full.ms,
            full.ratio(),
            same(found, &full),
        ),
        (Some(own), None) => {
            format!(
                "{head} | {:.2} | - | {:.2} | - | - | {} |",
                own.build_s,
                own.ms,
                same(found, &own)
            )
        }
        _ => format!("{head} | - | - | - | {:.2} | - | - |", found.cpu_ms),
    }
}

fn device(found: &Ablation) -> &str {
    found.device.as_deref().map_or("CPU kernel", |name| name.split(" (").next().unwrap_or(name))
}

fn same(found: &Ablation, measured: &Measured) -> String {
    match (measured.differ, measured.differ_cpu, measured.z) {
        (0, 0, _) => "bit for bit, also the CPU's".to_owned(),
        (0, _, _) if !found.software => "bit for bit".to_owned(),
        (n, _, Some(z)) => format!("{n} pixels round differently, z = {z:.1}"),
        (n, cpu, None) => format!("**no**: {n} pixels, {cpu} against the CPU"),
    }
}

/// A sentence where specialising does not pay.
fn verdict(name: &str, found: &Ablation) -> Option<String> {
    let full = found.rows.iter().find(|row| row.kernel == "full")?.measured?;
    let ratio = full.ratio();
    (ratio < 1.0 + MARGIN).then(|| {
        format!(
            "Specialising the kernel of `{name}` does not pay on {}: the full one takes {ratio:.3} times as \
            long a sample.",
            device(found)
        )
    })
}

/// The cost of each feature alone.
fn each(text: &mut String, effort: Effort, devices: &[DeviceChoice]) -> Result<(), Box<dyn Error>> {
    let scene = scene_of(EACH)?;
    for choice in devices {
        let found = compared(&scene, choice, effort, true)?;
        let base = found.rows.first().ok_or("the pack's own kernel is always there")?;
        let _ = writeln!(
            text,
            "\n### Each feature alone: `{EACH}` on {}, `rtr --ablate`\n\n\
            The scene's own kernel with one feature more than it needs, and what that one cannot be without.\n\n\
            | feature | WGSL lines | SPIR-V words | ms a sample | against the own kernel |\n\
            |---|---|---|---|---|",
            device(&found)
        );
        let mut rows: Vec<_> = found.rows.iter().collect();
        let cost = |row: &runtime::ablation::Row| row.measured.map_or(1.0, |m| m.ratio());
        rows.sort_by(|a, b| cost(b).total_cmp(&cost(a)));
        for row in rows {
            let words = match (row.spirv_words, base.spirv_words) {
                (Some(n), Some(base)) => format!("{:+}", i64::from(n) - i64::from(base)),
                _ => "-".to_owned(),
            };
            let (ms, ratio) = row.measured.map_or(("-".to_owned(), "-".to_owned()), |m| {
                (format!("{:.2}", m.ms), format!("{:.3}x", m.ratio()))
            });
            let lines = i64::from(row.wgsl_lines) - i64::from(base.wgsl_lines);
            let _ = writeln!(text, "| {} | {lines:+} | {words} | {ms} | {ratio} |", row.kernel);
        }
        let wrong: Vec<&str> = found.wrong().iter().map(|row| row.kernel.as_str()).collect();
        if !wrong.is_empty() {
            let _ = writeln!(text, "\nAnother picture with: {}.", wrong.join(", "));
        }
    }
    Ok(())
}
