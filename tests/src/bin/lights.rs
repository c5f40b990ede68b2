//! `cargo run --release -p tests --bin lights`: measures how lights are chosen and rewrites `docs/lights.md`.
//!
//! Noise is the variance of a pixel's samples over the square of the picture's mean, averaged over pixels;
//! cost is CPU seconds for a sample of every pixel. Their product says how long a given error takes, whatever
//! the number of samples: lower is better.

use std::fmt::Write as _;
use std::path::Path;

use compiler::lower::Visibility;
use compiler::pipeline::Compiled;
use cpu_time::ProcessTime;
use pack::Pack;
use runtime::{Control, DeviceChoice, Job, SampleRange, Scene, render};
use tests::scene;
use tests::statistics::stream::Stream;

/// Pixels of each picture.
const SIZE: [u32; 2] = [64, 48];
/// Independent pictures, each of so many samples a pixel.
const SEEDS: u32 = 16;
const SAMPLES: u32 = 16;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut text = String::from(HEADER);
    skies(&mut text)?;
    few(&mut text)?;
    many(&mut text)?;
    hidden(&mut text)?;
    let target = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/lights.md");
    std::fs::write(&target, &text)?;
    tests::console::line(&text);
    Ok(())
}

const HEADER: &str = "# How lights are chosen\n\n\
    Made by `cargo run --release -p tests --bin lights`; edit the program, not this page.\n\n\
    At each vertex one light is sampled and one direction by the material; both are weighted by the balance \
    heuristic. The light is taken from a table by its power, as far as it comes into the ball around everything \
    that is not a light itself; the sky counts with its flux through that ball. From two lights on a tree of \
    lights chooses by distance, by the directions that lights face and by the normal of the surface that is lit; of \
    up to eight lights each is weighed by itself. Lights that none of the paths traced by `rtc` receives count for \
    1/128 of their power (`--visibility never` leaves that out). The number that chooses a light also chooses the point on it. \
    Samples are independent here, so that noise does not depend on how many there are, unless a row says otherwise.\n\n\
    Noise is the variance of a pixel's samples over the square of the mean of the picture, averaged over pixels. \
    Cost is CPU microseconds for a sample of a pixel. Their product says how long a given error takes; lower is \
    better.\n";

/// Noise and cost of a scene.
#[derive(Clone, Copy, Debug)]
struct Measured {
    noise: f64,
    cost: f64,
}

impl Measured {
    fn product(self) -> f64 {
        self.noise * self.cost
    }
}

/// Renders `bytes` with each seed; `estimator` as in `Job`.
fn measure(bytes: &[u8], estimator: u32) -> Result<Measured, Box<dyn std::error::Error>> {
    let scene = Scene::new(Pack::from_bytes(bytes.to_vec())?);
    let n = f64::from(SEEDS);
    let mut sums: Vec<(f64, f64)> = Vec::new();
    let start = ProcessTime::now();
    for seed in 0..SEEDS {
        let mut job = Job::of_scene(&scene);
        job.resize(SIZE);
        job.estimator = estimator;
        job.seed = 1 + seed;
        job.samples = SampleRange { start: 0, end: SAMPLES };
        let outcome = render(&scene, &job, &DeviceChoice::Cpu, &Control::default())?;
        let means = outcome.film().means();
        sums.resize(means.len(), (0.0, 0.0));
        for (sum, rgb) in sums.iter_mut().zip(&means) {
            let value = 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
            sum.0 += value;
            sum.1 += value * value;
        }
    }
    let seconds = start.elapsed().as_secs_f64();
    let pixels = sums.len() as f64;
    let mean = sums.iter().map(|sum| sum.0).sum::<f64>() / n / pixels;
    let variance =
        sums.iter().map(|sum| (sum.1 - sum.0 * sum.0 / n) / (n - 1.0)).sum::<f64>() / pixels;
    let samples = f64::from(SAMPLES);
    Ok(Measured {
        noise: variance * samples / (mean * mean),
        cost: seconds * 1e6 / (n * samples * pixels),
    })
}

