//! Where everything is and how much of it there is: for people who look for it.

use std::collections::BTreeMap;

use lang::scene::{Scene, Shape};

use super::bounds::{self, Bounds};
use super::files::Files;
use crate::import::ImportError;

/// A thing, or a part of one.
#[derive(Clone, Debug, PartialEq)]
pub struct Listed {
    /// Its name in the scene; of a part in its file.
    pub name: String,
    /// The box around it: of instances and lights in the world, of assets and parts in their file, metres.
    pub bounds: Option<Bounds>,
    /// `None` for a sphere.
    pub triangles: Option<u64>,
}

/// Everything that a scene shows.
#[derive(Clone, Debug, PartialEq)]
pub struct Listing {
    /// All of it; the triangles are those of all instances.
    pub world: Listed,
    /// Mesh files, each with its parts.
    pub assets: Vec<(Listed, Vec<Listed>)>,
    /// Things in the world, in the order of the scene.
    pub instances: Vec<Listed>,
    /// Sphere lights.
    pub lights: Vec<Listed>,
}

/// Lists a scene. Boxes of instances are as tight as they can be.
///
/// # Errors
/// When a mesh cannot be loaded.
pub fn listing(scene: &Scene, files: &dyn Files) -> Result<Listing, ImportError> {
    let facts = files.assets();
    let mut by_asset: BTreeMap<Option<usize>, Vec<usize>> = BTreeMap::new();
    for (index, instance) in scene.instances.iter().enumerate() {
        let asset = match &instance.shape {
            Shape::Mesh { asset, .. } => Some(*asset),
            Shape::Sphere { .. }
            | Shape::Rectangle { .. }
            | Shape::Quad { .. }
            | Shape::Box { .. }
            | Shape::Faces { .. } => None,
        };
        by_asset.entry(asset).or_default().push(index);
    }
    let mut found = vec![None; scene.instances.len()];
    for (asset, of_asset) in by_asset {
        // One file after the other: only one has to be in memory.
        let meshes = files.load_meshes(&asset.into_iter().collect())?;
        for index in of_asset {
            found[index] = bounds::tight(&scene.instances[index], facts, &meshes);
        }
        drop(meshes);
        files.release();
    }
    let instances: Vec<Listed> = scene
        .instances
        .iter()
        .zip(found)
        .map(|(instance, bounds)| Listed {
            name: instance.name.text.clone(),
            bounds,
            triangles: bounds::triangles(instance, facts),
        })
        .collect();
    let lights = scene.lights.iter().map(|light| Listed {
        name: light.name.text.clone(),
        bounds: Bounds::of_sphere(light.center, light.radius),
        triangles: None,
    });
    let lights: Vec<Listed> = lights.collect();
    let all = instances.iter().chain(&lights).filter_map(|listed| listed.bounds);
    let world = Listed {
        name: String::new(),
        bounds: Bounds::union(all),
        triangles: Some(instances.iter().filter_map(|listed| listed.triangles).sum()),
    };
    Ok(Listing { world, assets: assets(scene, files), instances, lights })
}

fn assets(scene: &Scene, files: &dyn Files) -> Vec<(Listed, Vec<Listed>)> {
    let list = scene.assets.iter().zip(files.assets());
    list.map(|(asset, facts)| {
        let part = |part: &crate::import::PartFacts| Listed {
            name: part.name.clone(),
            bounds: Bounds::of(part.bounds.map(|corner| corner.map(f64::from))),
            triangles: Some(part.n_triangles as u64),
        };
        let parts: Vec<Listed> = facts.parts.iter().map(part).collect();
        let all = Listed {
            name: asset.name.text.clone(),
            bounds: Bounds::union(parts.iter().filter_map(|part| part.bounds)),
            triangles: Some(parts.iter().filter_map(|part| part.triangles).sum()),
        };
        (all, parts)
    })
    .collect()
}
