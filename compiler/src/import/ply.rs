//! PLY files, as text or binary of either order of bytes, become a [`MeshFile`].
//!
//! `header` tells what the file holds, and refuses what it cannot hold, before memory is taken; `rows` reads vertices
//! and polygons with `serde_ply`; `build` of all files of polygons makes the part. Axes and units are those of OBJ.

mod header;
mod rows;

use self::header::Header;
use self::rows::Rows;
use super::build::{self, Faces, Source};
use super::colors;
use super::error::{ErrorKind, ImportError};
use super::file::{Limits, Reader, read_file};
use super::foreign::{Format, foreign};
use super::frame::Frame;
use super::geometry::PartName;
use super::mesh::MeshFile;
use super::report::ImportReport;
use super::studio::Studio;
use files::ShowPath as _;
use lang::scene::Axis;
use std::path::Path;

/// Reads a PLY file whose unit is `metres_per_unit` and whose `up` axis is to become +Y.
pub fn load_ply(
    path: &Path,
    metres_per_unit: f64,
    up: Axis,
    limits: &Limits,
) -> Result<MeshFile, ImportError> {
    let (bytes, _loan) = read_file(path, limits)?;
    read_ply(&bytes, path, metres_per_unit, up, limits)
}

/// The same for a file whose bytes are in memory; `path` names it in messages.
pub fn read_ply(
    bytes: &[u8],
    path: &Path,
    metres_per_unit: f64,
    up: Axis,
    limits: &Limits,
) -> Result<MeshFile, ImportError> {
    let mut reader = Reader::new(limits);
    reader.remember(path, bytes);
    let file = path.shown().to_string();
    let fail = |(kind, message)| ImportError::new(kind, file.as_str(), message);
    if let Some(what) = foreign(bytes, Format::Ply) {
        return Err(fail((ErrorKind::Format, format!("this is not a PLY file but {what}"))));
    }
    if !bytes.starts_with(b"ply") {
        let message = "this is not a PLY file: it does not begin with `ply`";
        return Err(fail((ErrorKind::Format, message.to_owned())));
    }
    let header = Header::read(bytes, limits).map_err(fail)?;
    if header.n_faces == 0 {
        let message = format!("the file has no faces; it has {}", header.contents());
        let help = "a mesh has an element `face` with a list `vertex_indices`; make one of the points first";
        return Err(fail((ErrorKind::Empty, message)).with_help(help));
    }
    let mut report = ImportReport::default();
    warn_about(&header, &file, &mut report);
    let (rows, loan) = Rows::read(&header, &file, limits)?;
    if rows.n_not_polygons > 0 {
        let n = rows.n_not_polygons;
        report.warn(&file, format!("{n} faces have fewer than three corners and are left out"));
    }
    let source = Source {
        file: &file,
        faces: Faces::ByNumber,
        frame: Frame { metres_per_unit, up },
        names: &[PartName::default()],
        material_ids: &[],
        limits,
    };
    let parts = build::parts(rows.geometry, loan, &source, &mut report)?;
    report.files = reader.finish();
    let (materials, images) = (Vec::new(), Vec::new());
    let made = MeshFile { parts, materials, images, studio: Studio::default(), report };
    Ok(colors::settle(made))
}

fn warn_about(header: &Header<'_>, file: &str, report: &mut ImportReport) {
    for name in &header.images {
        let message = format!(
            "the image `{name}` is not used; declare it as `texture` and give it to a material"
        );
        report.warn(file, message);
    }
}
