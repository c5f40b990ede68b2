//! Reads the files that instances use; what cannot be read becomes a diagnostic at its path.

use std::borrow::Cow;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use lang::diagnostic::{Code, Diagnostic, Fix};
use lang::scene::{Asset, AssetFormat, Scene, Shape, SkyModel};
use lang::source::{SourceSet, Span};
use rayon::prelude::*;

use super::Options;
use crate::import::{
    Environment, ErrorKind, Image, ImportError, ImportReport, MeshFile, Pixels, load_environment,
    load_gltf, load_image, load_obj,
};
use crate::lower::Loaded;
use crate::reuse::Reuse;

/// A file that went into the pack.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FileRead {
    /// Path relative to the root scene's directory, as far as it can be.
    pub name: String,
    /// BLAKE3 of its bytes; for images of what they show.
    pub hash: [u8; 32],
}

/// The mesh files that are `needed`, by their index in the scene; `None` for a file that cannot be read.
pub(super) fn load_meshes(
    scene: &Scene,
    sources: &SourceSet,
    options: &Options<'_>,
    reuse: &Reuse,
    needed: &[bool],
) -> Option<Loaded> {
    let asset = |(asset, needed): (&Asset, &bool)| {
        if *needed { mesh(asset, sources, options, reuse).ok().map(Some) } else { Some(None) }
    };
    let assets = scene.assets.par_iter().zip(needed).map(asset).collect::<Option<_>>()?;
    Some(Loaded { assets, ..Loaded::default() })
}

fn mesh(
    asset: &Asset,
    sources: &SourceSet,
    options: &Options<'_>,
    reuse: &Reuse,
) -> Result<Arc<MeshFile>, ImportError> {
    let path = beside(sources, asset.path_span, &asset.path);
    let format = format!("{:?}", asset.format);
    reuse.mesh(&path, &format, || read_asset(asset, &path, options))
}

/// Loads every asset and texture, in parallel; results are in declaration order. A `Scene` holds only
/// those that some instance uses.
pub(super) fn load(
    scene: &Scene,
    sources: &SourceSet,
    options: &Options<'_>,
    reuse: &Reuse,
    diagnostics: &mut Vec<Diagnostic>,
) -> Result<(Loaded, Vec<FileRead>), ImportError> {
    let assets: Vec<_> =
        scene.assets.par_iter().map(|asset| mesh(asset, sources, options, reuse)).collect();
    let textures: Vec<_> = scene
        .textures
        .par_iter()
        .map(|texture| {
            let path = beside(sources, texture.path_span, &texture.path);
            let image = reuse.image(&path, || load_image(&path, &options.limits));
            image.map(|image| (image, path))
        })
        .collect();
    let mut files = Vec::new();
    let mut loaded = Loaded::default();
    let (assets, textures) = (with_memory(assets)?, with_memory(textures)?);
    for (asset, result) in scene.assets.iter().zip(assets) {
        let fault = |e| diagnostics.push(failed(&e, asset.path_span, &asset.path));
        let file = result.map_err(fault).ok();
        if let Some(file) = &file {
            report(&file.report, asset.path_span, diagnostics);
            let read = file.report.files.iter();
            files.extend(
                read.map(|f| FileRead { name: relative(&f.path, options.root), hash: f.hash }),
            );
        }
        loaded.assets.push(file);
    }
    for (texture, result) in scene.textures.iter().zip(textures) {
        let fault = |e| diagnostics.push(failed(&e, texture.path_span, &texture.path));
        let image = result.map_err(fault).ok();
        loaded.textures.push(image.map(|(image, path)| {
            files.push(FileRead { name: relative(&path, options.root), hash: content(&image) });
            image
        }));
    }
    loaded.environment = environment(scene, sources, options, reuse, &mut files, diagnostics)?;
    find_parts(scene, &loaded, diagnostics);
    files.sort_by(|a, b| a.name.cmp(&b.name));
    files.dedup();
    Ok((loaded, files))
}

/// The results, unless there was no memory for one of them: that is no fault of the scene.
fn with_memory<T>(
    results: Vec<Result<T, ImportError>>,
) -> Result<Vec<Result<T, ImportError>>, ImportError> {
    let mut kept = Vec::with_capacity(results.len());
    for result in results {
        match result {
            Err(error) if error.kind == ErrorKind::Memory => return Err(error),
            result => kept.push(result),
        }
    }
    Ok(kept)
}

