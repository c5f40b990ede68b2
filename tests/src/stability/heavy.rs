//! What takes minutes or gigabytes: measured with `--heavy`, kept in a file, shown on the page.

use std::path::{Path, PathBuf};
use std::time::Instant;

use super::shapes::one_centroid;
use super::tools::{WHITE_SKY, films_of, shot, sized, view};
use crate::scene;

/// One thing that is measured by hand: the case it belongs to, what, what it should be, and how it is measured.
pub type Heavy = (&'static str, &'static str, &'static str, fn() -> (String, bool));

/// All of them.
pub const HEAVY: &[Heavy] = &[
    ("X04", "time to build a tree of 1e5 triangles with one centroid", "< 1 s", build_time),
    ("X19", "1e7 triangles: build, render, depth of the stack", "right, ≤ 65", ten_million),
    ("X50", "1x1 image of 2^20 samples, in f32 and f64", "1, exact", a_million_samples),
    ("X50", "whole image of 16384x16384, 1 sample", "1, exact", a_large_image),
];

/// Where the results are.
#[must_use]
pub fn results() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("stability/heavy.tsv")
}

fn build_time() -> (String, bool) {
    let dir = tempfile::tempdir().expect("a temporary directory can be made");
    std::fs::write(dir.path().join("t.obj"), one_centroid(100_000)).expect("writable");
    let text = format!(
        "rts 1\n{WHITE_SKY}asset t = obj(\"t.obj\", unit: m, up: +y)\nmaterial m: diffuse {{ color = linear(0.5) }}
instance i {{ shape = t, material = m }}\n{}",
        shot([0.0, 0.0, 5.0], [0.0; 3], 30.0, 4)
    );
    let compiled = scene::compile_in(dir.path(), &text);
    let tree = compiled.lowered.times.bvh.as_secs_f64();
    (format!("{tree:.2} s"), tree < 1.0)
}

fn ten_million() -> (String, bool) {
    use std::io::Write as _;
    let dir = tempfile::tempdir().expect("a temporary directory can be made");
    let n = 2236_usize;
    let file = std::fs::File::create(dir.path().join("t.obj")).expect("writable");
    let mut file = std::io::BufWriter::new(file);
    for i in 0..=n {
        for j in 0..=n {
            let at = |k: usize| 2.0 * k as f64 / n as f64 - 1.0;
            writeln!(file, "v {:.6} {:.6} 0", at(i), at(j)).expect("writable");
        }
    }
    for a in (0..n).flat_map(|i| (0..n).map(move |j| i * (n + 1) + j + 1)) {
        let (b, c, d) = (a + 1, a + n + 1, a + n + 2);
        writeln!(file, "f {a} {c} {d}\nf {a} {d} {b}").expect("writable");
    }
    file.flush().expect("writable");
    drop(file);
    let text = format!(
        "rts 1\n{WHITE_SKY}asset t = obj(\"t.obj\", unit: m, up: +y)\nmaterial m: diffuse {{ color = linear(0.5) }}
instance i {{ shape = t, material = m }}\n{}",
        shot([0.0, 0.0, 5.0], [0.0; 3], 10.0, 2)
    );
    let begin = Instant::now();
    let compiled = scene::compile_in(dir.path(), &text);
    let time = begin.elapsed().as_secs_f64();
    let (triangles, need) = (compiled.lowered.triangles.len(), compiled.lowered.render.stack_need);
    let films = films_of(&scene::bytes(&compiled), sized(64, 1));
    let right = films.iter().all(|film| film.means().iter().all(|rgb| (rgb[1] - 0.5).abs() < 1e-6));
    (
        format!(
            "{triangles} triangles, {time:.0} s, depth {need}, radiance {}",
            if right { "right" } else { "wrong" }
        ),
        right && need <= 65 && triangles >= 9_999_000,
    )
}

fn sky() -> Vec<u8> {
    scene::bytes(&scene::compile(&format!(
        "rts 1\n{WHITE_SKY}{}",
        view([0.0, 0.0, 5.0], [0.0; 3], 2)
    )))
}

fn a_million_samples() -> (String, bool) {
    let films = films_of(&sky(), sized(1, 1 << 20));
    let values = films.each_ref().map(|film| film.mean(0)[1]);
    let rays = films.each_ref().map(|film| film.counters.rays);
    (
        format!("{} and {}, {} rays", values[0], values[1], rays[0]),
        values.map(f64::to_bits) == [1.0_f64.to_bits(); 2] && rays == [1 << 20; 2],
    )
}

fn a_large_image() -> (String, bool) {
    let pack = super::tools::open(&sky());
    let outcome = crate::picture::cpu(pack, sized(16_384, 1));
    let film = outcome.film();
    let all = film.sums.iter().all(|sum| super::tools::equal(*sum, [1.0; 3]));
    (format!("{} pixels, all 1: {all}", film.sums.len()), all)
}

/// Measures those that have `only` in their case or name, and rewrites their lines of the file.
///
/// # Errors
/// When the file cannot be written.
pub fn measure(only: &str) -> std::io::Result<()> {
    let old = std::fs::read_to_string(results()).unwrap_or_default();
    let mut lines: Vec<String> = old.lines().map(str::to_owned).collect();
    for (id, what, expected, run) in HEAVY {
        if !format!("{id} {what}").contains(only) {
            continue;
        }
        let (found, holds) = run();
        let begin = format!("{id}\t{what}\t");
        lines.retain(|line| !line.starts_with(&begin));
        let line = format!("{begin}{expected}\t{found}\t{}", if holds { "holds" } else { "fails" });
        crate::console::line(&line);
        lines.push(line);
        lines.sort();
        std::fs::create_dir_all(results().parent().expect("a file has a folder"))?;
        std::fs::write(results(), lines.join("\n") + "\n")?;
    }
    Ok(())
}
