//! The hand-written WGSL modules, embedded so that the crate works from any directory. The build script lists
//! what is under `wgsl/`.

/// Name and text, sorted by name.
const MODULES: &[(&str, &str)] = include!(concat!(env!("OUT_DIR"), "/modules.rs"));

/// Every hand-written module: its name, as in `#import`, and its text; sorted by name.
#[must_use]
pub fn module_texts() -> &'static [(&'static str, &'static str)] {
    MODULES
}
