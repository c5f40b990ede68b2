//! Reads the files that instances use, as far as anybody must; what cannot be read becomes a diagnostic at its path.
//!
//! A file is read when it is not known what it holds, or when its triangles or texels are asked for. What was odd in
//! a file is known with it, and said each time.

use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use lang::diagnostic::{Code, Diagnostic};
use lang::scene::{Asset, AssetFormat, Axis, FileFrame, GltfChoice, Scene, SkyModel, SunSky};
use lang::source::{SourceSet, Span};
use rayon::prelude::*;
use serde::Serialize;
use serde::de::DeserializeOwned;

use super::findings::{failed, find_parts, left_out, report};
use super::options::Options;
use super::session::Session;
use crate::atmosphere;
use crate::import::{
    Environment, EnvironmentFacts, ErrorKind, Image, ImageFacts, ImportError, ImportReport,
    MeshFacts, MeshFile, load_environment, load_gltf, load_image, load_obj, load_ply, load_stl,
};
use crate::lower::{Files, Meshes};
use crate::stage::{Key, KeyOf, Share, Stages};

/// A file that went into the pack.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FileRead {
    /// Path relative to the root scene's directory, as far as it can be.
    pub name: String,
    /// BLAKE3 of its bytes; for images of what they show.
    pub hash: [u8; 32],
}

/// The files of a scene.
pub(super) struct SceneFiles<'a> {
    origin: Origin<'a>,
    assets: Vec<MeshFacts>,
    textures: Vec<ImageFacts>,
    environment: Option<EnvironmentFacts>,
    loaded: Mutex<Loaded>,
}

/// What is in memory.
#[derive(Default)]
struct Loaded {
    meshes: Meshes,
    images: BTreeMap<usize, Arc<Image>>,
    environment: Option<Arc<Environment>>,
}

/// How many files were known.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Counts {
    pub(super) meshes: Share,
    pub(super) images: Share,
}

/// Where files come from, and where what is known of them is.
#[derive(Clone, Copy)]
pub(super) struct Origin<'a> {
    pub(super) scene: &'a Scene,
    pub(super) sources: &'a SourceSet,
    pub(super) options: &'a Options<'a>,
    pub(super) session: &'a Session,
    pub(super) stages: &'a Stages,
}

/// What is known of a file, and the file if it was loaded.
type Known<F, T> = (F, Option<Arc<T>>);

impl<'a> SceneFiles<'a> {
    /// Learns what is known of every asset and texture, in parallel; results are in declaration order. A `Scene`
    /// holds only those that some instance uses. `None` when there are errors in `diagnostics`.
    ///
    /// # Errors
    /// When there is no memory for a file.
    pub(super) fn new(
        origin: Origin<'a>,
        diagnostics: &mut Vec<Diagnostic>,
    ) -> Result<Option<(Self, Vec<FileRead>, Counts)>, ImportError> {
        let (scene, root) = (origin.scene, origin.options.root);
        let assets: Vec<_> = scene.assets.par_iter().map(|asset| origin.asset(asset)).collect();
        let textures = scene.textures.par_iter();
        let textures: Vec<_> =
            textures.map(|texture| origin.image(texture.path_span, &texture.path)).collect();
        let (mut files, mut counts) = (Vec::new(), Counts::default());
        let (mut known, mut loaded) = ((Vec::new(), Vec::new()), Loaded::default());
        for (index, (asset, found)) in scene.assets.iter().zip(with_memory(assets)?).enumerate() {
            match found {
                Err(error) => {
                    diagnostics.push(failed(&error, asset.path_span, &asset.path));
                    known.0.push(None);
                }
                Ok((facts, file)) => {
                    report(&facts.report, asset.path_span, diagnostics);
                    let camera = scene.camera.of_file.as_ref().map(|of_file| of_file.base.asset);
                    diagnostics.extend(left_out(&facts.studio, asset, camera == Some(index)));
                    counts.meshes.count(file.is_none());
                    files.extend(facts.report.files.iter().map(|file| FileRead {
                        name: relative(&file.path, root),
                        hash: file.hash,
                    }));
                    loaded.meshes.extend(file.map(|file| (index, file)));
                    known.0.push(Some(facts));
                }
            }
        }
        for (index, (texture, found)) in
            scene.textures.iter().zip(with_memory(textures)?).enumerate()
        {
            match found {
                Err(error) => diagnostics.push(failed(&error, texture.path_span, &texture.path)),
                Ok((facts, image)) => {
                    counts.images.count(image.is_none());
                    let path = origin.beside(texture.path_span, &texture.path);
                    files.push(FileRead { name: relative(&path, root), hash: facts.content });
                    loaded.images.extend(image.map(|image| (index, image)));
                    known.1.push(facts);
                }
            }
        }
        let environment = environment(origin, diagnostics)?;
        if let Some((path, (facts, image))) = environment.as_ref() {
            files.push(FileRead { name: relative(path, root), hash: facts.image.content });
            loaded.environment.clone_from(image);
        }
        find_parts(scene, &known.0, diagnostics);
        if diagnostics.iter().any(Diagnostic::is_error) {
            return Ok(None);
        }
        files.sort_by(|a, b| a.name.cmp(&b.name));
        files.dedup();
        let assets = known.0.into_iter().flatten().collect();
        let mut environment = environment.map(|(_, (facts, _))| facts);
        if let Some(day) = origin.day() {
            let made = atmosphere::environment(day);
            environment = Some(EnvironmentFacts::of(&made));
            loaded.environment = Some(Arc::new(made));
        }
        let (textures, loaded) = (known.1, Mutex::new(loaded));
        Ok(Some((Self { origin, assets, textures, environment, loaded }, files, counts)))
    }

