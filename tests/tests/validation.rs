//! Our pictures against block means of an independent renderer's.
//!
//! `tests/validation/validate.py` has rendered each scene with Mitsuba 3 and stored the means of its
//! blocks with their standard errors; `docs/validation.md` is what it found with many samples. Here
//! the same `.rts` files are rendered with few samples and fixed seeds, and every block and every
//! picture as a whole must agree within the errors of both sides. Needs no Mitsuba.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use pack::Pack;
use runtime::{Control, DeviceChoice, Job, SampleRange, Scene, render};
use statrs::distribution::{ContinuousCDF, Normal};
use tests::picture::Estimate;
use tests::{console, scene, statistics};

/// Size of our pictures: half that of theirs, so that a block of 10 x 10 pixels shows the same.
const SIZE: [u32; 2] = [40, 30];
/// Pictures whose spread is our error, and samples of each.
const REPLICATES: u32 = 32;
const SAMPLES: u32 = 16;

fn folder(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("validation").join(name)
}

/// Stems of the files with this ending, sorted.
fn stems(dir: &str, ending: &str) -> Vec<String> {
    let entries = std::fs::read_dir(folder(dir)).expect("the folder is part of the repository");
    let paths = entries.map(|entry| entry.expect("readable").path());
    let stems = paths.filter(|path| path.extension().is_some_and(|e| e == ending));
    let stem = |path: PathBuf| path.file_stem().and_then(|s| s.to_str()).map(str::to_owned);
    let mut stems: Vec<String> = stems.filter_map(stem).collect();
    stems.sort();
    stems
}

/// A grid of block means, three channels each.
struct Blocks {
    columns: usize,
    rows: usize,
    /// `rows * columns` blocks, row by row from the top left.
    means: Vec<[Estimate; 3]>,
    /// Mean of the picture.
    whole: [Estimate; 3],
}

impl Blocks {
    /// The stored means of a scene, four neighbours made one: the few samples of a small block are
    /// skewed where light is rare, and then Student's quotient is not Student's.
    fn stored(name: &str) -> Self {
        let path = folder("reference").join(name).with_extension("txt");
        let text = std::fs::read_to_string(path).expect("the scene has a reference");
        let mut lines = text.lines().filter(|line| !line.starts_with('#'));
        let words = lines.next().and_then(|line| line.strip_prefix("blocks ")).expect("a size");
        let size: Vec<usize> = words.split(' ').map(|w| w.parse().expect("a count")).collect();
        let (columns, rows) = (size[0], size[1]);
        let mut means = Vec::new();
        for (i, line) in lines.enumerate() {
            let place = format!("{} {}  ", i / columns, i % columns);
            let values = line.strip_prefix(&place).expect("row and column, in order");
            let values = values.split_whitespace().map(|w| w.parse().expect("a number"));
            let v: Vec<f64> = values.collect();
            assert_eq!(v.len(), 6, "mean and error of three channels: {line}");
            let pair = |k: usize| Estimate { mean: v[2 * k], error: v[2 * k + 1] };
            means.push([pair(0), pair(1), pair(2)]);
        }
        assert_eq!(means.len(), columns * rows, "{name} is complete");
        let (small, across) = (means, columns);
        let (columns, rows) = (columns / 2, rows / 2);
        let corners = (0..columns * rows).map(|i| i / columns * 2 * across + i % columns * 2);
        let four = |i: usize| [small[i], small[i + 1], small[i + across], small[i + across + 1]];
        let means: Vec<[Estimate; 3]> =
            corners.map(|i| [0, 1, 2].map(|k| mean_of(&four(i).map(|block| block[k])))).collect();
        // Mitsuba's independent sampler was used: the errors of blocks are independent.
        let whole = [0, 1, 2].map(|k| {
            let channel: Vec<Estimate> = means.iter().map(|block| block[k]).collect();
            mean_of(&channel)
        });
        Self { columns, rows, means, whole }
    }

    /// The means of our picture over the same blocks, with the errors that replicates show.
    fn rendered(name: &str, columns: usize, rows: usize) -> Self {
        let path = folder("scenes").join(name).with_extension("rts");
        let text = std::fs::read_to_string(path).expect("the reference has a scene");
        let compiled = scene::compile_in(&folder("scenes"), &text);
        let pack = Pack::from_bytes(scene::bytes(&compiled)).expect("packs can be read");
        let scene = Scene::new(pack);
        let replicates: Vec<Vec<[f64; 3]>> =
            (0..REPLICATES).map(|seed| block_means(&scene, seed, columns, rows)).collect();
        let estimate = |block: usize, k: usize| {
            let values: Vec<f64> = replicates.iter().map(|means| means[block][k]).collect();
            Estimate::of(&values)
        };
        let means = (0..columns * rows).map(|b| [0, 1, 2].map(|k| estimate(b, k))).collect();
        // Blocks of one picture may hang together, pictures of several seeds do not.
        let whole = [0, 1, 2].map(|k| {
            let picture = |blocks: &Vec<[f64; 3]>| blocks.iter().map(|rgb| rgb[k]).sum::<f64>();
            let n = (columns * rows) as f64;
            Estimate::of(&replicates.iter().map(|blocks| picture(blocks) / n).collect::<Vec<_>>())
        });
        Self { columns, rows, means, whole }
    }

    /// The same with every radiance multiplied.
    fn brighter(&self, factor: f64) -> Self {
        let scale = |e: Estimate| Estimate { mean: e.mean * factor, ..e };
        let means = self.means.iter().map(|block| block.map(scale)).collect();
        Self { means, whole: self.whole.map(scale), ..*self }
    }
}

