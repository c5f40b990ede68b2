//! A shrine at dusk: four GLB files of parts without materials, and the textures for them.
//!
//! `scenes/shrine/*.rts` give each part its material and its place; here is only shape. The pond,
//! the lights and three balls are shapes of the language and are not here.

mod banner;
mod bridge;
mod craft;
mod eaves;
mod flora;
mod ground;
mod hall;
mod kit;
mod land;
mod lantern;
mod noise;
mod paint;
mod ridge;
mod roof;
mod rope;
mod stairs;
mod torii;
mod tree;
mod veranda;

use std::path::Path;

use serde_json::json;

use super::glb::{Glb, MaterialSpec, NodeSpec};
use kit::Mesh;
use tree::Habit;

/// How much of everything there is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Detail {
    /// Cards of blossom in one layer of one tree.
    pub blossom: usize,
    /// Petals on the ground, on the water, in the air.
    pub petals: [usize; 3],
    /// Blades of grass, fresh and dry.
    pub grass: [usize; 2],
    /// Pebbles and rocks.
    pub stones: [usize; 2],
    /// Cards of a shrub and of a cedar.
    pub leaves: [usize; 2],
    /// Quads along a side of the ground.
    pub ground: usize,
}

impl Detail {
    /// The showcase.
    pub const FULL: Self = Self {
        blossom: 4_000,
        petals: [6_000, 2_400, 1_200],
        grass: [20_000, 9_000],
        stones: [3_000, 90],
        leaves: [1_200, 960],
        ground: 210,
    };
    /// The same parts with little in them, for tests.
    pub const REDUCED: Self = Self {
        blossom: 60,
        petals: [60, 60, 20],
        grass: [200, 100],
        stones: [60, 12],
        leaves: [40, 40],
        ground: 40,
    };
}

/// What was written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Written {
    /// Triangles in all files; the scene places some parts more than once.
    pub triangles: usize,
    /// Image files.
    pub textures: usize,
}

