//! `EXT_mesh_gpu_instancing`: the mesh of a node at many places.
//!
//! Turns the accessors of the extension into a matrix for each place, in the frame of the node. Attributes of instances
//! beside translation, rotation and scale are for programs, and not read.

use super::super::error::{ErrorKind, ImportError};
use super::super::file::Reader;
use super::accessor::Buffers;
use super::matrix::{Matrix, from_parts};
use ::gltf::json::{Accessor, Index, Node};

/// Name of the extension.
pub(super) const NAME: &str = "EXT_mesh_gpu_instancing";
/// Most places of one node; each becomes a part.
const MAX_INSTANCES: u64 = 1 << 20;

/// Where the mesh of `node`, which is `what`, is to be; `None` where it has one place, its own.
pub(super) fn matrices(
    buffers: &Buffers<'_>,
    node: &Node,
    what: &str,
    reader: &mut Reader<'_>,
) -> Result<Option<Vec<Matrix>>, ImportError> {
    let document = buffers.document;
    let extension = node.extensions.as_ref().and_then(|all| all.others.get(NAME));
    let Some(extension) = extension else { return Ok(None) };
    let fail = |kind, message: &str| document.error(kind, what, message);
    let accessor = |name: &str| -> Result<Option<Index<Accessor>>, ImportError> {
        let Some(value) = extension.get("attributes").and_then(|all| all.get(name)) else {
            return Ok(None);
        };
        let index = value.as_u64().and_then(|index| u32::try_from(index).ok());
        let index = index.ok_or_else(|| {
            fail(ErrorKind::Format, &format!("{name} of its instances is no accessor"))
        })?;
        Ok(Some(Index::new(index)))
    };
    let [translation, rotation, scale] =
        [accessor("TRANSLATION")?, accessor("ROTATION")?, accessor("SCALE")?];
    let Some(first) = translation.or(rotation).or(scale) else {
        let message = "its instances have neither TRANSLATION nor ROTATION nor SCALE";
        return Err(fail(ErrorKind::Format, message));
    };
    let count = Buffers::count(document, first)?;
    if count > MAX_INSTANCES {
        let message = format!("it has {count} instances, the limit is {MAX_INSTANCES}");
        return Err(fail(ErrorKind::Limit, &message));
    }
    // Numbers, a matrix, and the place that is made of it.
    reader.take(count * (40 + 3 * size_of::<Matrix>() as u64), document.file)?;
    let translations = column::<3>(buffers, translation, count, [0.0; 3])?;
    let rotations = column::<4>(buffers, rotation, count, [0.0, 0.0, 0.0, 1.0])?;
    let scales = column::<3>(buffers, scale, count, [1.0; 3])?;
    let places = translations.iter().zip(&rotations).zip(&scales).enumerate();
    let matrix = |(i, ((translation, rotation), scale)): (usize, ((&_, &_), &_))| {
        from_parts(translation, rotation, scale).ok_or_else(|| {
            fail(ErrorKind::Number, &format!("the rotation of its instance {i} is none"))
        })
    };
    places.map(matrix).collect::<Result<_, _>>().map(Some)
}

/// The numbers of an attribute, `usual` for every instance where it is not there.
fn column<const N: usize>(
    buffers: &Buffers<'_>,
    index: Option<Index<Accessor>>,
    count: u64,
    usual: [f32; N],
) -> Result<Vec<[f32; N]>, ImportError> {
    let n = usize::try_from(count).unwrap_or(usize::MAX);
    let Some(index) = index else { return Ok(vec![usual; n]) };
    let found = Buffers::count(buffers.document, index)?;
    if found != count {
        let what = format!("accessor {}", index.value());
        let message = format!("it has {found} elements, but there are {count} instances");
        return Err(buffers.document.error(ErrorKind::Accessor, &what, message));
    }
    buffers.floats::<N>(index)
}
