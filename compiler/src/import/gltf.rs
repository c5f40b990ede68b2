//! glTF 2.0, text or binary, becomes a [`MeshFile`].
//!
//! The `gltf` crate's JSON model is the parser. Its wrappers are not used, because they trust
//! indices (its own validator reads accessor tables unchecked): everything that refers to something
//! is looked up here, and every byte range is computed with checked arithmetic.
//!
//! The scene graph is flattened: each node's mesh is baked into the frame of the file. Mirroring
//! transforms turn triangles round, so that outside stays outside. `v` is flipped, because glTF
//! counts it downwards. Each place of an instanced mesh is a part. Lights and cameras are read, for people to copy into
//! their scene. Skins, morph targets and animations are those of one moment.

mod accessor;
mod bake;
mod container;
mod document;
mod draco;
mod instancing;
mod layers;
mod left_out;
mod maps;
mod material;
mod matrix;
mod meshopt;
mod node;
mod pose;
mod primitive;
mod skin;
mod specular_glossiness;
mod studio;
mod variant;

use self::container::Images;
use self::document::{Document, list};
use self::node::Walk;
use self::pose::Pose;
use super::colors;
use super::error::{ErrorKind, ImportError};
use super::file::{Limits, Reader, read_file};
use super::image_set::ImageSet;
use super::mesh::{MeshFile, keep};
use super::report::ImportReport;
use ::gltf::json::{Accessor, Material, Root, deserialize, mesh, scene};
use files::ShowPath as _;
use lang::scene::GltfChoice;
use std::path::Path;

/// Extensions that are understood.
const SUPPORTED: [&str; 19] = [
    draco::NAME,
    instancing::NAME,
    meshopt::NAME,
    maps::KTX2,
    maps::WEBP,
    variant::NAME,
    "KHR_lights_punctual",
    layers::ANISOTROPY,
    layers::SHEEN,
    "KHR_materials_clearcoat",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_specular",
    "KHR_materials_transmission",
    "KHR_materials_unlit",
    "KHR_materials_volume",
    "KHR_mesh_quantization",
    "KHR_texture_transform",
];

/// Reads a `.gltf` or `.glb` file with the buffers and images that it refers to.
pub fn load_gltf(
    path: &Path,
    choice: &GltfChoice,
    limits: &Limits,
) -> Result<MeshFile, ImportError> {
    let (bytes, _loan) = read_file(path, limits)?;
    read_gltf(&bytes, path, choice, limits)
}

/// The same for a file whose bytes are in memory; `path` is what its files are relative to.
pub fn read_gltf(
    bytes: &[u8],
    path: &Path,
    choice: &GltfChoice,
    limits: &Limits,
) -> Result<MeshFile, ImportError> {
    let mut reader = Reader::new(limits);
    reader.remember(path, bytes);
    let file = path.shown().to_string();
    let (json, chunk) = container::split(bytes, &file)?;
    reader.take(json_bytes(json), &file)?;
    let root = parse(json, &file)?;
    let document = Document { root: &root, file: &file };
    let mut report = ImportReport::default();
    left_out::warn(json, &document, &SUPPORTED, &mut report);
    warn_about(&document, choice, &mut report);
    let variant = variant::find(&document, choice.variant.as_deref())?;
    let folder = path.parent().unwrap_or(Path::new(""));
    let buffers = container::buffers(&document, chunk, folder, &mut reader)?;
    let pose = Pose::of(&buffers, choice, &mut reader)?;
    let Walk { placed, studio, skins } = node::walk(&buffers, &pose, &mut reader)?;
    let table = primitive::Table::new(&document, variant, &placed, &mut reader, &mut report)?;
    let mut images = ImageSet::default();
    let mut source = Images { document: &document, buffers: &buffers, folder, reader };
    let materials = material::convert(&table, &mut source, &mut images, &mut report)?;
    let Images { reader, .. } = source;
    let parts = bake::parts((&placed, &skins), &table, &materials, &buffers, &mut report)?;
    let images = images.decode(limits, &mut report)?;
    report.files = reader.finish();
    keep(&parts, &file, limits)?;
    report.n_triangles = parts.iter().map(|part| part.triangles.len() as u64).sum();
    if report.n_triangles == 0 {
        let message = match report.zero_area.count {
            0 => "the scene of this file has no triangles".to_owned(),
            n => format!("none of its {n} triangles has an area"),
        };
        return Err(ImportError::new(ErrorKind::Empty, file, message));
    }
    let materials = materials.into_iter().map(|material| material.imported).collect();
    Ok(colors::settle(MeshFile { parts, materials, images, studio, report }))
}

