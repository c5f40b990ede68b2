//! WGSL names → Rust names. A name stays as it is, unless Rust or the generated module keeps it for
//! itself; then it gets underscores at its end until it is free.

use std::collections::BTreeSet;

/// Words that Rust does not accept as names of its own items (2024 edition, reserved ones included).
const KEYWORDS: &[&str] = &[
    "Self", "abstract", "as", "async", "await", "become", "box", "break", "const", "continue",
    "crate", "do", "dyn", "else", "enum", "extern", "false", "final", "fn", "for", "gen", "if",
    "impl", "in", "let", "loop", "macro", "match", "mod", "move", "mut", "override", "priv", "pub",
    "ref", "return", "self", "static", "struct", "super", "trait", "true", "try", "type", "typeof",
    "unsafe", "unsized", "use", "virtual", "where", "while", "yield",
];

/// The type names that a generated module declares itself, or takes from Rust.
pub(crate) const TYPE_NAMES: &[&str] = &[
    "Real",
    "Kernel",
    "Bindings",
    "Default",
    "wgsl",
    "core",
    "std",
    "glam",
    "f32",
    "f64",
    "u32",
    "i32",
    "bool",
    "usize",
    "Vec2",
    "Vec3",
    "Vec4",
    "UVec2",
    "UVec3",
    "UVec4",
    "IVec2",
    "IVec3",
    "IVec4",
    "BVec2",
    "BVec3",
    "BVec4",
    "Mat2",
    "Mat3",
    "Mat4",
    "Option",
    "Some",
    "None",
    "Copy",
    "Clone",
    "Debug",
    "PartialEq",
];

/// Names that Rust would take for a pattern in `let`.
pub(crate) const PATTERNS: &[&str] = &["None", "Some", "Ok", "Err"];

/// The names already given in one Rust namespace.
#[derive(Clone, Debug, Default)]
pub(crate) struct Names {
    taken: BTreeSet<String>,
}

impl Names {
    /// A namespace in which `names` are taken.
    pub(crate) fn with<'n>(names: impl IntoIterator<Item = &'n str>) -> Self {
        Self { taken: names.into_iter().map(str::to_owned).collect() }
    }

    /// A free name as close to `wanted` as Rust allows.
    pub(crate) fn add(&mut self, wanted: &str) -> String {
        let mut name = if wanted.is_empty() || wanted == "_" {
            "unnamed".to_owned()
        } else {
            wanted.to_owned()
        };
        while KEYWORDS.contains(&name.as_str()) || !self.taken.insert(name.clone()) {
            name.push('_');
        }
        name
    }

    /// A free name made of `stem` and a number.
    pub(crate) fn add_numbered(&mut self, stem: &str, number: usize) -> String {
        self.add(&format!("{stem}{number}"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keywords_and_repeats_get_underscores() {
        let mut names = Names::with(["taken"]);
        let got: Vec<String> = ["match", "match", "x", "x", "x", "taken", "_", "self"]
            .map(|wanted| names.add(wanted))
            .into();
        assert_eq!(got, ["match_", "match__", "x", "x_", "x__", "taken_", "unnamed", "self_"]);
    }
}
