//! Links the full kernel, measures it, and lists every declaration that the linker can emit, so that a kernel in a pack
//! can be recognised as ours.

#[path = "build/emitted.rs"]
mod emitted;
#[path = "build/families.rs"]
mod families;
#[path = "build/known.rs"]
mod known;
#[path = "src/trust/pieces.rs"]
mod pieces;

use std::error::Error;
use std::path::{Path, PathBuf};
use std::{env, fs};

fn main() -> Result<(), Box<dyn Error>> {
    let out = PathBuf::from(env::var_os("OUT_DIR").ok_or("cargo sets OUT_DIR")?);
    let kernel = shaders::link(&shaders::FeatureSet::full())?;
    if env::var_os("CARGO_FEATURE_GPU").is_some() {
        write(&out, "known.rs", &known::table()?)?;
        write(&out, "full.wgsl", &kernel.text)?;
    }
    let lines = pack::manifest::KernelSize::lines_of(&kernel.text);
    println!("cargo::rustc-env=FULL_KERNEL_LINES={lines}");
    let (module, info) = shaders::validate(&kernel)?;
    let words = shaders::spirv_words(&module, &info)?;
    println!("cargo::rustc-env=FULL_KERNEL_WORDS={words}");
    // The modules themselves are compiled into `shaders`: cargo runs this again when they change.
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-changed=build");
    println!("cargo::rerun-if-changed=src/trust");
    Ok(())
}

fn write(folder: &Path, name: &str, text: &str) -> Result<(), Box<dyn Error>> {
    Ok(fs::write(folder.join(name), text)?)
}
