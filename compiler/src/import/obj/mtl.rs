//! MTL files become materials.
//!
//! The text is checked first (with lines), and `tobj` gets what it reads right. The old Phong numbers
//! become metallic-roughness ones:
//!
//! - `Kd` is the base colour, taken as linear Rec. 709, as exporters write it. A black `Kd` beside a
//!   `map_Kd` is taken as white: many exporters write that, and black would hide the image.
//! - `Ns` is a Blinn-Phong exponent n: `alpha = sqrt(2 / (n + 2))` (Walter et al. 2007), and
//!   roughness is the square root of alpha. `Pr` and `Pm`, where given, say it directly.
//! - `Ks` without any `Kd` is a metal of that colour; without `Ks` and `Ns` (or with `illum` 0 or 1)
//!   there is no highlight at all.
//! - `illum` 4, 6, 7 and 9 mean glass: transmission is `1 - d`, or 1 where 6 or 7 say no `d`.
//! - `Pc` and `Pcr` are a clear coat and its roughness.
//! - `norm` is a normal map. `map_Bump` is a height without a unit: there is no telling how steep it is.
//! - `map_d`, or `d` below 1 otherwise, is coverage, cut at one half.

use super::super::error::{ErrorKind, ImportError};
use super::super::file::Reader;
use super::super::image_set::{Alpha, ImageSet};
use super::super::lines::{numbers_of, split_word, text, uncommented};
use super::super::material::{ImportedMaterial, MapUse};
use super::super::report::ImportReport;
use super::parse::Obj;
use crate::input::Root;
use files::ShowPath as _;
use lang::scene::{ColorSpace, Wrap};
use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// All materials of an OBJ file.
pub(super) struct Library {
    pub(super) materials: Vec<ImportedMaterial>,
    /// For each name that the OBJ file uses, the material of that name.
    pub(super) ids: Vec<Option<u32>>,
}

/// A material as `tobj` read it, with the file that it came from.
struct Found {
    material: tobj::Material,
    library: PathBuf,
}

/// Bytes of `tobj`'s material, of the entry by which it is found, and of what it becomes.
const MATERIAL_BYTES: u64 = 2048;

/// Reads the libraries of an OBJ file and makes the materials that it uses.
pub(super) fn load(
    folder: &Path,
    obj_file: &str,
    obj: &Obj,
    reader: &mut Reader<'_>,
    images: &mut ImageSet<'_>,
    report: &mut ImportReport,
) -> Result<Library, ImportError> {
    let mut found: BTreeMap<String, Found> = BTreeMap::new();
    let mut missing = false;
    let mut done: BTreeSet<&str> = BTreeSet::new();
    for (written, line) in &obj.libraries {
        if !done.insert(written) {
            continue;
        }
        let (paths, absent) = library_paths(folder, written, &reader.limits.root);
        for name in absent {
            missing = true;
            let message = format!("there is no `{name}`; its materials are not known");
            report.warn(format!("{obj_file}:{line}"), message);
        }
        let is_absent = |path: &PathBuf| !reader.limits.root.has(path);
        let whole = library_path(folder, written);
        if is_absent(&whole) {
            let names = written.split_whitespace().map(|name| library_path(folder, name));
            report.absent.extend(std::iter::once(whole).chain(names).filter(is_absent));
        }
        for path in paths {
            for material in read_library(&path, reader, report)? {
                let library = path.clone();
                found.insert(material.name.clone(), Found { material, library });
            }
        }
    }
    let mut library = Library { materials: Vec::new(), ids: Vec::new() };
    for (name, line) in &obj.materials {
        let Some(found) = found.get(name) else {
            if !missing {
                let message = format!("no material library defines `{name}`");
                report.warn(format!("{obj_file}:{line}"), message);
            }
            library.ids.push(None);
            continue;
        };
        library.ids.push(u32::try_from(library.materials.len()).ok());
        library.materials.push(convert(found, reader, images, report)?);
    }
    Ok(library)
}

