//! Links the full kernel with what layers need and translates it to Rust in single precision.

use std::error::Error;
use std::path::Path;
use std::{env, fs};

fn main() -> Result<(), Box<dyn Error>> {
    // The modules themselves are compiled into `shaders`: cargo runs this again when they change.
    println!("cargo::rerun-if-changed=build.rs");
    let kernel =
        shaders::link_with(&shaders::FeatureSet::full(), &[shaders::AOV, shaders::LIGHTS])?;
    let walk = native::Seam { function: "trace", path: "crate::walk::trace" };
    let by_hand = native::ByHand {
        seams: &[walk],
        companion: Some("crate::walk::Companion<'a>"),
        entrances: &["path_begin", "path_advance", "trace", "aov_advance", "lights_advance"],
    };
    let text = native::generate_with(&kernel.text, native::Precision::F32, by_hand);
    // An error names the place in our modules, not in the linked text.
    let text = text.map_err(|error| {
        format!("{:?}: {}", kernel.locate_line(error.line, error.column), error.message)
    })?;
    let out = env::var_os("OUT_DIR").ok_or("cargo sets OUT_DIR")?;
    Ok(fs::write(Path::new(&out).join("kernel.rs"), text)?)
}
