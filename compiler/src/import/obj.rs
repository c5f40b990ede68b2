//! Wavefront OBJ with its MTL files becomes a [`MeshFile`].
//!
//! `parse` reads the text once into flat arrays; `mtl` reads the material libraries, with `tobj`;
//! `build` of all files of polygons makes the parts, one for each pair of name and material; triangles without
//! normals get computed ones. Axes are turned so that `up` becomes +Y by a rotation (never a reflection), and
//! units become metres.

mod mtl;
mod parse;

use self::parse::Oddities;
use super::build::{self, Faces, Source};
use super::colors;
use super::error::{ErrorKind, ImportError};
use super::file::{Limits, Reader, read_file};
use super::foreign::{Format, foreign};
use super::frame::Frame;
use super::image_set::ImageSet;
use super::mesh::MeshFile;
use super::report::ImportReport;
use super::studio::Studio;
use files::ShowPath as _;
use lang::scene::Axis;
use std::path::Path;

/// Reads an OBJ file whose unit is `metres_per_unit` and whose `up` axis is to become +Y.
///
/// A material library or texture that is missing is a warning in the report; everything else that
/// is wrong is an error with its line.
pub fn load_obj(
    path: &Path,
    metres_per_unit: f64,
    up: Axis,
    limits: &Limits,
) -> Result<MeshFile, ImportError> {
    let (bytes, _loan) = read_file(path, limits)?;
    read_obj(&bytes, path, metres_per_unit, up, limits)
}

/// The same for a file whose bytes are in memory; `path` is where its libraries are looked for.
pub fn read_obj(
    bytes: &[u8],
    path: &Path,
    metres_per_unit: f64,
    up: Axis,
    limits: &Limits,
) -> Result<MeshFile, ImportError> {
    let mut reader = Reader::new(limits);
    reader.remember(path, bytes);
    let file = path.shown().to_string();
    if let Some(what) = foreign(bytes, Format::Obj) {
        let message = format!("this is not an OBJ file but {what}");
        let error = ImportError::new(ErrorKind::Format, file, message);
        return Err(error.with_help("export it as OBJ text or glTF"));
    }
    let (obj, loan) = parse::parse(bytes, &file, limits)?;
    let mut report = ImportReport::default();
    warn_about(&obj.oddities, &file, &mut report);
    let mut images = ImageSet::default();
    let folder = path.parent().unwrap_or(Path::new(""));
    let library = mtl::load(folder, &file, &obj, &mut reader, &mut images, &mut report)?;
    let source = Source {
        file: &file,
        faces: Faces::ByLine,
        frame: Frame { metres_per_unit, up },
        names: &obj.names,
        material_ids: &library.ids,
        limits,
    };
    let parts = build::parts(obj.geometry, loan, &source, &mut report)?;
    let images = images.decode(limits, &mut report)?;
    report.files = reader.finish();
    let materials = library.materials;
    let made = MeshFile { parts, materials, images, studio: Studio::default(), report };
    Ok(colors::settle(made))
}

fn warn_about(odd: &Oddities, file: &str, report: &mut ImportReport) {
    for (keyword, (count, line)) in &odd.skipped {
        let message = format!("`{keyword}` is not used here; {count} such lines are skipped");
        report.warn(format!("{file}:{line}"), message);
    }
    let mut warn = |(count, line): (u64, u64), message: &dyn Fn(u64) -> String| {
        if count > 0 {
            report.warn(
                if line == 0 { file.to_owned() } else { format!("{file}:{line}") },
                message(count),
            );
        }
    };
    warn(odd.colored, &|n| {
        format!("{n} vertices have a colour and others none; no colour is used")
    });
    warn(odd.latin, &|n| {
        format!("{n} names are not UTF-8 and were read as Latin-1; this is the first")
    });
    let [uvs, normals] = odd.dangling;
    warn(uvs, &|n| format!("{n} faces have UV indices, but there are no `vt` lines above them"));
    warn(normals, &|n| {
        let what = "have normal indices, but there are no `vn` lines above them";
        format!("{n} faces {what}: their normals are computed")
    });
}
