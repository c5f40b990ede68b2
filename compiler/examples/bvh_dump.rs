//! Builds the tree of a triangle soup and writes it in the form that other builders are compared in.
//!
//! Usage: `bvh_dump SCENE TREE [THREADS [SIZES [BUILDER]]]`, where `SIZES` is how many triangles each mesh has
//! (`1000x12` stands for twelve meshes of a thousand). Without it there is one mesh. All files little-endian. Scene: `u64` count, then nine
//! `f32` per triangle. Tree: `u64` nodes, `u64` indices, nodes of 32 bytes (lower corner, first,
//! upper corner, count: a leaf over `indices[first ..]`, or with count 0 the children `first` and
//! `first + 1`), then `u32` indices.
#![expect(clippy::print_stdout, reason = "a measuring tool reports on standard output")]

use std::{env, error::Error, fs, time::Instant};

use compiler::bvh::{self, Joined, Preset, Primitives};
use compiler::cache::Cache;
use pack::abi::ChildRef;

fn main() -> Result<(), Box<dyn Error>> {
    let args: Vec<String> = env::args().collect();
    let [_, scene, out, rest @ ..] = args.as_slice() else {
        return Err("usage: bvh_dump SCENE TREE [THREADS]".into());
    };
    let preset: Preset = rest.get(2).map_or(Ok(Preset::default()), |s| s.parse())?;
    let threads = rest.first().map_or(Ok(1), |s| s.parse())?;
    rayon::ThreadPoolBuilder::new().num_threads(threads).build_global()?;
    let bytes = fs::read(scene)?;
    let (words, _) = bytes.get(8..).ok_or("no triangles")?.as_chunks();
    let floats: Vec<f32> = words.iter().copied().map(f32::from_le_bytes).collect();
    drop(bytes);
    let triangles: &[[[f32; 3]; 3]] = bytemuck::cast_slice(&floats);
    let mesh_sizes = match rest.get(1) {
        Some(text) => sizes(text)?,
        None => vec![triangles.len()],
    };
    let before = (cpu_and_peak().0, resident());
    let start = Instant::now();
    let primitives = Primitives {
        triangles,
        mesh_sizes: &mesh_sizes,
        mesh_motions: &[],
        spheres: &[],
        sphere_motions: &[],
    };
    let (tree, _) = bvh::build_scene(&primitives, preset, &Cache::disabled())?;
    let wall = start.elapsed().as_secs_f64();
    let after = cpu_and_peak();
    println!(
        "BUILD rtc {preset} th{threads} wall {wall:.3} cpu {:.3} peak B/tri {:.1} nodes {} stack {}",
        after.0 - before.0,
        (after.1 - before.1) / triangles.len() as f64,
        tree.nodes.len(),
        tree.stack_need
    );
    fs::write(out, dump(&tree))?;
    Ok(())
}

/// `1000x12,40` as a list.
fn sizes(text: &str) -> Result<Vec<usize>, Box<dyn Error>> {
    let mut sizes = Vec::new();
    for part in text.split(',') {
        let (size, times) = part.split_once('x').unwrap_or((part, "1"));
        sizes.extend(std::iter::repeat_n(size.parse::<usize>()?, times.parse()?));
    }
    Ok(sizes)
}

/// CPU seconds of this process and its peak resident bytes, where the system tells (0 elsewhere).
fn cpu_and_peak() -> (f64, f64) {
    let stat = fs::read_to_string("/proc/self/stat").unwrap_or_default();
    let ticks = |i| stat.split(' ').nth(i).and_then(|s: &str| s.parse().ok()).unwrap_or(0.0);
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let peak = status.lines().find_map(|l| l.strip_prefix("VmHWM:"));
    let kib = peak.and_then(|s| s.trim().trim_end_matches(" kB").parse().ok()).unwrap_or(0.0);
    ((ticks(13) + ticks(14)) / 100.0, kib * 1024.0)
}

/// Resident bytes now; starts a new peak where the system can.
fn resident() -> f64 {
    // Refused without harm on systems that cannot.
    let _ = fs::write("/proc/self/clear_refs", "5");
    let pages = fs::read_to_string("/proc/self/statm").unwrap_or_default();
    4096.0 * pages.split(' ').nth(1).and_then(|s| s.parse().ok()).unwrap_or(0.0)
}

fn dump(tree: &Joined) -> Vec<u8> {
    let mut nodes = vec![([0.0; 3], [0.0; 3], 0_u32, 0_u32)];
    nodes[0] = (tree.bounds.lo3(), tree.bounds.hi3(), 0, 0);
    let mut stack = vec![(tree.root, 0)];
    while let Some((word, at)) = stack.pop() {
        match ChildRef::decode(word) {
            ChildRef::Inner(index) => {
                let n = tree.nodes[index as usize];
                let first = nodes.len();
                nodes.push((n.left_lo, n.left_hi, 0, 0));
                nodes.push((n.right_lo, n.right_hi, 0, 0));
                nodes[at].2 = u32::try_from(first).expect("fewer than 2^32 nodes");
                stack.push((n.right, first + 1));
                stack.push((n.left, first));
            }
            ChildRef::Triangles { first, count } => (nodes[at].2, nodes[at].3) = (first, count),
            ChildRef::Spheres { .. } | ChildRef::Instance(_) | ChildRef::Empty => {}
        }
    }
    let mut out = Vec::new();
    out.extend((nodes.len() as u64).to_le_bytes());
    out.extend((tree.triangle_order.len() as u64).to_le_bytes());
    for (lo, hi, first, count) in nodes {
        out.extend(lo.into_iter().flat_map(f32::to_le_bytes));
        out.extend(first.to_le_bytes());
        out.extend(hi.into_iter().flat_map(f32::to_le_bytes));
        out.extend(count.to_le_bytes());
    }
    out.extend(tree.triangle_order.iter().flat_map(|i| i.to_le_bytes()));
    out
}
