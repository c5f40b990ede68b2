//! Trees and walks of another library, through files. The forms of scenes and trees are those of `bvh_dump`;
//! little endian.
//!
//! - `PROGRAM MODE 1 TREE` with the scene's path in `SCENE` builds with one thread and writes the tree.
//! - `PROGRAM MODE 1 RAYS HITS` builds, and then walks: `RAYS` holds a `u64` and so many times six `f32`, origin
//!   and direction; it writes `HITS`, a `u64` and so many times an `f32`, the distance of the nearest hit or
//!   -1.
//!
//! Each prints `cpu` and a number: the CPU seconds of the build, or of the walk alone.

use std::error::Error;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use glam::Vec3;

use crate::scene::Tri;
use crate::walk::{Child, Ray, To, Walked, pair as both};

/// What the program is asked for, and what that is called on the page.
pub(crate) type Mode = (&'static str, &'static str);

/// Walks through trees without spatial splits.
pub(crate) const WALKS_OF_BINNED: [Mode; 1] = [("intersect_med", "Embree 3.13, medium")];
/// Walks through trees with them; the second with every precaution against rays that slip through.
pub(crate) const WALKS_OF_SPLIT: [Mode; 2] = [
    ("intersect_high", "Embree 3.13, high"),
    ("intersect_high_robust", "Embree 3.13, high, robust"),
];
/// Builds.
pub(crate) const MODES: [Mode; 2] = [
    ("bvh_med", "Embree 3.13, medium (binned)"),
    ("bvh_high", "Embree 3.13, high (spatial splits)"),
];

pub(crate) struct Yardstick<'a> {
    program: &'a Path,
    scene: PathBuf,
    tree: PathBuf,
}

impl<'a> Yardstick<'a> {
    /// Writes the scene for the program.
    pub(crate) fn new(
        program: &'a Path,
        folder: &Path,
        triangles: &[Tri],
    ) -> Result<Self, Box<dyn Error>> {
        let mut bytes = (triangles.len() as u64).to_le_bytes().to_vec();
        let numbers = triangles.as_flattened().as_flattened();
        bytes.extend(numbers.iter().flat_map(|x| x.to_le_bytes()));
        let (scene, tree) = (folder.join("scene.bin"), folder.join("tree.bin"));
        fs::write(&scene, bytes)?;
        Ok(Self { program, scene, tree })
    }

    /// CPU seconds and the tree's bytes.
    pub(crate) fn build(&self, mode: &str) -> Result<(f64, Vec<u8>), Box<dyn Error>> {
        let cpu = self.run(mode, &[&self.tree])?;
        Ok((cpu, fs::read(&self.tree)?))
    }

    /// CPU seconds of a walk, and the distance to what every ray hits.
    pub(crate) fn walk(
        &self,
        mode: &Mode,
        rays: &[Ray],
    ) -> Result<(f64, Vec<f32>), Box<dyn Error>> {
        let mut bytes = (rays.len() as u64).to_le_bytes().to_vec();
        let numbers = rays.iter().flat_map(|ray| [ray.origin.to_array(), ray.dir.to_array()]);
        bytes.extend(numbers.flatten().flat_map(f32::to_le_bytes));
        let [rays, hits] = ["rays.bin", "hits.bin"].map(|name| self.scene.with_file_name(name));
        fs::write(&rays, bytes)?;
        let cpu = self.run(mode.0, &[&rays, &hits])?;
        let bytes = fs::read(&hits)?;
        let numbers = bytes.get(8..).ok_or("the yardstick wrote no hits")?.as_chunks::<4>().0;
        Ok((cpu, numbers.iter().map(|four| f32::from_le_bytes(*four)).collect()))
    }

    /// CPU seconds that the program says it took.
    fn run(&self, mode: &str, files: &[&Path]) -> Result<f64, Box<dyn Error>> {
        let mut command = Command::new(self.program);
        command.args([mode, "1"]).args(files).env("SCENE", &self.scene);
        let said = String::from_utf8(command.output()?.stdout)?;
        let cpu = said.split("cpu ").nth(1).and_then(|rest| rest.split_whitespace().next());
        Ok(cpu.and_then(|s| s.parse().ok()).ok_or("the yardstick says no time")?)
    }
}

/// Reads a tree; the program is ours, so its files are taken as they are.
pub(crate) fn read(bytes: &[u8]) -> Walked {
    let word = |at: usize| {
        let four = bytes[at..at + 4].try_into().expect("four bytes");
        u32::from_le_bytes(four)
    };
    let n_nodes = word(0) as usize;
    let n_indices = word(8) as usize;
    let corner = |at: usize| Vec3::from_array([0, 4, 8].map(|k| f32::from_bits(word(at + k))));
    let child = |node: u32, pair: &dyn Fn(u32) -> u32| {
        let at = 16 + 32 * node as usize;
        let (first, count) = (word(at + 12), word(at + 28));
        let to = match count {
            0 => To::Inner(pair(first)),
            _ => To::Leaf { first, count },
        };
        Child { lo: corner(at), hi: corner(at + 16), to }
    };
    // Pairs are numbered as they come in the file.
    let firsts: Vec<u32> = (0..n_nodes)
        .filter(|node| word(16 + 32 * node + 28) == 0)
        .map(|node| word(16 + 32 * node + 12))
        .collect();
    let mut pair_of = vec![0; n_nodes];
    for (pair, first) in (0..).zip(&firsts) {
        pair_of[*first as usize] = pair;
    }
    let pair = |first: u32| pair_of[first as usize];
    let children = |first: u32| both([child(first, &pair), child(first + 1, &pair)]);
    let nodes = firsts.iter().map(|&first| children(first)).collect();
    let order = (0..n_indices).map(|i| word(16 + 32 * n_nodes + 4 * i)).collect();
    Walked { nodes, order }
}
