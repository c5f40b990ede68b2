//! Trees of another library, through files. The forms are those of `bvh_dump`.

use std::error::Error;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use glam::Vec3;

use crate::scene::Tri;
use crate::walk::{Child, To, Walked, pair as both};

/// What the program is asked for, and what that is called on the page.
pub(crate) const MODES: [(&str, &str); 2] = [
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
        let mut command = Command::new(self.program);
        command.args([mode, "1"]).arg(&self.tree).env("SCENE", &self.scene);
        let said = String::from_utf8(command.output()?.stdout)?;
        let cpu = said.split("cpu ").nth(1).and_then(|rest| rest.split(' ').next());
        let cpu = cpu.and_then(|s| s.trim().parse().ok()).ok_or("the yardstick says no time")?;
        Ok((cpu, fs::read(&self.tree)?))
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