fn library_path(folder: &Path, name: &str) -> PathBuf {
    folder.join(name.replace('\\', "/"))
}

/// The files that an `mtllib` line means, one name with spaces or several names, and those that are not there.
fn library_paths<'a>(folder: &Path, written: &'a str, root: &Root) -> (Vec<PathBuf>, Vec<&'a str>) {
    let path = |name: &str| library_path(folder, name);
    if root.has(&path(written)) {
        return (vec![path(written)], Vec::new());
    }
    let (there, absent): (Vec<&str>, Vec<&str>) =
        written.split_whitespace().partition(|name| root.has(&path(name)));
    if there.is_empty() {
        return (Vec::new(), vec![written]);
    }
    (there.into_iter().map(path).collect(), absent)
}

fn read_library(
    path: &Path,
    reader: &mut Reader<'_>,
    report: &mut ImportReport,
) -> Result<Vec<tobj::Material>, ImportError> {
    let bytes = reader.read(path)?;
    let file = path.shown().to_string();
    let n_materials =
        bytes.split(|byte| *byte == b'\n').filter(|line| line.starts_with(b"newmtl")).count();
    reader.take(bytes.len() as u64 * 4 + n_materials as u64 * MATERIAL_BYTES, &file)?;
    let cleaned = clean(&bytes, &file, report)?;
    let parsed = tobj::load_mtl_buf(&mut cleaned.as_slice());
    let (materials, _) = parsed.map_err(|error| {
        ImportError::new(ErrorKind::Format, file, format!("cannot be read: {error}"))
    })?;
    Ok(materials)
}

/// Keeps the lines that matter, checked, as UTF-8.
fn clean(bytes: &[u8], file: &str, report: &mut ImportReport) -> Result<Vec<u8>, ImportError> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let mut out = Vec::with_capacity(bytes.len());
    let mut within = Within::Nothing;
    let mut told_latin = false;
    for (line_idx, line) in bytes.split(|byte| *byte == b'\n').enumerate() {
        let place = || format!("{file}:{}", line_idx + 1);
        let (line, is_latin) = text(line.trim_ascii());
        let checked = clean_line(line.as_bytes(), within);
        match checked.map_err(|(kind, message)| ImportError::new(kind, place(), message))? {
            Line::Keep(line) => {
                if line.starts_with(b"newmtl") {
                    within = Within::Material;
                }
                if is_latin && !std::mem::replace(&mut told_latin, true) {
                    report.warn(place(), "this is not UTF-8; such lines are read as Latin-1");
                }
                out.extend_from_slice(&line);
                out.push(b'\n');
            }
            Line::Nameless => {
                within = Within::Nameless;
                report.warn(place(), "`newmtl` without a name; this material is left out");
            }
            Line::Drop => {}
            Line::Odd(message) => report.warn(place(), message),
        }
    }
    Ok(out)
}

/// What the lines at hand describe.
#[derive(Clone, Copy, PartialEq)]
enum Within {
    /// Nothing: no material has begun.
    Nothing,
    /// A material that nothing can refer to.
    Nameless,
    Material,
}

enum Line {
    Keep(Vec<u8>),
    Drop,
    /// `newmtl` without a name.
    Nameless,
    /// Dropped, and worth a warning.
    Odd(String),
}