fn parse(json: &[u8], file: &str) -> Result<Root, ImportError> {
    let parsed: Result<Root, _> = deserialize::from_slice(json);
    // A file that needs an extension may lack what plain glTF demands: say the extension first.
    let required = match &parsed {
        Ok(root) => root.extensions_required.clone(),
        Err(_) => required_extensions(json),
    };
    let unknown: Vec<&str> =
        required.iter().map(String::as_str).filter(|name| !SUPPORTED.contains(name)).collect();
    if !unknown.is_empty() {
        let list = unknown.join(", ");
        let message = format!("the file requires {list}, which is not supported");
        return Err(ImportError::new(ErrorKind::Extension, file, message).with_help(remedy(&list)));
    }
    let root = parsed.map_err(|error| {
        let kind = if error.is_eof() { "the JSON is cut off" } else { "the JSON is not glTF" };
        ImportError::new(ErrorKind::Format, file, format!("{kind}: {error}"))
    })?;
    if !root.asset.version.starts_with("2.") {
        let version = super::error::excerpt(root.asset.version.as_bytes());
        let message = format!("this is glTF {version}, only 2.x is read");
        return Err(ImportError::new(ErrorKind::Format, file, message)
            .with_help("convert it to glTF 2.0, for example with Blender"));
    }
    Ok(root)
}

fn remedy(extensions: &str) -> String {
    if extensions.contains("meshopt") {
        "store it without compression, for example with `gltf-transform copy in.glb out.glb` or by \
         exporting it again"
            .to_owned()
    } else {
        "export it again without this extension".to_owned()
    }
}

/// `extensionsRequired` of a JSON text that is otherwise not understood.
fn required_extensions(json: &[u8]) -> Vec<String> {
    #[derive(Default, serde::Deserialize)]
    struct Required {
        #[serde(rename = "extensionsRequired", default)]
        names: Vec<String>,
    }
    let required: Required = deserialize::from_slice(json).unwrap_or_default();
    required.names
}

/// The most memory that a parsed text takes: an object for each `{`, a number, index or pair after each `,` and
/// `[`, and its texts; lists may have doubled.
fn json_bytes(json: &[u8]) -> u64 {
    const OBJECT: usize = {
        let (node, material) = (size_of::<scene::Node>(), size_of::<Material>());
        let (primitive, accessor) = (size_of::<mesh::Primitive>(), size_of::<Accessor>());
        let larger = if node > material { node } else { material };
        let other = if primitive > accessor { primitive } else { accessor };
        if larger > other { larger } else { other }
    };
    const ENTRY: usize = 32;
    let cost = |byte: &u8| match byte {
        b'{' => 2 * OBJECT,
        b',' | b'[' => 2 * ENTRY,
        _ => 1,
    };
    json.iter().map(|byte| cost(byte) as u64).sum()
}

/// Says what else could be chosen.
fn warn_about(document: &Document<'_>, choice: &GltfChoice, report: &mut ImportReport) {
    let root = document.root;
    if !root.animations.is_empty() && choice.time.is_none() {
        let names = root.animations.iter().filter_map(|animation| animation.name.as_deref());
        let names = list("its animations are", names);
        let message = format!("{names}; it is shown as stored unless `time` chooses a moment");
        report.warn(document.file, message);
    }
    let variants = variant::names(document);
    if !variants.is_empty() && choice.variant.is_none() {
        let names = list("its variants are", variants.into_iter());
        report.warn(document.file, format!("{names}; `variant` shows one of them"));
    }
}
