//! Renders the ball beside each material in the reference: `docs/balls/NAME.png`.
//!
//! `cargo run --release -p tests --bin balls [-- NAME...]` makes all of them, or those named.

use std::path::Path;

use lang::schema::{Kind, TypeSchema};
use tests::{ball, console, picture, scene};

/// Width and height in pixels.
const SIZE: u32 = 128;
/// Samples of a pixel.
const SAMPLES: u32 = 400;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let wanted: Vec<String> = std::env::args().skip(1).collect();
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/balls");
    for schema in Kind::Material.types() {
        if wanted.is_empty() || wanted.iter().any(|name| name == schema.name) {
            render(schema, &folder)?;
            console::line(&format!("docs/balls/{}.png", schema.name));
        }
    }
    Ok(())
}

/// Renders the example of one material.
fn render(schema: &TypeSchema, folder: &Path) -> Result<(), Box<dyn std::error::Error>> {
    let outcome = picture::cpu(scene::pack(&ball::scene(schema.example, SIZE, SAMPLES)), |_| {});
    std::fs::create_dir_all(folder)?;
    let path = folder.join(format!("{}.png", schema.name));
    runtime::output::write(&path, &outcome.picture, false)?;
    Ok(())
}
