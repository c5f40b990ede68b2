//! Opening packs: mapping, and checking every rule.

use std::fmt::Write as _;
use std::time::Instant;

use compiler::bvh::Layout;
use cpu_time::ProcessTime;

use super::packs::Packs;
use super::{Outcome, SCENES, median};
use crate::mapped;

/// More than elsewhere: it is over soon.
const ROUNDS: usize = 9;

/// Scenes by number of threads.
pub(super) fn table(packs: &mut Packs, text: &mut String) -> Outcome {
    let _ = writeln!(
        text,
        "\n## Opening a pack: map and check every rule\n\n\
        The file is in the system's cache, and re-mapped each time; medians of {ROUNDS}.\n\n\
        | scene | MB | threads | wall ms | CPU ms | GB/s |\n|---|---|---|---|---|---|"
    );
    let all = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
    for name in SCENES {
        let path = packs.of(name, Layout::Wide)?;
        let size = std::fs::metadata(&path)?.len() as f64;
        let mut counts = vec![1, all];
        counts.dedup();
        for threads in counts {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build()?;
            let (mut walls, mut cpus) = (Vec::new(), Vec::new());
            for _ in 0..ROUNDS {
                let (cpu, wall) = (ProcessTime::now(), Instant::now());
                let pack = pool.install(|| mapped::map(&path))?;
                walls.push(wall.elapsed().as_secs_f64());
                cpus.push(cpu.elapsed().as_secs_f64());
                drop(pack);
            }
            let (wall, cpu) = (median(walls), median(cpus));
            let _ = writeln!(
                text,
                "| `{name}` | {:.1} | {threads} | {:.1} | {:.1} | {:.2} |",
                size / 1e6,
                wall * 1e3,
                cpu * 1e3,
                size / 1e9 / wall,
            );
        }
    }
    Ok(())
}
