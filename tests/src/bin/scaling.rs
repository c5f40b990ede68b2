//! `cargo run --release -p tests --bin scaling`: measures how cost grows with the number of triangles and rewrites
//! `docs/scaling.md`.
//!
//! One landscape at more and more triangles, seen by the same camera, through the whole of the compiler and the CPU
//! kernel. Exponents are slopes of least squares through the logarithms.

use std::fmt::Write as _;
use std::path::Path;
use std::time::Instant;

use compiler::bvh::{Input, Preset, build};
use cpu_time::ProcessTime;
use pack::abi::Triangle;
use runtime::{Control, DeviceChoice, Job, SampleRange, Scene, render};
use scenes::generate::{Glb, MaterialSpec, MeshData, NodeSpec};
use tests::scene;

/// Squares along a side of the landscape; two triangles a square.
const SIDES: [u32; 7] = [71, 126, 224, 400, 707, 1265, 2237];

/// Width and depth of the landscape, metres.
const WIDTH: f32 = 60.0;

const SIZE: [u32; 2] = [256, 144];
const SAMPLES: u32 = 16;

const TEXT: &str = "rts 1
asset land = gltf(\"land.glb\")
instance hills { shape = land }
light lamp: sphere { center = (18, 26, -10)m, radius = 3m, color = linear(90) }
sky above: constant { color = linear(0.4) }
camera eye: perspective { from = (0, 6, 26)m, to = (0, -1.5, 0)m, fov.vertical = 40deg }
film small { size = (256, 144)px }
render main: path { samples = 16, depth = 8 }
";

/// What one size costs.
struct Point {
    triangles: f64,
    /// CPU seconds from text to pack, without the tree; of the tree.
    compile: f64,
    tree: f64,
    /// Bytes.
    pack: f64,
    /// Wall seconds.
    open: f64,
    /// CPU seconds for a million rays.
    trace: f64,
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let points: Result<Vec<Point>, _> = SIDES.into_iter().map(measure).collect();
    let text = page(&points?);
    let target = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/scaling.md");
    std::fs::write(target, &text)?;
    tests::console::line(&text);
    Ok(())
}

/// Hills with furrows, metres.
fn height(x: f32, z: f32) -> f32 {
    1.6 * (0.21 * x + 0.4).sin() * (0.17 * z).cos()
        + 0.5 * (0.63 * x).sin() * (0.71 * z).sin()
        + 0.06 * (3.1 * x + 1.7 * z).sin()
}

/// The landscape with `side` squares along a side.
fn landscape(side: u32) -> MeshData {
    let mut mesh = MeshData::default();
    let at = |i: u32| WIDTH * (i as f32 / side as f32 - 0.5);
    for (x, z) in (0..=side).flat_map(|i| (0..=side).map(move |j| (at(i), at(j)))) {
        let h = 1e-2;
        let slope = |dx: f32, dz: f32| height(x + dx, z + dz) - height(x - dx, z - dz);
        let n = glam::Vec3::new(-slope(h, 0.0), 2.0 * h, -slope(0.0, h)).normalize();
        mesh.positions.push([x, height(x, z), z]);
        mesh.normals.push(n.to_array());
        mesh.uvs.push([0.0; 2]);
    }
    for (i, j) in (0..side).flat_map(|i| (0..side).map(move |j| (i, j))) {
        let a = i * (side + 1) + j;
        let (b, c, d) = (a + 1, a + side + 1, a + side + 2);
        mesh.indices.extend([a, b, d, a, d, c]);
    }
    mesh
}

fn write(side: u32, path: &Path) -> std::io::Result<()> {
    let mut glb = Glb::default();
    let material = glb.material(MaterialSpec(serde_json::json!({
        "pbrMetallicRoughness": { "baseColorFactor": [0.4, 0.36, 0.3, 1.0], "metallicFactor": 0.0 },
    })));
    let mesh = glb.mesh("land", &landscape(side), material);
    let node = NodeSpec {
        name: "land".to_owned(),
        mesh: Some(mesh),
        translation: [0.0; 3],
        scale: 1.0,
        children: Vec::new(),
    };
    glb.node(node);
    std::fs::write(path, glb.finish())
}

fn measure(side: u32) -> Result<Point, Box<dyn std::error::Error>> {
    let folder = tempfile::tempdir()?;
    write(side, &folder.path().join("land.glb"))?;
    let start = ProcessTime::now();
    let compiled = scene::compile_in(folder.path(), TEXT);
    let path = folder.path().join("land.pack");
    compiled.writer(&compiler::lower::srgb_table())?.write(&path)?;
    let all = start.elapsed().as_secs_f64();
    let triangles = compiled.lowered.counters.triangles as f64;
    drop(compiled);

    let start = Instant::now();
    let pack = tests::mapped::map(&path)?;
    let open = start.elapsed().as_secs_f64();
    let tree = tree(pack.records::<Triangle>())?;
    let scene = Scene::new(pack);
    let trace = trace(&scene)?;
    let pack = std::fs::metadata(&path)?.len() as f64;
    let point = Point { triangles, compile: (all - tree).max(0.0), tree, pack, open, trace };
    tests::console::line(&row(&point));
    Ok(point)
}

/// CPU seconds to build the tree anew over triangles in the order of the pack, each once.
fn tree(triangles: &[Triangle]) -> Result<f64, Box<dyn std::error::Error>> {
    let mut once: Vec<&Triangle> = triangles.iter().collect();
    once.sort_by_key(|t| (t.id0, t.id1, t.id2));
    once.dedup_by_key(|t| (t.id0, t.id1, t.id2));
    let corners: Vec<_> = once.into_iter().map(|t| [t.v0, t.v1, t.v2]).collect();
    let start = ProcessTime::now();
    build(Preset::default(), Input::of_triangles(&corners))?;
    Ok(start.elapsed().as_secs_f64())
}

/// CPU seconds for a million rays.
fn trace(scene: &Scene) -> Result<f64, String> {
    let mut job = Job::of_scene(scene);
    job.resize(SIZE);
    job.samples = SampleRange { start: 0, end: SAMPLES };
    let start = ProcessTime::now();
    let outcome =
        render(scene, &job, &DeviceChoice::Cpu, &Control::default()).map_err(|e| e.to_string())?;
    let rays = outcome.film().counters.rays as f64;
    Ok(start.elapsed().as_secs_f64() * 1e6 / rays)
}

fn row(point: &Point) -> String {
    format!(
        "| {:.0} | {:.3} | {:.3} | {:.1} | {:.1} | {:.2} | {:.3} |",
        point.triangles,
        point.compile,
        point.tree,
        point.pack / 1e6,
        point.pack / point.triangles,
        1e3 * point.open,
        point.trace,
    )
}

/// One of the costs.
type Cost = fn(&Point) -> f64;

/// The slope of ln y over ln n.
fn exponent(points: &[Point], y: Cost) -> f64 {
    let logs: Vec<(f64, f64)> =
        points.iter().map(|p| (p.triangles.ln(), y(p).max(1e-9).ln())).collect();
    let n = logs.len() as f64;
    let mean = |f: fn(&(f64, f64)) -> f64| logs.iter().map(f).sum::<f64>() / n;
    let (mx, my) = (mean(|l| l.0), mean(|l| l.1));
    let covariance: f64 = logs.iter().map(|(x, y)| (x - mx) * (y - my)).sum();
    let variance: f64 = logs.iter().map(|(x, _)| (x - mx).powi(2)).sum();
    covariance / variance
}

fn page(points: &[Point]) -> String {
    let mut text = format!(
        "# How cost grows with the number of triangles\n\n\
        Made by `cargo run --release -p tests --bin scaling`; edit the program, not this page.\n\n\
        One landscape at more and more triangles, seen by the same camera at {} x {} pixels, {SAMPLES} samples, up \
        to 8 vertices a path, on the CPU kernel. CPU seconds are user + system time of the whole process; opening is \
        seconds of the clock, map and check of every rule. The tree is `--bvh default`, one build; the rest of \
        compiling is reading the file, normals, order, proof of the kernel and writing.\n\n\
        | triangles | compiling, CPU s | the tree, CPU s | pack, MB | bytes a triangle | opening, ms | CPU s a Mray |\n\
        |---|---|---|---|---|---|---|\n",
        SIZE[0], SIZE[1],
    );
    for point in points {
        let _ = writeln!(text, "{}", row(point));
    }
    let fits: [(&str, Cost); 5] = [
        ("compiling", |p| p.compile),
        ("tree", |p| p.tree),
        ("pack", |p| p.pack),
        ("opening", |p| p.open),
        ("a ray", |p| p.trace),
    ];
    text += "\nExponents k of a fit c n^k over the sizes from 100,000 triangles on, where constant parts no longer \
             count:\n\n| what | k |\n|---|---|\n";
    for (what, y) in fits {
        let _ = writeln!(text, "| {what} | {:.2} |", exponent(&points[2..], y));
    }
    text
}
