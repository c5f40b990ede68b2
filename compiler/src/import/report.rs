//! What an import did besides succeeding: counts, bounds, warnings.

use std::path::PathBuf;

use serde::{Deserialize, Serialize};

use crate::counted::counted;

/// Warnings of one file that are kept; more of them tell nobody more.
const MAX_WARNINGS: usize = 100;

/// What was noticed while reading one mesh file.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ImportReport {
    /// Every file that was read, in order: the mesh file first, then MTL files, buffers, images.
    pub files: Vec<FileRead>,
    /// Files that it names and that are not there.
    pub absent: Vec<PathBuf>,
    /// Triangles kept, over all parts.
    pub n_triangles: u64,
    /// Faces with more than three corners that were cut into triangles.
    pub n_polygons: u64,
    /// Polygons so crooked that they were cut as a fan from their first corner.
    pub crooked_polygons: Finding,
    /// Triangles without area; dropped.
    pub zero_area: Finding,
    /// Triangles longer than 1e5 times their height; kept.
    pub needles: Finding,
    /// Normals of length zero; replaced.
    pub zero_normals: Finding,
    /// Triangles whose normals were computed because the file has none for them.
    pub computed_normals: u64,
    /// Texels brighter than a half float can hold or not finite; clamped to 65504 or 0.
    pub clamped_texels: u64,
    /// Lowest and highest corner over all parts, metres, +Y up.
    pub bounds: Option<[[f32; 3]; 2]>,
    /// Odd things, in the order in which they were met; each kind once.
    pub warnings: Vec<Warning>,
    /// Odd things after the first hundred.
    pub n_untold: u64,
}

/// A file that went into an import.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct FileRead {
    /// Where it was found.
    pub path: PathBuf,
    /// BLAKE3 of its bytes.
    pub hash: [u8; 32],
}

/// How often something was met, and where first.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Finding {
    /// How often.
    pub count: u64,
    /// `file:line` (OBJ) or `file: mesh 0 primitive 1 triangle 5` (glTF); `None` while `count` is 0.
    pub first: Option<String>,
}

impl Finding {
    /// Counts one; `place` is asked only for the first.
    pub(super) fn add(&mut self, place: impl FnOnce() -> String) {
        if self.count == 0 {
            self.first = Some(place());
        }
        self.count += 1;
    }
}

/// Something that the user should know but that does not stop the import.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Warning {
    /// `file`, `file:line` or `file: material "x"`.
    pub place: String,
    /// What it is, in one line.
    pub message: String,
}

impl ImportReport {
    /// Adds a warning.
    pub(super) fn warn(&mut self, place: impl Into<String>, message: impl Into<String>) {
        if self.warnings.len() < MAX_WARNINGS {
            self.warnings.push(Warning { place: place.into(), message: message.into() });
        } else {
            self.n_untold += 1;
        }
    }

    /// Adds a warning about `count` things of a kind, named as one and as several; none about no things.
    pub(super) fn warn_of(
        &mut self,
        place: &str,
        what: &str,
        count: u64,
        [one, several]: [&str; 2],
    ) {
        if count > 0 {
            self.warn(place, format!("{what} ({})", counted(count, one, several)));
        }
    }
}
