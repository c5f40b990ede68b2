//! Builds small glTF files for tests.

use serde_json::{Value, json};

/// A glTF document in the making; everything lies in one buffer.
#[derive(Clone)]
pub(crate) struct Builder {
    /// The document.
    pub(crate) json: Value,
    /// Its buffer.
    pub(crate) binary: Vec<u8>,
}

impl Default for Builder {
    fn default() -> Self {
        let json = json!({
            "asset": {"version": "2.0"}, "buffers": [{"byteLength": 0}], "bufferViews": [],
            "accessors": [], "meshes": [], "nodes": [], "scenes": [{"nodes": []}], "scene": 0
        });
        Self { json, binary: Vec::new() }
    }
}

impl Builder {
    /// Appends `value` to a list of the document; returns its index.
    pub(crate) fn push(&mut self, list: &str, value: Value) -> usize {
        let list = self.json[list].as_array_mut().expect("a list");
        list.push(value);
        list.len() - 1
    }

    /// Appends bytes to the buffer; returns the index of their view.
    pub(crate) fn view(&mut self, bytes: &[u8]) -> usize {
        let offset = self.binary.len();
        self.binary.extend_from_slice(bytes);
        self.binary.resize(self.binary.len().next_multiple_of(4), 0);
        self.json["buffers"][0]["byteLength"] = json!(self.binary.len());
        self.push(
            "bufferViews",
            json!({"buffer": 0, "byteOffset": offset, "byteLength": bytes.len()}),
        )
    }

    /// An accessor of floats.
    pub(crate) fn floats<const N: usize>(&mut self, values: &[[f32; N]], kind: &str) -> usize {
        let view = self.view(bytemuck::cast_slice(values.as_flattened()));
        let count = values.len();
        self.push(
            "accessors",
            json!({"bufferView": view, "componentType": 5126, "count": count, "type": kind}),
        )
    }

    /// An accessor of 16-bit indices.
    pub(crate) fn indices(&mut self, values: &[u16]) -> usize {
        let view = self.view(bytemuck::cast_slice(values));
        let count = values.len();
        self.push(
            "accessors",
            json!({"bufferView": view, "componentType": 5123, "count": count, "type": "SCALAR"}),
        )
    }

    /// A mesh of one primitive, and a node of the scene that shows it.
    pub(crate) fn mesh(&mut self, primitive: &Value) {
        let mesh = self.push("meshes", json!({"primitives": [primitive]}));
        let node = self.push("nodes", json!({"mesh": mesh}));
        let nodes = self.json["scenes"][0]["nodes"].as_array_mut().expect("a list");
        nodes.push(json!(node));
    }

    /// The whole file.
    pub(crate) fn glb(&self) -> Vec<u8> {
        glb(Some(self.json.to_string().as_bytes()), &self.binary)
    }
}

/// A GLB file of the given chunks.
pub(crate) fn glb(json: Option<&[u8]>, binary: &[u8]) -> Vec<u8> {
    let mut out = b"glTF\x02\0\0\0\0\0\0\0".to_vec();
    let mut chunk = |kind: &[u8; 4], bytes: &[u8], fill: u8| {
        let length = bytes.len().next_multiple_of(4);
        out.extend_from_slice(&u32::try_from(length).expect("small").to_le_bytes());
        out.extend_from_slice(kind);
        out.extend_from_slice(bytes);
        out.resize(out.len() + length - bytes.len(), fill);
    };
    if let Some(json) = json {
        chunk(b"JSON", json, b' ');
    }
    chunk(b"BIN\0", binary, 0);
    let length = u32::try_from(out.len()).expect("small").to_le_bytes();
    out[8..12].copy_from_slice(&length);
    out
}

/// One triangle with positions, normals, UVs and indices: accessors 0 to 3.
pub(crate) fn triangle() -> Builder {
    let mut document = Builder::default();
    let positions = document.floats(&[[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], "VEC3");
    let normals = document.floats(&[[0.0, 0.0, 1.0]; 3], "VEC3");
    let uvs = document.floats(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]], "VEC2");
    let indices = document.indices(&[0, 1, 2]);
    let attributes = json!({"POSITION": positions, "NORMAL": normals, "TEXCOORD_0": uvs});
    document.mesh(&json!({"attributes": attributes, "indices": indices}));
    document
}

/// `triangle()` with positions and indices compressed by `EXT_meshopt_compression`; the views are 0 and 3.
pub(crate) fn compressed_triangle() -> Builder {
    use meshoptimizer_rs::Workspace;
    use meshoptimizer_rs::codec::{
        IndexEncoding, VertexEncoding, encode_index_buffer, encode_vertex_buffer,
    };
    let mut document = triangle();
    let work = &mut Workspace::default();
    let encoding = VertexEncoding::new(0, 0).expect("version 0");
    let positions = encode_vertex_buffer(&document.binary[..36], 3, 12, encoding, work);
    let indices = encode_index_buffer(&[0, 1, 2], IndexEncoding::DEFAULT, work);
    let streams = [
        (0, positions, json!({"mode": "ATTRIBUTES", "byteStride": 12})),
        (3, indices, json!({"mode": "TRIANGLES", "byteStride": 2})),
    ];
    for (view, stream, mut extension) in streams {
        let stream = stream.expect("encode");
        let at = document.view(&stream);
        let stored = document.json["bufferViews"].as_array_mut().expect("a list").remove(at);
        for key in ["buffer", "byteOffset", "byteLength"] {
            extension[key] = stored[key].clone();
        }
        extension["count"] = json!(3);
        // A buffer of which there are no bytes, as the extension wants it for programs without it.
        document.json["bufferViews"][view]["buffer"] = json!(1);
        document.json["bufferViews"][view]["byteOffset"] = json!(0);
        document.json["bufferViews"][view]["extensions"] =
            json!({"EXT_meshopt_compression": extension});
    }
    document.push("buffers", json!({"byteLength": 100}));
    document.json["extensionsRequired"] = json!(["EXT_meshopt_compression"]);
    document
}

/// A PNG of 2 x 1 texels.
pub(crate) fn tiny_png() -> Vec<u8> {
    let mut out = Vec::new();
    let encoder = image::codecs::png::PngEncoder::new(&mut out);
    let texels = [255, 0, 0, 255, 0, 255, 0, 64];
    image::ImageEncoder::write_image(encoder, &texels, 2, 1, image::ExtendedColorType::Rgba8)
        .expect("encode");
    out
}