/// Gradient skies on a diffuse plane with a ball on it: with and without sampling the sky.
fn skies(text: &mut String) -> Result<(), Box<dyn std::error::Error>> {
    let rows = [
        ("sun of the defaults", "sun.direction = (0.692, 0.207, -0.692)"),
        ("sun overhead", "sun.direction = (0.1, 0.9, 0.2)"),
        ("glow without a disc", "sun.direction = (0.692, 0.207, -0.692), disc.color = linear(0)"),
        (
            "a disc of 2 degrees, `disc.power` 4000",
            "sun.direction = (0.692, 0.207, -0.692), disc.power = 4000, disc.color = linear(150, 127, 60)",
        ),
        (
            "bands alone (a glow of 1e-9 makes it a light)",
            "sun.direction = (0.692, 0.207, -0.692), disc.color = linear(0), glow.color = linear(1e-9)",
        ),
    ];
    text.push_str(
        "\n## Gradient skies: a grey plane and a ball, two bounces\n\n\
         | sky | found by chance: noise | cost | sampled: noise | cost | product, by chance over sampled |\n\
         |---|---|---|---|---|---|\n",
    );
    for (name, fields) in rows {
        let scene_text = format!(
            "rts 1
sky s: gradient {{ {fields} }}
material grey: diffuse {{ color = linear(0.6) }}
instance floor {{ shape = rectangle(size: (20, 20)m), material = grey }}
instance ball {{ shape = sphere(radius: 1m), material = grey, at = (0, 1, 0)m }}
camera eye: perspective {{ from = (0, 3, 6)m, to = (0, 0.6, 0)m, fov.vertical = 40deg }}
film f {{ size = (64, 48)px }}
render main: path {{ camera = eye, film = f, samples = 16, depth = 4, sampler = pcg }}
"
        );
        let bytes = scene::bytes(&scene::compile(&scene_text));
        let (chance, sampled) = (measure(&bytes, 2)?, measure(&bytes, 0)?);
        let _ = writeln!(
            text,
            "| {name} | {:.3} | {:.2} | {:.3} | {:.2} | {:.2}x |",
            chance.noise,
            chance.cost,
            sampled.noise,
            sampled.cost,
            chance.product() / sampled.product(),
        );
    }
    Ok(())
}

/// A row of one scene, by the table of powers and by the tree.
fn row(
    text: &mut String,
    name: &str,
    mut compiled: Compiled,
) -> Result<(), Box<dyn std::error::Error>> {
    let tree = measure(&scene::bytes(&compiled), 0)?;
    compiled.lowered.light_nodes.clear();
    for light in &mut compiled.lowered.lights {
        light.trail = 0;
    }
    let table = measure(&scene::bytes(&compiled), 0)?;
    let _ = writeln!(
        text,
        "| {name} | {:.3} | {:.2} | {:.3} | {:.2} | {:.2}x |",
        table.noise,
        table.cost,
        tree.noise,
        tree.cost,
        table.product() / tree.product(),
    );
    Ok(())
}

/// A scene of a few lights, and what it is called.
fn few_scenes() -> Vec<(&'static str, String)> {
    // Cameras look down: lamps that are seen would be most of the noise.
    let down =
        "camera eye: perspective { from = (0, 1.2, 3)m, to = (0, 0, 0)m, fov.vertical = 35deg }\n";
    let far = "camera eye: perspective { from = (0, 2, 5)m, to = (0, 0.3, -0.6)m, fov.vertical = 14deg }\n";
    let lamp = |name: usize, [x, y, z]: [f64; 3], radius: f64, strength: f64| {
        format!(
            "light lamp{name}: sphere {{ center = ({x}, {y}, {z})m, radius = {radius}m, strength = {strength} }}\n"
        )
    };
    let corridor: String = (0_u8..15)
        .map(|i| lamp(i.into(), [f64::from(i) * 4.0 - 28.0, 1.5, 0.0], 0.05, 50.0))
        .collect();
    let cellar: String = (0_u8..8)
        .map(|i| {
            let y = if i % 2 == 0 { 1.5 } else { -1.5 };
            lamp(i.into(), [f64::from(i) - 3.5, y, 0.0], 0.05, 50.0)
        })
        .collect();
    let two = lamp(0, [-2.0, 2.0, 0.0], 0.3, 4.0) + &lamp(1, [2.0, 2.0, 0.0], 0.1, 60.0);
    let plates: String = [(0.06, 75.0), (0.12, 25.0), (0.2, 9.0), (0.3, 5.0)]
        .into_iter()
        .enumerate()
        .map(|(i, (radius, strength))| lamp(i, [i as f64 * 0.8 - 1.2, 2.2, -1.6], radius, strength))
        .collect::<String>()
        + "material plate: conductor { color = linear(0.9), roughness = 0.25 }
instance tilted { shape = box(size: (3.4, 0.04, 0.8)m), material = plate, at = (0, 0.6, -0.6)m, rotate = (25, 0, 0)deg }
instance wall { shape = rectangle(size: (12, 8)m), material = grey, at = (0, 0, -3)m, rotate = (90, 0, 0)deg }
";
    vec![
        ("corridor of 15 equal lamps", corridor + down),
        ("eight lamps, half of them below the floor", cellar + down),
        ("two lamps of unequal power", two + down),
        ("four lamps of unequal size and power over a metal plate, after Veach", plates + far),
    ]
}

