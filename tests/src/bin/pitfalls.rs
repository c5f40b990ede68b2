//! `cargo run --release -p tests --bin pitfalls`: measures and rewrites `docs/pitfalls.md`.

use std::path::Path;

fn main() -> std::io::Result<()> {
    let page = tests::pitfalls::page();
    let target = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/pitfalls.md");
    std::fs::write(target, &page)?;
    tests::console::line(&page);
    Ok(())
}