fn clean_line(line: &[u8], within: Within) -> Result<Line, (ErrorKind, String)> {
    let (keyword, rest) = split_word(line);
    let keep = |rest: &[u8]| Ok(Line::Keep([keyword, b" ", rest].concat()));
    let key = String::from_utf8_lossy(keyword);
    let known = matches!(
        keyword,
        b"Kd"
            | b"Ks"
            | b"Ke"
            | b"Ns"
            | b"Ni"
            | b"d"
            | b"Tr"
            | b"Pr"
            | b"Pm"
            | b"Pc"
            | b"Pcr"
            | b"illum"
            | b"map_Kd"
            | b"map_Ke"
            | b"map_d"
            | b"norm"
    );
    if known && within == Within::Nothing {
        return Err((ErrorKind::Format, format!("`{key}` before the first `newmtl`")));
    }
    if within == Within::Nameless && keyword != b"newmtl" {
        return Ok(Line::Drop);
    }
    match keyword {
        b"newmtl" if rest.is_empty() => Ok(Line::Nameless),
        b"newmtl" => keep(rest),
        b"Kd" | b"Ks" | b"Ke" => {
            let rest = uncommented(rest);
            if rest.starts_with(b"spectral") || rest.starts_with(b"xyz") {
                return Ok(Line::Odd(format!("`{key}` that is not `r g b` is not used")));
            }
            match numbers_of(rest, &mut [0.0; 3])? {
                3 => keep(rest),
                1 => keep(&[rest, b" ", rest, b" ", rest].concat()),
                n => Err((ErrorKind::Format, format!("`{key}` has 3 numbers, found {n}"))),
            }
        }
        b"Ns" | b"Ni" | b"d" | b"Tr" | b"Pr" | b"Pm" | b"Pc" | b"Pcr" => {
            let rest = uncommented(rest);
            let number = rest.strip_prefix(b"-halo ").unwrap_or(rest).trim_ascii();
            match numbers_of(number, &mut [0.0; 1])? {
                1 => keep(number),
                n => Err((ErrorKind::Format, format!("`{key}` has 1 number, found {n}"))),
            }
        }
        b"illum" => {
            let rest = uncommented(rest);
            let number = std::str::from_utf8(rest).ok().and_then(|s| s.parse::<u8>().ok());
            if number.is_some() { keep(rest) } else { Ok(Line::Drop) }
        }
        b"map_Kd" | b"map_Ke" | b"map_d" | b"norm" => {
            if rest.is_empty() {
                return Ok(Line::Odd(format!("`{key}` without a file name")));
            }
            keep(rest)
        }
        b"map_Bump" | b"map_bump" | b"bump" => Ok(Line::Odd(format!(
            "`{key}` is a height without a unit and is not used; a normal map is `norm`"
        ))),
        _ => Ok(Line::Drop),
    }
}

fn convert(
    found: &Found,
    reader: &mut Reader<'_>,
    images: &mut ImageSet<'_>,
    report: &mut ImportReport,
) -> Result<ImportedMaterial, ImportError> {
    let mtl = &found.material;
    let place = format!("{}: material `{}`", found.library.shown(), mtl.name);
    let mut maps = Maps { found, place: &place, reader, images, report };
    let mut out = ImportedMaterial::named(mtl.name.clone());
    out.metallic = 0.0;
    out.color_map = maps.load(mtl.diffuse_texture.as_deref(), ColorSpace::Srgb, Alpha::Own)?;
    let emission_map = mtl.unknown_param.get("map_Ke").map(String::as_str);
    out.emission_map = maps.load(emission_map, ColorSpace::Srgb, Alpha::Own)?;
    let normal_map = mtl.unknown_param.get("norm").map(String::as_str);
    out.normal_map = maps.load(normal_map, ColorSpace::Data, Alpha::Own)?;
    out.alpha_map = maps.load(mtl.dissolve_texture.as_deref(), ColorSpace::Data, Alpha::Mask)?;
    set_colors(&mut out, mtl, &place, report);
    set_gloss(&mut out, mtl);
    set_transparency(&mut out, mtl, &place, report);
    Ok(out)
}

