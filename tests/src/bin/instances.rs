//! `cargo run --package tests --bin instances`: measures and rewrites `docs/instances.md`.
//!
//! Meshes of several sizes in several places, stored once (`rtc --instances auto`) and for each place
//! (`--instances never`): size of the pack, time of rays.

use std::fmt::Write as _;
use std::path::Path;

use compiler::bvh::Layout;
use compiler::lower::{Instancing, MIN_SAVED, MIN_TRIANGLES};
use cpu_time::ProcessTime;
use pack::Pack;
use runtime::{Control, DeviceChoice, Job, Scene, render};
use tests::scene;
use tests::statistics::stream::Stream;

/// Rounds of each measurement; odd, so that the median is a measured value.
const ROUNDS: usize = 5;
/// Bands around and along the balls: 72 to 3,000 triangles.
const BALLS: [(u32, u32); 4] = [(6, 7), (9, 9), (20, 13), (50, 31)];
/// How many balls there are, in which space they are, metres, and their radius.
const PLACES: [(&str, usize, f64, f64); 4] = [
    ("2, apart", 2, 3.0, 1.0),
    ("16, apart", 16, 4.0, 0.9),
    ("200, touching", 200, 6.0, 0.6),
    ("200, through one another", 200, 2.0, 0.6),
];

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let dir = tempfile::tempdir()?;
    let mut text = format!(
        "# Meshes that are stored once\n\n\
        Made by `cargo run --package tests --bin instances`; edit the program, not this page.\n\n\
        A mesh that is placed twice or more is stored once, with one tree in its own frame, where that saves \
        {MIN_SAVED} triangles and the mesh has {MIN_TRIANGLES} or more; `rtc --instances never` stores every place. \
        Never stored once are places whose triangles are lights, whose leaves or petals depend on the name of the \
        thing (`gap`, `pillow`, `tilt`), and whose transform has no good inverse.\n\n\
        Balls of clay on a plane under a white sky, turned and stretched each in its own way. CPU seconds (user + \
        system) on one thread, medians of {ROUNDS} interleaved rounds; compare columns, not pages. A row whose mesh \
        is too small is stored in each place whatever was asked, and shows what the measurement is worth.\n\n\
        | triangles | places | pack, once | pack, each | CPU s, once | CPU s, each | ratio |\n\
        |---|---|---|---|---|---|---|\n"
    );
    for (around, along) in BALLS {
        let n_triangles = write_ball(&dir.path().join("ball.obj"), around, along)?;
        for places in PLACES {
            let row = row(dir.path(), n_triangles, places)?;
            tests::console::line(row.trim_end());
            text += &row;
        }
    }
    let target = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/instances.md");
    std::fs::write(&target, &text)?;
    Ok(())
}

/// Writes a ball; returns its number of triangles.
fn write_ball(path: &Path, around: u32, along: u32) -> std::io::Result<usize> {
    use std::f64::consts::PI;
    let mut text = String::from("s off\n");
    for j in 0..=along {
        for i in 0..around {
            let (sin, cos) = (2.0 * PI * f64::from(i) / f64::from(around)).sin_cos();
            let (radius, height) = (PI * f64::from(j) / f64::from(along)).sin_cos();
            let _ = writeln!(text, "v {:.6} {:.6} {:.6}", radius * cos, -height, radius * sin);
        }
    }
    let mut n_triangles = 0;
    for j in 0..along {
        for i in 0..around {
            let at = |i: u32, j: u32| j * around + i % around + 1;
            let [a, b, c, d] = [at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)];
            if j > 0 {
                let _ = writeln!(text, "f {a} {c} {d}");
                n_triangles += 1;
            }
            if j + 1 < along {
                let _ = writeln!(text, "f {a} {b} {c}");
                n_triangles += 1;
            }
        }
    }
    std::fs::write(path, text)?;
    Ok(n_triangles)
}

fn scene_text((_, n, spread, radius): (&str, usize, f64, f64)) -> String {
    let mut stream = Stream::new(7, 0);
    let mut text = String::from(
        "rts 1\nsky day: constant { color = linear(1) }\nmaterial clay: diffuse { color = linear(0.7) }\n\
         asset ball = obj(\"ball.obj\", unit: m, up: +y)\n\
         instance floor { shape = rectangle(size: (60, 60)m), material = clay, at = (0, -3, 0)m }\n",
    );
    for i in 0..n {
        let [x, z] = [0; 2].map(|_| stream.between(-spread, spread));
        let y = stream.between(-spread, spread) * 0.5;
        let [a, b] = [0; 2].map(|_| stream.between(0.0, 360.0));
        let tall = radius * stream.between(0.5, 1.5);
        let _ = writeln!(
            text,
            "instance b{i} {{ shape = ball, material = clay, at = ({x:.3}, {y:.3}, {z:.3})m, \
             scale = ({radius}, {tall:.3}, {radius}), rotate = ({a:.1}, {b:.1}, 0)deg }}"
        );
    }
    text + "camera eye: perspective { from = (0, 3, 12)m, to = (0, 0, 0)m, fov.vertical = 40deg }
film f { size = (160, 120)px }
render main: path { camera = eye, film = f, samples = 16, depth = 5, seed = 1 }\n"
}

/// One line of the table.
fn row(
    dir: &Path,
    n_triangles: usize,
    places: (&str, usize, f64, f64),
) -> Result<String, Box<dyn std::error::Error>> {
    let text = scene_text(places);
    let ways = [Instancing::Auto, Instancing::Never];
    let mut show = [Vec::new(), Vec::new()];
    let mut sizes = [0; 2];
    for _ in 0..ROUNDS {
        for (way, how) in ways.into_iter().enumerate() {
            let bytes =
                scene::bytes(&scene::compile_shared(dir, &text, (how, Layout::default()), |_| {}));
            sizes[way] = bytes.len();
            let scene = Scene::new(Pack::from_bytes(bytes)?);
            let mut job = Job::of_scene(&scene);
            job.threads = Some(1);
            let start = ProcessTime::now();
            render(&scene, &job, &DeviceChoice::Cpu, &Control::default())?;
            show[way].push(start.elapsed().as_secs_f64());
        }
    }
    let show = show.map(median);
    Ok(format!(
        "| {n_triangles} | {} | {:.2} MB | {:.2} MB | {:.3} | {:.3} | {:.2} |\n",
        places.0,
        sizes[0] as f64 / 1e6,
        sizes[1] as f64 / 1e6,
        show[0],
        show[1],
        show[0] / show[1],
    ))
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}
