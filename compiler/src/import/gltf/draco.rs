//! `KHR_draco_mesh_compression`: compressed primitives become the elements of their accessors.
//!
//! What accessors claim is the most that is decoded, and memory for it is asked for before; the decoder has the same
//! limits. What it gives is as long as the accessors say and of their types, so that everything else reads accessors as
//! it does without compression. Attributes that the extension does not list are stored as in any other file.

use super::super::error::{ErrorKind, ImportError, excerpt};
use super::super::file::Reader;
use super::super::guard;
use super::accessor::Buffers;
use super::document::Document;
use super::primitive;
use ::gltf::json::accessor::{Accessor, ComponentType};
use ::gltf::json::mesh::{Mode, Primitive};
use ::gltf::json::validation::Checked;
use ::gltf::json::{Index, Value};
use draco_core::{
    DataType, DecodeLimits, DecoderBuffer, ErrorKind as Reason, Mesh, MeshDecoder, PointAttribute,
    PointIndex,
};
use rayon::prelude::*;
use std::collections::BTreeMap;

/// Name of the extension.
pub(super) const NAME: &str = "KHR_draco_mesh_compression";

/// The elements of each accessor that is compressed, without gaps, by the index of the accessor.
pub(super) type Elements = BTreeMap<usize, Vec<u8>>;

/// What the decoder takes for each triangle while it works; 158 bytes were measured.
const WORK: u64 = 200;
/// The largest element of an attribute: four floats.
const LARGEST: u64 = 16;

/// A compressed primitive.
struct Stream<'a> {
    place: String,
    bytes: &'a [u8],
    /// Unique identifier of each attribute in the stream, and the accessor that it is for.
    attributes: Vec<(u32, Index<Accessor>)>,
    indices: Index<Accessor>,
    limits: DecodeLimits,
}

/// Decodes all compressed primitives.
pub(super) fn elements(
    buffers: &Buffers<'_>,
    reader: &mut Reader<'_>,
) -> Result<Elements, ImportError> {
    let streams = streams(buffers, reader)?;
    let decoded = streams.par_iter().map(|stream| stream.decode(buffers.document));
    let decoded: Result<Vec<_>, _> = decoded.collect();
    Ok(decoded?.into_iter().flatten().collect())
}

/// Finds them, and takes the memory that they need.
fn streams<'a>(
    buffers: &'a Buffers<'_>,
    reader: &mut Reader<'_>,
) -> Result<Vec<Stream<'a>>, ImportError> {
    let document = buffers.document;
    let (mut streams, mut n_triangles) = (Vec::new(), 0_u64);
    // Which buffer view an accessor is decoded from.
    let mut origins: BTreeMap<usize, u64> = BTreeMap::new();
    for (mesh_idx, mesh) in document.root.meshes.iter().enumerate() {
        for (primitive_idx, primitive) in mesh.primitives.iter().enumerate() {
            let extension = primitive.extensions.as_ref().and_then(|all| all.others.get(NAME));
            let Some(extension) = extension else { continue };
            let place = primitive::name(mesh_idx, primitive_idx);
            let (mut stream, view) = find(buffers, (primitive, extension), place)?;
            if stream.is_known(view, &mut origins, document)? {
                continue;
            }
            n_triangles = n_triangles.saturating_add(stream.limits.max_faces);
            let max = reader.limits.triangles;
            if n_triangles > max {
                let message =
                    format!("its meshes have {n_triangles} triangles, the limit is {max}");
                return Err(ImportError::new(ErrorKind::Limit, document.file, message));
            }
            reader.take(stream.claim(document)?, document.file)?;
            streams.push(stream);
        }
    }
    Ok(streams)
}