    fn lock(&self) -> MutexGuard<'_, Loaded> {
        self.loaded.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Files for SceneFiles<'_> {
    fn assets(&self) -> &[MeshFacts] {
        &self.assets
    }

    fn textures(&self) -> &[ImageFacts] {
        &self.textures
    }

    fn environment(&self) -> Option<&EnvironmentFacts> {
        self.environment.as_ref()
    }

    fn load_meshes(&self, assets: &BTreeSet<usize>) -> Result<Meshes, ImportError> {
        let there = self.lock().meshes.clone();
        let absent: Vec<usize> =
            assets.iter().copied().filter(|asset| !there.contains_key(asset)).collect();
        let load = |asset: usize| {
            let file = self.origin.mesh(&self.origin.scene.assets[asset], &self.assets[asset])?;
            Ok((asset, file))
        };
        let new: Vec<_> = absent.into_par_iter().map(load).collect::<Result<_, ImportError>>()?;
        let mut loaded = self.lock();
        loaded.meshes.extend(new);
        let found = loaded.meshes.iter().filter(|(asset, _)| assets.contains(asset));
        Ok(found.map(|(asset, file)| (*asset, Arc::clone(file))).collect())
    }

    fn load_images(
        &self,
        textures: &BTreeSet<usize>,
    ) -> Result<BTreeMap<usize, Arc<Image>>, ImportError> {
        let there = self.lock().images.clone();
        let absent: Vec<usize> =
            textures.iter().copied().filter(|texture| !there.contains_key(texture)).collect();
        let load = |index: usize| {
            let texture = &self.origin.scene.textures[index];
            let path = self.origin.beside(texture.path_span, &texture.path);
            let image = Arc::new(load_image(&path, &self.origin.options.limits)?);
            unchanged(ImageFacts::of(&image) == self.textures[index], &path)?;
            Ok((index, image))
        };
        let new: Vec<_> = absent.into_par_iter().map(load).collect::<Result<_, ImportError>>()?;
        let mut loaded = self.lock();
        loaded.images.extend(new);
        let found = loaded.images.iter().filter(|(texture, _)| textures.contains(texture));
        Ok(found.map(|(texture, image)| (*texture, Arc::clone(image))).collect())
    }

    fn load_environment(&self) -> Result<Arc<Environment>, ImportError> {
        if let Some(found) = &self.lock().environment {
            return Ok(Arc::clone(found));
        }
        if let Some(day) = self.origin.day() {
            return Ok(Arc::new(atmosphere::environment(day)));
        }
        let (path, _, _) = self.origin.sky().expect("the scene has a sky of an image");
        let found = Arc::new(load_environment(&path, &self.origin.options.limits)?);
        unchanged(Some(EnvironmentFacts::of(&found)) == self.environment, &path)?;
        self.lock().environment = Some(Arc::clone(&found));
        Ok(found)
    }

