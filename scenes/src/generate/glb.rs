//! Meshes, materials and images become one binary glTF 2.0 file.

use std::io::Cursor;

use serde_json::{Value, json};

/// An indexed triangle mesh; one entry of each list a vertex. Metres, +y up.
#[derive(Clone, Debug, Default)]
pub struct MeshData {
    /// Corners.
    pub positions: Vec<[f32; 3]>,
    /// Unit normals.
    pub normals: Vec<[f32; 3]>,
    /// Texture coordinates, v down.
    pub uvs: Vec<[f32; 2]>,
    /// Three a triangle, outside counter-clockwise.
    pub indices: Vec<u32>,
}

/// A metallic-roughness material as glTF JSON; textures are indices of `Glb::image`.
pub struct MaterialSpec(pub Value);

/// A node of the scene graph.
pub struct NodeSpec {
    /// Its name: a part of the asset.
    pub name: String,
    /// Mesh index, if it has one.
    pub mesh: Option<usize>,
    /// Metres.
    pub translation: [f32; 3],
    /// Uniform scale.
    pub scale: f32,
    /// Indices of nodes below it.
    pub children: Vec<usize>,
}

/// A GLB file being put together.
#[derive(Default)]
pub struct Glb {
    binary: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
    meshes: Vec<Value>,
    materials: Vec<Value>,
    images: Vec<Value>,
    nodes: Vec<Value>,
    is_child: Vec<bool>,
}

impl Glb {
    /// Adds an RGBA image, stored as PNG; returns its texture index.
    pub fn image(&mut self, name: &str, image: &image::RgbaImage) -> usize {
        let mut png = Cursor::new(Vec::new());
        image.write_to(&mut png, image::ImageFormat::Png).expect("writing to memory cannot fail");
        let view = self.view(png.get_ref(), None);
        self.images.push(json!({ "name": name, "bufferView": view, "mimeType": "image/png" }));
        self.images.len() - 1
    }

    /// Adds a material; returns its index.
    pub fn material(&mut self, material: MaterialSpec) -> usize {
        self.materials.push(material.0);
        self.materials.len() - 1
    }

    /// Adds a mesh of one primitive; returns its index.
    pub fn mesh(&mut self, name: &str, data: &MeshData, material: usize) -> usize {
        let (lo, hi) = bounds(&data.positions);
        let position = self.accessor(bytemuck::cast_slice(&data.positions), 5126, "VEC3");
        self.accessors[position]["min"] = json!(lo);
        self.accessors[position]["max"] = json!(hi);
        let normal = self.accessor(bytemuck::cast_slice(&data.normals), 5126, "VEC3");
        let uv = self.accessor(bytemuck::cast_slice(&data.uvs), 5126, "VEC2");
        let indices = self.accessor(bytemuck::cast_slice(&data.indices), 5125, "SCALAR");
        self.meshes.push(json!({ "name": name, "primitives": [{
            "attributes": { "POSITION": position, "NORMAL": normal, "TEXCOORD_0": uv },
            "indices": indices, "material": material,
        }]}));
        self.meshes.len() - 1
    }

    /// Adds a node; children must have been added before. Returns its index.
    pub fn node(&mut self, node: NodeSpec) -> usize {
        let NodeSpec { name, translation, scale, .. } = &node;
        let scale = [scale; 3];
        let mut json = json!({ "name": name, "translation": translation, "scale": scale });
        if let Some(mesh) = node.mesh {
            json["mesh"] = json!(mesh);
        }
        if !node.children.is_empty() {
            json["children"] = json!(node.children);
        }
        for child in node.children {
            self.is_child[child] = true;
        }
        self.nodes.push(json);
        self.is_child.push(false);
        self.nodes.len() - 1
    }

    /// The finished file.
    #[must_use]
    pub fn finish(mut self) -> Vec<u8> {
        let roots: Vec<usize> = (0..self.nodes.len()).filter(|&i| !self.is_child[i]).collect();
        pad(&mut self.binary, 0);
        let textures: Vec<Value> =
            (0..self.images.len()).map(|i| json!({ "source": i, "sampler": 0 })).collect();
        let document = json!({
            "asset": { "version": "2.0", "generator": "scenes" },
            "scene": 0,
            "scenes": [{ "nodes": roots }],
            "nodes": self.nodes,
            "meshes": self.meshes,
            "materials": self.materials,
            "textures": textures,
            "samplers": [{ "wrapS": 10497, "wrapT": 10497 }],
            "images": self.images,
            "accessors": self.accessors,
            "bufferViews": self.views,
            "buffers": [{ "byteLength": self.binary.len() }],
        });
        let mut text = document.to_string().into_bytes();
        pad(&mut text, b' ');
        let total = 12 + 8 + text.len() + 8 + self.binary.len();
        let mut file = Vec::with_capacity(total);
        file.extend(b"glTF");
        for word in [2, total as u32, text.len() as u32] {
            file.extend(word.to_le_bytes());
        }
        file.extend(b"JSON");
        file.extend(text);
        file.extend((self.binary.len() as u32).to_le_bytes());
        file.extend(b"BIN\0");
        file.extend(self.binary);
        file
    }

    fn view(&mut self, bytes: &[u8], target: Option<u32>) -> usize {
        pad(&mut self.binary, 0);
        let mut view =
            json!({ "buffer": 0, "byteOffset": self.binary.len(), "byteLength": bytes.len() });
        if let Some(target) = target {
            view["target"] = json!(target);
        }
        self.binary.extend(bytes);
        self.views.push(view);
        self.views.len() - 1
    }

    fn accessor(&mut self, bytes: &[u8], component: u32, kind: &str) -> usize {
        let lanes = match kind {
            "VEC3" => 3,
            "VEC2" => 2,
            _ => 1,
        };
        // 34963 holds indices, 34962 vertex attributes.
        let view = self.view(bytes, Some(if lanes == 1 { 34963 } else { 34962 }));
        self.accessors.push(json!({ "bufferView": view, "componentType": component,
            "count": bytes.len() / (4 * lanes), "type": kind }));
        self.accessors.len() - 1
    }
}

fn pad(bytes: &mut Vec<u8>, filler: u8) {
    while !bytes.len().is_multiple_of(4) {
        bytes.push(filler);
    }
}

fn bounds(points: &[[f32; 3]]) -> ([f32; 3], [f32; 3]) {
    let mut lo = [f32::INFINITY; 3];
    let mut hi = [f32::NEG_INFINITY; 3];
    for point in points {
        for k in 0..3 {
            lo[k] = lo[k].min(point[k]);
            hi[k] = hi[k].max(point[k]);
        }
    }
    (lo, hi)
}
