//! Accessors become plain arrays, each byte range checked before it is read.

use super::super::error::{ErrorKind, ImportError};
use super::document::Document;
use ::gltf::json::Index;
use ::gltf::json::accessor::{Accessor, ComponentType, Type, sparse};
use ::gltf::json::buffer::View;
use ::gltf::json::validation::Checked;
use std::borrow::Cow;
use std::collections::BTreeMap;

/// Most elements of a sparse accessor without base values: nothing in the file pays for them.
const MAX_ZEROS: usize = 1 << 24;

/// The bytes of all buffers of a file.
pub(super) struct Buffers<'a> {
    pub(super) document: &'a Document<'a>,
    pub(super) data: Vec<Option<Cow<'a, [u8]>>>,
    /// Of buffer views that are compressed, what they hold.
    pub(super) views: Vec<Option<Vec<u8>>>,
    /// Of accessors that are compressed, their elements without gaps.
    pub(super) elements: BTreeMap<usize, Vec<u8>>,
}

/// Elements of one accessor in a byte range that holds them all.
struct Elements<'a> {
    bytes: &'a [u8],
    stride: usize,
    size: usize,
    count: usize,
}

impl<'a> Elements<'a> {
    fn iter(&self) -> impl Iterator<Item = &'a [u8]> {
        let (bytes, stride, size) = (self.bytes, self.stride, self.size);
        (0..self.count).map(move |i| &bytes[i * stride..i * stride + size])
    }
}

type Failure = (ErrorKind, String);

fn failure<T>(message: impl Into<String>) -> Result<T, Failure> {
    Err((ErrorKind::Accessor, message.into()))
}

