//! For the tests: the goldens of the f32 kernels become those of their f64 twins, to be compiled.

#[path = "tests/twin/mod.rs"]
mod twin;

use std::path::Path;
use std::{env, fs, io};

fn main() -> io::Result<()> {
    println!("cargo::rerun-if-changed=tests/generated");
    let out = env::var_os("OUT_DIR").ok_or(io::ErrorKind::NotFound)?;
    let exceptions = fs::read_to_string("tests/generated/f64.txt")?;
    for entry in fs::read_dir("tests/generated")? {
        let path = entry?.path();
        let stem = path.file_stem().unwrap_or_default().to_string_lossy();
        if path.extension().is_some_and(|extension| extension == "rs") {
            let text = twin::twin(&stem, &fs::read_to_string(&path)?, &exceptions);
            fs::write(Path::new(&out).join(format!("{stem}_f64.rs")), text)?;
        }
    }
    Ok(())
}
