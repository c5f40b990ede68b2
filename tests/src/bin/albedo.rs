//! `cargo run --release -p tests --bin albedo`: says how far the tables of directional albedo that the compiler holds are
//! from those that this computes; with `--write` it replaces them. With names, such as `Gloss`, only those tables.

use std::path::Path;

use pack::abi::AlbedoTable;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let names: Vec<&String> = arguments.iter().filter(|text| !text.starts_with("--")).collect();
    let is_wanted = |of| names.is_empty() || names.iter().any(|name| **name == format!("{of:?}"));
    let mut all = Vec::new();
    for of in AlbedoTable::ALL {
        let held = compiler::lower::albedo::table(of);
        if !is_wanted(of) {
            all.extend(held);
            continue;
        }
        let made = tests::albedo::table(of);
        let values = made.as_flattened().iter().zip(held.as_flattened());
        let most = values.map(|(a, b)| (a - b).abs()).fold(0.0_f32, f32::max);
        let text = format!("{of:?}: {} words, largest difference {most:.1e}", made.len());
        tests::console::line(&text);
        all.extend(made);
    }
    if arguments.iter().any(|argument| argument == "--write") {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../compiler/src/lower/albedo.f32");
        let bytes: Vec<u8> = all.as_flattened().iter().flat_map(|x| x.to_le_bytes()).collect();
        std::fs::write(&path, bytes)?;
    }
    Ok(())
}
