//! The build script of a wide kernel: links the full kernel and translates it to Rust for as many invocations at once
//! as there are lanes.

use std::error::Error;
use std::path::Path;
use std::{env, fs};

/// Writes `kernel.rs`.
pub(crate) fn translate(lanes: native::Lanes) -> Result<(), Box<dyn Error>> {
    // The modules themselves are compiled into `shaders`: cargo runs this again when they change.
    println!("cargo::rerun-if-changed=build.rs");
    let kernel = shaders::link(&shaders::FeatureSet::full())?;
    let trace = native::Seam { function: "trace", path: "crate::render::trace" };
    let by_hand = native::ByHand {
        seams: &[trace],
        companion: Some("crate::render::Companion<'a>"),
        entrances: &[
            "ray_miss",
            "box_inverse",
            "triangle_shear",
            "spheres_trace",
            "order_triangle",
            "order_skipped",
            "candidate_triangle",
            "dispatch_triangle_after",
            "dispatch_ends",
        ],
    };
    let text = native::generate_wide(&kernel.text, "kernel_f32::kernel", lanes, by_hand);
    // An error names the place in our modules, not in the linked text.
    let text = text.map_err(|error| {
        format!("{:?}: {}", kernel.locate_line(error.line, error.column), error.message)
    })?;
    let out = env::var_os("OUT_DIR").ok_or("cargo sets OUT_DIR")?;
    Ok(fs::write(Path::new(&out).join("kernel.rs"), text)?)
}