impl Buffers<'_> {
    /// The bytes of a buffer view, and the stride that it says.
    pub(super) fn view(
        &self,
        index: Index<View>,
        what: &str,
    ) -> Result<(&[u8], Option<usize>), ImportError> {
        self.try_view(index).map_err(|(kind, message)| self.document.error(kind, what, message))
    }

    fn try_view(&self, index: Index<View>) -> Result<(&[u8], Option<usize>), Failure> {
        let view_idx = index.value();
        let Some(view) = self.document.root.get(index) else {
            return failure(format!("there is no buffer view {view_idx}"));
        };
        let stride = view.byte_stride.as_ref().map(|stride| stride.0).filter(|stride| *stride > 0);
        if let Some(Some(decoded)) = self.views.get(view_idx) {
            return Ok((decoded, stride));
        }
        let buffer_idx = view.buffer.value();
        let Some(Some(bytes)) = self.data.get(buffer_idx) else {
            return failure(format!(
                "buffer view {view_idx}: there are no bytes of buffer {buffer_idx}"
            ));
        };
        let offset = view.byte_offset.map_or(0, |offset| offset.0);
        let range = range(offset, view.byte_length.0).and_then(|range| bytes.get(range));
        let Some(range) = range else {
            let (length, total) = (view.byte_length.0, bytes.len());
            return failure(format!(
                "buffer view {view_idx}: {length} bytes from {offset} are not inside buffer \
                 {buffer_idx} of {total} bytes"
            ));
        };
        Ok((range, stride))
    }

    /// Floats with `N` components, each finite. Normalised integers become 0..1 or -1..1.
    pub(super) fn floats<const N: usize>(
        &self,
        index: Index<Accessor>,
    ) -> Result<Vec<[f32; N]>, ImportError> {
        let read = || {
            let accessor = self.find(index)?;
            let (component, size) = element_size(accessor, N)?;
            if component == ComponentType::U32 {
                return failure("32-bit integers where floats are expected");
            }
            let convert = Convert { component, normalized: accessor.normalized };
            let decode = |bytes: &[u8]| convert.element::<N>(bytes);
            let base = self.base((index, accessor), size)?;
            let mut values: Vec<[f32; N]> = match base {
                Some(base) => base.iter().map(decode).collect(),
                None => vec![[0.0; N]; count_of(accessor)?],
            };
            if let Some(sparse) = &accessor.sparse {
                self.overlay(sparse, size, &mut values, decode)?;
            }
            let broken = values.iter().position(|value| !value.iter().all(|x| x.is_finite()));
            match broken {
                Some(i) => Err((ErrorKind::Number, format!("element {i} is not finite"))),
                None => Ok(values),
            }
        };
        self.named(index, read())
    }

    /// `N` indices of vertices or joints, each below `below`; `things`: what there are so many of.
    pub(super) fn indices<const N: usize>(
        &self,
        index: Index<Accessor>,
        below: usize,
        things: &str,
    ) -> Result<Vec<[u32; N]>, ImportError> {
        let read = || {
            let accessor = self.find(index)?;
            let (component, size) = element_size(accessor, N)?;
            let each = component.size();
            let decode =
                |bytes: &[u8]| std::array::from_fn(|i| unsigned(&bytes[i * each..(i + 1) * each]));
            if !matches!(component, ComponentType::U8 | ComponentType::U16 | ComponentType::U32) {
                return failure("indices must be unsigned integers");
            }
            let base = self.base((index, accessor), size)?;
            let mut values: Vec<[u32; N]> = match base {
                Some(base) => base.iter().map(decode).collect(),
                None => vec![[0; N]; count_of(accessor)?],
            };
            if let Some(sparse) = &accessor.sparse {
                self.overlay(sparse, size, &mut values, decode)?;
            }
            let outside = values.iter().flatten().position(|value| *value as usize >= below);
            match outside {
                Some(at) => {
                    let (i, value) = (at / N, values[at / N][at % N]);
                    let message = format!("element {i} is {value}, but there are {below} {things}");
                    Err((ErrorKind::Index, message))
                }
                None => Ok(values),
            }
        };
        self.named(index, read())
    }

    /// Number of elements that an accessor claims.
    pub(super) fn count(
        document: &Document<'_>,
        index: Index<Accessor>,
    ) -> Result<u64, ImportError> {
        let what = format!("accessor {}", index.value());
        let accessor = document.root.get(index);
        let accessor = accessor.ok_or_else(|| {
            document.error(ErrorKind::Accessor, &what, "there is no such accessor")
        })?;
        Ok(accessor.count.0)
    }

    fn named<T>(
        &self,
        index: Index<Accessor>,
        result: Result<T, Failure>,
    ) -> Result<T, ImportError> {
        result.map_err(|(kind, message)| {
            self.document.error(kind, &format!("accessor {}", index.value()), message)
        })
    }

    fn find(&self, index: Index<Accessor>) -> Result<&Accessor, Failure> {
        let found = self.document.root.get(index);
        found.ok_or_else(|| (ErrorKind::Accessor, "there is no such accessor".to_owned()))
    }

    /// The values outside the sparse part; `None` when they are all zero.
    fn base(
        &self,
        (index, accessor): (Index<Accessor>, &Accessor),
        size: usize,
    ) -> Result<Option<Elements<'_>>, Failure> {
        let count = count_of(accessor)?;
        if let Some(bytes) = self.elements.get(&index.value()) {
            // Indices may be asked for as something else, whose elements are larger.
            return match size.checked_mul(count).and_then(|length| bytes.get(..length)) {
                Some(bytes) => Ok(Some(Elements { bytes, stride: size, size, count })),
                None => failure("its compressed elements are not of its type"),
            };
        }
        let Some(view) = accessor.buffer_view else {
            if accessor.sparse.is_none() {
                return failure("it has no buffer view");
            }
            if count > MAX_ZEROS {
                return failure(format!("{count} elements without values; at most {MAX_ZEROS}"));
            }
            return Ok(None);
        };
        let offset = accessor.byte_offset.map_or(0, |offset| offset.0);
        self.elements(view, offset, size, count).map(Some)
    }

    /// `count` elements of `size` bytes at `offset` of a view.
    fn elements(
        &self,
        view: Index<View>,
        offset: u64,
        size: usize,
        count: usize,
    ) -> Result<Elements<'_>, Failure> {
        let (bytes, stride) = self.try_view(view)?;
        let stride = stride.unwrap_or(size);
        if stride < size {
            return failure(format!("stride {stride} is less than the {size} bytes of an element"));
        }
        if count == 0 {
            return Ok(Elements { bytes: &[], stride, size, count });
        }
        let length = stride.checked_mul(count - 1).and_then(|length| length.checked_add(size));
        let inside = length
            .and_then(|length| range(offset, length as u64))
            .and_then(|range| bytes.get(range));
        let Some(inside) = inside else {
            let (view, total) = (view.value(), bytes.len());
            return failure(format!(
                "{count} elements of {size} bytes, {stride} apart, from byte {offset} are not \
                 inside buffer view {view} of {total} bytes"
            ));
        };
        Ok(Elements { bytes: inside, stride, size, count })
    }

    /// Replaces some values by those of the sparse part.
    fn overlay<T>(
        &self,
        sparse: &sparse::Sparse,
        size: usize,
        values: &mut [T],
        decode: impl Fn(&[u8]) -> T,
    ) -> Result<(), Failure> {
        let count = usize::try_from(sparse.count.0).ok().filter(|count| *count <= values.len());
        let Some(count) = count else {
            let (many, all) = (sparse.count.0, values.len());
            return failure(format!("{many} sparse values for {all} elements"));
        };
        let Checked::Valid(kind) = sparse.indices.component_type else {
            return failure("the sparse indices have no known component type");
        };
        let (indices, new) = (&sparse.indices, &sparse.values);
        let at = self.elements(indices.buffer_view, indices.byte_offset.0, kind.0.size(), count)?;
        let new = self.elements(new.buffer_view, new.byte_offset.0, size, count)?;
        for (index, bytes) in at.iter().map(unsigned).zip(new.iter()) {
            let n = values.len();
            let Some(value) = values.get_mut(index as usize) else {
                return failure(format!("sparse index {index}, but there are {n} elements"));
            };
            *value = decode(bytes);
        }
        Ok(())
    }
}