fn set_colors(
    out: &mut ImportedMaterial,
    mtl: &tobj::Material,
    place: &str,
    report: &mut ImportReport,
) {
    let black = |color: Option<[f32; 3]>| color.is_none_or(|c| c.iter().all(|x| *x <= 0.0));
    let wide = |color: [f32; 3]| color.map(f64::from);
    let specular = mtl.specular.filter(|_| !black(mtl.specular));
    let color = match (mtl.diffuse, specular, &out.color_map) {
        (kd, _, Some(_)) => kd.filter(|_| !black(kd)).map_or([1.0; 3], wide),
        (kd, Some(ks), None) if black(kd) => {
            out.metallic = 1.0;
            wide(ks)
        }
        // The default of the format for what a file leaves out.
        (kd, _, None) => kd.map_or([0.8; 3], wide),
    };
    if color.iter().any(|x| !(0.0..=1.0).contains(x)) {
        let [r, g, b] = color;
        report.warn(place, format!("colour ({r}, {g}, {b}) is cut to 0..1"));
    }
    out.color = color.map(|x| x.clamp(0.0, 1.0));
    let emission = mtl.emissive.map_or([0.0; 3], wide).map(|x| x.max(0.0));
    let dark = emission.iter().all(|x| *x == 0.0);
    out.emission = if dark && out.emission_map.is_some() { [1.0; 3] } else { emission };
}

fn set_gloss(out: &mut ImportedMaterial, mtl: &tobj::Material) {
    let number = |key: &str| mtl.unknown_param.get(key).and_then(|s| s.parse::<f64>().ok());
    let no_specular = mtl.specular.is_none_or(|ks| ks.iter().all(|x| *x <= 0.0));
    let dull = matches!(mtl.illumination_model, Some(0 | 1));
    let exponent = mtl.shininess.map(|n| f64::from(n).max(0.0));
    out.roughness = match (number("Pr"), exponent) {
        (Some(roughness), _) => roughness.clamp(0.0, 1.0),
        (None, Some(n)) => (2.0 / (n + 2.0)).sqrt().sqrt(),
        (None, None) => 1.0,
    };
    if let Some(metallic) = number("Pm") {
        out.metallic = metallic.clamp(0.0, 1.0);
    }
    let says_nothing = mtl.specular.is_some() || exponent.is_none();
    let physical = number("Pr").is_some() || out.metallic > 0.0 || number("Pc").is_some();
    out.coat = number("Pc").unwrap_or(0.0).clamp(0.0, 1.0);
    out.coat_roughness = number("Pcr").unwrap_or(0.0).clamp(0.0, 1.0);
    out.diffuse_only = !physical && (dull || (no_specular && says_nothing));
    if let Some(ior) = mtl.optical_density.map(f64::from).filter(|ior| *ior >= 1.0) {
        out.ior = ior;
    }
}

/// `Tr` is one less `d`. `Tr 1` alone would make a surface invisible, but some programs write it for opaque ones.
fn set_transparency(
    out: &mut ImportedMaterial,
    mtl: &tobj::Material,
    place: &str,
    report: &mut ImportReport,
) {
    let mut tr = mtl.unknown_param.get("Tr").and_then(|s| s.parse::<f64>().ok());
    if mtl.dissolve.is_none() && tr.is_some_and(|tr| tr >= 1.0) {
        tr = None;
        report.warn(place, "`Tr 1` would make this material invisible; it is read as opaque");
    }
    let coverage = mtl.dissolve.map(f64::from).or(tr.map(|tr| 1.0 - tr));
    let coverage = coverage.map(|d| d.clamp(0.0, 1.0));
    match (mtl.illumination_model, coverage) {
        (Some(6 | 7), None) => out.transmission = 1.0,
        (Some(4 | 6 | 7 | 9), Some(d)) => out.transmission = 1.0 - d,
        (_, Some(d)) => out.alpha = d,
        _ => {}
    }
    out.solid = out.transmission > 0.0;
}

/// Finds and asks for the images of a material.
struct Maps<'m, 'r, 'i> {
    found: &'m Found,
    place: &'m str,
    reader: &'m mut Reader<'r>,
    images: &'m mut ImageSet<'i>,
    report: &'m mut ImportReport,
}

