//! `cargo run --release -p tests --bin stability`: measures and rewrites `docs/stability.md`.
//! `--heavy [WORDS]` first measures what takes minutes and gigabytes, or those of them that have the words in
//! their case or name.

use std::path::Path;

fn main() -> std::io::Result<()> {
    let mut arguments = std::env::args().skip(1);
    if arguments.next().as_deref() == Some("--heavy") {
        tests::stability::heavy::measure(&arguments.next().unwrap_or_default())?;
    }
    let page = tests::stability::page();
    let target = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/stability.md");
    std::fs::write(target, &page)?;
    tests::console::line(&page);
    Ok(())
}
