//! Packs of examples, compiled once and gone when the program ends.

use std::collections::BTreeMap;
use std::error::Error;
use std::path::PathBuf;

use compiler::bvh::Layout;
use runtime::Scene;
use tempfile::TempDir;

use crate::{mapped, scene};

/// Those that were asked for.
pub struct Packs {
    folder: TempDir,
    made: BTreeMap<(&'static str, &'static str), PathBuf>,
}

impl Packs {
    pub(super) fn new() -> std::io::Result<Self> {
        Ok(Self { folder: tempfile::tempdir()?, made: BTreeMap::new() })
    }

    /// The pack of an example at its full extent.
    pub(super) fn of(
        &mut self,
        name: &'static str,
        layout: Layout,
    ) -> Result<PathBuf, Box<dyn Error>> {
        if let Some(path) = self.made.get(&(name, layout.name())) {
            return Ok(path.clone());
        }
        let example = scenes::catalog::find(name).ok_or("there is no such example")?;
        let path = self.folder.path().join(format!("{name}-{layout}.pack"));
        std::fs::write(&path, scene::bytes(&scene::full_example(example, &[], layout)))?;
        self.made.insert((name, layout.name()), path.clone());
        Ok(path)
    }

    /// The same, opened.
    pub(super) fn scene(
        &mut self,
        name: &'static str,
        layout: Layout,
    ) -> Result<Scene, Box<dyn Error>> {
        Ok(Scene::new(mapped::map(self.of(name, layout)?)?))
    }
}