impl Maps<'_, '_, '_> {
    fn load(
        &mut self,
        written: Option<&str>,
        space: ColorSpace,
        alpha: Alpha,
    ) -> Result<Option<MapUse>, ImportError> {
        let Some(written) = written else {
            return Ok(None);
        };
        let options = MapOptions::parse(written);
        if options.ignored {
            let message =
                format!("options of `{written}` beside -clamp and -colorspace are not used");
            self.report.warn(self.place, message);
        }
        let space = match (space, options.space) {
            (own, None) => own,
            (ColorSpace::Data, Some(said)) => {
                if said == ColorSpace::Srgb {
                    let message =
                        format!("-colorspace of `{written}` is not used: it has no colours");
                    self.report.warn(self.place, message);
                }
                ColorSpace::Data
            }
            (_, Some(said)) => said,
        };
        let name = options.file.replace('\\', "/");
        let wrap = [if options.clamp { Wrap::Clamp } else { Wrap::Repeat }; 2];
        let path = self.place_of(&name);
        if !self.reader.limits.root.has(&path) {
            self.report.absent.push(path);
            self.report.warn(self.place, format!("there is no image `{name}`"));
            return Ok(None);
        }
        let place = path.shown().to_string();
        if let Some(image) = self.images.find_place(&place, alpha) {
            return Ok(Some(MapUse { image, space, wrap }));
        }
        let bytes = Cow::Owned(self.reader.read(&path)?);
        let image = self.images.add(name, place, alpha, bytes)?;
        Ok(Some(MapUse { image, space, wrap }))
    }

    /// The image beside the library; a path of the exporter's machine is tried by its last part.
    fn place_of(&self, name: &str) -> PathBuf {
        let folder = self.found.library.parent().unwrap_or(Path::new(""));
        let foreign = name.starts_with('/') || name.contains(':');
        let last = name.rsplit('/').next().unwrap_or(name);
        folder.join(if foreign { last } else { name })
    }
}

/// A `map_` line, taken apart.
struct MapOptions<'a> {
    file: &'a str,
    clamp: bool,
    /// What `-colorspace` says.
    space: Option<ColorSpace>,
    ignored: bool,
}

impl<'a> MapOptions<'a> {
    fn parse(written: &'a str) -> Self {
        let mut out = Self { file: written.trim(), clamp: false, space: None, ignored: false };
        while out.file.starts_with('-') {
            let (option, mut rest) = cut_word(out.file);
            let (first, after) = cut_word(rest);
            match option {
                "-clamp" => {
                    out.clamp = first == "on";
                    rest = after;
                }
                "-colorspace" => {
                    match first.to_ascii_lowercase().as_str() {
                        "srgb" => out.space = Some(ColorSpace::Srgb),
                        "linear" | "raw" | "non-color" => out.space = Some(ColorSpace::Linear),
                        _ => out.ignored = true,
                    }
                    rest = after;
                }
                "-o" | "-s" | "-t" => {
                    let mut neutral = true;
                    for _ in 0..3 {
                        let (word, after) = cut_word(rest);
                        let Ok(number) = word.parse::<f64>() else { break };
                        neutral &= (number - if option == "-s" { 1.0 } else { 0.0 }).abs() <= 0.0;
                        rest = after;
                    }
                    out.ignored |= !neutral;
                }
                "-mm" => {
                    out.ignored = true;
                    rest = cut_word(after).1;
                }
                "-blendu" | "-blendv" | "-cc" | "-texres" => rest = after,
                "-bm" | "-boost" | "-imfchan" | "-type" => {
                    out.ignored = true;
                    rest = after;
                }
                _ => return out, // a file name that begins with a dash
            }
            out.file = rest;
        }
        out
    }
}

fn cut_word(text: &str) -> (&str, &str) {
    let (word, rest) = text.split_once(char::is_whitespace).unwrap_or((text, ""));
    (word, rest.trim_start())
}
