//! `cargo run --release -p tests --bin corrections`: measures and rewrites `docs/corrections.md`.

use std::path::Path;

fn main() -> std::io::Result<()> {
    let page = tests::corrections::page();
    let target = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/corrections.md");
    std::fs::write(target, &page)?;
    tests::console::line(&page);
    Ok(())
}
