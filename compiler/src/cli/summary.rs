//! What `rtc` says of a finished compilation.

use files::ShowPath as _;
use std::fmt::Write as _;
use std::path::Path;
use std::time::Duration;

use shaders::{FeatureSet, PORTABLE_STORAGE};

use crate::lower::{self, Counters};
use crate::pipeline::{Compiled, Phase, Reused};
use crate::stage::Share;

/// The pack and what is in it.
pub(super) fn done(output: &Path, compiled: &Compiled, time: Duration) -> String {
    let counters = &compiled.lowered.counters;
    let size = std::fs::metadata(output).map_or(0, |meta| meta.len());
    let mut things = Vec::new();
    for (count, one, several) in [
        (counters.triangles, "triangle", "triangles"),
        (counters.spheres, "sphere", "spheres"),
        (counters.lights, "light", "lights"),
        (compiled.lowered.textures.len() as u64, "texture", "textures"),
    ] {
        if count > 0 {
            things.push(format!("{} {}", grouped(count), if count == 1 { one } else { several }));
        }
    }
    if counters.instances > 0 {
        things.push(instances_text(counters));
    }
    let trees = &compiled.lowered.trees;
    things.extend((trees.groups > 0).then(|| trees_text(compiled)));
    format!(
        "{}: {:.1} MB, {} in {:.2} s",
        output.shown(),
        size as f64 / 1e6,
        if things.is_empty() { "nothing but sky".to_owned() } else { things.join(", ") },
        time.as_secs_f64(),
    )
}

/// What to say of a kernel with more storage buffers than every device has. It is no warning: it comes from the
/// size of the scene, and nothing in the text is to be changed.
pub(super) fn portability(features: &FeatureSet) -> Option<String> {
    let needed = features.storage_buffers().ok().filter(|needed| *needed > PORTABLE_STORAGE)?;
    Some(format!(
        "note: the kernel needs {needed} storage buffers of 128 MiB at most, and not every GPU has more than \
         {PORTABLE_STORAGE} for it; `rtr` renders on the CPU where there are too few"
    ))
}

/// What is stored once, and how often it is shown.
fn instances_text(counters: &Counters) -> String {
    let (meshes, instances) = (grouped(counters.meshes), grouped(counters.instances));
    format!(
        "{} triangles shown ({instances} instances of {meshes} meshes)",
        grouped(counters.shown)
    )
}

/// Which builder made the trees, what it made of the triangles, and what it had not to do again.
fn trees_text(compiled: &Compiled) -> String {
    let trees = &compiled.lowered.trees;
    let mut text = format!("bvh {}", trees.preset);
    if trees.loaded > 0 {
        let _ = write!(text, " {}/{} cached", trees.loaded, trees.groups);
    }
    let triangles = compiled.lowered.counters.triangles;
    if trees.references as u64 > triangles {
        let _ =
            write!(text, " ({:.2} leaves a triangle)", trees.references as f64 / triangles as f64);
    }
    text
}

/// A table of phases, and what the cache did.
pub(super) fn timings(phases: &[Phase], compiled: &Compiled) -> String {
    let mut text = String::from("phase                               ms  reused\n");
    for Phase { name, time } in phases {
        let line = format!(
            "{name:<30} {:>7.1}  {}",
            time.as_secs_f64() * 1e3,
            phase_reuse(name, &compiled.reused)
        );
        let _ = writeln!(text, "{}", line.trim_end());
    }
    let trees = &compiled.lowered.trees;
    let ms = |time: Duration| time.as_secs_f64() * 1e3;
    let counters = &compiled.lowered.counters;
    if counters.instances > 0 {
        let _ = writeln!(
            text,
            "{}, {} triangles stored",
            instances_text(counters),
            grouped(counters.triangles)
        );
    }
    text + &format!(
        "bvh {}: {} of {} trees cached, {:.1} ms of building saved; {} stored, {:.1} ms spent building",
        trees.preset,
        trees.loaded,
        trees.groups,
        ms(trees.saved),
        trees.stored,
        ms(trees.build_time),
    )
}

/// What a phase took over, for the table.
fn phase_reuse(name: &str, reused: &Reused) -> String {
    let Reused { texts, meshes, images, lowered: _, trees, kernel } = reused;
    let share = |share: &Share, what: &str| format!("{} of {} {what}", share.reused, share.all);
    match name {
        "read and check the text" => format!("0 of {texts} texts"),
        "read files" => format!("{}, {}", share(meshes, "meshes"), share(images, "images")),
        "build or fetch trees" => share(trees, "trees"),
        "link and prove the kernel" => share(kernel, "proofs"),
        _ => String::new(),
    }
}

/// One line about everything that was known from earlier compilations, if anything was.
pub(super) fn reused_text(reused: &Reused) -> Option<String> {
    let Reused { texts: _, meshes, images, lowered, trees, kernel } = reused;
    let share = |share: &Share, what: &str| {
        (share.reused > 0).then(|| format!("{} of {} {what}", share.reused, share.all))
    };
    let said = |said: bool, what: &str| said.then(|| what.to_owned());
    let lower::Reused { geometry, parts, textures } = *lowered;
    let all = match (geometry, textures) {
        (true, true) => Some("the geometry and the textures of the last pack"),
        (true, false) => Some("the geometry of the last pack"),
        (false, true) if parts => {
            Some("the textures of the last pack and the geometry of what has not moved")
        }
        (false, true) => Some("the textures of the last pack"),
        (false, false) => parts.then_some("the geometry of what has not moved"),
    };
    let files = !geometry && !parts && !textures;
    let parts = [
        all.map(str::to_owned),
        share(meshes, "meshes").filter(|_| files),
        share(images, "images").filter(|_| files),
        share(trees, "trees").filter(|_| !geometry),
        said(kernel.reused > 0, "the proof of the kernel"),
    ];
    let parts: Vec<String> = parts.into_iter().flatten().collect();
    (!parts.is_empty()).then(|| format!("reused {}", parts.join(", ")))
}

/// 1234567 as 1,234,567.
fn grouped(n: u64) -> String {
    let digits = n.to_string();
    let mut out = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            out.push(',');
        }
        out.push(digit);
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thousands_are_grouped() {
        assert_eq!(grouped(0), "0");
        assert_eq!(grouped(999), "999");
        assert_eq!(grouped(1_234_567), "1,234,567");
    }

    #[test]
    fn only_what_was_reused_is_told() {
        assert_eq!(reused_text(&Reused::default()), None);
        let share = |reused, all| Share { reused, all };
        let reused = Reused { trees: share(14, 16), images: share(0, 3), ..Reused::default() };
        assert_eq!(reused_text(&reused).as_deref(), Some("reused 14 of 16 trees"));
        let reused = Reused { meshes: share(1, 2), kernel: share(1, 1), ..reused };
        let expected = "reused 1 of 2 meshes, 14 of 16 trees, the proof of the kernel";
        assert_eq!(reused_text(&reused).as_deref(), Some(expected));
    }

    #[test]
    fn only_a_kernel_for_few_gpus_is_told_of() {
        let mut features = FeatureSet::full();
        assert_eq!(features.storage_buffers().ok(), Some(PORTABLE_STORAGE));
        assert_eq!(portability(&features), None);
        features.windows.tri = 3;
        let line = portability(&features).expect("nine are more than seven");
        assert!(line.contains("needs 9 storage buffers"), "{line}");
    }
}
