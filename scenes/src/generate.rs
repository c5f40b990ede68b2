//! Procedural assets: parameters become OBJ, GLB and HDR files beside the scene that uses them.
//!
//! The same code gives the same bytes on every machine: all transcendental functions are `libm`'s,
//! and nothing depends on time, threads or directories. It does not know the renderer.

#![expect(
    clippy::cast_possible_truncation,
    reason = "files hold f32, u32 and bytes; the numbers written here are small"
)]

mod evening;
mod file;
mod glb;
mod knot;
mod lathe;
mod obj;
pub mod shrine;
mod tea_table;
mod vector;

use std::path::{Path, PathBuf};

use file::write_atomically;

pub use glb::{Glb, MaterialSpec, MeshData, NodeSpec};

/// How much of everything to make; only the shrine is large enough to know the difference.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Extent {
    /// What the pictures show.
    Full,
    /// The same parts with little in them, for tests.
    Reduced,
}

/// A file or folder that was written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Generated {
    /// Where it is.
    pub path: PathBuf,
    /// What is in it, for a scene of many files.
    pub holds: Option<shrine::Written>,
}

/// Writes the asset `name` under `dir`; an unknown name is a bug of the scene table.
///
/// # Errors
/// Any failure to create or write the file.
pub fn generate(name: &str, dir: &Path, extent: Extent) -> std::io::Result<Generated> {
    let path = dir.join(name);
    match name {
        "knot.obj" => write_atomically(&path, &knot::obj(knot::Resolution::FULL)),
        "evening.hdr" => write_atomically(&path, &evening::hdr()?),
        "tea_table.glb" => write_atomically(&path, &tea_table::glb()),
        "shrine" => {
            let detail = match extent {
                Extent::Full => shrine::Detail::FULL,
                Extent::Reduced => shrine::Detail::REDUCED,
            };
            let holds = Some(shrine::write(dir, &detail)?);
            return Ok(Generated { path: dir.to_path_buf(), holds });
        }
        _ => Err(std::io::Error::other(format!("no generator makes `{name}`"))),
    }?;
    Ok(Generated { path, holds: None })
}
