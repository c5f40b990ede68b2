//! A checked scene becomes a pack: files are read, the scene lowered, the kernel linked and proven.
//!
//! It does not parse, print, or decide where the pack goes.

mod explain;
mod features;
mod files;
mod findings;
mod manifest;
mod options;
mod session;

use std::time::{Duration, Instant};

use lang::diagnostic::Diagnostic;
use lang::scene::Scene;
use lang::source::SourceSet;
use pack::manifest::KernelSize;
use pack::{PackError, PackWriter};
use shaders::{FeatureSet, LayoutError, Linked, ShaderError};

use crate::import::{ImportError, MeshFacts};
use crate::lower::{self, Files as _, Listing, LowerError, Lowered, Rows};
use crate::stage::{KeyOf, Share, Stages};
use files::{Origin, SceneFiles};

pub use files::FileRead;
pub use options::Options;
pub use session::Session;

/// A phase and what it took.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Phase {
    /// What was done.
    pub name: &'static str,
    /// Wall time.
    pub time: Duration,
}

/// Everything that goes into a pack.
#[derive(Debug)]
pub struct Compiled {
    /// The records.
    pub lowered: Lowered,
    /// What the kernel must be able to do.
    pub features: FeatureSet,
    /// The kernel.
    pub kernel: Linked,
    /// Names and places, for people.
    pub manifest: pack::Manifest,
    /// Name of the inputs: files, options and compiler version.
    pub recipe_id: [u8; 32],
    /// Files that were read besides the scene texts.
    pub files: Vec<FileRead>,
    /// The mapped pack that some of it was taken from; it must not have changed when a pack is written of it.
    pub source: Option<pack::Witness>,
    /// What was known from earlier compilations.
    pub reused: Reused,
    /// What took how long.
    pub phases: Vec<Phase>,
}

/// How much of a pack earlier compilations had made.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Reused {
    /// Texts, all of which are read again.
    pub texts: usize,
    /// Mesh files, and what they hold.
    pub meshes: Share,
    /// Image files, and what they hold.
    pub images: Share,
    /// Sections.
    pub lowered: lower::Reused,
    /// Trees.
    pub trees: Share,
    /// The proof of the kernel.
    pub kernel: Share,
}