/// Mean of estimates whose errors are independent.
fn mean_of(estimates: &[Estimate]) -> Estimate {
    let n = estimates.len() as f64;
    let square: f64 = estimates.iter().map(|e| e.error * e.error).sum();
    Estimate { mean: estimates.iter().map(|e| e.mean).sum::<f64>() / n, error: square.sqrt() / n }
}

/// Means of the blocks of one picture.
fn block_means(scene: &Scene, seed: u32, columns: usize, rows: usize) -> Vec<[f64; 3]> {
    let mut job = Job::of_scene(scene);
    job.resize(SIZE);
    job.samples = SampleRange { start: 0, end: SAMPLES };
    job.seed = seed;
    let outcome = render(scene, &job, &DeviceChoice::Cpu, &Control::default());
    let outcome = outcome.expect("the scene renders");
    let pixels = outcome.film().means();
    let [width, height] = SIZE.map(|side| side as usize);
    assert!(width % columns == 0 && height % rows == 0, "blocks hold whole pixels");
    let mut means = vec![[0.0; 3]; columns * rows];
    let share = (columns * rows) as f64 / (width * height) as f64;
    for (i, rgb) in pixels.iter().enumerate() {
        let (x, y) = (i % width * columns / width, i / width * rows / height);
        for k in 0..3 {
            means[y * columns + x][k] += rgb[k] * share;
        }
    }
    means
}

/// z of the difference as a normal deviate: Student's quotient with Welch's degrees of freedom, both
/// sides counted as `REPLICATES` values (theirs are more), by eq. 3.3 of Wallace 1959, "Bounds on
/// normal approximations to Student's and the chi-square distributions". What is without noise on
/// both sides may differ by the rounding of single precision.
fn normal_score(ours: &Estimate, theirs: &Estimate) -> f64 {
    let rounding = 1e-5 * theirs.mean;
    let (a, b) = (ours.error.powi(2), theirs.error.powi(2));
    let total = a + b + rounding * rounding;
    if total <= 0.0 {
        return if ours.mean == 0.0 { 0.0 } else { f64::INFINITY };
    }
    let t = (ours.mean - theirs.mean) / total.sqrt();
    let freedom =
        total * total * f64::from(REPLICATES - 1) / (a * a + b * b).max(1e-12 * total * total);
    let scale = (8.0 * freedom + 1.0) / (8.0 * freedom + 3.0);
    t.signum() * scale * (freedom * (t * t / freedom).ln_1p()).sqrt()
}

/// Largest |z| of a block, and of the whole picture.
fn worst(ours: &Blocks, theirs: &Blocks) -> [f64; 2] {
    let largest = |a: &[Estimate; 3], b: &[Estimate; 3]| {
        (0..3).map(|k| normal_score(&a[k], &b[k]).abs()).fold(0.0, f64::max)
    };
    let blocks = ours.means.iter().zip(&theirs.means);
    let block = blocks.map(|(a, b)| largest(a, b)).fold(0.0, f64::max);
    [block, largest(&ours.whole, &theirs.whole)]
}

/// Bound on |z| of each of all the numbers that this file compares.
fn bound(scenes: usize, blocks: usize) -> f64 {
    let level = statistics::level(scenes * 3 * (blocks + 1));
    Normal::standard().inverse_cdf(1.0 - level / 2.0)
}

/// A scene with both sides' blocks.
struct Pair {
    name: String,
    ours: Blocks,
    theirs: Blocks,
}

/// Every scene, rendered once for all tests of this file.
fn pairs() -> &'static [Pair] {
    static PAIRS: OnceLock<Vec<Pair>> = OnceLock::new();
    PAIRS.get_or_init(|| {
        let pair = |name: String| {
            let theirs = Blocks::stored(&name);
            let ours = Blocks::rendered(&name, theirs.columns, theirs.rows);
            Pair { name, ours, theirs }
        };
        stems("reference", "txt").into_iter().map(pair).collect()
    })
}

#[test]
fn blocks_of_every_scene_agree_with_an_independent_renderer() {
    let mut failures = String::new();
    for Pair { name, ours, theirs } in pairs() {
        let [block, whole] = worst(ours, theirs);
        let bound = bound(pairs().len(), theirs.means.len());
        let line =
            format!("{name:16} largest |z|: block {block:.2}, picture {whole:.2} of {bound:.2}");
        console::line(&line);
        if block.max(whole) >= bound {
            let _ = writeln!(failures, "{line}");
        }
    }
    assert!(failures.is_empty(), "\n{failures}");
}

/// The errors are small enough to mean something.
#[test]
fn a_picture_that_is_three_percent_too_bright_is_found_out() {
    for Pair { name, ours, theirs } in pairs() {
        // Of the picture: a block without noise would find out anything.
        let [_, found] = worst(&ours.brighter(1.03), theirs);
        console::line(&format!("{name:16} 3 % brighter: |z| {found:.2}"));
        assert!(found > bound(pairs().len(), theirs.means.len()), "{name}: |z| is {found:.2} only");
    }
}

#[test]
fn every_scene_has_a_reference_and_a_picture() {
    let names = stems("scenes", "rts");
    assert!(!names.is_empty());
    assert_eq!(names, stems("reference", "txt"));
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs");
    let page = std::fs::read_to_string(docs.join("validation.md")).expect("there is a page");
    for name in names {
        assert!(page.contains(&format!("| `{name}` |")), "{name} is not on the page");
        assert!(docs.join("validation").join(&name).with_extension("png").is_file(), "{name}");
    }
}
