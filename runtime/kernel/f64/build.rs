//! Links the full kernel and translates it to Rust in double precision.

use std::error::Error;
use std::path::Path;
use std::{env, fs};

fn main() -> Result<(), Box<dyn Error>> {
    // The modules themselves are compiled into `shaders`: cargo runs this again when they change.
    println!("cargo::rerun-if-changed=build.rs");
    let kernel = shaders::link_with(&shaders::FeatureSet::full(), &[shaders::LIGHTS])?;
    let entrances = &["path_begin", "path_advance", "trace", "lights_advance"];
    let by_hand = native::ByHand { entrances, ..native::ByHand::default() };
    let text = native::generate_with(&kernel.text, native::Precision::F64, by_hand);
    // An error names the place in our modules, not in the linked text.
    let text = text.map_err(|error| {
        format!("{:?}: {}", kernel.locate_line(error.line, error.column), error.message)
    })?;
    let out = env::var_os("OUT_DIR").ok_or("cargo sets OUT_DIR")?;
    Ok(fs::write(Path::new(&out).join("kernel.rs"), text)?)
}
