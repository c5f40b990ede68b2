//! Compiles a scene of which an earlier compilation made the geometry.
//!
//! After an edit of a camera, a film, a light's strength, a sky or the numbers of a material, everything that was
//! made of files (trees, triangles, texels) is the same. It is taken from the earlier pack, and only the rest is
//! made anew: no mesh or image is read. The pack has the same bytes as if everything had been made. Where there is
//! any doubt, everything is.

use std::sync::Arc;

use lang::diagnostic::Diagnostic;
use lang::scene::Scene;
use lang::source::SourceSet;
use pack::Pack;
use serde::{Deserialize, Serialize};

use super::essence::Essence;
use super::{Clock, CompileError, Compiled, FileRead, Options, link, manifest};
use crate::lower::{Sketch, lower_again};
use crate::reuse::{Reuse, Reused, Share};

/// What a compilation leaves for the next one, besides its pack.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Memory {
    /// What the geometry depends on, see `Essence`.
    geometry: [u8; 32],
    /// Names and hashes of the files that went into the pack.
    files: Vec<(String, [u8; 32])>,
    sketch: Sketch,
}

impl Memory {
    pub(super) fn new(essence: &Essence, files: &[FileRead], mut sketch: Sketch) -> Self {
        sketch.set_sky(&essence.sky);
        let files = files.iter().map(|file| (file.name.clone(), file.hash)).collect();
        Self { geometry: essence.geometry, files, sketch }
    }

    /// As bytes; `None` for numbers that cannot be written.
    #[must_use]
    pub fn encode(&self) -> Option<Vec<u8>> {
        bincode::serde::encode_to_vec(self, bincode::config::standard()).ok()
    }

    /// `None` for what is none.
    #[must_use]
    pub fn decode(bytes: &[u8]) -> Option<Self> {
        let config = bincode::config::standard();
        let (memory, used) = bincode::serde::decode_from_slice(bytes, config).ok()?;
        (used == bytes.len()).then_some(memory)
    }

    /// Whether the geometry of a scene is the one that is remembered, if its files are what they were.
    #[must_use]
    pub fn fits(&self, essence: &Essence) -> bool {
        essence.geometry == self.geometry
    }
}

/// Compiles a scene with an `essence` that `memory` fits; `earlier` is the pack that was made with it. `None` if
/// everything must be made; then `diagnostics` is as it was.
///
/// # Errors
/// When the kernel cannot be linked or proven, or the scene has errors.
pub fn compile_again(
    (scene, essence): (&Scene, &Essence),
    sources: &SourceSet,
    options: &Options<'_>,
    (earlier, memory): (&Arc<Pack>, Memory),
    reuse: &Reuse,
    diagnostics: &mut Vec<Diagnostic>,
) -> Result<Option<Compiled>, CompileError> {
    let mut clock = Clock::start();
    let mut found = Vec::new();
    let known = (earlier, &memory.sketch);
    let Some(mut lowered) = lower_again(scene, &essence.sky, known, &options.trees, &mut found)
    else {
        return Ok(None);
    };
    let failed = found.iter().any(Diagnostic::is_error);
    diagnostics.append(&mut found);
    if failed {
        return Err(CompileError::Scene);
    }
    reuse.keep_all();
    clock.phase("take over the geometry");
    let (features, kernel, size) = link(&lowered, reuse, Some(earlier.as_ref()))?;
    clock.phase("link and prove the kernel");
    let named = |(name, hash): (String, [u8; 32])| FileRead { name, hash };
    let files: Vec<FileRead> = memory.files.into_iter().map(named).collect();
    let context = manifest::Context { scene, sources, options, files: &files };
    let manifest = context.manifest(&lowered, &features, size);
    let recipe_id = context.recipe_id();
    let n_trees = lowered.trees.groups;
    let trees = Share { reused: n_trees, all: n_trees };
    let reused = Reused { texts: sources.ids().count(), geometry: true, trees, ..reuse.counts() };
    let memory = lowered.sketch.take().map(|sketch| Memory::new(essence, &files, sketch));
    let phases = clock.phases;
    let compiled =
        Compiled { lowered, features, kernel, manifest, recipe_id, files, memory, reused, phases };
    Ok(Some(compiled))
}