    fn release(&self) {
        *self.lock() = Loaded::default();
    }
}

/// An error if a file is not what it was.
fn unchanged(same: bool, path: &Path) -> Result<(), ImportError> {
    if same { Ok(()) } else { Err(ImportError::changed(path)) }
}

impl Origin<'_> {
    /// A path in the text is relative to the file in which it stands.
    fn beside(&self, at: Span, path: &str) -> PathBuf {
        let dir = Path::new(self.sources.name(at.file)).parent().unwrap_or(Path::new(""));
        dir.join(path)
    }

    /// The image of the sky: its path, where that stands, and as it is written.
    fn sky(&self) -> Option<(PathBuf, Span, &str)> {
        let model = self.scene.sky.as_ref().map(|sky| &sky.model)?;
        let SkyModel::Image { path, path_span, .. } = model else { return None };
        Some((self.beside(*path_span, path), *path_span, path))
    }

    /// The clear sky, if the scene has one: its image is computed.
    fn day(&self) -> Option<&SunSky> {
        match &self.scene.sky.as_ref()?.model {
            SkyModel::SunSky(day) => Some(day),
            SkyModel::Constant(_) | SkyModel::Gradient { .. } | SkyModel::Image { .. } => None,
        }
    }

    /// Begins the key of what is known of a file.
    fn key(&self, what: &str, path: &Path) -> KeyOf {
        let mut key = KeyOf::stage(what);
        key.bytes(path.as_os_str().as_encoded_bytes());
        if let Some(root) = self.options.limits.root.folder() {
            key.bytes(root.as_os_str().as_encoded_bytes());
        }
        key
    }

    fn asset(&self, asset: &Asset) -> Result<Known<MeshFacts, MeshFile>, ImportError> {
        let path = self.beside(asset.path_span, &asset.path);
        let (reads, root) = (&self.session.reads, &self.options.limits.root);
        reads.read(&path);
        let key = self.asset_key(asset, &path);
        let known = self.stages.get::<MeshFacts>(key).filter(|facts| {
            let ImportReport { files, absent, .. } = &facts.report;
            files.iter().all(|file| reads.content(&file.path, root) == Some(file.hash))
                && absent.iter().all(|path| reads.content(path, root).is_none())
        });
        let found = if let Some(facts) = known {
            self.session.kept.touch(file_key(key, &facts.report));
            (facts, None)
        } else {
            let file = Arc::new(read_asset(asset, &path, self.options)?);
            let facts = MeshFacts::of(&file);
            self.stages.put(key, &facts);
            self.session.kept.put(file_key(key, &facts.report), &file);
            (facts, Some(file))
        };
        let ImportReport { files, absent, .. } = &found.0.report;
        if let Some(itself) = files.first().filter(|file| file.path == path) {
            reads.know(&path, itself.hash);
        }
        files.iter().map(|file| &file.path).chain(absent).for_each(|path| reads.read(path));
        Ok(found)
    }

    /// The file of an asset of which this is known.
    fn mesh(&self, asset: &Asset, facts: &MeshFacts) -> Result<Arc<MeshFile>, ImportError> {
        let path = self.beside(asset.path_span, &asset.path);
        let key = file_key(self.asset_key(asset, &path), &facts.report);
        if let Some(kept) = self.session.kept.get(key) {
            return Ok(kept);
        }
        let file = Arc::new(read_asset(asset, &path, self.options)?);
        unchanged(file.report == facts.report, &path)?;
        self.session.kept.put(key, &file);
        Ok(file)
    }

    fn asset_key(&self, asset: &Asset, path: &Path) -> Key {
        let mut key = self.key("mesh file", path);
        let (format, frame) = match &asset.format {
            AssetFormat::Obj(frame) => ("obj", Some(frame)),
            AssetFormat::Ply(frame) => ("ply", Some(frame)),
            AssetFormat::Stl(frame) => ("stl", Some(frame)),
            AssetFormat::Gltf(_) => ("gltf", None),
        };
        key.text(format);
        if let AssetFormat::Gltf(GltfChoice { time, animation, variant }) = &asset.format {
            key.floats(&time.map_or([0.0; 2], |time| [1.0, time]));
            for name in [animation, variant] {
                key.text(name.as_deref().unwrap_or_default()).number(name.is_some());
            }
        }
        if let Some(&FileFrame { metres_per_unit, up }) = frame {
            let up = match up {
                Axis::PlusX => 0_u32,
                Axis::MinusX => 1,
                Axis::PlusY => 2,
                Axis::MinusY => 3,
                Axis::PlusZ => 4,
                Axis::MinusZ => 5,
            };
            key.floats(&[metres_per_unit]).number(up);
        }
        key.end()
    }

    fn image(&self, span: Span, path: &str) -> Result<Known<ImageFacts, Image>, ImportError> {
        let path = self.beside(span, path);
        let load = || load_image(&path, &self.options.limits);
        self.whole_file(("image", &path), load, ImageFacts::of)
    }

    /// What is known of a file that is read by itself.
    fn whole_file<F: Serialize + DeserializeOwned, T>(
        &self,
        (what, path): (&str, &Path),
        load: impl FnOnce() -> Result<T, ImportError>,
        facts: impl FnOnce(&T) -> F,
    ) -> Result<Known<F, T>, ImportError> {
        self.session.reads.read(path);
        let content = self.session.reads.content(path, &self.options.limits.root);
        let mut key = self.key(what, path);
        let key = key.bytes(&content.unwrap_or_default()).end();
        if let Some(facts) = self.stages.get(key).filter(|_| content.is_some()) {
            return Ok((facts, None));
        }
        let file = load()?;
        let facts = facts(&file);
        self.stages.put(key, &facts);
        Ok((facts, Some(Arc::new(file))))
    }
}

