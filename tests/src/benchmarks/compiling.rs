//! From text to pack: with nothing in the cache, with everything, and after edits.

use std::error::Error;
use std::fmt::Write as _;
use std::path::Path;

use super::packs::Packs;
use super::{Outcome, ROUNDS, SCENES, median};
use crate::edits::{self, Cost};

fn folder() -> std::path::PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes")
}

/// Three compilations of a scene with a cache of their own.
struct Round {
    /// Of the pack, bytes.
    size: f64,
    cold: Cost,
    warm: Cost,
    unchanged: Cost,
}

impl Round {
    fn new(source: &Path) -> Result<Self, Box<dyn Error>> {
        let temporary = tempfile::tempdir()?;
        let pack = temporary.path().join("scene.pack");
        let run = || edits::compile(source, &pack, temporary.path());
        let cold = run()?;
        let size = std::fs::metadata(&pack)?.len() as f64;
        std::fs::remove_file(&pack)?;
        Ok(Self { size, cold, warm: run()?, unchanged: run()? })
    }
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
        let mut rounds = Vec::new();
        for _ in 0..ROUNDS {
            rounds.push(Round::new(&source)?);
        }
        let middle = |of: fn(&Round) -> f64| median(rounds.iter().map(of));
        let _ = writeln!(
            text,
            "| `{name}` | {:.1} | {:.2} | {:.2} | {:.2} | {:.2} | {:.2} | {:.3} |",
            middle(|round| round.size) / 1e6,
            middle(|round| round.cold.cpu),
            middle(|round| round.cold.wall),
            middle(|round| round.cold.peak as f64 / round.size),
            middle(|round| round.warm.cpu),
            middle(|round| round.warm.wall),
            middle(|round| round.unchanged.wall),
        );
    }
    Ok(())
}

/// The shrine after edits.
pub(super) fn edits(_: &mut Packs, text: &mut String) -> Outcome {
    let temporary = tempfile::tempdir()?;
    edits::table(&folder(), temporary.path(), ROUNDS, text)
}
