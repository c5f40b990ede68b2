//! Where the bytes of a glTF file are: GLB chunks, data URIs, files beside it.

use super::super::error::{ErrorKind, ImportError, excerpt};
use super::super::file::Reader;
use super::accessor::Buffers;
use super::document::Document;
use super::{draco, meshopt};
use ::gltf::json::buffer::View;
use ::gltf::json::{Image, Index};
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use percent_encoding::percent_decode_str;
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// The JSON text, and the binary chunk if there is one.
pub(super) fn split<'a>(
    bytes: &'a [u8],
    file: &str,
) -> Result<(&'a [u8], Option<&'a [u8]>), ImportError> {
    if !bytes.starts_with(b"glTF") {
        let text = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
        return if text.trim_ascii_start().starts_with(b"{") {
            Ok((text, None))
        } else {
            let message = "this is neither a GLB file nor the JSON text of a glTF file";
            Err(ImportError::new(ErrorKind::Format, file, message))
        };
    }
    let error = |message: String| ImportError::new(ErrorKind::Format, file, message);
    let word = |at: usize| {
        let word = bytes.get(at..at + 4).and_then(|word| <[u8; 4]>::try_from(word).ok());
        word.map(u32::from_le_bytes)
    };
    let cut_off = || error("the GLB header is cut off".to_owned());
    let (version, length) = (word(4).ok_or_else(cut_off)?, word(8).ok_or_else(cut_off)?);
    if version != 2 {
        return Err(error(format!("this is GLB version {version}, only 2 is read")));
    }
    if (length as usize) > bytes.len() {
        let real = bytes.len();
        let message = format!("the file is cut off: its header says {length} bytes, it has {real}");
        return Err(error(message));
    }
    let bytes = &bytes[..length as usize];
    let (mut json, mut binary) = (None, None);
    let mut at = 12;
    while at + 8 <= bytes.len() {
        let (size, kind) = (word(at).ok_or_else(cut_off)?, word(at + 4).ok_or_else(cut_off)?);
        let chunk = bytes[at + 8..].get(..size as usize);
        let Some(chunk) = chunk else {
            let message = format!("the chunk at byte {at} has {size} bytes, more than the file");
            return Err(error(message));
        };
        match &kind.to_le_bytes() {
            b"JSON" if json.is_none() => json = Some(chunk),
            b"BIN\0" if binary.is_none() => binary = Some(chunk),
            _ => {} // the format says: skip chunks that are not known
        }
        at += 8 + chunk.len();
    }
    let json = json.ok_or_else(|| error("the GLB file has no JSON chunk".to_owned()))?;
    Ok((json, binary))
}

/// The bytes of every buffer.
pub(super) fn buffers<'a>(
    document: &'a Document<'a>,
    chunk: Option<&'a [u8]>,
    folder: &Path,
    reader: &mut Reader<'_>,
) -> Result<Buffers<'a>, ImportError> {
    let mut data = Vec::with_capacity(document.root.buffers.len());
    for (index, buffer) in document.root.buffers.iter().enumerate() {
        let what = format!("buffer {index}");
        let bytes = match &buffer.uri {
            Some(uri) => Some(Cow::Owned(fetch(document, &what, uri, folder, reader)?)),
            None if index == 0 => chunk.map(Cow::Borrowed),
            None => None, // an error only if something refers to it
        };
        let length = buffer.byte_length.0;
        if let Some(bytes) = &bytes
            && (bytes.len() as u64) < length
        {
            let real = bytes.len();
            let message = format!("it says {length} bytes, but there are only {real}");
            return Err(document.error(ErrorKind::Accessor, &what, message));
        }
        data.push(bytes);
    }
    let views = meshopt::views(document, &data, reader)?;
    let mut buffers = Buffers { document, data, views, elements: BTreeMap::new() };
    buffers.elements = draco::elements(&buffers, reader)?;
    Ok(buffers)
}

/// The bytes behind a URI: a data URI or a file beside the glTF file.
fn fetch(
    document: &Document<'_>,
    what: &str,
    uri: &str,
    folder: &Path,
    reader: &mut Reader<'_>,
) -> Result<Vec<u8>, ImportError> {
    if let Some(data) = uri.strip_prefix("data:") {
        let error = |message: String| document.error(ErrorKind::Format, what, message);
        let Some((_, text)) = data.split_once(";base64,") else {
            return Err(error("a data URI that is not base64".to_owned()));
        };
        reader.take(text.len() as u64, document.file)?;
        return STANDARD.decode(text).map_err(|e| error(format!("broken base64: {e}")));
    }
    reader.read(&local_path(document, what, uri, folder)?)
}

/// The file that a relative URI means.
fn local_path(
    document: &Document<'_>,
    what: &str,
    uri: &str,
    folder: &Path,
) -> Result<PathBuf, ImportError> {
    let refuse = |message: String| Err(document.error(ErrorKind::Format, what, message));
    let shown = excerpt(uri.as_bytes());
    let scheme = uri.split_once(':').map(|(scheme, _)| scheme);
    if scheme.is_some_and(|scheme| !scheme.contains(['/', '.']) && !scheme.is_empty()) {
        return refuse(format!("`{shown}` is a URL; only files beside the glTF file are read"));
    }
    if uri.starts_with(['/', '\\']) {
        return refuse(format!("`{shown}` is an absolute path; it must be relative to the file"));
    }
    let Ok(decoded) = percent_decode_str(uri).decode_utf8() else {
        return refuse(format!("`{shown}` is not UTF-8"));
    };
    if decoded.is_empty() || decoded.contains('\0') {
        return refuse(format!("`{shown}` is not a file name"));
    }
    Ok(folder.join(decoded.as_ref()))
}

/// Where the images of a file come from.
pub(super) struct Images<'a, 'r> {
    pub(super) document: &'a Document<'a>,
    pub(super) buffers: &'a Buffers<'a>,
    pub(super) folder: &'a Path,
    pub(super) reader: Reader<'r>,
}

impl<'a> Images<'a, '_> {
    /// The name of an image: its file, or `image 3` for one inside the file.
    pub(super) fn name(&self, index: Index<Image>) -> String {
        let uri = self.document.root.get(index).and_then(|image| image.uri.as_deref());
        let uri = uri.filter(|uri| !uri.starts_with("data:"));
        uri.map_or_else(|| format!("image {}", index.value()), str::to_owned)
    }

    /// The encoded bytes of an image, and its place for messages.
    pub(super) fn bytes(
        &mut self,
        index: Index<Image>,
    ) -> Result<(Cow<'a, [u8]>, String), ImportError> {
        let what = format!("image {}", index.value());
        let document = self.document;
        let Some(image) = document.root.get(index) else {
            return Err(document.error(ErrorKind::Index, &what, "there is no such image"));
        };
        let place = format!("{}: {what}", document.file);
        match (&image.buffer_view, &image.uri) {
            (Some(view), _) => Ok((Cow::Borrowed(self.view(*view, &what)?), place)),
            (None, Some(uri)) => {
                let bytes = fetch(document, &what, uri, self.folder, &mut self.reader)?;
                Ok((Cow::Owned(bytes), place))
            }
            (None, None) => {
                Err(document.error(ErrorKind::Format, &what, "it has neither data nor a file"))
            }
        }
    }

    fn view(&self, view: Index<View>, what: &str) -> Result<&'a [u8], ImportError> {
        self.buffers.view(view, what).map(|(bytes, _)| bytes)
    }
}