/// The key of a file in memory, with all that was read for it.
fn file_key(key: Key, report: &ImportReport) -> Key {
    let mut of = KeyOf::stage("mesh file in memory");
    of.key(key);
    for file in &report.files {
        of.bytes(&file.hash);
    }
    of.end()
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
#[expect(clippy::type_complexity, reason = "a path and what is known of it")]
fn environment(
    origin: Origin<'_>,
    diagnostics: &mut Vec<Diagnostic>,
) -> Result<Option<(PathBuf, Known<EnvironmentFacts, Environment>)>, ImportError> {
    let Some((path, path_span, written)) = origin.sky() else { return Ok(None) };
    let load = || load_environment(&path, &origin.options.limits);
    let found = match origin.whole_file(("image of the sky", &path), load, EnvironmentFacts::of) {
        Ok(found) => found,
        Err(error) if error.kind == ErrorKind::Memory => return Err(error),
        Err(error) => {
            diagnostics.push(failed(&error, path_span, written));
            return Ok(None);
        }
    };
    let image = &found.0.image;
    if image.width != 2 * image.height {
        let (width, height) = (image.width, image.height);
        let message = format!(
            "`{written}` is {width} x {height} pixels; an image of all directions is twice as wide as high"
        );
        let warning = Diagnostic::warning(Code("W0528"), "sky_shape", message);
        diagnostics.push(warning.at(path_span, "it will look stretched"));
    }
    if !image.is_radiance {
        let message =
            format!("`{written}` is a picture, not radiance: its sun is no brighter than paper");
        let warning = Diagnostic::warning(Code("W0529"), "sky_picture", message)
            .at(path_span, "read with the sRGB curve")
            .with_help("use an HDR or EXR image");
        diagnostics.push(warning);
    }
    Ok(Some((path, found)))
}

fn read_asset(asset: &Asset, path: &Path, options: &Options<'_>) -> Result<MeshFile, ImportError> {
    match &asset.format {
        &AssetFormat::Obj(FileFrame { metres_per_unit, up }) => {
            load_obj(path, metres_per_unit, up, &options.limits)
        }
        &AssetFormat::Ply(FileFrame { metres_per_unit, up }) => {
            load_ply(path, metres_per_unit, up, &options.limits)
        }
        &AssetFormat::Stl(FileFrame { metres_per_unit, up }) => {
            load_stl(path, metres_per_unit, up, &options.limits)
        }
        AssetFormat::Gltf(choice) => load_gltf(path, choice, &options.limits),
    }
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
