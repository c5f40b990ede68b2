//! `cargo run --release -p tests --bin albedo`: says how far the tables of directional albedo that the compiler holds are
//! from those that this computes; with `--write` it replaces them.

use std::path::Path;

use pack::abi::AlbedoTable;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let made: Vec<(AlbedoTable, Vec<[f32; 4]>)> =
        AlbedoTable::ALL.map(|of| (of, tests::albedo::table(of))).into();
    for (of, words) in &made {
        let held = compiler::lower::albedo::table(*of);
        let values = words.as_flattened().iter().zip(held.as_flattened());
        let most = values.map(|(a, b)| (a - b).abs()).fold(0.0_f32, f32::max);
        tests::console::line(&format!(
            "{of:?}: {} words, largest difference {most:.1e}",
            words.len()
        ));
    }
    if std::env::args().any(|argument| argument == "--write") {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../compiler/src/lower/albedo.f32");
        let values = made.iter().flat_map(|(_, words)| words.as_flattened());
        let bytes: Vec<u8> = values.flat_map(|value| value.to_le_bytes()).collect();
        std::fs::write(&path, bytes)?;
    }
    Ok(())
}
