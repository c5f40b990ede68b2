//! Input that breaks builders: the kinds of `compiler/tests/bvh/shapes.rs`, which also has the tests that nothing is lost.

use std::error::Error;
use std::fmt::Write as _;

use compiler::bvh::{self, Input, Preset};

use crate::measure::cpu_seconds;
use crate::shapes;

/// Triangles of each kind.
const COUNT: u32 = 100_000;

/// One row a kind.
pub(crate) fn section() -> Result<String, Box<dyn Error>> {
    let presets = Preset::ALL;
    let names = presets.map(|preset| format!("`{preset}`")).join(" | ");
    let mut text = format!(
        "\n## Degenerate input\n\n{COUNT} triangles each: `same`, one triangle again and again; `point`, one point; `nested`, \
         one around the other; `geom`, sizes and distances over 2^120; `flat`, in a plane; `line`, without area on a line; \
         `far`, small and far from the origin; `nan`, some without finite corners; `fan`, around a point; `slivers`, long and \
         thin across everything; `soup` and `long` are not degenerate. CPU seconds, one thread, one run; the \
         deepest tree of all builders. That every triangle is in a leaf and every box holds what is in it is tested in \
         `compiler/tests/bvh/trees.rs`.\n\n| input | {names} | depth |\n|---|{}---|\n",
        "---|".repeat(presets.len()),
    );
    for kind in shapes::KINDS {
        let triangles = shapes::degenerate(kind, COUNT);
        let mut depth = 0;
        let _ = write!(text, "| `{kind}` ");
        for preset in presets {
            let before = cpu_seconds();
            let tree = bvh::build(preset, Input::of_triangles(&triangles))?;
            let _ = write!(text, "| {:.3} ", cpu_seconds() - before);
            depth = depth.max(tree.depth);
        }
        let _ = writeln!(text, "| {depth} |");
    }
    Ok(text)
}
