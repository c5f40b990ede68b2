//! `scene/survival.wgsl`: Russian roulette where paths may have any length.

use super::wgsl::imports;
use crate::FeatureSet;

/// The module for this scene. The full kernel asks the frame whether there is a limit.
pub(crate) fn text(features: &FeatureSet) -> String {
    let mut text = String::from("// Generated: whether paths may have any length.\n\n");
    let mut body = "";
    if features.unlimited {
        text += &imports(["kernel/unlimited.wgsl", "scene/constants.wgsl", "scene/records.wgsl"]);
        body = "    if (load_frame_max_depth() == NONE) {\n        \
                return unlimited_survival(bounce, q);\n    }\n";
    }
    text += "\n// The chance of a path to survive `bounce` whose throughput asks for `q`.\n\
             fn dispatch_survival(bounce: u32, q: f32) -> f32 {\n";
    text + body + "    return q;\n}\n"
}
