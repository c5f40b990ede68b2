//! Bytes that are not of the format a scene says → what they are.

/// A format of meshes that has a reader for files of polygons.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Format {
    Obj,
    Ply,
    Stl,
}

/// What `bytes` are that are not of the format `of`, as far as their beginning tells.
pub(super) fn foreign(bytes: &[u8], of: Format) -> Option<&'static str> {
    const MAGIC: [(&[u8], Option<Format>, &str); 7] = [
        (b"glTF", None, "a GLB file; read it with `gltf(...)`"),
        (b"ply", Some(Format::Ply), "a PLY file; read it with `ply(...)`"),
        (b"solid ", Some(Format::Stl), "an STL file; read it with `stl(...)`"),
        (b"Kaydara FBX", None, "an FBX file"),
        (b"PK\x03\x04", None, "a ZIP archive"),
        (b"\xff\xfe", None, "UTF-16 text"),
        (b"\xfe\xff", None, "UTF-16 text"),
    ];
    let found = MAGIC.iter().find(|(magic, _, _)| bytes.starts_with(magic));
    match found {
        Some((_, format, _)) if *format == Some(of) => None,
        Some((_, _, what)) => Some(what),
        None if bytes.is_empty() => Some("empty"),
        None if of == Format::Obj && bytes.iter().take(4096).any(|byte| *byte == 0) => {
            Some("binary data")
        }
        None => None,
    }
}
