//! A tea table as GLB: glazed bowls with a painted band, a brass pot with worn patches, a woven mat
//! with fringes cut out by alpha, a paper lamp that glows. Every texture is painted here.

use image::{Rgba, RgbaImage};
use serde_json::json;

use super::glb::{Glb, MaterialSpec, MeshData, NodeSpec};
use super::lathe::{lathe, smooth_profile};

/// The finished file.
pub(super) fn glb() -> Vec<u8> {
    let mut glb = Glb::default();
    let bowl = bowl(&mut glb);
    let pot = pot(&mut glb);
    let mat = mat(&mut glb);
    let lamp = lamp(&mut glb);
    let place = |glb: &mut Glb, name: &str, mesh, translation, scale| {
        let children = Vec::new();
        glb.node(NodeSpec { name: name.into(), mesh: Some(mesh), translation, scale, children })
    };
    let bowls = vec![
        place(&mut glb, "bowl_left", bowl, [-0.17, 0.004, 0.06], 1.0),
        place(&mut glb, "bowl_right", bowl, [0.15, 0.004, 0.10], 0.9),
        place(&mut glb, "bowl_far", bowl, [0.03, 0.004, -0.16], 1.05),
    ];
    let pot = place(&mut glb, "pot", pot, [-0.02, 0.004, 0.0], 1.0);
    let mat = place(&mut glb, "mat", mat, [0.0, 0.0, 0.0], 1.0);
    let lamp = place(&mut glb, "lamp", lamp, [0.30, 0.0, -0.22], 1.0);
    let set = NodeSpec {
        name: "bowls".into(),
        mesh: None,
        translation: [0.0; 3],
        scale: 1.0,
        children: bowls,
    };
    let bowls = glb.node(set);
    glb.node(NodeSpec {
        name: "tea_table".into(),
        mesh: None,
        translation: [0.0; 3],
        scale: 1.0,
        children: vec![bowls, pot, mat, lamp],
    });
    glb.finish()
}

fn bowl(glb: &mut Glb) -> usize {
    let outside =
        [[0.0, 0.0], [0.026, 0.0], [0.028, 0.008], [0.044, 0.024], [0.056, 0.046], [0.060, 0.066]];
    let inside = [[0.0575, 0.068], [0.053, 0.046], [0.040, 0.026], [0.022, 0.013], [0.0, 0.011]];
    let profile: Vec<[f64; 2]> = outside.into_iter().chain(inside).collect();
    let paint = glb.image("bowl_paint", &paint(512, 256, bowl_paint));
    let material = glb.material(MaterialSpec(json!({
        "name": "glaze",
        "pbrMetallicRoughness": {
            "baseColorTexture": { "index": paint }, "metallicFactor": 0.0, "roughnessFactor": 0.18,
        },
    })));
    glb.mesh("bowl", &lathe(&smooth_profile(&profile, 8), 96), material)
}

fn pot(glb: &mut Glb) -> usize {
    let points = [
        [0.0, 0.0],
        [0.045, 0.0],
        [0.058, 0.012],
        [0.074, 0.045],
        [0.066, 0.082],
        [0.040, 0.104],
        [0.038, 0.110],
        [0.030, 0.118],
        [0.010, 0.124],
        [0.008, 0.132],
        [0.014, 0.141],
        [0.009, 0.149],
        [0.0, 0.151],
    ];
    let wear = glb.image("pot_wear", &paint(256, 256, pot_wear));
    let material = glb.material(MaterialSpec(json!({
        "name": "brass",
        "pbrMetallicRoughness": {
            "baseColorFactor": [0.91, 0.68, 0.33, 1.0],
            "metallicRoughnessTexture": { "index": wear },
            "metallicFactor": 1.0, "roughnessFactor": 1.0,
        },
    })));
    glb.mesh("pot", &lathe(&smooth_profile(&points, 8), 128), material)
}

fn mat(glb: &mut Glb) -> usize {
    let weave = glb.image("mat_weave", &paint(512, 512, mat_weave));
    let material = glb.material(MaterialSpec(json!({
        "name": "mat",
        "alphaMode": "MASK", "alphaCutoff": 0.5, "doubleSided": true,
        "pbrMetallicRoughness": {
            "baseColorTexture": { "index": weave }, "metallicFactor": 0.0, "roughnessFactor": 0.9,
        },
    })));
    let (x, z, y) = (0.34, 0.27, 0.003);
    let data = MeshData {
        positions: vec![[-x, y, z], [x, y, z], [x, y, -z], [-x, y, -z]],
        normals: vec![[0.0, 1.0, 0.0]; 4],
        uvs: vec![[0.0, 1.0], [1.0, 1.0], [1.0, 0.0], [0.0, 0.0]],
        indices: vec![0, 1, 2, 0, 2, 3],
    };
    glb.mesh("mat", &data, material)
}

