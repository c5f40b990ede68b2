//! What is said of a render: a headline before it, samples and faults after it, and the exit code that follows.

use super::console::Console;
use super::exit::Exit;
use super::progress::{duration_text, mrays};
use crate::job::Job;
use crate::outcome::Outcome;
use crate::scene::Scene;
use crate::schedule::Stop;
use files::ShowPath as _;
use std::path::Path;

/// Rounding at edges lets one path in 100,000 slip past a surface; more than that is a hole.
const LEAKS: f64 = 1e-4;

/// What ends the program; `None` when all is well.
pub(super) fn exit(outcome: &Outcome) -> Option<Exit> {
    if !outcome.failures.is_empty() {
        Some(Exit::Bug)
    } else if outcome.device_error.is_some() {
        Some(Exit::World)
    } else if outcome.too_many_bad() || outcome.stop == Stop::Failed {
        Some(Exit::NotFinite)
    } else if outcome.stop == Stop::Cancelled {
        Some(Exit::Interrupted)
    } else {
        None
    }
}

/// What is rendered, in one line.
pub(super) fn headline(path: &Path, scene: &Scene, job: &Job) -> String {
    let [w, h] = job.image_size;
    let crop = if job.crop.pixels() == u64::from(w) * u64::from(h) {
        String::new()
    } else {
        format!(" (crop {})", job.crop)
    };
    let triangles = scene.pack().records::<pack::abi::Triangle>().len();
    let spheres = scene.pack().records::<pack::abi::Sphere>().len();
    format!(
        "{}: {w}x{h}{crop}, samples {}; triangles: {triangles}, spheres: {spheres}, lights: {}",
        path.shown(),
        job.samples,
        scene.settings().n_lights,
    )
}

/// Says how far the picture came, and what is wrong with it.
pub(super) fn summarize(console: &Console, outcome: &Outcome, job: &Job) {
    let film = outcome.film();
    let counters = &film.counters;
    let (_, most) = film.samples();
    let why = match outcome.stop {
        Stop::Complete => String::new(),
        stop => format!(", {}", stop.name()),
    };
    console.note(&format!(
        "{most} of {} spp in {}{why}: {:.2} Mrays/s, {} rays, longest path {}",
        job.spp(),
        duration_text(outcome.elapsed),
        mrays(counters.rays, outcome.elapsed),
        counters.rays,
        counters.depth,
    ));
    sample_counts(console, outcome);
    if let Some(most) = job.clamp_indirect {
        console.note(&format!(
            "--clamp-indirect {most} removed {:.2} % of the light: the picture is biased",
            100.0 * film.removed(),
        ));
    }
    if let Some(error) = &outcome.device_error {
        let kept =
            if most > 0 { "samples completed before are kept" } else { "nothing is written" };
        console.warn(&format!("error: {error}; {kept}"));
    }
    for failure in &outcome.failures {
        console.warn(&format!(
            "error: bug in rtr: block {} from sample {} failed: {}",
            failure.tile, failure.sample, failure.message
        ));
    }
    if counters.overflows > 0 {
        console.warn(&format!(
            "warning: {} times a path was inside of more than four things at once, and the least of \
             them was forgotten",
            counters.overflows,
        ));
    }
    if counters.leaks as f64 > LEAKS * film.total_samples() as f64 {
        console.warn(&format!(
            "warning: {} times a path left a thing that it had never entered: a mesh is open, or \
             surfaces touch",
            counters.leaks,
        ));
    }
    if let Some(bad) = counters.first_bad {
        let grade = if outcome.too_many_bad() { "error" } else { "warning" };
        let (x, y, sample) = (bad.x, bad.y, bad.sample);
        console.warn(&format!(
            "{grade}: {} of {} samples were not finite and count as black; the first again: \
             --crop {x},{y},1,1 --samples {sample}..{} --seed {}",
            counters.bad,
            film.total_samples(),
            sample.saturating_add(1),
            job.seed,
        ));
    }
}

/// Says where pixels have different numbers of samples.
fn sample_counts(console: &Console, outcome: &Outcome) {
    let film = outcome.film();
    let (least, most) = film.samples();
    if outcome.stop == Stop::TimeLimit && least == 0 && most > 0 {
        let done = film.counts.iter().filter(|n| **n > 0).count();
        let share = 100.0 * done as f64 / film.counts.len().max(1) as f64;
        console.warn(&format!(
            "warning: the time was enough for {share:.1} % of the pixels, the others are black; give it \
             more, or render less with --size or --crop"
        ));
    } else if least != most && outcome.picture.meta.adaptive {
        let mean = film.total_samples() as f64 / film.counts.len().max(1) as f64;
        console.note(&format!(
            "--adaptive gave pixels {least} to {most} samples, {mean:.0} on average: the picture is slightly biased"
        ));
    } else if least != most {
        console.warn(&format!("warning: pixels have between {least} and {most} samples"));
    }
}