/// The stream of a primitive, and the index of its buffer view.
fn find<'a>(
    buffers: &'a Buffers<'_>,
    (primitive, extension): (&Primitive, &Value),
    place: String,
) -> Result<(Stream<'a>, u64), ImportError> {
    let fail = |kind, message: &str| buffers.document.error(kind, &place, message);
    let wrong = || fail(ErrorKind::Format, "it is not what KHR_draco_mesh_compression says");
    let index = |value: &Value| value.as_u64().and_then(|index| u32::try_from(index).ok());
    let view = extension.get("bufferView").and_then(index).ok_or_else(wrong)?;
    let listed = extension.get("attributes").and_then(Value::as_object).ok_or_else(wrong)?;
    let mut attributes = Vec::with_capacity(listed.len());
    // Attributes of applications, which nobody reads, have names that are not those of glTF.
    for (semantic, accessor) in &primitive.attributes {
        if let Checked::Valid(semantic) = semantic
            && let Some(id) = listed.get(&semantic.to_string())
        {
            attributes.push((index(id).ok_or_else(wrong)?, *accessor));
        }
    }
    if primitive.mode != Checked::Valid(Mode::Triangles) {
        return Err(fail(
            ErrorKind::Extension,
            "of meshes in Draco only lists of triangles are read",
        ));
    }
    let indices = primitive.indices.ok_or_else(|| fail(ErrorKind::Format, "it has no indices"))?;
    let (bytes, _) = buffers.view(Index::new(view), &place)?;
    let n_faces = Buffers::count(buffers.document, indices)? / 3;
    let limits = DecodeLimits::default().with_max_faces(n_faces);
    Ok((Stream { place, bytes, attributes, indices, limits }, view.into()))
}

impl Stream<'_> {
    /// Whether what it holds is decoded already, as another primitive has the same; notes it otherwise.
    fn is_known(
        &self,
        view: u64,
        origins: &mut BTreeMap<usize, u64>,
        document: &Document<'_>,
    ) -> Result<bool, ImportError> {
        let mut known = true;
        let attributes = self.attributes.iter().map(|(_, accessor)| *accessor);
        for accessor in attributes.chain([self.indices]) {
            let index = accessor.value();
            match origins.insert(index, view) {
                None => known = false,
                Some(before) if before == view => {}
                Some(_) => {
                    let message =
                        format!("accessor {index} belongs to another compressed primitive");
                    return Err(document.error(ErrorKind::Format, &self.place, message));
                }
            }
        }
        Ok(known)
    }

    /// Bytes that decoding takes at most; limits the decoder to them.
    fn claim(&mut self, document: &Document<'_>) -> Result<u64, ImportError> {
        let mut n_points = 0;
        for (_, accessor) in &self.attributes {
            n_points = n_points.max(Buffers::count(document, *accessor)?);
        }
        // Of what the stream holds beside what is asked for nothing is known: as much again.
        let n_values = n_points.saturating_mul(2 * self.attributes.len() as u64);
        let values = n_values.saturating_mul(LARGEST);
        self.limits = self.limits.with_max_points(n_points).with_max_decoded_bytes(values);
        let n_faces = self.limits.max_faces;
        Ok(values.saturating_mul(2).saturating_add(n_faces.saturating_mul(WORK)))
    }

    /// Its elements, by accessor.
    fn decode(&self, document: &Document<'_>) -> Result<Vec<(usize, Vec<u8>)>, ImportError> {
        let fail = |message: &str| document.error(ErrorKind::Accessor, &self.place, message);
        let mut mesh = Mesh::new();
        let decoded = guard::quietly(|| {
            let mut bytes = DecoderBuffer::new(self.bytes).with_limits(self.limits);
            MeshDecoder::new().decode(&mut bytes, &mut mesh)
        });
        match decoded {
            Some(Ok(())) => {}
            Some(Err(error)) if error.kind() == Reason::LimitExceeded => {
                return Err(fail("its compressed bytes hold more than its accessors say"));
            }
            Some(Err(error)) => {
                let text = excerpt(error.message().as_bytes());
                return Err(fail(&format!("its compressed bytes are damaged: {text}")));
            }
            None => return Err(fail("its compressed bytes are damaged: the decoder gave up")),
        }
        let mut elements = Vec::with_capacity(self.attributes.len() + 1);
        for (id, index) in &self.attributes {
            let accessor = accessor(document, *index)?;
            let attribute = mesh.attribute_by_unique_id(*id);
            let missing = || fail(&format!("its compressed bytes have no attribute {id}"));
            let values = values(&mesh, attribute.ok_or_else(missing)?, accessor);
            elements.push((index.value(), named(document, *index, values)?));
        }
        let indices = indices(&mesh, accessor(document, self.indices)?);
        elements.push((self.indices.value(), named(document, self.indices, indices)?));
        Ok(elements)
    }
}

