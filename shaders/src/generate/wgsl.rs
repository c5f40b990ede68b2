//! Names, tags and values → the pieces of WGSL that several generated modules have.

use std::fmt::{Display, Write as _};

/// `#import` lines for `modules`.
pub(super) fn imports<'m>(modules: impl IntoIterator<Item = &'m str>) -> String {
    modules.into_iter().flat_map(|module| ["#import \"", module, "\"\n"]).collect()
}

/// The name of a tag in the kernel: `MATERIAL_DIFFUSE`.
pub(super) fn tag(of: &str, stem: &str) -> String {
    format!("{of}_{}", stem.to_ascii_uppercase())
}

/// A `switch` over tags whose cases return; one case needs no switch, none only `otherwise`.
pub(super) fn switch(selector: &str, cases: &[(impl Display, String)], otherwise: &str) -> String {
    match cases {
        [] => format!("    return {otherwise};\n"),
        [(_, only)] => format!("    return {only};\n"),
        _ => {
            let mut text = format!("    switch ({selector}) {{\n");
            for (tag, value) in cases {
                let _ = writeln!(text, "        case {tag}: {{ return {value}; }}");
            }
            let _ = writeln!(text, "        default: {{ return {otherwise}; }}\n    }}");
            text
        }
    }
}
