//! `EXT_meshopt_compression`: compressed buffer views become their bytes.
//!
//! What is decoded is as long as the file says, at most the memory that there is; the decoder bounds its own work.

use super::super::error::{ErrorKind, ImportError};
use super::super::file::Reader;
use super::accessor::range;
use super::document::Document;
use ::gltf::json::Value;
use ::gltf::json::buffer::View;
use meshoptimizer_rs::codec::{BufferView, Filter, Mode};
use meshoptimizer_rs::{Limits, Workspace};
use std::borrow::Cow;

/// Name of the extension.
pub(super) const NAME: &str = "EXT_meshopt_compression";

/// The decoded bytes of each buffer view that is compressed; `data` are those of buffers.
pub(super) fn views(
    document: &Document<'_>,
    data: &[Option<Cow<'_, [u8]>>],
    reader: &mut Reader<'_>,
) -> Result<Vec<Option<Vec<u8>>>, ImportError> {
    let views = document.root.buffer_views.iter().enumerate();
    let decoded = views.map(|(index, view)| {
        let extension = view.extensions.as_ref().and_then(|all| all.others.get(NAME));
        let decode = |extension| decode(document, data, (index, view, extension), reader);
        extension.map(decode).transpose()
    });
    decoded.collect()
}

fn decode(
    document: &Document<'_>,
    data: &[Option<Cow<'_, [u8]>>],
    (index, view, extension): (usize, &View, &Value),
    reader: &mut Reader<'_>,
) -> Result<Vec<u8>, ImportError> {
    let what = format!("buffer view {index}");
    let fail = |message: &str| document.error(ErrorKind::Accessor, &what, message);
    let wrong = || fail("it is not what EXT_meshopt_compression says");
    let number = |name: &str| extension.get(name).and_then(Value::as_u64);
    let text = |name: &str| extension.get(name).and_then(Value::as_str);
    let size = |name: &str| number(name).and_then(|n| usize::try_from(n).ok()).ok_or_else(wrong);
    let mode = text("mode").and_then(|mode| Mode::parse(mode).ok()).ok_or_else(wrong)?;
    let filter = Filter::parse(text("filter").unwrap_or("NONE")).map_err(|_| wrong())?;
    let (count, stride) = (size("count")?, size("byteStride")?);
    let stored = BufferView::new(mode, filter, count, stride).map_err(|_| wrong())?;
    if stored.byte_length() as u64 != view.byte_length.0 {
        return Err(fail("it is not as long as what EXT_meshopt_compression says"));
    }
    // The bytes, and as much again while filters work.
    reader.take((stored.byte_length() as u64).saturating_mul(2), document.file)?;
    let bytes = data.get(size("buffer")?).and_then(Option::as_deref);
    let part = range(number("byteOffset").unwrap_or(0), size("byteLength")? as u64);
    let bytes = part.and_then(|part| bytes?.get(part));
    let bytes = bytes.ok_or_else(|| fail("its compressed bytes are not inside their buffer"))?;
    let limits = Limits { max_bytes: usize::MAX, ..Limits::default() };
    let decoded = stored.decode(bytes, &mut Workspace::new(limits));
    decoded.map_err(|error| fail(&format!("its compressed bytes are damaged: {error}")))
}
