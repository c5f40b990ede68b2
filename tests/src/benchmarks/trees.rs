//! Building a tree over one mesh; `docs/bvh.md` has more of it.

use std::fmt::Write as _;

use compiler::bvh::{Fragment, Input, Layout, Preset, build};
use cpu_time::ProcessTime;
use pack::abi::Triangle;

use super::packs::Packs;
use super::{Outcome, ROUNDS, median};
use crate::mapped;

/// A sentence.
pub(super) fn table(packs: &mut Packs, text: &mut String) -> Outcome {
    let pack = mapped::map(packs.of("mesh", Layout::Wide)?)?;
    let triangles = pack.records::<Triangle>();
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build()?;
    let mut seconds = Vec::new();
    for _ in 0..ROUNDS {
        let fragments: Vec<Fragment> = (0..)
            .zip(triangles)
            .map(|(i, t)| Fragment::of_triangle(&[t.v0, t.v1, t.v2], i))
            .collect();
        let start = ProcessTime::now();
        pool.install(|| build(Preset::Fast, Input::of_boxes(fragments)))?;
        seconds.push(start.elapsed().as_secs_f64());
    }
    let cpu = median(seconds);
    let _ = writeln!(
        text,
        "\n## BVH build: `mesh`, {} triangles, one thread\n\n\
        {cpu:.3} CPU s, {:.2} CPU s per million triangles.",
        triangles.len(),
        cpu * 1e6 / triangles.len() as f64,
    );
    Ok(())
}
