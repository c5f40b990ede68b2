//! Lists the modules under `wgsl/`: a file that is there is a module.

use std::error::Error;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::{env, fs};

fn main() -> Result<(), Box<dyn Error>> {
    let mut names = Vec::new();
    for folder in fs::read_dir("wgsl")? {
        let folder = folder?.path();
        for file in fs::read_dir(&folder)? {
            names.push(name(&file?.path()).ok_or("modules are `wgsl/FOLDER/FILE.wgsl`")?);
        }
    }
    names.sort();
    let mut source = String::from("&[\n");
    for name in names {
        let path = format!("concat!(env!(\"CARGO_MANIFEST_DIR\"), \"/wgsl/{name}\")");
        writeln!(source, "    ({name:?}, include_str!({path})),")?;
    }
    source += "]\n";
    let out = PathBuf::from(env::var_os("OUT_DIR").ok_or("cargo sets OUT_DIR")?);
    fs::write(out.join("modules.rs"), source)?;
    println!("cargo::rerun-if-changed=wgsl");
    Ok(())
}

/// `FOLDER/FILE.wgsl`.
fn name(path: &Path) -> Option<String> {
    let file = path.file_name()?.to_str()?.strip_suffix(".wgsl")?;
    let folder = path.parent()?.file_name()?.to_str()?;
    Some(format!("{folder}/{file}.wgsl"))
}
