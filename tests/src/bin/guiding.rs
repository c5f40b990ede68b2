//! `cargo run --release -p tests --bin guiding [SCENE ..]`: what path guiding and manifold next-event estimation
//! could give, before either is built; rewrites `docs/guiding.md`.
//!
//! Both are judged from recorded paths of the kernel as it is. A guided path would be the same path with other
//! odds: with r the ratio of the density that a segment had to the density that the guide would give it, and R the
//! product of r up to a contribution X, the second moment under the guide is the expectation, over the paths as
//! they are, of sum X^2 R + 2 sum over earlier Y of Y X R(Y). No kernel has to change for that, and neither guide
//! nor manifold walk costs anything here: what it prints are upper bounds.

use std::error::Error;
use std::fmt::Write as _;
use std::path::Path;

use pack::Pack;
use runtime::check::{self, Sample, Step};
use runtime::{Job, SampleRange, Scene};
use tests::guiding::{Guide, events, vertices};
use tests::scene;

/// Pixels of each picture.
const SIZE: [u32; 2] = [48, 27];
/// Samples a pixel to learn from, and as many others to judge by.
const SAMPLES: u32 = 256;
/// Pictures of each scene.
const SEEDS: u32 = 4;
const SCENES: [&str; 3] = ["cornell_sphere", "materials", "shrine"];
/// Cosine of the sharpest turn by refraction between air and an index of 1.5, at grazing incidence.
const STRAIGHT: f64 = 2.0 / 3.0;

fn main() -> Result<(), Box<dyn Error>> {
    let wanted: Vec<String> = std::env::args().skip(1).collect();
    let mut text = String::from(HEADER);
    for name in
        SCENES.into_iter().filter(|name| wanted.is_empty() || wanted.iter().any(|w| w == name))
    {
        row(&mut text, name)?;
    }
    tests::console::line(&text);
    if wanted.is_empty() {
        let target = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/guiding.md");
        std::fs::write(target, text + VERDICT)?;
    }
    Ok(())
}

const HEADER: &str = "# What path guiding and manifold next-event estimation could give\n\n\
    Made by `cargo run --release -p tests --bin guiding`; edit the program, not this page.\n\n\
    Neither is in the kernel. The program records paths, computes what their variance would be, and charges nothing \
    for the guide or for the search on the manifold, so each figure is an upper bound of the gain at equal time.\n\n\
    - **Path guiding** (after M\u{fc}ller, Gross & Nov\u{e1}k 2017, \"Practical Path Guiding\"): at every vertex where the \
    material has a density, a cell of space and material offers a histogram over 128 directions, learned from 256 \
    samples a pixel, with the target of least variance. Each cell keeps the best share of the material's own \
    sampling. It is judged by 256 other samples a pixel.\n\
    - **Manifold next-event estimation** (Hanika, Droske & Fascione 2015): all noise of light that reaches a surface \
    through smooth glass or off mirrors is gone.\n\n\
    Noise is the variance of a pixel's samples over the square of its mean, averaged over pixels without the noisiest hundredth. \
    A gain of 2x means half the variance. Least and greatest of four pictures with different seeds.\n\n\
    | scene | noise | guiding | manifold, through glass | manifold, mirrors too |\n|---|---|---|---|---|\n";

/// Adds the row of a scene.
fn row(text: &mut String, name: &str) -> Result<(), Box<dyn Error>> {
    let example = scenes::catalog::find(name).ok_or("no such scene")?;
    let compiled = scene::full_example(example, &[], compiler::bvh::Layout::default());
    let scene = Scene::new(Pack::from_bytes(scene::bytes(&compiled))?);
    let mut moments = Vec::new();
    for seed in 1..=SEEDS {
        let mut job = Job::of_scene(&scene);
        job.resize(SIZE);
        job.seed = seed;
        job.samples = SampleRange { start: 0, end: SAMPLES };
        let guide = Guide::learn(check::paths(&scene, &job, |samples| {
            samples.iter().flat_map(vertices).collect::<Vec<_>>()
        })?);
        job.samples = SampleRange { start: SAMPLES, end: 2 * SAMPLES };
        moments.push(Moments::sum(&check::paths(&scene, &job, |samples| {
            Moments::of_pixel(&guide, &samples)
        })?));
    }
    let range = |of: fn(&Moments) -> f64| {
        let values = moments.iter().map(of);
        let (low, high) = values.fold((f64::INFINITY, 0.0_f64), |(a, b), x| (a.min(x), b.max(x)));
        format!("{low:.2} to {high:.2}")
    };
    writeln!(
        text,
        "| `{name}` | {} | {}x | {}x | {}x |",
        range(|m| m.plain),
        range(|m| m.plain / m.guided),
        range(|m| m.plain / m.refracted),
        range(|m| m.plain / m.manifold),
    )?;
    Ok(())
}

