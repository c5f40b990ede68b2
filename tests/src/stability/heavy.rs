//! What takes minutes or gigabytes: measured with `--heavy`, kept in a file, shown on the page.

use std::path::{Path, PathBuf};

use super::shapes::one_centroid;
use super::tools::{WHITE_SKY, films_of, shot, sized, view};
use crate::picture::channel;
use crate::scene;

/// One thing that is measured by hand: the case it belongs to, what, what it should be, and how it is measured.
pub type Heavy = (&'static str, &'static str, &'static str, fn() -> (String, bool));

/// All of them.
pub const HEAVY: &[Heavy] = &[
    ("X04", "time to build a tree of 1e5 triangles with one centroid", "< 1 s", build_time),
    ("X19", "1e7 triangles: build, render, depth of the stack", "right, ≤ 65", ten_million),
    ("X31", "first and last texels of a texture of 16384x16384", "to 8 bits", a_large_texture),
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
    let compiled = scene::compile_in(dir.path(), &text);
    let (triangles, need) = (compiled.lowered.triangles.len(), compiled.lowered.render.stack_need);
    let films = films_of(&scene::bytes(&compiled), sized(64, 1));
    let right = films.iter().all(|film| film.means().iter().all(|rgb| (rgb[1] - 0.5).abs() < 1e-6));
    (
        format!(
            "{triangles} triangles, depth {need}, radiance {}",
            if right { "right" } else { "wrong" }
        ),
        right && need <= 65 && triangles >= 9_999_000,
    )
}

/// Four quads, each of one texel, fill a picture of four pixels.
fn a_large_texture() -> (String, bool) {
    use std::fmt::Write as _;
    const SIDE: u32 = 16_384;
    let dir = tempfile::tempdir().expect("a temporary directory can be made");
    let grey = |x: u32, y: u32| u8::try_from((x + 7 * y) % 251).expect("below 251");
    let image = image::GrayImage::from_fn(SIDE, SIDE, |x, y| image::Luma([grey(x, y)]));
    image.save(dir.path().join("t.png")).expect("writable");
    drop(image);
    let last = SIDE - 1;
    // Pixels row by row from the top: the sides of the picture that they are on, and their texels.
    let quads =
        [([-1, 1], [0, 0]), ([1, 1], [last, 0]), ([-1, -1], [0, last]), ([1, -1], [last, last])];
    let mut obj = String::new();
    for (i, ([sx, sy], texel)) in (1..).zip(quads) {
        let [u, v] = texel.map(|k| (f64::from(k) + 0.5) / f64::from(SIDE));
        for [x, y] in [[0, 0], [2 * sx, 0], [2 * sx, 2 * sy], [0, 2 * sy]] {
            let _ = writeln!(obj, "v {x} {y} 0");
        }
        let [a, b, c, d] = [3, 2, 1, 0].map(|k| 4 * i - k);
        let _ = writeln!(
            obj,
            "vt {u} {}\nf {a}/{i} {b}/{i} {c}/{i}\nf {a}/{i} {c}/{i} {d}/{i}",
            1.0 - v
        );
    }
    std::fs::write(dir.path().join("q.obj"), obj).expect("writable");
    let shot =
        shot([0.0, 0.0, 5.0], [0.0; 3], 20.0, 1).replace("up = (0.1, 0.2, 1)", "up = (0, 1, 0)");
    let text = format!(
        "rts 1\ntexture t = image(\"t.png\", space: linear)\nasset q = obj(\"q.obj\", unit: m, up: +y)
material m: emissive {{ color = t.rgb }}\ninstance i {{ shape = q, material = m }}\n{shot}"
    );
    let bytes = scene::bytes(&scene::compile_in(dir.path(), &text));
    let films = films_of(&bytes, sized(2, 1));
    let expected = quads.map(|(_, [x, y])| grey(x, y));
    let found = films.each_ref().map(|film| channel(film, 0));
    // Near 1 a coordinate is rounded to 2^-24, a thousandth of a texel, and as much of the neighbour shows.
    let is = |x: f64, texel: u8| (x * 255.0 - f64::from(texel)).abs() < 0.5;
    let right = |film: &Vec<f64>| film.iter().zip(expected).all(|(x, texel)| is(*x, texel));
    let shown: Vec<String> = found[0].iter().map(|x| format!("{:.0}", x * 255.0)).collect();
    (format!("{} of {expected:?} in 255", shown.join(", ")), found.iter().all(right))
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
