//! `cargo run --release -p tests --bin furnace`: what white surfaces give back, and rewrites `docs/furnace.md`.

use std::fmt::Write as _;
use std::path::Path;

use rayon::prelude::*;
use tests::furnace::{COSINES, Surface, surfaces};

/// Samples of a direction.
const SAMPLES: u32 = 1 << 16;

const HEADER: &str = "# White furnaces\n\n\
    Made by `cargo run --release -p tests --bin furnace`; edit the program, not this page.\n\n\
    A surface without absorption in light of radiance 1 from everywhere gives back 1. Each row is a family of surfaces \
    over a grid of its parameters (roughness 0.03 to 1, anisotropy 0 to 1, index 1.05 to 3, both sides of glass, coats of \
    all roughnesses); it shows the lowest and the highest share at each cosine, and where the worst is. Shares are means \
    of the weights of 65,536 samples.\n\n";

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let all = surfaces();
    let turns = [0.0, 0.5, 1.0];
    let shares: Vec<[[f64; 3]; 4]> = all
        .par_iter()
        .map(|surface| COSINES.map(|mu| turns.map(|turn| surface.share(mu, turn, SAMPLES))))
        .collect();
    let mut text = String::from(HEADER);
    let columns: Vec<String> = COSINES.iter().map(|mu| format!("cosine {mu}")).collect();
    writeln!(text, "| surface | {} | worst at |", columns.join(" | "))?;
    writeln!(text, "|---|{}---|", "---|".repeat(COSINES.len()))?;
    let mut families: Vec<&str> = all.iter().map(|surface| surface.family).collect();
    families.dedup();
    families.sort_unstable();
    families.dedup();
    for family in families {
        let rows: Vec<(&Surface, &[[f64; 3]; 4])> =
            all.iter().zip(&shares).filter(|(surface, _)| surface.family == family).collect();
        let ends = |column: usize| {
            let values = rows.iter().flat_map(|(_, shares)| shares[column]);
            values.fold([f64::MAX, f64::MIN], |[low, high], v| [low.min(v), high.max(v)])
        };
        let cells = (0..COSINES.len()).map(|column| {
            let [low, high] = ends(column);
            format!("{low:.4} to {high:.4}")
        });
        let cells: Vec<String> = cells.collect();
        let worst = rows.iter().max_by(|a, b| off(a.1).total_cmp(&off(b.1)));
        let at = worst.map_or_else(String::new, |(surface, shares)| {
            format!("{:.4}: {}", off(shares), surface.name)
        });
        writeln!(text, "| {family} | {} | {at} |", cells.join(" | "))?;
    }
    let target = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/furnace.md");
    std::fs::write(&target, &text)?;
    tests::console::line(&text);
    Ok(())
}

/// The largest distance from 1.
fn off(shares: &[[f64; 3]; 4]) -> f64 {
    shares.iter().flatten().map(|share| (share - 1.0).abs()).fold(0.0, f64::max)
}
