//! Layouts of nodes, and who walks them on the CPU.

use std::fmt::Write as _;

use compiler::bvh::Layout;
use runtime::{DeviceChoice, Job};

use super::devices::{Cost, SAMPLES, SIZE, cost};
use super::packs::Packs;
use super::{Outcome, ROUNDS, median};

const WALKS: [(Layout, bool, &str); 3] = [
    (Layout::Binary, false, "binary nodes, generated walk"),
    (Layout::Wide, false, "wide nodes, generated walk"),
    (Layout::Wide, true, "wide nodes, walk by hand"),
];

/// Scenes by walks.
pub(super) fn table(packs: &mut Packs, text: &mut String) -> Outcome {
    let [width, height] = SIZE;
    let _ = writeln!(
        text,
        "\n## The walk through the tree: {width} x {height}, {SAMPLES} samples a pixel, the CPU kernel\n\n\
        `generated`: `trace` as it was translated from the WGSL; `by hand`: a tree of eights of its own \
        (`runtime/src/walk.rs`). The same picture, bit for bit; all of path tracing is in the times.\n\n\
        | scene | nodes and walk | CPU s | Mrays | Mrays per CPU s | against the first |\n\
        |---|---|---|---|---|---|"
    );
    for name in ["mesh", "shrine"] {
        let (wide, binary) = (packs.scene(name, Layout::Wide)?, packs.scene(name, Layout::Binary)?);
        let mut runs: [Vec<Cost>; 3] = Default::default();
        for _ in 0..ROUNDS {
            for ((layout, native, _), runs) in WALKS.iter().zip(&mut runs) {
                let scene = if *layout == Layout::Wide { &wide } else { &binary };
                let change = |job: &mut Job| job.native_walk = *native;
                runs.push(cost(scene, &DeviceChoice::Cpu, SAMPLES, change)?);
            }
        }
        let base = median(runs[0].iter().map(|run| run.cpu));
        for ((_, _, what), runs) in WALKS.iter().zip(&runs) {
            let cpu = median(runs.iter().map(|run| run.cpu));
            let mrays = runs[0].rays as f64 / 1e6;
            let _ = writeln!(
                text,
                "| `{name}` | {what} | {cpu:.2} | {mrays:.2} | {:.2} | {:.2}x |",
                mrays / cpu,
                cpu / base,
            );
        }
    }
    Ok(())
}
