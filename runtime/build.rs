//! Links the full kernel, translates it to Rust in three forms, and lists every declaration that
//! the linker can emit, so that a kernel in a pack can be recognised as ours.

#[path = "build/families.rs"]
mod families;
#[path = "build/known.rs"]
mod known;
#[path = "src/trust/pieces.rs"]
mod pieces;

use native::ByHand;
use std::error::Error;
use std::path::{Path, PathBuf};
use std::{env, fs};

fn main() -> Result<(), Box<dyn Error>> {
    let out = PathBuf::from(env::var_os("OUT_DIR").ok_or("cargo sets OUT_DIR")?);
    let kernel = shaders::link(&shaders::FeatureSet::full())?;
    let walk = native::Seam { function: "trace", path: "crate::walk::trace" };
    let by_hand = ByHand { seams: &[walk], companion: Some("crate::walk::Companion<'a>") };
    write(&out, "kernel_f32.rs", &translate(&kernel, native::Precision::F32, by_hand)?)?;
    let trace = native::Seam { function: "trace", path: "crate::wide::trace" };
    let by_hand = ByHand { seams: &[trace], companion: Some("crate::wide::Companion<'a>") };
    let wide = native::generate_wide(&kernel.text, "crate::kernel::f32", by_hand)
        .map_err(|error| located(&kernel, &error))?;
    write(&out, "kernel_wide.rs", &wide)?;
    let nothing = ByHand::default();
    write(&out, "kernel_f64.rs", &translate(&kernel, native::Precision::F64, nothing)?)?;
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

/// An error names the place in our modules, not in the linked text.
fn translate(
    kernel: &shaders::Linked,
    precision: native::Precision,
    by_hand: ByHand<'_>,
) -> Result<String, Box<dyn Error>> {
    native::generate_with(&kernel.text, precision, by_hand).map_err(|error| located(kernel, &error))
}

fn located(kernel: &shaders::Linked, error: &native::NativeError) -> Box<dyn Error> {
    let before = kernel.text.split_inclusive('\n').take(error.line.saturating_sub(1) as usize);
    let byte = before.map(str::len).sum::<usize>() + error.column.saturating_sub(1) as usize;
    format!("{:?}: {}", kernel.locate(byte), error.message).into()
}

fn write(folder: &Path, name: &str, text: &str) -> Result<(), Box<dyn Error>> {
    Ok(fs::write(folder.join(name), text)?)
}
