//! Renders the ball beside each material in the reference: `docs/balls/NAME.png`.
//!
//! `cargo run --release -p tests --bin balls [-- NAME...]` makes all of them, or those named. To look at them large:
//! `balls -- --size 512 --samples 256 --out FOLDER`.

use std::path::PathBuf;

use clap::Parser;
use lang::schema::{Kind, TypeSchema};
use tests::{ball, console, picture, scene};

/// Renders a ball of each material.
#[derive(Parser)]
struct Args {
    /// Materials; all of them if none is named.
    names: Vec<String>,
    /// Width and height in pixels.
    #[arg(long, default_value_t = 128)]
    size: u32,
    /// Samples of a pixel.
    #[arg(long, default_value_t = 400)]
    samples: u32,
    /// Where pictures go.
    #[arg(long, default_value = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/balls"))]
    out: PathBuf,
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let args = Args::parse();
    std::fs::create_dir_all(&args.out)?;
    for schema in lang::schema::types_of(Kind::Material) {
        if args.names.is_empty() || args.names.iter().any(|name| name == schema.name) {
            render(schema, &args)?;
        }
    }
    Ok(())
}

/// Renders the example of one material.
fn render(schema: &TypeSchema, args: &Args) -> Result<(), Box<dyn std::error::Error>> {
    let text = ball::scene(schema.example, args.size, args.samples);
    let outcome = picture::cpu(scene::pack(&text), |_| {});
    let path = args.out.join(format!("{}.png", schema.name));
    runtime::output::write(&path, &outcome.picture, false)?;
    console::line(&path.display().to_string());
    Ok(())
}