/// Mean of the luminance, and its variance under each estimator.
#[derive(Clone, Copy, Debug, Default)]
struct Moments {
    mean: f64,
    plain: f64,
    guided: f64,
    /// Without caustics.
    manifold: f64,
    /// Without caustics that were only refracted.
    refracted: f64,
}

impl Moments {
    fn of_pixel(guide: &Guide, samples: &[Sample]) -> Self {
        let n = samples.len() as f64;
        let mut first = Self::default();
        let mut second = Self::default();
        for sample in samples.iter().filter(|s| s.radiance.iter().all(|x| x.is_finite())) {
            let (mut x, mut odds) = (0.0, 1.0);
            let mut smooth = Smooth::default();
            // Earlier contributions, each times its R.
            let mut earlier = 0.0;
            for (step, added, material) in events(sample) {
                if step.pdf > 0.0 {
                    odds *= guide.ratio(step, material);
                }
                second.guided += added * (added * odds + 2.0 * earlier);
                earlier += added * odds;
                x += added;
                smooth.pass(step, added);
            }
            let (m, r) = (x - smooth.caustic, x - smooth.refracted);
            first = Self {
                mean: first.mean + x,
                manifold: first.manifold + m,
                refracted: first.refracted + r,
                ..first
            };
            second.plain += x * x;
            second.manifold += m * m;
            second.refracted += r * r;
        }
        let variance = |second: f64, first: f64| second / n - (first / n).powi(2);
        Self {
            mean: first.mean / n,
            plain: variance(second.plain, first.mean),
            guided: variance(second.guided, first.mean),
            manifold: variance(second.manifold, first.manifold),
            refracted: variance(second.refracted, first.refracted),
        }
    }

    /// Means over the picture of variances over the square of the pixel, without the hundredth of the pixels that
    /// are worst under each: edges of lamps would outweigh all others.
    fn sum(pixels: &[Self]) -> Self {
        let mean = pixels.iter().map(|m| m.mean).sum::<f64>() / pixels.len() as f64;
        let relative = |of: fn(&Self) -> f64| {
            let of = |m: &Self| of(m) / m.mean.max(1e-2 * mean).powi(2);
            let mut values: Vec<f64> = pixels.iter().map(of).collect();
            values.sort_by(f64::total_cmp);
            values.truncate(values.len() - values.len() / 100);
            values.iter().sum::<f64>() / values.len() as f64
        };
        let (plain, guided) = (relative(|m| m.plain), relative(|m| m.guided));
        let (manifold, refracted) = (relative(|m| m.manifold), relative(|m| m.refracted));
        Self { mean, plain, guided, manifold, refracted }
    }
}

/// What a path owes to emitters met along directions without a density, after a vertex with one.
#[derive(Clone, Copy, Debug, Default)]
struct Smooth {
    caustic: f64,
    refracted: f64,
    is_after_rough: bool,
    /// Since the last vertex with a density, no turn was sharper than refraction by glass.
    is_refracted: bool,
    dir: [f64; 3],
}

impl Smooth {
    fn pass(&mut self, step: &Step, added: f64) {
        if step.shadow {
            return;
        }
        let cosine: f64 = (0..3).map(|k| self.dir[k] * step.dir[k]).sum();
        self.dir = step.dir;
        if step.pdf > 0.0 {
            (self.is_after_rough, self.is_refracted) = (true, true);
        } else if self.is_after_rough {
            self.is_refracted &= cosine > STRAIGHT;
            self.caustic += added;
            self.refracted += if self.is_refracted { added } else { 0.0 };
        }
    }
}

const VERDICT: &str = "\n## What follows\n\n\
    Either would be built if it gave 1.5x at equal time on some common scene. Guiding stays below that even when it \
    is free: most directions already come from the lights, and where a diffuse wall is left the guide has little to \
    say. In the shrine it learns from too few samples and loses.\n\n\
    Manifold next-event estimation reaches that bound only where it finds every path through glass, at no cost. A \
    search traces at least three more rays for every shadow ray that glass stops, and those off mirrors need seeds \
    as well, so that the time it takes eats what it gives. Neither is built.\n";
