//! Materials and cameras that are like those of mesh files become ordinary ones: what a declaration does not say is taken
//! from the file. All that is done with declared materials and cameras then holds for them.
//!
//! It knows of a file what is known without its triangles and texels.

mod camera;
mod material;
mod named;

use lang::diagnostic::Diagnostic;
use lang::scene::Scene;

use crate::import::MeshFacts;

/// The scene in which nothing is like something of a file any more; `None` where nothing is. Faults go to `diagnostics`.
pub fn of_files(
    scene: &Scene,
    assets: &[MeshFacts],
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<Scene> {
    let has_materials = scene.materials.iter().any(|material| material.of_file.is_some());
    if !has_materials && scene.camera.of_file.is_none() {
        return None;
    }
    let mut complete = scene.clone();
    if let Some(of_file) = &scene.camera.of_file {
        match camera::complete(scene, of_file, &assets[of_file.base.asset]) {
            Ok(camera) => complete.camera = camera,
            Err(error) => diagnostics.push(*error),
        }
    }
    if has_materials {
        material::complete(&mut complete, assets, diagnostics);
    }
    Some(complete)
}
