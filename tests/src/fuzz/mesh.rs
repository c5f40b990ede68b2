//! OBJ, MTL, PLY, STL and glTF: what is accepted can be used without a check.

use std::fs;
use std::path::Path;

use compiler::import::{
    ErrorKind, ImportError, Limits, MeshFile, read_gltf, read_obj, read_ply, read_stl,
};
use lang::scene::{Axis, GltfChoice};

pub(super) const OBJ_WORDS: &[&[u8]] = &[
    b"v ",
    b"vt ",
    b"vn ",
    b"f ",
    b"l ",
    b"p ",
    b"o ",
    b"g ",
    b"s off\n",
    b"s 1\n",
    b"usemtl ",
    b"mtllib ",
    b"f -1 -2 -3\n",
    b"f 1/1/1 2/2/2 3/3/3\n",
    b"f 1//1 2//1 3//1\n",
    b"\\\n",
    b"#",
    b"\0",
    b"\xe9",
    b"\r",
    b"f 1 2 3 4 5 6 7 8 9\n",
];

pub(super) const MTL_WORDS: &[&[u8]] = &[
    b"newmtl ",
    b"Kd ",
    b"Ks ",
    b"Ke ",
    b"Ns ",
    b"Ni ",
    b"d ",
    b"Tr ",
    b"illum ",
    b"map_Kd ",
    b"map_d ",
    b"bump ",
    b"Pr ",
    b"Pm ",
    b"-clamp on ",
    b"-o 1 2 3 ",
    b"-s 0 0 0 ",
    b"-mm 0 1 ",
    b"a.png",
    b"a.mtl",
    b"../",
    b"/dev/zero",
    b"-colorspace sRGB ",
    b"\xe9",
];

pub(super) const PLY_WORDS: &[&[u8]] = &[
    b"ply\n",
    b"format ascii 1.0\n",
    b"format binary_little_endian 1.0\n",
    b"format binary_big_endian 1.0\n",
    b"element vertex 4\n",
    b"element face 1\n",
    b"element edge 1\n",
    b"element face 4294967295\n",
    b"property float x\n",
    b"property double y\n",
    b"property uchar red\n",
    b"property float nx\n",
    b"property float s\n",
    b"property list uchar int vertex_indices\n",
    b"property list uint uint vertex_index\n",
    b"property list uchar float texcoord\n",
    b"comment TextureFile a.png\n",
    b"end_header\n",
    b"\r",
    b"nan",
    b"-1",
    b"1e39",
    b"\xe9",
    b"\0",
    b"\xff\xff\xff\xff",
];

pub(super) const STL_WORDS: &[&[u8]] = &[
    b"solid ",
    b"facet normal 0 0 1\n",
    b"outer loop\n",
    b"vertex 1 2 3\n",
    b"endloop\n",
    b"endfacet\n",
    b"endsolid\n",
    b"SOLID",
    b"\\\n",
    b"\r",
    b"nan",
    b"1e39",
    b"\xe9",
    b"\0",
    b"\xff\xff\xff\xff",
    b"\0\0\x80\x7f",
];

pub(super) const GLTF_WORDS: &[&[u8]] = &[
    b"\"accessors\":",
    b"\"bufferViews\":",
    b"\"byteOffset\":",
    b"\"byteStride\":",
    b"\"count\":",
    b"\"sparse\":",
    b"\"componentType\":5126",
    b"\"type\":\"VEC3\"",
    b"\"indices\":",
    b"\"children\":",
    b"\"nodes\":",
    b"\"mesh\":",
    b"\"matrix\":",
    b"\"scale\":[",
    b"\"mode\":5",
    b"\"extensions\":",
    b"\"extensionsRequired\":[\"x\"]",
    b"\"uri\":\"data:;base64,AAAA\"",
    b"\"uri\":\"../a\"",
    b"null",
    b"[]",
    b"{}",
    b"4294967295",
    b"-1",
    b"1e39",
    b"\"KHR_texture_transform\":",
    b"JSON",
    b"BIN\0",
];

/// Small, so that no claim can make a run slow.
#[allow(clippy::needless_update, reason = "whatever else is limited stays as it is")]
pub(super) fn limits() -> Limits {
    Limits {
        file_bytes: 1 << 20,
        triangles: 1 << 16,
        pixels: 1 << 16,
        total_pixels: 1 << 18,
        ..Limits::default()
    }
}