/// `length` bytes from `offset`, if such a range can exist.
pub(super) fn range(offset: u64, length: u64) -> Option<std::ops::Range<usize>> {
    let start = usize::try_from(offset).ok()?;
    let end = usize::try_from(offset.checked_add(length)?).ok()?;
    Some(start..end)
}

fn count_of(accessor: &Accessor) -> Result<usize, Failure> {
    let count = usize::try_from(accessor.count.0).ok().filter(|count| *count < u32::MAX as usize);
    count.map_or_else(|| failure(format!("{} elements are too many", accessor.count.0)), Ok)
}

/// Component type and bytes of an element that must have `n` components: 1 to 4, or the 16 of a matrix.
fn element_size(accessor: &Accessor, n: usize) -> Result<(ComponentType, usize), Failure> {
    let (Checked::Valid(component), Checked::Valid(kind)) =
        (accessor.component_type, accessor.type_)
    else {
        return failure("its type or component type is not one of glTF");
    };
    let expected = match n {
        1 => Type::Scalar,
        2 => Type::Vec2,
        3 => Type::Vec3,
        4 => Type::Vec4,
        _ => Type::Mat4,
    };
    if kind != expected {
        return failure(format!("it has the type {kind:?}, expected {expected:?}"));
    }
    Ok((component.0, n * component.0.size()))
}

/// A little-endian unsigned integer of 1, 2 or 4 bytes.
fn unsigned(bytes: &[u8]) -> u32 {
    bytes.iter().rev().fold(0, |value, byte| value << 8 | u32::from(*byte))
}

/// How components become floats.
#[derive(Clone, Copy)]
struct Convert {
    component: ComponentType,
    normalized: bool,
}

impl Convert {
    fn element<const N: usize>(self, bytes: &[u8]) -> [f32; N] {
        let size = self.component.size();
        std::array::from_fn(|i| self.component(&bytes[i * size..(i + 1) * size]))
    }

    fn component(self, bytes: &[u8]) -> f32 {
        let bits = unsigned(bytes);
        // The low byte or half holds an I8 or I16; the formulas are those of the glTF specification.
        let (value, max) = match self.component {
            ComponentType::F32 => return f32::from_bits(bits),
            ComponentType::I8 => (f32::from(bits.to_le_bytes()[0].cast_signed()), 127.0),
            ComponentType::U8 => (f32::from(bits.to_le_bytes()[0]), 255.0),
            ComponentType::I16 => {
                let [low, high, ..] = bits.to_le_bytes();
                (f32::from(i16::from_le_bytes([low, high])), 32767.0)
            }
            ComponentType::U16 | ComponentType::U32 => {
                let [low, high, ..] = bits.to_le_bytes();
                (f32::from(u16::from_le_bytes([low, high])), 65535.0)
            }
        };
        if self.normalized { (value / max).max(-1.0) } else { value }
    }
}
