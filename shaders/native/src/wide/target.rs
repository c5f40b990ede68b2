//! What the functions of a wide module are compiled for.

/// Instructions that every function may use.
pub(crate) const TARGET: &str = "#[target_feature(enable = \"avx2,bmi1,bmi2,lzcnt,popcnt\")]";
