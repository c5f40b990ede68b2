//! The two layouts of nodes: what they take, and what rays cost in the kernel that renders; beside it,
//! where there is one, another library's walk through its own trees.

use std::error::Error;

use compiler::bvh::{self, Joined, Layout, Preset};
use glam::UVec4;
use pack::abi::{Frame, Material, NONE, TriShade, Triangle, WideNode};
use runtime::kernel::f32 as kernel;
use runtime::kernel::trace_each;
use runtime::kernel::walk::{Companion, Geometry, Tree, Width};
use tests::embree::{self, Embree};

use crate::embree_tree;
use crate::measure::{build, cpu_seconds, walked, walked_wide};
use crate::scene::{Tri, VIEWS};
use crate::walk::{Cost, Ray};

/// Runs of each kernel; odd, so that the median is a measured value.
pub(crate) const ROUNDS: usize = 5;
const GENERATED: &str = "generated";
const BY_HAND: &str = "by hand";
/// The kernel's frame: everything is nearer than 1.
const SCALE: f32 = 1.0 / 8192.0;

/// One walk through one layout of one tree.
pub(crate) struct Row {
    pub(crate) layout: Layout,
    /// Who walks it.
    pub(crate) walk: &'static str,
    /// CPU seconds to make it from the binary tree.
    pub(crate) made: f64,
    pub(crate) node_bytes: usize,
    pub(crate) stack: u32,
    pub(crate) cost: Cost,
    /// Median of CPU seconds of all rays in the kernel.
    pub(crate) cpu: f64,
}

/// The same rays in trees and walks of another library.
pub(crate) struct Other {
    pub(crate) name: &'static str,
    /// Median of CPU seconds of all rays.
    pub(crate) cpu: f64,
    /// Rays that hit something else than ours, or at another distance by more than `SAME_HIT`.
    pub(crate) differ: usize,
}

/// What rays cost in one tree, ours first; the others have one that was made for the same.
pub(crate) struct Group {
    pub(crate) preset: Preset,
    pub(crate) rows: Vec<Row>,
    pub(crate) others: Vec<Other>,
}

/// All of them.
pub(crate) struct Groups {
    pub(crate) n_triangles: usize,
    pub(crate) n_rays: usize,
    pub(crate) by_preset: Vec<Group>,
}

/// Words that begin with a page, as those of a pack do: nodes lie in one line of the cache each.
struct Section {
    words: Vec<UVec4>,
    start: usize,
    end: usize,
}

impl Section {
    const PAGE: usize = 4096;

    fn new(bytes: &[u8]) -> Self {
        let mut words = vec![UVec4::ZERO; (bytes.len() + Self::PAGE) / size_of::<UVec4>()];
        let start = words.as_ptr().align_offset(Self::PAGE);
        bytemuck::cast_slice_mut(&mut words[start..])[..bytes.len()].copy_from_slice(bytes);
        let end = start + bytes.len().div_ceil(size_of::<UVec4>());
        Self { words, start, end }
    }

    fn words(&self) -> &[UVec4] {
        &self.words[self.start..self.end]
    }
}

/// What a kernel reads of one layout.
struct Words {
    frame: Vec<UVec4>,
    nodes: Section,
    triangles: Section,
    shades: Vec<UVec4>,
    tree: Option<Tree>,
}

/// Both layouts of two trees.
pub(crate) fn all(triangles: &[Tri], embree: Option<&Embree>) -> Result<Groups, Box<dyn Error>> {
    let scaled: Vec<Tri> = triangles.iter().map(|t| t.map(|p| p.map(|x| x * SCALE))).collect();
    let other = embree.map(|embree| embree.scene(&scaled, &[])).transpose()?;
    let mut all = Groups { n_triangles: scaled.len(), n_rays: 0, by_preset: Vec::new() };
    for (preset, modes) in [
        (Preset::Fast, &embree_tree::WALKS_OF_BINNED[..]),
        (Preset::Default, &embree_tree::WALKS_OF_SPLIT[..]),
    ] {
        let (tree, _) = build(preset, &scaled)?;
        let rays = rays(&tree, triangles);
        all.n_rays = rays.len();
        let others = other.as_ref().map(|other| (other, modes));
        all.by_preset.push(compare(preset, &tree, &scaled, &rays, others)?);
    }
    Ok(all)
}