/// Few lights over a floor, independent samples and Sobol's.
fn few(text: &mut String) -> Result<(), Box<dyn std::error::Error>> {
    text.push_str(
        "\n## Few lamps\n\n\
         | scene | table: noise | cost | tree: noise | cost | product, table over tree |\n\
         |---|---|---|---|---|---|\n",
    );
    for (name, lights) in few_scenes() {
        for (sampler, suffix) in [("pcg", ""), ("sobol", ", Sobol's samples, 16 a pixel")] {
            let scene_text = format!(
                "rts 1
material grey: diffuse {{ color = linear(0.5) }}
instance floor {{ shape = rectangle(size: (80, 12)m), material = grey }}
{lights}
film f {{ size = (64, 48)px }}
render main: path {{ camera = eye, film = f, samples = 16, depth = 2, sampler = {sampler} }}
"
            );
            row(text, &format!("{name}{suffix}"), scene::compile(&scene_text))?;
        }
    }
    Ok(())
}

/// Triangles over the hall; those of the ball are 2 (rows - 1) columns.
const LIGHTS: usize = 10_000;

/// As OBJ text: small triangles, facing down, over a square of side 60 at height 3.
fn ceiling() -> String {
    let mut stream = Stream::new(1, 0);
    let mut obj = String::new();
    for i in 0..LIGHTS {
        let (x, z) = (stream.between(-30.0, 30.0), stream.between(-30.0, 30.0));
        let _ = writeln!(obj, "v {x} 3 {z}\nv {} 3 {z}\nv {x} 3 {}", x + 0.06, z + 0.06);
        let _ = writeln!(obj, "f {} {} {}", 3 * i + 1, 3 * i + 2, 3 * i + 3);
    }
    obj
}

/// As OBJ text: a ball of radius 1 made of triangles that face outside.
fn globe() -> String {
    let (rows, columns) = (51_usize, 100_usize);
    let mut obj = String::new();
    for row in 0..=rows {
        for column in 0..columns {
            let theta = std::f64::consts::PI * row as f64 / rows as f64;
            let phi = std::f64::consts::TAU * column as f64 / columns as f64;
            let (x, z) = (theta.sin() * phi.cos(), theta.sin() * phi.sin());
            let _ = writeln!(obj, "v {x} {} {z}", theta.cos());
        }
    }
    let at = |row: usize, column: usize| row * columns + column % columns + 1;
    for row in 0..rows {
        for column in 0..columns {
            let (a, b) = (at(row, column), at(row, column + 1));
            let (c, d) = (at(row + 1, column), at(row + 1, column + 1));
            // One triangle at the poles, where the other has no area.
            if row > 0 {
                let _ = writeln!(obj, "f {a} {b} {c}");
            }
            if row + 1 < rows {
                let _ = writeln!(obj, "f {b} {d} {c}");
            }
        }
    }
    obj
}

