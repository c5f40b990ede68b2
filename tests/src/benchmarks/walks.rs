//! Layouts of nodes, who walks them on the CPU, and how many pixels are rendered at a time.

use std::fmt::Write as _;

use compiler::bvh::Layout;
use runtime::{CpuWay, DeviceChoice, Job};

use super::devices::{Cost, SAMPLES, SIZE, cost};
use super::packs::Packs;
use super::{Outcome, ROUNDS, median};

const GENERATED: CpuWay = CpuWay { by_hand: false, lanes: 1 };
const BY_HAND: CpuWay = CpuWay { by_hand: true, lanes: 1 };
const EIGHT: CpuWay = CpuWay { by_hand: true, lanes: 8 };
const SIXTEEN: CpuWay = CpuWay { by_hand: true, lanes: 16 };

const WALKS: [(Layout, CpuWay, &str); 5] = [
    (Layout::Binary, GENERATED, "binary nodes, generated walk"),
    (Layout::Wide, GENERATED, "wide nodes, generated walk"),
    (Layout::Wide, BY_HAND, "wide nodes, walk by hand"),
    (Layout::Wide, EIGHT, "the same, eight pixels at a time"),
    (Layout::Wide, SIXTEEN, "the same, sixteen pixels at a time"),
];

/// Scenes by walks.
pub(super) fn table(packs: &mut Packs, text: &mut String) -> Outcome {
    let [width, height] = SIZE;
    let _ = writeln!(
        text,
        "\n## The walk through the tree: {width} x {height}, {SAMPLES} samples a pixel, the CPU kernel\n\n\
        `generated`: `trace` as it was translated from the WGSL; `by hand`: a tree of its own \
        (`runtime/kernel/f32/src/walk.rs`), with eight children a node, or sixteen in the last row; several pixels at a time: the wide forms of the kernel \
        (`runtime/kernel/wide/render.rs`), eight with AVX2 and sixteen with AVX-512, where the processor has them. \
        The same picture, bit for bit; all of path tracing is in the times.\n\n\
        | scene | nodes and walk | CPU s | Mrays | Mrays per CPU s | against the first |\n\
        |---|---|---|---|---|---|"
    );
    for name in ["cornell", "cornell_sphere", "weekend", "materials", "gltf", "mesh", "shrine"] {
        let (wide, binary) = (packs.scene(name, Layout::Wide)?, packs.scene(name, Layout::Binary)?);
        let walks: Vec<_> =
            WALKS.iter().filter(|(_, way, _)| way.lanes <= CpuWay::most_lanes()).collect();
        let mut runs: Vec<Vec<Cost>> = walks.iter().map(|_| Vec::new()).collect();
        for _ in 0..ROUNDS {
            for ((layout, way, _), runs) in walks.iter().zip(&mut runs) {
                let scene = if *layout == Layout::Wide { &wide } else { &binary };
                let change = |job: &mut Job| job.way = *way;
                runs.push(cost(scene, &DeviceChoice::Cpu, SAMPLES, change)?);
            }
        }
        let base = median(runs[0].iter().map(|run| run.cpu));
        for ((_, _, what), runs) in walks.iter().zip(&runs) {
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
