//! Wavefront OBJ with its MTL files becomes a [`MeshFile`].
//!
//! `parse` reads the text once into flat arrays; `mtl` reads the material libraries, with `tobj`;
//! `build` makes the parts, one for each pair of name and material; triangles without normals get
//! computed ones. Axes are turned so that `up` becomes +Y by a rotation (never a reflection), and
//! units become metres.

mod build;
mod frame;
mod lines;
mod mtl;
mod parse;

use self::parse::Oddities;
use super::error::{ErrorKind, ImportError};
use super::file::{Limits, Reader, read_file};
use super::image_set::ImageSet;
use super::mesh::{MeshFile, Part, keep};
use super::report::ImportReport;
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
    reject_foreign(bytes, &file)?;
    let (obj, loan) = parse::parse(bytes, &file, limits)?;
    let mut report = ImportReport::default();
    warn_about(&obj.oddities, &file, &mut report);
    let mut images = ImageSet::default();
    let folder = path.parent().unwrap_or(Path::new(""));
    let library = mtl::load(folder, &file, &obj, &mut reader, &mut images, &mut report)?;
    let source = build::Source {
        file: &file,
        frame: frame::Frame { metres_per_unit, up },
        names: &obj.names,
        material_ids: &library.ids,
        limits,
    };
    let n_faces = obj.geometry.faces.len();
    let parts = build::parts(obj.geometry, &source, &mut report)?;
    drop(loan);
    keep(&parts, &file, limits)?;
    let images = images.decode(limits, &mut report)?;
    report.files = reader.finish();
    finish(&file, n_faces, parts, report).map(|(parts, report)| MeshFile {
        parts,
        materials: library.materials,
        images,
        report,
    })
}

fn finish(
    file: &str,
    n_faces: usize,
    parts: Vec<Part>,
    mut report: ImportReport,
) -> Result<(Vec<Part>, ImportReport), ImportError> {
    report.n_triangles = parts.iter().map(|part| part.triangles.len() as u64).sum();
    if report.n_triangles == 0 {
        let message = match n_faces {
            0 => "the file has no faces".to_owned(),
            n => format!("none of its {n} faces has an area"),
        };
        return Err(ImportError::new(ErrorKind::Empty, file, message));
    }
    Ok((parts, report))
}

/// Says what a file is that is not OBJ text at all.
fn reject_foreign(bytes: &[u8], file: &str) -> Result<(), ImportError> {
    const OTHERS: [(&[u8], &str); 7] = [
        (b"glTF", "a GLB file; read it with `gltf(...)`"),
        (b"ply", "a PLY file"),
        (b"solid ", "an STL file"),
        (b"Kaydara FBX", "an FBX file"),
        (b"PK\x03\x04", "a ZIP archive"),
        (b"\xff\xfe", "UTF-16 text"),
        (b"\xfe\xff", "UTF-16 text"),
    ];
    let what = OTHERS.iter().find(|(magic, _)| bytes.starts_with(magic)).map(|(_, what)| *what);
    let binary = || bytes.iter().take(4096).any(|byte| *byte == 0);
    let what = match what {
        Some(what) => what,
        None if bytes.is_empty() => "empty",
        None if binary() => "binary data",
        None => return Ok(()),
    };
    Err(ImportError::new(ErrorKind::Format, file, format!("this is not an OBJ file but {what}"))
        .with_help("export it as OBJ text or glTF"))
}

fn warn_about(odd: &Oddities, file: &str, report: &mut ImportReport) {
    for (keyword, (count, line)) in &odd.skipped {
        let message = format!("`{keyword}` is not used here; {count} such lines are skipped");
        report.warn(format!("{file}:{line}"), message);
    }
    let mut warn = |(count, line): (u64, u64), message: &dyn Fn(u64) -> String| {
        if count > 0 {
            report.warn(format!("{file}:{line}"), message(count));
        }
    };
    warn(odd.colored, &|n| format!("colours of {n} vertices are not used"));
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
