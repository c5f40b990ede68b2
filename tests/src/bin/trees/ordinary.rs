//! What building costs, and what it gives, on ordinary meshes beside the hard scene: `fast` and `default`, on
//! one thread and on two.

use std::error::Error;
use std::fmt::Write as _;
use std::path::Path;
use std::time::Instant;

use compiler::bvh::{self, Joined, Preset, Primitives};
use compiler::cache::Cache;
use compiler::import::{self, Limits};
use lang::scene::GltfChoice;

use crate::measure::{cpu_seconds, walked};
use crate::scene::{self, Tri, View};
use crate::walk::{Cost, Walked};

/// Builds of each tree; odd, so that the median is a measured value.
const ROUNDS: usize = 3;
/// What is compared.
const BUILDS: [(Preset, usize); 4] =
    [(Preset::Fast, 1), (Preset::Default, 1), (Preset::Fast, 2), (Preset::Default, 2)];

/// How the section begins, which is also how it is found in the page.
pub(crate) const TITLE: &str = "\n## Ordinary meshes\n";

/// Meshes that `tests/peers` writes, what they are made of, and what they are seen from.
const MESHES: [(&str, &[&str], [View; 4]); 2] = [
    (
        "meadow",
        &["ground.glb", "grass.glb"],
        [
            [[0.0, 6.0, 26.0], [0.0, -1.5, 0.0]],
            [[-20.0, 4.0, -20.0], [0.0, 0.0, 0.0]],
            [[10.0, 3.0, -5.0], [-20.0, 0.0, 10.0]],
            [[0.0, 30.0, 0.0], [3.0, 0.0, 3.0]],
        ],
    ),
    (
        "landscape",
        &["landscape.glb"],
        [
            [[0.0, 8.0, 40.0], [0.0, 0.0, 0.0]],
            [[-40.0, 10.0, -40.0], [0.0, 0.0, 0.0]],
            [[20.0, 6.0, -10.0], [-40.0, 0.0, 20.0]],
            [[0.0, 60.0, 0.0], [5.0, 0.0, 5.0]],
        ],
    ),
];

/// Triangles, and how many each mesh has.
struct Scene {
    name: &'static str,
    triangles: Vec<Tri>,
    sizes: Vec<usize>,
    views: [View; 4],
}

/// The section, from meshes in `folder`.
pub(crate) fn section(folder: &Path) -> Result<String, Box<dyn Error>> {
    let mut text = String::from(TITLE);
    text += "\nMade by `cargo run --release -p tests --bin trees -- --ordinary FOLDER`, with what \
             `python tests/peers/landscape.py FOLDER` writes there. Both meshes have 1.5 million triangles: \
             390,000 blades of grass on hills; terrain, petals and columns over a plain, edges from 4 mm to 566 m. The hard scene \
             is that of the next section. Seconds are medians of ";
    let _ = write!(text, "{ROUNDS} interleaved rounds, without placing, welding and writing. ");
    text += "References, steps and tests as below.\n\n\
             | scene | tree | threads | CPU s | wall s | references | steps | tests |\n|---|---|---|---|---|---|---|---|\n";
    for (name, files, views) in MESHES {
        let mut scene = Scene { name, triangles: Vec::new(), sizes: Vec::new(), views };
        for file in files {
            let mesh =
                import::load_gltf(&folder.join(file), &GltfChoice::default(), &Limits::default())?;
            let corners = |part: &import::Part| -> Vec<Tri> {
                (0..part.triangles.len()).map(|tri_idx| part.corners(tri_idx)).collect()
            };
            let triangles: Vec<Tri> = mesh.parts.iter().flat_map(corners).collect();
            scene.sizes.push(triangles.len());
            scene.triangles.extend(triangles);
        }
        text += &rows(&scene)?;
    }
    let triangles = scene::scene(true);
    let sizes = vec![triangles.len()];
    text += &rows(&Scene { name: "hard", triangles, sizes, views: scene::VIEWS })?;
    Ok(text)
}

fn rows(scene: &Scene) -> Result<String, Box<dyn Error>> {
    let mut times = [const { Vec::new() }; BUILDS.len()];
    let mut trees: Vec<Joined> = Vec::new();
    for round in 0..ROUNDS {
        for ((preset, threads), times) in BUILDS.into_iter().zip(&mut times) {
            let (tree, time) = build(scene, preset, threads)?;
            times.push(time);
            if round == 0 {
                trees.push(tree);
            }
        }
    }
    let walks: Vec<Walked> = trees.iter().map(walked).collect();
    let rays = walks[0].rays(&scene.triangles, &scene.views);
    let costs: Vec<Cost> = walks.iter().map(|w| w.cost(&rays, &scene.triangles)).collect();
    let mut text = String::new();
    for (k, (preset, threads)) in BUILDS.into_iter().enumerate() {
        let median = |of: fn(&[f64; 2]) -> f64| {
            let mut list: Vec<f64> = times[k].iter().map(of).collect();
            list.sort_by(f64::total_cmp);
            list[ROUNDS / 2]
        };
        let per_ray = |count: u64| count as f64 / rays.len() as f64;
        let _ = writeln!(
            text,
            "| {} | `{preset}` | {threads} | {:.2} | {:.2} | {:.3} | {:.1} | {:.1} |",
            scene.name,
            median(|t| t[0]),
            median(|t| t[1]),
            trees[k].triangle_order.len() as f64 / scene.triangles.len() as f64,
            per_ray(costs[k].steps),
            per_ray(costs[k].tests),
        );
        assert_eq!(costs[k].hits, costs[0].hits, "{preset} finds other hits");
    }
    for (one, two) in [(0, 2), (1, 3)] {
        assert_eq!(trees[one], trees[two], "threads change the tree of {}", scene.name);
    }
    Ok(text)
}

/// The tree, and its CPU and wall seconds.
fn build(
    scene: &Scene,
    preset: Preset,
    threads: usize,
) -> Result<(Joined, [f64; 2]), Box<dyn Error>> {
    let primitives = Primitives {
        triangles: &scene.triangles,
        mesh_sizes: &scene.sizes,
        mesh_motions: &[],
        spheres: &[],
        sphere_motions: &[],
    };
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build()?;
    let (cpu, wall) = (cpu_seconds(), Instant::now());
    let built = pool.install(|| bvh::build_scene(&primitives, preset, &Cache::disabled()));
    let time = [cpu_seconds() - cpu, wall.elapsed().as_secs_f64()];
    Ok((built?.0, time))
}