/// Why there is no pack, apart from faults in the scene's text or files.
#[derive(Debug, thiserror::Error)]
pub enum CompileError {
    /// The scene has errors; they are among the diagnostics.
    #[error("the scene has errors")]
    Scene,
    /// There is no memory for a file of the scene.
    #[error(transparent)]
    Memory(#[from] ImportError),
    /// The scene is too large for the format.
    #[error(transparent)]
    Lower(#[from] LowerError),
    /// The kernel could not be linked or is not valid: a bug of ours, or too many bindings.
    #[error(transparent)]
    Shader(#[from] ShaderError),
    /// The kernel reads other bytes than the compiler writes: a bug of ours.
    #[error(transparent)]
    Layout(#[from] LayoutError),
    /// The pack could not be put together or written.
    #[error(transparent)]
    Pack(#[from] PackError),
}

/// Compiles a scene. Faults in its files and warnings are added to `diagnostics`.
///
/// # Errors
/// `CompileError::Scene` when `diagnostics` has errors; otherwise what stopped the compiler.
pub fn compile(
    scene: &Scene,
    sources: &SourceSet,
    options: &Options<'_>,
    diagnostics: &mut Vec<Diagnostic>,
) -> Result<Compiled, CompileError> {
    let (session, stages) = (Session::once(), Stages::new());
    compile_after((scene, sources), options, (&session, &stages), diagnostics)
}

/// As `compile`, with what earlier compilations left. The pack has the same bytes.
///
/// # Errors
/// As those of `compile`.
pub fn compile_after(
    (scene, sources): (&Scene, &SourceSet),
    options: &Options<'_>,
    (session, stages): (&Session, &Stages),
    diagnostics: &mut Vec<Diagnostic>,
) -> Result<Compiled, CompileError> {
    let mut clock = Clock::start();
    let origin = Origin { scene, sources, options, session, stages };
    let Some((found, files, counts)) = SceneFiles::new(origin, diagnostics)? else {
        return Err(CompileError::Scene);
    };
    clock.phase("read files");
    let edited = lower::edited(scene, found.assets(), diagnostics);
    if diagnostics.iter().any(Diagnostic::is_error) {
        return Err(CompileError::Scene);
    }
    let scene = edited.as_ref().unwrap_or(scene);
    let complete = lower::of_files(scene, found.assets(), diagnostics);
    if diagnostics.iter().any(Diagnostic::is_error) {
        return Err(CompileError::Scene);
    }
    let scene = complete.as_ref().unwrap_or(scene);
    let framed = lower::framed(scene, found.assets(), diagnostics);
    if scene.camera.fit.is_some() && framed.is_none() {
        return Err(CompileError::Scene);
    }
    let scene = framed.as_ref().unwrap_or(scene);
    let sunny = lower::with_sun(scene);
    let scene = sunny.as_ref().unwrap_or(scene);
    let lowered = lower::lower(scene, &found, &options.trees, stages, diagnostics)?;
    drop(found);
    if diagnostics.iter().any(Diagnostic::is_error) {
        return Err(CompileError::Scene);
    }
    clock.times(&lowered.times);
    let mut reused = Reused {
        texts: sources.ids().count(),
        meshes: counts.meshes,
        images: counts.images,
        lowered: lowered.reused,
        trees: Share { reused: lowered.trees.loaded, all: lowered.trees.groups },
        kernel: Share::default(),
    };
    let features = features::of(&lowered);
    let kernel = shaders::link(&features)?;
    let key = KeyOf::stage("kernel").text(&kernel.text).end();
    reused.kernel.count(stages.get::<KernelSize>(key).is_some());
    let size = stages.try_value(key, || prove(&kernel))?;
    clock.phase("link and prove the kernel");
    let context = manifest::Context { scene, sources, options, files: &files };
    let manifest = context.manifest(&lowered, &features, size);
    let recipe_id = context.recipe_id();
    let source = stages.pack().and_then(|pack| pack.witness());
    let phases = clock.phases;
    Ok(Compiled { lowered, features, kernel, manifest, recipe_id, files, source, reused, phases })
}

/// Where everything in a scene is. Faults in its files are added to `diagnostics`.
///
/// # Errors
/// As those of `compile`.
pub fn list(
    (scene, sources): (&Scene, &SourceSet),
    options: &Options<'_>,
    diagnostics: &mut Vec<Diagnostic>,
) -> Result<Listing, CompileError> {
    let (session, stages) = (Session::once(), Stages::new());
    let origin = Origin { scene, sources, options, session: &session, stages: &stages };
    match SceneFiles::new(origin, diagnostics)? {
        Some((found, _, _)) => {
            let edited = lower::edited(scene, found.assets(), diagnostics);
            if diagnostics.iter().any(Diagnostic::is_error) {
                return Err(CompileError::Scene);
            }
            Ok(lower::listing(edited.as_ref().unwrap_or(scene), &found)?)
        }
        None => Err(CompileError::Scene),
    }
}

/// What is known of the mesh files of a scene, in the order of `Scene::assets`. Faults and warnings are added to
/// `diagnostics`.
///
/// # Errors
/// `CompileError::Scene` when `diagnostics` has errors, or what kept a file from being read.
pub fn assets(
    (scene, sources): (&Scene, &SourceSet),
    options: &Options<'_>,
    diagnostics: &mut Vec<Diagnostic>,
) -> Result<Vec<MeshFacts>, CompileError> {
    let (session, stages) = (Session::once(), Stages::new());
    let origin = Origin { scene, sources, options, session: &session, stages: &stages };
    let found = SceneFiles::new(origin, diagnostics)?;
    found.map_or(Err(CompileError::Scene), |(found, _, _)| Ok(found.assets().to_vec()))
}

/// Whether the kernel is valid and reads what the compiler writes; then its size.
fn prove(kernel: &Linked) -> Result<KernelSize, CompileError> {
    let (module, info) = shaders::validate(kernel)?;
    shaders::check_layouts(&module)?;
    let words = shaders::spirv_words(&module, &info)?;
    Ok(KernelSize { lines: KernelSize::lines_of(&kernel.text), words })
}

/// The size of the kernel that renders any scene.
///
/// # Errors
/// When it cannot be linked or is not valid: a bug of ours.
pub fn full_kernel_size() -> Result<KernelSize, CompileError> {
    prove(&shaders::link(&FeatureSet::full())?)
}

impl Compiled {
    /// A writer over everything; write it to a file or to memory.
    ///
    /// # Errors
    /// When the manifest is too large.
    pub fn writer<'a>(&'a self, srgb: &'a [f32; 256]) -> Result<PackWriter<'a>, PackError> {
        let lowered = &self.lowered;
        let mut writer = PackWriter::new();
        writer.record(&lowered.render).record(&lowered.camera);
        if let Some(sky) = &lowered.sky {
            writer.record(sky);
        }
        let kept = [
            lowered.nodes.section(),
            lowered.wide_nodes.section(),
            lowered.triangles.section(),
            lowered.shades.section(),
            lowered.vertex_colors.section(),
            lowered.texels.section(),
        ];
        for section in kept.into_iter().flatten() {
            writer.section(section);
        }
        writer
            .records(made(&lowered.nodes))
            .records(made(&lowered.wide_nodes))
            .records(made(&lowered.triangles))
            .records(made(&lowered.shades))
            .records(made(&lowered.vertex_colors))
            .texels(made(&lowered.texels))
            .records(&lowered.spheres)
            .records(&lowered.materials)
            .records(&lowered.objects)
            .records(&lowered.links)
            .records(&lowered.motion)
            .records(&lowered.camera_keys)
            .records(&lowered.instances)
            .records(&lowered.media)
            .records(&lowered.lights)
            .records(&lowered.light_nodes)
            .records(&lowered.textures)
            .sky_table(&lowered.sky_table)
            .albedo(&lowered.albedo)
            .kernel(&self.kernel.text)
            .recipe_id(self.recipe_id)
            .taken_from(self.source.clone());
        let format = pack::abi::TextureFormat::Rgba8Srgb as u32;
        if lowered.textures.iter().any(|texture| texture.format == format) {
            writer.srgb_table(srgb);
        }
        writer.manifest(&self.manifest)?;
        Ok(writer)
    }
}

/// The records that are not those of an earlier pack.
fn made<T>(rows: &Rows<T>) -> &[T] {
    match rows {
        Rows::Made(rows) => rows,
        Rows::Kept(_) => &[],
    }
}

/// Collects phases.
struct Clock {
    last: Instant,
    phases: Vec<Phase>,
}

impl Clock {
    fn start() -> Self {
        Self { last: Instant::now(), phases: Vec::new() }
    }

    fn phase(&mut self, name: &'static str) {
        let now = Instant::now();
        self.phases.push(Phase { name, time: now - self.last });
        self.last = now;
    }

    fn times(&mut self, times: &lower::Times) {
        for (name, time) in [
            ("place and weld geometry", times.geometry),
            ("build or fetch trees", times.bvh),
            ("put primitives in leaf order", times.order),
        ] {
            self.phases.push(Phase { name, time });
        }
        self.last = Instant::now();
    }
}
