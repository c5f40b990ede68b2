//! What the functions of a wide module are compiled for.

use crate::options::Lanes;

impl Lanes {
    /// Invocations side by side.
    #[must_use]
    pub const fn count(self) -> usize {
        match self {
            Self::Avx2 => 8,
            Self::Avx512 => 16,
        }
    }

    /// The attribute with the instructions that every function may use.
    pub(crate) fn attribute(self) -> &'static str {
        match self {
            Self::Avx2 => "#[target_feature(enable = \"avx2,fma,bmi1,bmi2,lzcnt,popcnt\")]",
            Self::Avx512 => {
                "#[target_feature(enable = \"avx512f,avx512bw,avx512cd,avx512dq,avx512vl,avx2,bmi1,bmi2,lzcnt,popcnt\")]"
            }
        }
    }

    /// The operations on lanes, without the headers that speak of this crate.
    pub(crate) fn operations(self) -> String {
        let set = match self {
            Self::Avx2 => include_str!("../prelude/avx2.rs"),
            Self::Avx512 => include_str!("../prelude/avx512.rs"),
        };
        let common = include_str!("../prelude/lanes.rs");
        let code = |text: &'static str| text.split_once("\n\n").map_or(text, |(_, code)| code);
        format!("{}\n{}", code(set), code(common))
    }
}
