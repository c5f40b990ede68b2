//! Compiles a scene of which an earlier compilation made the geometry.
//!
//! After an edit of a camera, a film, a light's strength, a sky or the numbers of a material, everything that was
//! made of files (trees, triangles, texels) is the same. It is taken from the earlier pack, and only the rest is
//! made anew: no mesh or image is read. The pack has the same bytes as if everything had been made. Where there is
//! any doubt, everything is. Where only things stand elsewhere, the triangles of all others are taken from the earlier
//! pack.

use std::sync::Arc;

use lang::diagnostic::Diagnostic;
use lang::scene::Scene;
use lang::source::SourceSet;
use pack::Pack;
use serde::{Deserialize, Serialize};

use super::essence::Essence;
use super::{Clock, CompileError, Compiled, FileRead, Made, Options, complete, load};
use crate::cache::Cache;
use crate::lower::{Left, Lowered, Roster, Sketch, files_of_moved, lower_again, lower_moved};
use crate::reuse::{Geometry, Reuse};

/// What a compilation leaves for the next one, besides its pack.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Memory {
    /// What the geometry depends on, see `Essence`.
    geometry: [u8; 32],
    /// The same without where things stand.
    placeless: [u8; 32],
    /// Names and hashes of the files that went into the pack.
    files: Vec<(String, [u8; 32])>,
    sketch: Sketch,
    /// Name of what is remembered of each thing.
    roster: [u8; 32],
}

/// What is remembered of each thing, to be kept under its name.
#[derive(Debug)]
pub struct EncodedRoster {
    name: [u8; 32],
    bytes: Vec<u8>,
}

impl EncodedRoster {
    fn new(roster: &Roster) -> Option<Self> {
        let bytes = bincode::serde::encode_to_vec(roster, bincode::config::standard()).ok()?;
        Some(Self { name: *blake3::hash(&bytes).as_bytes(), bytes })
    }

    /// Stores it in the cache.
    pub fn store(&self, cache: &Cache) {
        // Without it moving things costs more.
        let _ = cache.store_record(&blake3::Hash::from(self.name), &self.bytes);
    }
}

impl Memory {
    /// What is left, and what is remembered of each thing where that is new; else it is that of an `earlier` one.
    pub(super) fn of(
        essence: &Essence,
        files: &[FileRead],
        lowered: &mut Lowered,
        earlier: Option<&Self>,
    ) -> (Option<Self>, Option<EncodedRoster>) {
        let (sketch, roster) = (lowered.sketch.take(), lowered.roster.take());
        let roster = roster.as_ref().and_then(EncodedRoster::new);
        let before = earlier.map(|memory| memory.roster);
        let name = roster.as_ref().map(|roster| roster.name).or(before).unwrap_or_default();
        let memory = sketch.map(|mut sketch| {
            sketch.set_sky(&essence.sky);
            let files = files.iter().map(|file| (file.name.clone(), file.hash)).collect();
            let Essence { geometry, placeless, .. } = *essence;
            Self { geometry, placeless, files, sketch, roster: name }
        });
        (memory, roster)
    }

    /// What is remembered of each thing.
    fn roster(&self, cache: &Cache) -> Option<Roster> {
        let name = blake3::Hash::from(self.roster);
        let bytes = cache.record(&name).filter(|bytes| blake3::hash(bytes) == name)?;
        let config = bincode::config::standard();
        let (roster, used) = bincode::serde::decode_from_slice(&bytes, config).ok()?;
        (used == bytes.len()).then_some(roster)
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

    /// Whether the geometry of a scene is the one that is remembered, or things of it elsewhere, if its files are what
    /// they were.
    #[must_use]
    pub fn fits(&self, essence: &Essence) -> bool {
        essence.placeless == self.placeless
    }

    /// Whether everything is where it was.
    fn stays(&self, essence: &Essence) -> bool {
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
    (earlier, memory): (&Arc<Pack>, &Memory),
    reuse: &Reuse,
    diagnostics: &mut Vec<Diagnostic>,
) -> Result<Option<Compiled>, CompileError> {
    let mut clock = Clock::start();
    let mut found = Vec::new();
    let stays = memory.stays(essence);
    let lowered = if stays {
        let known = (earlier, &memory.sketch);
        lower_again(scene, &essence.sky, known, &options.trees, &mut found)
    } else {
        moved((scene, essence), sources, options, (earlier, memory), reuse, &mut found)
    };
    let Some(lowered) = lowered else { return Ok(None) };
    let failed = found.iter().any(Diagnostic::is_error);
    diagnostics.append(&mut found);
    if failed {
        return Err(CompileError::Scene);
    }
    reuse.keep_all();
    if stays {
        clock.phase("take over the geometry");
    } else {
        clock.times(&lowered.times);
    }
    let named = |(name, hash): &(String, [u8; 32])| FileRead { name: name.clone(), hash: *hash };
    let files = memory.files.iter().map(named).collect();
    let geometry = if stays { Geometry::All } else { Geometry::OfOthers };
    let made = Made { lowered, files, geometry, earlier: Some((earlier.as_ref(), memory)) };
    complete((scene, essence), sources, options, reuse, made, clock).map(Some)
}

/// Lowers a scene in which things stand elsewhere. `None` if everything must be made, or to say what is wrong.
fn moved(
    (scene, essence): (&Scene, &Essence),
    sources: &SourceSet,
    options: &Options<'_>,
    (pack, memory): (&Arc<Pack>, &Memory),
    reuse: &Reuse,
    found: &mut Vec<Diagnostic>,
) -> Option<Lowered> {
    let roster = memory.roster(options.trees.cache)?;
    let needed = files_of_moved(scene, &roster, &options.trees)?;
    let loaded = load::load_meshes(scene, sources, options, reuse, &needed)?;
    let left = Left { pack, sketch: &memory.sketch, roster: &roster };
    let lowered = lower_moved(scene, &essence.sky, &loaded, left, &options.trees, found)?.ok()?;
    found.iter().all(|diagnostic| !diagnostic.is_error()).then_some(lowered)
}
