//! Parts of a mesh file → what is worked out from their triangles, cached from one compilation to the next.

use glam::DVec3;
use lang::scene::Parts;
use serde::Serialize;
use serde::de::DeserializeOwned;

use super::files::Files;
use super::geometry::transform::Transform;
use crate::import::{ImportError, Part};
use crate::stage::{KeyOf, Stages};

/// What `measure` finds out about the parts of an asset that a shape shows; cached as `stage`. Beside the parts it may
/// depend on `numbers` only.
///
/// # Errors
/// When the file cannot be loaded.
pub(super) fn of_parts<T: Serialize + DeserializeOwned>(
    stage: &str,
    (asset, parts): (usize, &Parts),
    numbers: &[f64],
    (files, stages): (&dyn Files, &Stages),
    measure: impl FnOnce(&[&Part]) -> T,
) -> Result<T, ImportError> {
    let facts = &files.assets()[asset];
    let parts = facts.chosen(parts);
    let mut key = KeyOf::stage(stage);
    for part in &parts {
        key.bytes(&facts.parts[*part].content);
    }
    key.floats(numbers);
    stages.try_value(key.end(), || {
        let meshes = files.load_meshes(&[asset].into())?;
        let parts: Vec<_> = parts.iter().map(|part| &meshes[&asset].parts[*part]).collect();
        Ok(measure(&parts))
    })
}

/// The corners of each triangle of a part where `transform` puts it.
pub(super) fn placed(part: &Part, transform: &Transform) -> impl Iterator<Item = [DVec3; 3]> {
    let point = |p: [f32; 3]| transform.point(DVec3::from(p.map(f64::from)));
    (0..part.triangles.len()).map(move |i| part.corners(i).map(point))
}