fn accessor<'a>(
    document: &Document<'a>,
    index: Index<Accessor>,
) -> Result<&'a Accessor, ImportError> {
    named(document, index, document.root.get(index).ok_or_else(|| "it is not there".to_owned()))
}

fn named<T>(
    document: &Document<'_>,
    index: Index<Accessor>,
    result: Result<T, String>,
) -> Result<T, ImportError> {
    let what = || format!("accessor {}", index.value());
    result.map_err(|message| document.error(ErrorKind::Accessor, &what(), message))
}

/// One value a point, as the accessor says that they are stored.
fn values(mesh: &Mesh, attribute: &PointAttribute, accessor: &Accessor) -> Result<Vec<u8>, String> {
    let n_points = check_count(accessor, mesh.num_points())?;
    let (Checked::Valid(component), Checked::Valid(kind)) =
        (accessor.component_type, accessor.type_)
    else {
        return Err("its type or component type is not one of glTF".to_owned());
    };
    let n = usize::from(attribute.num_components());
    if component_type(attribute.data_type()) != Some(component.0) || n != kind.multiplicity() {
        let found = attribute.data_type();
        return Err(format!("its type is not that of its compressed bytes, {n} x {found:?}"));
    }
    let size = n * component.0.size();
    let stride = usize::try_from(attribute.byte_stride()).unwrap_or(size);
    let data = attribute.buffer().data();
    let mut out = Vec::with_capacity(n_points * size);
    for point in 0..n_points {
        let point = PointIndex(u32::try_from(point).unwrap_or(u32::MAX));
        let at = (attribute.mapped_index(point).0 as usize).checked_mul(stride);
        let value = at.and_then(|at| data.get(at..at.checked_add(size)?));
        out.extend_from_slice(value.ok_or("its compressed bytes lack some of its elements")?);
    }
    Ok(out)
}

fn component_type(stored: DataType) -> Option<ComponentType> {
    match stored {
        DataType::Int8 => Some(ComponentType::I8),
        DataType::Uint8 => Some(ComponentType::U8),
        DataType::Int16 => Some(ComponentType::I16),
        DataType::Uint16 => Some(ComponentType::U16),
        DataType::Uint32 => Some(ComponentType::U32),
        DataType::Float32 => Some(ComponentType::F32),
        // Not in glTF.
        DataType::Int32
        | DataType::Int64
        | DataType::Uint64
        | DataType::Float64
        | DataType::Bool
        | DataType::Invalid => None,
    }
}

/// Three indices a triangle, as the accessor says that they are stored.
fn indices(mesh: &Mesh, accessor: &Accessor) -> Result<Vec<u8>, String> {
    let n_indices = check_count(accessor, mesh.num_faces() * 3)?;
    let corners = mesh.faces().iter().flatten().map(|point| point.0);
    let too_wide = |_| "its component type is too small for its compressed bytes".to_owned();
    let mut out = Vec::with_capacity(n_indices * 4);
    match accessor.component_type {
        Checked::Valid(kind) if kind.0 == ComponentType::U8 => {
            for corner in corners {
                out.push(u8::try_from(corner).map_err(too_wide)?);
            }
        }
        Checked::Valid(kind) if kind.0 == ComponentType::U16 => {
            for corner in corners {
                out.extend(u16::try_from(corner).map_err(too_wide)?.to_le_bytes());
            }
        }
        Checked::Valid(_) | Checked::Invalid => out.extend(corners.flat_map(u32::to_le_bytes)),
    }
    Ok(out)
}

/// `found`, which must be what the accessor says.
fn check_count(accessor: &Accessor, found: usize) -> Result<usize, String> {
    let says = accessor.count.0;
    let message = || format!("it has {says} elements, and its compressed bytes hold {found}");
    if found as u64 == says { Ok(found) } else { Err(message()) }
}