/// Parts of one file.
type Parts = Vec<(&'static str, Mesh)>;

/// Writes every file that `scenes/shrine` reads, under `dir`.
///
/// # Errors
/// Any failure to create or write a file.
pub fn write(dir: &Path, detail: &Detail) -> std::io::Result<Written> {
    let files = [
        ("gate.glb", gate()),
        ("hall.glb", hall()),
        ("garden.glb", garden(detail)),
        ("trees.glb", trees(detail)),
    ];
    let mut triangles = 0;
    for (name, parts) in files {
        triangles += parts.iter().map(|(_, mesh)| mesh.triangles()).sum::<usize>();
        super::file::write_atomically(&dir.join(name), &glb(parts))?;
    }
    let mut textures = 0;
    for picture in flora::PICTURES.iter().chain(craft::PICTURES) {
        picture.write(&dir.join("tex"))?;
        textures += 1;
    }
    Ok(Written { triangles, textures })
}

/// One node a part; the material is a stand-in that the scene replaces.
fn glb(parts: Parts) -> Vec<u8> {
    let mut glb = Glb::default();
    let stand_in = glb.material(MaterialSpec(json!({ "name": "stand_in" })));
    for (name, mesh) in parts {
        let mesh = glb.mesh(name, &mesh.0, stand_in);
        let translation = [0.0; 3];
        glb.node(NodeSpec {
            name: name.into(),
            mesh: Some(mesh),
            translation,
            scale: 1.0,
            children: Vec::new(),
        });
    }
    glb.finish()
}

/// The torii with its rope, banners, lanterns of both kinds.
fn gate() -> Parts {
    let gate = torii::torii();
    let stone = lantern::stone_lantern();
    let paper = lantern::paper_lantern();
    let [first, second, third] = [0.0, 1.9, 4.1].map(banner::banner);
    vec![
        ("torii_red", gate.red),
        ("torii_black", gate.black),
        ("torii_gold", gate.gold),
        ("torii_stone", gate.stone),
        ("torii_tablet", gate.tablet),
        ("rope", rope::rope()),
        ("streamers", rope::streamers()),
        ("cord", rope::cord()),
        ("lantern_stone", stone.stone),
        ("lantern_pane", stone.pane),
        ("lantern_bars", stone.bars),
        ("lantern_paper", paper.paper),
        ("lantern_rim", paper.rim),
        ("lantern_brass", paper.brass),
        ("cloth_a", first.cloth),
        ("cloth_b", second.cloth),
        ("cloth_c", third.cloth),
        ("pole", first.pole),
        ("pole_fittings", first.fittings),
        ("curtain", banner::curtain(2.7, 1.05)),
    ]
}

/// The hall and its roof.
fn hall() -> Parts {
    let mut hall = hall::hall();
    veranda::veranda(&mut hall, hall::FLOOR);
    hall::furnish(&mut hall);
    let mut roof = roof::roof();
    ridge::ridges(&mut roof);
    eaves::eaves(&mut roof);
    vec![
        ("columns", hall.columns),
        ("beams_x", hall.beams_x),
        ("beams_z", hall.beams_z),
        ("floor", hall.floor),
        ("plaster", hall.plaster),
        ("paper", hall.paper),
        ("lattice_x", hall.lattice_x),
        ("lattice_y", hall.lattice_y),
        ("screen", hall.screen),
        ("podium", hall.stone),
        ("rail", hall.rail),
        ("bronze", hall.bronze),
        ("fittings", hall.gold),
        ("covers", roof.covers),
        ("pans", roof.pans),
        ("discs", roof.discs),
        ("ridges", roof.ridges),
        ("soffit", roof.soffit),
        ("rafters_x", roof.rafters_x),
        ("rafters_z", roof.rafters_z),
        ("gables", roof.gables),
        ("gold", roof.gold),
    ]
}

/// Land, stairs, bridge, and what lies and grows near the ground.
fn garden(detail: &Detail) -> Parts {
    let stairs = stairs::stairs();
    let bridge = bridge::bridge();
    vec![
        ("ground", land::ground(detail.ground)),
        ("ridges", ground::ridges()),
        ("stairs", stairs.stone),
        ("stairs_rail", stairs.rail),
        ("stairs_bronze", stairs.bronze),
        ("planks", bridge.planks),
        ("girders", bridge.girders),
        ("piers", bridge.piers),
        ("bridge_rail", bridge.railing),
        ("bridge_bronze", bridge.bronze),
        ("rocks", ground::rocks(detail.stones[1])),
        ("pebbles", ground::pebbles(detail.stones[0])),
        ("grass", ground::grass(detail.grass[0], false)),
        ("grass_dry", ground::grass(detail.grass[1], true)),
        ("irises", ground::irises(60)),
        ("lilies", ground::lilies(48)),
        ("fallen", ground::fallen(detail.petals[0])),
        ("floating", ground::floating(detail.petals[1])),
        ("air", ground::air(detail.petals[2])),
    ]
}

/// Two cherry trees with four layers of blossom each, shrubs, cedars.
fn trees(detail: &Detail) -> Parts {
    let hero = tree::tree(&Habit {
        seed: 12,
        trunk: [1.9, 0.30],
        lean: [0.5, 0.0, 0.25],
        limbs: [6.0, 4.6],
        toward: [0.55, 0.1, 0.1],
    });
    let round = tree::tree(&Habit {
        seed: 29,
        trunk: [2.1, 0.24],
        lean: [0.1, 0.0, 0.1],
        limbs: [6.0, 3.3],
        toward: [0.0, 0.2, 0.0],
    });
    let n = detail.blossom;
    let (cedar_trunk, cedar_crown) = tree::cedar(5, detail.leaves[1]);
    vec![
        ("hero_bloom_a", hero.blossom(2 * n, 0.042, 1)),
        ("hero_bloom_b", hero.blossom(n, 0.070, 2)),
        ("hero_bloom_c", hero.blossom(n, 0.066, 3)),
        ("hero_bloom_d", hero.blossom(n, 0.036, 4)),
        ("hero_leaves", hero.blossom(n / 8, 0.04, 5)),
        ("hero_bark", hero.bark),
        ("round_bloom_b", round.blossom(n, 0.095, 6)),
        ("round_bloom_c", round.blossom(n, 0.090, 7)),
        ("round_bloom_e", round.blossom(n, 0.085, 8)),
        ("round_buds", round.blossom(n / 4, 0.06, 9)),
        ("round_bark", round.bark),
        ("shrub", tree::shrub(7, detail.leaves[0])),
        ("shrub_flowers", tree::shrub(8, detail.leaves[0] / 4)),
        ("cedar_trunk", cedar_trunk),
        ("cedar_crown", cedar_crown),
    ]
}

#[cfg(test)]
mod tests {
    use super::super::vector::{add, cross, dot, sub};
    use super::*;

    /// Bumps and normal maps are dents on a face whose winding and normals disagree.
    #[test]
    fn faces_and_their_normals_look_the_same_way() {
        let detail = Detail::REDUCED;
        for (name, mesh) in [gate(), hall(), garden(&detail), trees(&detail)].into_iter().flatten()
        {
            let p = |i: u32| mesh.0.positions[i as usize].map(f64::from);
            let n = |i: u32| mesh.0.normals[i as usize].map(f64::from);
            for t in mesh.0.indices.chunks(3) {
                let face = cross(sub(p(t[1]), p(t[0])), sub(p(t[2]), p(t[0])));
                let along = dot(face, add(n(t[0]), add(n(t[1]), n(t[2]))));
                assert!(along >= -1e-9, "{name}: {t:?} at {:?}, {along:e}", p(t[0]));
            }
        }
    }
}