/// The image of the sky, with what is odd about it.
fn environment(
    scene: &Scene,
    sources: &SourceSet,
    options: &Options<'_>,
    reuse: &Reuse,
    files: &mut Vec<FileRead>,
    diagnostics: &mut Vec<Diagnostic>,
) -> Result<Option<Environment>, ImportError> {
    let model = scene.sky.as_ref().map(|sky| &sky.model);
    let Some(SkyModel::Image { path: written, path_span, .. }) = model else {
        return Ok(None);
    };
    let path = beside(sources, *path_span, written);
    reuse.read(&path);
    let found = match load_environment(&path, &options.limits) {
        Ok(found) => found,
        Err(error) if error.kind == ErrorKind::Memory => return Err(error),
        Err(error) => {
            diagnostics.push(failed(&error, *path_span, written));
            return Ok(None);
        }
    };
    let image = &found.image;
    if image.width != 2 * image.height {
        let (width, height) = (image.width, image.height);
        let message = format!(
            "`{written}` is {width} x {height} pixels; an image of all directions is twice as wide as high"
        );
        let warning = Diagnostic::warning(Code("W0528"), "sky_shape", message);
        diagnostics.push(warning.at(*path_span, "it will look stretched"));
    }
    if !image.is_radiance {
        let message =
            format!("`{written}` is a picture, not radiance: its sun is no brighter than paper");
        let warning = Diagnostic::warning(Code("W0529"), "sky_picture", message)
            .at(*path_span, "read with the sRGB curve")
            .with_help("use an HDR or EXR image");
        diagnostics.push(warning);
    }
    files.push(FileRead { name: relative(&path, options.root), hash: content(image) });
    Ok(Some(found))
}

fn read_asset(asset: &Asset, path: &Path, options: &Options<'_>) -> Result<MeshFile, ImportError> {
    match asset.format {
        AssetFormat::Obj { metres_per_unit, up } => {
            load_obj(path, metres_per_unit, up, &options.limits)
        }
        AssetFormat::Gltf => load_gltf(path, &options.limits),
    }
}

/// BLAKE3 over what the image shows, whatever its file looks like.
fn content(image: &Image) -> [u8; 32] {
    let mut hasher = blake3::Hasher::new();
    hasher.update(&image.width.to_le_bytes());
    hasher.update(match &image.data {
        Pixels::Rgba8(bytes) => bytes,
        Pixels::Rgba16F(bits) => bytemuck::cast_slice(bits),
    });
    *hasher.finalize().as_bytes()
}

/// A path in the text is relative to the file in which it stands.
pub(super) fn beside(sources: &SourceSet, at: Span, path: &str) -> PathBuf {
    let dir = Path::new(sources.name(at.file)).parent().unwrap_or(Path::new(""));
    dir.join(path)
}

/// The path as seen from `root`, with `/` between its parts: the same wherever both lie.
pub(super) fn relative(path: &Path, root: &Path) -> String {
    let (mut path, mut root) = (path.components().peekable(), root.components().peekable());
    while path.peek().is_some() && path.peek() == root.peek() {
        path.next();
        root.next();
    }
    let up = root.map(|_| Cow::Borrowed(".."));
    let down = path.map(|part| part.as_os_str().to_string_lossy());
    up.chain(down).collect::<Vec<_>>().join("/")
}

fn failed(error: &ImportError, span: Span, written: &str) -> Diagnostic {
    let code = match error.kind {
        ErrorKind::Missing | ErrorKind::Io | ErrorKind::Outside => "E0514",
        ErrorKind::Format => "E0503",
        ErrorKind::Number => "E0504",
        ErrorKind::Index => "E0505",
        ErrorKind::Accessor => "E0506",
        ErrorKind::Extension => "E0507",
        ErrorKind::Empty => "E0508",
        ErrorKind::Limit | ErrorKind::Memory => "E0509",
        ErrorKind::Image => "E0602",
    };
    let itself = Path::new(&error.place).ends_with(written);
    let message = match error.kind {
        ErrorKind::Missing if itself => format!("there is no file `{written}`"),
        ErrorKind::Missing => format!("`{written}` needs a file that is not there"),
        ErrorKind::Io
        | ErrorKind::Format
        | ErrorKind::Number
        | ErrorKind::Index
        | ErrorKind::Accessor
        | ErrorKind::Extension
        | ErrorKind::Empty
        | ErrorKind::Limit
        | ErrorKind::Image
        | ErrorKind::Outside
        | ErrorKind::Memory => format!("`{written}` cannot be used"),
    };
    let found = Diagnostic::error(Code(code), message).at(span, "named here");
    let found = found.with_note(error.to_string());
    if error.help.is_empty() { found } else { found.with_help(error.help.clone()) }
}