fn lamp(glb: &mut Glb) -> usize {
    let points =
        [[0.030, 0.0], [0.052, 0.02], [0.066, 0.07], [0.066, 0.13], [0.050, 0.18], [0.026, 0.20]];
    let paper = glb.image("lamp_paper", &paint(256, 256, lamp_paper));
    let material = glb.material(MaterialSpec(json!({
        "name": "paper",
        "doubleSided": true,
        "emissiveFactor": [1.0, 1.0, 1.0],
        "emissiveTexture": { "index": paper },
        "extensions": { "KHR_materials_emissive_strength": { "emissiveStrength": 5.0 } },
        "pbrMetallicRoughness": {
            "baseColorFactor": [0.8, 0.72, 0.6, 1.0], "metallicFactor": 0.0, "roughnessFactor": 0.8,
        },
    })));
    glb.mesh("lamp", &lathe(&smooth_profile(&points, 4), 32), material)
}

/// Calls `texel(u, v)` at each texel centre; u right, v down, both 0..1.
fn paint(width: u32, height: u32, texel: fn(f64, f64) -> [f64; 4]) -> RgbaImage {
    RgbaImage::from_fn(width, height, |x, y| {
        let u = (f64::from(x) + 0.5) / f64::from(width);
        let v = (f64::from(y) + 0.5) / f64::from(height);
        Rgba(texel(u, v).map(|c| (c.clamp(0.0, 1.0) * 255.0 + 0.5) as u8))
    })
}

/// Cream glaze; a cobalt band of waves outside, a ring inside. v = 0 is the inner centre.
fn bowl_paint(u: f64, v: f64) -> [f64; 4] {
    let cream = [0.93, 0.90, 0.83, 1.0];
    let cobalt = [0.10, 0.20, 0.48, 1.0];
    let wave = 0.68 + 0.025 * libm::sin(std::f64::consts::TAU * 9.0 * u);
    let in_band = libm::fabs(v - wave) < 0.02;
    let in_rings = libm::fabs(v - 0.60) < 0.006 || libm::fabs(v - 0.76) < 0.006;
    let in_heart = v < 0.06 || libm::fabs(v - 0.36) < 0.008;
    if in_band || in_rings || in_heart { cobalt } else { cream }
}

/// Roughness in green, metallic in blue: polished brass with matt fingerprints.
fn pot_wear(u: f64, v: f64) -> [f64; 4] {
    let tau = std::f64::consts::TAU;
    let blotch = libm::sin(tau * (3.0 * u + 0.7 * libm::sin(tau * 2.0 * v)))
        * libm::sin(tau * (2.0 * v + 0.4 * libm::sin(tau * 3.0 * u)));
    let worn = (0.5 + 0.5 * blotch).clamp(0.0, 1.0);
    [0.0, 0.12 + 0.38 * worn * worn, 1.0, 1.0]
}

/// Straw woven in a twill, fringes at two ends cut out by alpha.
fn mat_weave(u: f64, v: f64) -> [f64; 4] {
    let (x, y) = (libm::floor(u * 96.0), libm::floor(v * 76.0));
    let over = (x + 2.0 * y).rem_euclid(4.0) < 2.0;
    let shade = if over { 1.0 } else { 0.72 };
    let border = libm::fabs(v - 0.5) > 0.42;
    let straw = if border { [0.28, 0.13, 0.10] } else { [0.66, 0.52, 0.29] };
    let fringe = !(0.05..=0.95).contains(&u);
    let cut = fringe && libm::floor(v * 152.0).rem_euclid(3.0) < 1.0;
    let [r, g, b] = straw.map(|c| c * shade);
    [r, g, b, if cut { 0.0 } else { 1.0 }]
}

/// Warm paper with darker ribs.
fn lamp_paper(_u: f64, v: f64) -> [f64; 4] {
    let rib = libm::fabs(libm::sin(std::f64::consts::TAU * 6.0 * v)) < 0.12;
    let glow = 0.55 + 0.45 * libm::sin(std::f64::consts::PI * v);
    let light = if rib { 0.35 * glow } else { glow };
    [light, 0.72 * light, 0.40 * light, 1.0]
}
