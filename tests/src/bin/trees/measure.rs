//! Building, timing and walking trees.

use std::error::Error;

use compiler::bvh::{self, Joined, Preset, Primitives};
use compiler::cache::Cache;
use cpu_time::ProcessTime;
use glam::Vec3;
use pack::abi::{ChildRef, Node, WideNode};
use tests::embree::Embree;

use crate::embree_tree;
use crate::scene::{self, Tri};
use crate::walk::{Child, Cost, Ray, Shape, To, Walked, pair};

/// Builds of each tree; odd, so that the median is a measured value.
pub(crate) const ROUNDS: usize = 3;

/// One tree.
pub(crate) struct Row {
    pub(crate) name: String,
    /// Median of CPU seconds.
    pub(crate) cpu: f64,
    pub(crate) references: usize,
    pub(crate) shape: Shape,
    pub(crate) cost: Cost,
    n_rays: usize,
}

/// All trees of one scene.
pub(crate) struct Rows {
    pub(crate) n_triangles: usize,
    pub(crate) rows: Vec<Row>,
}

impl Row {
    pub(crate) fn per_ray(&self, count: u64) -> f64 {
        count as f64 / self.n_rays as f64
    }
}

/// Builds and walks every tree.
pub(crate) fn all(triangles: &[Tri], embree: Option<&Embree>) -> Result<Rows, Box<dyn Error>> {
    let other = embree.map(|embree| embree.scene(triangles, &[])).transpose()?;
    let mut took: Vec<(String, Vec<f64>)> = Vec::new();
    let mut trees: Vec<Walked> = Vec::new();
    for round in 0..ROUNDS {
        let mut note = |name: String, time: f64, tree: &mut dyn FnMut() -> Walked| match round {
            0 => {
                took.push((name, vec![time]));
                trees.push(tree());
            }
            _ => took.iter_mut().filter(|t| t.0 == name).for_each(|t| t.1.push(time)),
        };
        for preset in Preset::ALL {
            let (tree, time) = build(preset, triangles)?;
            note(format!("`{preset}`"), time, &mut || walked(&tree));
        }
        for (mode, name) in embree_tree::MODES {
            let Some(other) = &other else { continue };
            let (cpu, tree) = other.build(mode)?;
            note(name.to_owned(), cpu, &mut || embree_tree::read(&tree));
        }
    }
    let rays = trees[1].rays(triangles, &scene::VIEWS);
    let rows = took.into_iter().zip(&trees).map(|((name, mut times), tree)| {
        times.sort_by(f64::total_cmp);
        row(name, times[ROUNDS / 2], tree, triangles, &rays)
    });
    let rows: Vec<Row> = rows.collect();
    for row in &rows {
        assert_eq!(row.cost.hits, rows[0].cost.hits, "{} finds other hits", row.name);
    }
    Ok(Rows { n_triangles: triangles.len(), rows })
}

fn row(name: String, cpu: f64, tree: &Walked, triangles: &[Tri], rays: &[Ray]) -> Row {
    let mut seen = vec![false; triangles.len()];
    tree.order.iter().for_each(|&i| seen[i as usize] = true);
    assert!(seen.iter().all(|s| *s), "{name} has lost triangles");
    let references = tree.order.len();
    let (shape, cost) = (tree.shape(), tree.cost(rays, triangles));
    Row { name, cpu, references, shape, cost, n_rays: rays.len() }
}

pub(crate) fn build(preset: Preset, triangles: &[Tri]) -> Result<(Joined, f64), Box<dyn Error>> {
    let primitives = Primitives {
        triangles,
        mesh_sizes: &[triangles.len()],
        mesh_motions: &[],
        spheres: &[],
        sphere_motions: &[],
    };
    let cpu = cpu_seconds();
    let (tree, _) = bvh::build_scene(&primitives, preset, &Cache::disabled())?;
    Ok((tree, cpu_seconds() - cpu))
}

fn child([lo, hi]: [[f32; 3]; 2], word: u32) -> Child {
    let to = match ChildRef::decode(word) {
        ChildRef::Inner(node) => To::Inner(node),
        ChildRef::Triangles { first, count } | ChildRef::Spheres { first, count } => {
            To::Leaf { first, count }
        }
        ChildRef::Instance(_) | ChildRef::Empty => To::Nowhere,
    };
    Child { lo: Vec3::from_array(lo), hi: Vec3::from_array(hi), to }
}

/// A binary tree.
pub(crate) fn walked(tree: &Joined) -> Walked {
    let children = |n: &Node| {
        pair([child([n.left_lo, n.left_hi], n.left), child([n.right_lo, n.right_hi], n.right)])
    };
    Walked { nodes: tree.nodes.iter().map(children).collect(), order: tree.triangle_order.clone() }
}

/// The same tree with wide nodes.
pub(crate) fn walked_wide(nodes: &[WideNode], order: &[u32]) -> Walked {
    let children = |n: &WideNode| {
        let words = n.words();
        [0, 1, 2, 3].map(|slot| child(n.corners(slot), words[slot]))
    };
    Walked { nodes: nodes.iter().map(children).collect(), order: order.to_vec() }
}

/// User and system time of this process, seconds.
pub(crate) fn cpu_seconds() -> f64 {
    ProcessTime::now().as_duration().as_secs_f64()
}