/// Four corners, two materials, a polygon: what MTL files are read with.
const OBJ_WITH_MATERIALS: &[u8] =
    b"mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\n\
    usemtl red\nf 1/1 2/2 3/3\nusemtl blue\nf 1/1 3/3 4/2\n";

pub(super) fn obj(folder: &Path, bytes: &[u8]) -> Result<(), String> {
    // One that is not there: its absence is a finding, not an error.
    judge(read_obj(bytes, &folder.join("a.obj"), 0.01, Axis::PlusZ, &limits()))
}

pub(super) fn mtl(folder: &Path, bytes: &[u8]) -> Result<(), String> {
    let image = folder.join("a.png");
    if !image.exists() {
        fs::write(&image, super::seeds::tiny_png()).map_err(|e| e.to_string())?;
    }
    fs::write(folder.join("a.mtl"), bytes).map_err(|e| e.to_string())?;
    let path = folder.join("a.obj");
    judge(read_obj(OBJ_WITH_MATERIALS, &path, 1.0, Axis::PlusY, &limits()))
}

pub(super) fn ply(folder: &Path, bytes: &[u8]) -> Result<(), String> {
    judge(read_ply(bytes, &folder.join("a.ply"), 0.01, Axis::PlusZ, &limits()))
}

pub(super) fn stl(folder: &Path, bytes: &[u8]) -> Result<(), String> {
    judge(read_stl(bytes, &folder.join("a.stl"), 0.001, Axis::PlusZ, &limits()))
}

pub(super) fn gltf(folder: &Path, bytes: &[u8]) -> Result<(), String> {
    moments(bytes, &folder.join("a.gltf"))
}

pub(super) fn glb(folder: &Path, bytes: &[u8]) -> Result<(), String> {
    moments(bytes, &folder.join("a.glb"))
}

/// As the file is stored, and as its animations have it.
fn moments(bytes: &[u8], path: &Path) -> Result<(), String> {
    let at = |time| GltfChoice { time, ..GltfChoice::default() };
    judge(read_gltf(bytes, path, &at(None), &limits()))?;
    match read_gltf(bytes, path, &at(Some(0.5)), &limits()) {
        // Nothing in it moves.
        Err(error) if error.kind == ErrorKind::Choice => Ok(()),
        moved => judge(moved),
    }
}

/// Makes the length in the header true again.
pub(super) fn repair_glb(bytes: &mut [u8]) {
    let length = u32::try_from(bytes.len()).unwrap_or(u32::MAX).to_le_bytes();
    if let Some(header) = bytes.get_mut(8..12) {
        header.copy_from_slice(&length);
    }
}

fn judge(result: Result<MeshFile, ImportError>) -> Result<(), String> {
    let mesh = result.map_err(|error| {
        let refusal = error.to_string();
        assert!(!refusal.contains("gave up"), "a decoder panicked: {refusal}");
        refusal
    })?;
    assert_usable(&mesh);
    Ok(())
}

/// Everything that came out must be usable without a check.
fn assert_usable(mesh: &MeshFile) {
    for part in &mesh.parts {
        assert!(part.colors.is_empty() || part.colors.len() == part.positions.len());
        assert!(part.material.is_none_or(|m| (m as usize) < mesh.materials.len()));
        for tri in 0..part.triangles.len() {
            assert!(part.corners(tri).iter().flatten().all(|x| x.is_finite()));
            let normals = part.corner_normals(tri).unwrap_or([[1.0, 0.0, 0.0]; 3]);
            for normal in normals {
                let length2 = normal.iter().map(|x| x * x).sum::<f32>();
                assert!((length2 - 1.0).abs() < 1e-4, "{normal:?}");
            }
            let uvs = part.corner_uvs(tri).unwrap_or_default();
            assert!(uvs.iter().flatten().all(|x| x.is_finite()));
            let colors = part.corner_colors(tri);
            assert!(colors.iter().flatten().all(|x| (0.0..=1.0).contains(x)));
        }
    }
    for material in &mesh.materials {
        let maps = [material.color_map, material.emission_map, material.alpha_map];
        assert!(maps.iter().flatten().all(|map| (map.image as usize) < mesh.images.len()));
    }
}