/// Things that were counted during import and that the user should know.
fn report(report: &ImportReport, span: Span, diagnostics: &mut Vec<Diagnostic>) {
    let mut warn = |code, lint, message: String, first: &Option<String>| {
        let warning = Diagnostic::warning(Code(code), lint, message).at(span, "");
        diagnostics.push(match first {
            Some(place) => warning.with_note(format!("the first is at {place}")),
            None => warning,
        });
    };
    let plural = |n: u64, one: &str, many: &str| {
        if n == 1 { format!("1 {one}") } else { format!("{n} {many}") }
    };
    let zero = &report.zero_area;
    if zero.count > 0 {
        let what = plural(zero.count, "triangle without area was", "triangles without area were");
        warn("W0520", "zero_area", format!("{what} left out"), &zero.first);
    }
    let needles = &report.needles;
    if needles.count > 0 {
        let what = plural(needles.count, "triangle is", "triangles are");
        let message =
            format!("{what} a needle, more than 1e5 times as long as high: expect noise there");
        warn("W0521", "needles", message, &needles.first);
    }
    let normals = &report.zero_normals;
    if normals.count > 0 {
        let what = plural(normals.count, "normal has", "normals have");
        warn("W0522", "zero_normals", format!("{what} no length and was replaced"), &normals.first);
    }
    if report.clamped_texels > 0 {
        let what = plural(report.clamped_texels, "texel channel was", "texel channels were");
        warn(
            "W0523",
            "clamped_texels",
            format!("{what} clamped to what a half float holds"),
            &None,
        );
    }
    for warning in &report.warnings {
        let message = format!("{}: {}", warning.place, warning.message);
        warn("W0524", "import", message, &None);
    }
    if report.n_untold > 0 {
        let message = format!("{} more things like these are odd in this file", report.n_untold);
        warn("W0524", "import", message, &None);
    }
}

/// A part that a file does not have is an unknown name, with the names it has.
fn find_parts(scene: &Scene, loaded: &Loaded, diagnostics: &mut Vec<Diagnostic>) {
    for instance in &scene.instances {
        let Shape::Mesh { asset, part: Some(part) } = &instance.shape else { continue };
        let Some(file) = &loaded.assets[*asset] else { continue };
        if !file.find_parts(part).is_empty() {
            continue;
        }
        let names = file.part_names();
        let asset = &scene.assets[*asset];
        let message = format!("`{}` has no part named `{part}`", asset.name.text);
        let mut found = Diagnostic::error(Code("E0521"), message)
            .at(instance.shape_span, "not in the file")
            .because(asset.path_span, "the file");
        if let [similar, ..] = lang::suggest::suggest(part, names.iter().copied()).as_slice() {
            let text = format!("{}.{similar}", asset.name.text);
            let message = format!("a part with a similar name exists: `{similar}`");
            found = found.with_fix(Fix::guess(message, instance.shape_span, text));
        } else {
            found = found.with_note(listed(&names));
        }
        diagnostics.push(found);
    }
}

fn listed(names: &[&str]) -> String {
    const MOST: usize = 12; // a screen line or two
    match names.len() {
        0 => "the file names no parts; use the asset as a whole".to_owned(),
        n if n <= MOST => format!("its parts: {}", names.join(", ")),
        n => format!("its parts: {}, and {} more", names[..MOST].join(", "), n - MOST),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_do_not_depend_on_where_the_scene_lies() {
        let of = |path: &str, root: &str| relative(Path::new(path), Path::new(root));
        assert_eq!(of("a/b/c.obj", "a/b"), "c.obj");
        assert_eq!(of("/x/a/parts/lamp.rts", "/x/a"), "parts/lamp.rts");
        assert_eq!(of("a/parts/lamp.rts", "a/b"), "../parts/lamp.rts");
        assert_eq!(of("c.obj", ""), "c.obj");
    }
}
