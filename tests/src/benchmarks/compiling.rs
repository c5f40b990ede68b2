//! From text to pack: with nothing in the cache, with everything, and after edits.

use std::fmt::Write as _;
use std::path::Path;

use super::packs::Packs;
use super::{Outcome, SCENES};
use crate::edits;

fn folder() -> std::path::PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes")
}

/// Scenes, cold and warm.
pub(super) fn table(_: &mut Packs, text: &mut String) -> Outcome {
    let _ = writeln!(
        text,
        "\n## From text to pack\n\n\
        A process of its own, the program that `rtc` is. Cold: no tree in the cache and no pack. Warm: the cache of the \
        cold run, and the pack deleted. Unchanged: the pack is there, too. Memory: the most that the cold run has, in sizes of \
        the pack.\n\n\
        | scene | MB | cold CPU s | cold wall s | memory, packs | warm CPU s | warm wall s | unchanged wall s |\n\
        |---|---|---|---|---|---|---|---|"
    );
    for name in SCENES {
        let example = scenes::catalog::find(name).ok_or("there is no such example")?;
        example.generate(&folder(), scenes::generate::Extent::Full)?;
        let source = example.source(&folder());
        let temporary = tempfile::tempdir()?;
        let pack = temporary.path().join("scene.pack");
        let run = || edits::compile(&source, &pack, temporary.path());
        let cold = run()?;
        let size = std::fs::metadata(&pack)?.len() as f64;
        std::fs::remove_file(&pack)?;
        let warm = run()?;
        let unchanged = run()?;
        let _ = writeln!(
            text,
            "| `{name}` | {:.1} | {:.2} | {:.2} | {:.2} | {:.2} | {:.2} | {:.3} |",
            size / 1e6,
            cold.cpu,
            cold.wall,
            cold.peak as f64 / size,
            warm.cpu,
            warm.wall,
            unchanged.wall,
        );
    }
    Ok(())
}

/// The shrine after edits.
pub(super) fn edits(_: &mut Packs, text: &mut String) -> Outcome {
    let temporary = tempfile::tempdir()?;
    edits::table(&folder(), temporary.path(), text)?;
    Ok(())
}