/// Ten thousand triangles that glow, chosen by the table and by the tree.
fn many(text: &mut String) -> Result<(), Box<dyn std::error::Error>> {
    // The camera looks down: lights smaller than a pixel would be most of what it sees of noise.
    let spread = "instance glow { shape = mesh, material = lamp }
camera eye: perspective { from = (0, 2.8, 5)m, to = (0, 0, 0)m, fov.vertical = 40deg }";
    let compact = "instance glow { shape = mesh, material = lamp, at = (0, 1.5, 0)m, scale = 0.4 }
instance back { shape = rectangle(size: (60, 60)m), material = grey, rotate = (90, 0, 0)deg, at = (0, 0, -4)m }
camera eye: perspective { from = (0, 2, 6)m, to = (0, 1.2, 0)m, fov.vertical = 50deg }";
    text.push_str(
        "\n## Ten thousand glowing triangles\n\n\
         | scene | table: noise | cost | tree: noise | cost | product, table over tree |\n\
         |---|---|---|---|---|---|\n",
    );
    for (name, obj, rest) in [
        ("spread over the ceiling of a hall of 60 m", ceiling(), spread),
        ("one glowing ball of 40 cm over a floor", globe(), compact),
    ] {
        let dir = tempfile::tempdir()?;
        std::fs::write(dir.path().join("mesh.obj"), obj)?;
        let scene_text = format!(
            "rts 1
asset mesh = obj(\"mesh.obj\", unit: m, up: +y)
material lamp: emissive {{ color = linear(1), strength = 30, sides = front }}
material grey: diffuse {{ color = linear(0.5) }}
material gloss: principled {{ color = linear(0.4, 0.5, 0.6), roughness = 0.3 }}
instance floor {{ shape = rectangle(size: (60, 60)m), material = grey }}
instance ball {{ shape = sphere(radius: 80cm), material = gloss, at = (1.6, 0.8, 1)m }}
instance block {{ shape = box(size: (1, 1.4, 1)m), material = grey, at = (-1.6, 0.7, 0)m }}
{rest}
film f {{ size = (64, 48)px }}
render main: path {{ camera = eye, film = f, samples = 16, depth = 4, sampler = pcg }}
"
        );
        row(text, name, scene::compile_in(dir.path(), &scene_text))?;
    }
    Ok(())
}

/// As OBJ text: `n` small triangles, facing down, in a box around the origin with these half sides.
fn swarm(n: usize, [x, y, z]: [f64; 3]) -> String {
    let mut stream = Stream::new(2, 0);
    let mut obj = String::new();
    for i in 0..n {
        let [a, b, c] = [x, y, z].map(|half| stream.between(-half, half));
        let _ = writeln!(obj, "v {a} {b} {c}\nv {} {b} {c}\nv {a} {b} {}", a + 0.02, c + 0.02);
        let _ = writeln!(obj, "f {} {} {}", 3 * i + 1, 3 * i + 2, 3 * i + 3);
    }
    obj
}

/// Ten thousand lamps, the strongest tenth of them in a closed crate, with and without learned visibility.
fn hidden(text: &mut String) -> Result<(), Box<dyn std::error::Error>> {
    text.push_str(
        "\n## Ten thousand lamps, a tenth of them a hundred times as strong in a closed crate\n\n\
         | sampler | all count: noise | cost | visibility learned: noise | cost | product, all over learned |\n\
         |---|---|---|---|---|---|\n",
    );
    let dir = tempfile::tempdir()?;
    std::fs::write(dir.path().join("open.obj"), swarm(LIGHTS - LIGHTS / 10, [6.0, 0.2, 6.0]))?;
    std::fs::write(dir.path().join("shut.obj"), swarm(LIGHTS / 10, [0.9, 0.7, 0.9]))?;
    for (name, sampler) in [("independent", "pcg"), ("Sobol", "sobol")] {
        let scene_text = format!(
            "rts 1
asset open = obj(\"open.obj\", unit: m, up: +y)
asset shut = obj(\"shut.obj\", unit: m, up: +y)
material glow: emissive {{ color = linear(1), strength = 20, sides = front }}
material glare: emissive {{ color = linear(1), strength = 2000, sides = front }}
material grey: diffuse {{ color = linear(0.6) }}
instance lamps {{ shape = open, material = glow, at = (0, 3, 0)m }}
instance strong {{ shape = shut, material = glare, at = (0, 1, 0)m }}
instance floor {{ shape = rectangle(size: (14, 14)m), material = grey }}
instance crate {{ shape = box(size: (2, 2, 2)m), material = grey, at = (0, 1.001, 0)m }}
camera eye: perspective {{ from = (0, 2.6, 6)m, to = (0, 0.4, 0.5)m, fov.vertical = 24deg }}
film f {{ size = (64, 48)px }}
render main: path {{ camera = eye, film = f, samples = 16, depth = 4, sampler = {sampler} }}
"
        );
        let of = |visibility| {
            measure(&scene::bytes(&scene::compile_lit(dir.path(), &scene_text, visibility)), 0)
        };
        let (all, learned) = (of(Visibility::Never)?, of(Visibility::Auto)?);
        let _ = writeln!(
            text,
            "| {name} | {:.3} | {:.2} | {:.3} | {:.2} | {:.2}x |",
            all.noise,
            all.cost,
            learned.noise,
            learned.cost,
            all.product() / learned.product(),
        );
    }
    Ok(())
}