/// The rays of the other tables, in the kernel's frame. They depend on the scene alone.
fn rays(tree: &Joined, triangles: &[Tri]) -> Vec<Ray> {
    let mut unscaled = walked(tree);
    for child in unscaled.nodes.as_flattened_mut() {
        (child.lo, child.hi) = (child.lo / SCALE, child.hi / SCALE);
    }
    let rays = unscaled.rays(triangles, &VIEWS).into_iter();
    rays.map(|ray| Ray { origin: ray.origin * SCALE, dir: ray.dir }).collect()
}

/// Both layouts of a tree, the runs interleaved; every ray must have the same hit in all.
fn compare(
    preset: Preset,
    tree: &Joined,
    triangles: &[Tri],
    rays: &[Ray],
    others: Option<(&embree::Scene<'_>, &[embree_tree::Mode])>,
) -> Result<Group, Box<dyn Error>> {
    let before = cpu_seconds();
    let mut wide = Vec::new();
    let root = bvh::widen(&tree.nodes, tree.root, &mut wide)?;
    let made = cpu_seconds() - before;
    let binary_nodes: &[u8] = bytemuck::cast_slice(&tree.nodes);
    let wide_nodes: &[u8] = bytemuck::cast_slice(&wide);
    // The last number is `Frame::wide`.
    let kernels = [
        (GENERATED, tree.root, binary_nodes, 0),
        (GENERATED, root, wide_nodes, 1),
        (BY_HAND, root, wide_nodes, 1),
    ];
    let mut words =
        kernels.map(|(_, root, nodes, asked)| Words::new(tree, root, nodes, asked, triangles));
    words[2].walk_by_hand(&wide, root);
    let (took, others) = times(tree, &words, rays, others)?;
    let costs = [
        walked(tree).cost(rays, triangles),
        walked_wide(&wide, &tree.triangle_order).cost(rays, triangles),
    ];
    let stacks = [tree.stack_need, pack::bvh::stack_need(&wide, &[], root)];
    let row = |((walk, _, nodes, asked), cpu): ((&'static str, u32, &[u8], u32), f64)| {
        let is_wide = usize::from(asked != 0);
        Row {
            layout: [Layout::Binary, Layout::Wide][is_wide],
            walk,
            made: [0.0, made][is_wide],
            node_bytes: nodes.len(),
            stack: stacks[is_wide],
            cost: costs[is_wide],
            cpu,
        }
    };
    Ok(Group { preset, rows: kernels.into_iter().zip(took).map(row).collect(), others })
}

/// Median of CPU seconds of each kernel, and of what is beside them.
fn times<const N: usize>(
    tree: &Joined,
    words: &[Words; N],
    rays: &[Ray],
    others: Option<(&embree::Scene<'_>, &[embree_tree::Mode])>,
) -> Result<([f64; N], Vec<Other>), Box<dyn Error>> {
    let mut took = [const { Vec::new() }; N];
    let modes = others.map_or(&[][..], |(_, modes)| modes);
    let mut theirs: Vec<(Vec<f64>, usize)> = vec![(Vec::new(), 0); modes.len()];
    let mut hits = Vec::new();
    let asked: Vec<embree::Ray> = rays.iter().map(Ray::asked).collect();
    for _ in 0..ROUNDS {
        for (words, took) in words.iter().zip(&mut took) {
            let before = cpu_seconds();
            let found = words.hits(rays);
            took.push(cpu_seconds() - before);
            let found: Vec<_> = found.iter().map(|hit| whose(tree, *hit)).collect();
            hits.extend(hits.is_empty().then(|| found.clone()).into_iter().flatten());
            let differ = hits.iter().zip(&found).filter(|(a, b)| a != b).count();
            assert_eq!(differ, 0, "rays have other hits");
        }
        for ((scene, mode), (took, differ)) in others
            .iter()
            .flat_map(|(scene, modes)| modes.iter().map(move |m| (scene, m)))
            .zip(&mut theirs)
        {
            let (cpu, found) = scene.trace(mode.0, &asked)?;
            took.push(cpu);
            *differ = hits
                .iter()
                .zip(&found)
                .filter(|((t, whose), there)| {
                    !embree::is_same_hit(whose.map(|_| f32::from_bits(*t)), **there)
                })
                .count();
        }
    }
    let other = |(mode, (mut took, differ)): (&embree_tree::Mode, (Vec<f64>, usize))| Other {
        name: mode.1,
        cpu: median(&mut took),
        differ,
    };
    Ok((took.map(|mut took| median(&mut took)), modes.iter().zip(theirs).map(other).collect()))
}

fn median(took: &mut [f64]) -> f64 {
    took.sort_by(f64::total_cmp);
    took[ROUNDS / 2]
}

/// Distance and triangle of the scene, in whichever place it was met.
fn whose(tree: &Joined, (t, place): (u32, u32)) -> (u32, Option<u32>) {
    (t, tree.triangle_order.get(place as usize).copied())
}

impl Words {
    fn new(tree: &Joined, root: u32, nodes: &[u8], wide: u32, triangles: &[Tri]) -> Self {
        let (path_at, camera_key_at) = (NONE, NONE);
        let still = Frame { path_at, camera_key_at, object_at: NONE, ..Frame::default() };
        let frame = Frame { root, wide, ..still };
        let record = |i: &u32| {
            let [v0, v1, v2] = triangles[*i as usize];
            Triangle { v0, id0: 3 * i, v1, id1: 3 * i + 1, v2, id2: 3 * i + 2 }
        };
        let records: Vec<Triangle> = tree.triangle_order.iter().map(record).collect();
        let shades = vec![TriShade { light: NONE, ..TriShade::default() }; records.len()];
        Self {
            frame: bytemuck::pod_collect_to_vec(&[frame]),
            nodes: Section::new(nodes),
            triangles: Section::new(bytemuck::cast_slice(&records)),
            shades: bytemuck::pod_collect_to_vec(&shades),
            tree: None,
        }
    }

    /// Makes the tree that the CPU walks by hand.
    fn walk_by_hand(&mut self, nodes: &[WideNode], root: u32) {
        let triangles = bytemuck::cast_slice(self.triangles.words());
        let shades = bytemuck::cast_slice(&self.shades);
        let materials = &[Material::default()];
        let geometry = Geometry {
            nodes,
            triangles,
            instances: &[],
            root,
            shades,
            materials,
            textures: &[],
            texels: &[],
        };
        self.tree = Some(Tree::new(&geometry, Width::of_processor()));
    }

    /// Distance (bits) and triangle of every ray.
    fn hits(&self, rays: &[Ray]) -> Vec<(u32, u32)> {
        // One material of no special kind: nothing is cut out.
        let heap = [UVec4::ZERO; 64];
        let mut kernel = kernel::Kernel::new(kernel::Bindings {
            frame_words: &self.frame,
            film_words: &mut [],
            heap_words: &heap,
            node_words: self.nodes.words(),
            tri_words: self.triangles.words(),
            shade_words: &self.shades,
            sphere_words: &[],
            texel_words: &[],
        });
        kernel.companion = Companion::new(self.tree.as_ref());
        let none = glam::UVec2::splat(NONE);
        let in_kernel =
            |ray: &Ray| kernel.ray_new(ray.origin, ray.dir, kernel::RAY_FAR, none, NONE, 0.0);
        let rays: Vec<_> = rays.iter().map(in_kernel).collect();
        let hits = trace_each(&mut kernel, &rays);
        hits.iter().map(|hit| (hit.t.to_bits(), hit.prim)).collect()
    }
}
