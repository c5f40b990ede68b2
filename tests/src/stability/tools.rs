//! What the cases share: one body of a measurement for both precisions, scenes of one point, films.

use std::path::Path;

use compiler::cache::Cache;
use compiler::import::Limits;
use compiler::lower::Trees;
use compiler::pipeline::{self, Compiled, Options};
use lang::source::{LoadError, Loader};
use pack::{Checked, Pack};
use runtime::{Film, Job, Precision, SampleRange};

use crate::picture::{self, Estimate, channel};
use crate::scene;

/// One measurement, written once, as `name::single::run` and `name::double::run`. In the body `Real`, `V2`, `V3`
/// are the kernel's types, `k` is its module, `open(&bench)` the kernel, `ray` a ray; `real` and `v3` round
/// numbers as a pack does, to `f32`, and `wide` is the way back.
macro_rules! twins {
    ($(#[$doc:meta])* fn $name:ident($($arg:ident: $ty:ty),*) -> $out:ty $body:block) => {
        $(#[$doc])*
        mod $name {
            twins!(@ single, f32, glam::Vec2, glam::Vec3, ray, |v: DVec3| v.as_vec3(),
                |x: f64| x as f32, |v: glam::Vec3| v.as_dvec3(), ($($arg: $ty),*) -> $out $body);
            twins!(@ double, f64, glam::DVec2, glam::DVec3, ray_double,
                |v: DVec3| v.as_vec3().as_dvec3(), |x: f64| f64::from(x as f32),
                |v: DVec3| v, ($($arg: $ty),*) -> $out $body);
        }
    };
    (@ $module:ident, $real:ident, $v2:ty, $v3:ty, $ray:ident, $narrow:expr, $round:expr, $wide:expr,
        ($($arg:ident: $ty:ty),*) -> $out:ty $body:block) => {
        #[allow(dead_code, unused_imports, clippy::useless_conversion, clippy::unnecessary_cast,
            clippy::cast_possible_truncation, clippy::cast_lossless,
            reason = "one text for both precisions")]
        pub(super) mod $module {
            use super::super::*;
            use glam::DVec3;
            use runtime::kernel::$real as k;
            type Real = $real;
            type V2 = $v2;
            type V3 = $v3;
            fn v3(v: DVec3) -> V3 { ($narrow)(v) }
            fn real(x: f64) -> Real { ($round)(x) }
            fn wide(v: V3) -> DVec3 { ($wide)(v) }
            fn open(bench: &crate::kernel::Bench) -> k::Kernel<'_> { bench.$module() }
            fn scatter(lobe: &crate::kernel::Lobe) -> k::Scatter { lobe.$module() }
            fn ray(origin: V3, dir: V3) -> k::Ray { crate::kernel::$ray(origin, dir) }
            pub(crate) fn run($($arg: $ty),*) -> $out $body
        }
    };
}

/// Both of them, `f32` first.
macro_rules! both {
    ($name:ident($($arg:expr),*)) => {
        [$name::single::run($($arg),*), $name::double::run($($arg),*)]
    };
}

/// A camera that sees one point: all pixels estimate one number.
#[must_use]
pub fn view(from: [f64; 3], to: [f64; 3], depth: u32) -> String {
    let [from, to] = [from, to].map(|p| format!("({:e}, {:e}, {:e})m", p[0], p[1], p[2]));
    format!(
        "camera eye: perspective {{ from = {from}, to = {to}, up = (0.1, 0.2, 1), fov.vertical = 0.001deg }}
film f {{ size = (16, 16)px }}
render main: path {{ camera = eye, film = f, samples = 16, depth = {depth}, seed = 11 }}
"
    )
}

/// A picture of `size` pixels of what is `from` -> `to`, `fov` degrees high.
#[must_use]
pub fn shot(from: [f64; 3], to: [f64; 3], fov: f64, depth: u32) -> String {
    view(from, to, depth).replace("0.001deg", &format!("{fov}deg"))
}

/// A sky of radiance 1.
pub const WHITE_SKY: &str = "sky heaven: constant { color = linear(1) }\n";

/// A checked pack again.
#[must_use]
pub fn open(bytes: &[u8]) -> Pack<Checked> {
    Pack::from_bytes(bytes.to_vec()).expect("what was written can be read")
}

/// Films of a pack in both precisions; `f32` first.
#[must_use]
pub fn films_of(bytes: &[u8], set: impl Fn(&mut Job)) -> [Film; 2] {
    [Precision::F32, Precision::F64].map(|precision| {
        let outcome = picture::cpu(open(bytes), |job| {
            set(job);
            job.precision = precision;
        });
        outcome.film().clone()
    })
}

/// Films of a text that begins after `rts 1`, `side` pixels square.
#[must_use]
pub fn films(text: &str, side: u32, samples: u32) -> [Film; 2] {
    films_of(&scene::bytes(&scene::compile(&format!("rts 1\n{text}"))), sized(side, samples))
}

/// A job of this size.
pub fn sized(side: u32, samples: u32) -> impl Fn(&mut Job) {
    move |job| {
        job.resize([side, side]);
        job.samples = SampleRange { start: 0, end: samples };
    }
}

/// Mean of the green channel over pixels that see the same thing.
#[must_use]
pub fn estimates(films: &[Film; 2]) -> [Estimate; 2] {
    [0, 1].map(|i| Estimate::of(&channel(&films[i], 1)))
}

/// As [`films`], as estimates.
#[must_use]
pub fn means(text: &str, side: u32, samples: u32) -> [Estimate; 2] {
    estimates(&films(text, side, samples))
}

/// Whether a pixel is this one, bit for bit.
#[must_use]
pub fn equal(rgb: [f64; 3], other: [f64; 3]) -> bool {
    rgb.map(f64::to_bits) == other.map(f64::to_bits)
}

/// Whether a pixel is anything but 0.
#[must_use]
pub fn lit(rgb: [f64; 3]) -> bool {
    !equal(rgb, [0.0; 3])
}

/// How many pixels of the films `test` is true of.
#[must_use]
pub fn count(films: &[Film; 2], test: impl Fn([f64; 3]) -> bool) -> [u64; 2] {
    [0, 1].map(|i| films[i].means().into_iter().filter(|rgb| test(*rgb)).count() as u64)
}

/// Whether two films are the same, bit for bit.
#[must_use]
pub fn same(a: &Film, b: &Film) -> bool {
    let bits = |film: &Film| film.sums.iter().flatten().map(|x| x.to_bits()).collect::<Vec<_>>();
    bits(a) == bits(b)
}

/// Largest difference of two estimates of the same thing in standard errors.
#[must_use]
pub fn distance(a: Estimate, b: Estimate) -> f64 {
    if a == b { 0.0 } else { (a.mean - b.mean).abs() / a.error.hypot(b.error) }
}

/// The first error of what was said.
#[must_use]
pub fn first_error(said: &str) -> String {
    let errors = |line: &&str| line.contains("error[");
    said.lines().find(errors).or(said.lines().next()).unwrap_or("nothing").to_owned()
}

/// The bytes of a text's pack, with paths as long as a pack allows: longer than the language does.
#[must_use]
pub fn endless(text: &str) -> Vec<u8> {
    let mut compiled = scene::compile(&format!("rts 1\n{text}"));
    compiled.lowered.render.max_depth = 65_535;
    scene::bytes(&compiled)
}

struct NoImports;

impl Loader for NoImports {
    fn load(&mut self, _: &str, _: &str) -> Result<(String, String), LoadError> {
        Err(LoadError::NotFound)
    }
}

/// A text with its files, compiled, and what was said about it; the pack is not there when it is wrong.
#[must_use]
pub fn diagnose(root: &Path, text: &str) -> (Option<Compiled>, String) {
    let name = root.join("test.rts").display().to_string();
    let analysis =
        lang::analyze(&name, &format!("rts 1\n{text}"), &mut NoImports, &lang::Options::default());
    let mut diagnostics = analysis.diagnostics;
    let cache = Cache::disabled();
    let options =
        Options { root, trees: Trees::usual(&cache), limits: Limits::default(), defines: &[] };
    let compiled = analysis.scene.and_then(|scene| {
        pipeline::compile(&scene, &analysis.sources, &options, &mut diagnostics).ok()
    });
    let lines = diagnostics.iter().map(|d| {
        let labels = d.labels.iter().map(|label| label.text.as_str());
        let more = labels.chain(d.notes.iter().map(String::as_str)).filter(|text| !text.is_empty());
        let more: Vec<_> = more.collect();
        format!("{}: {}", lang::diagnostic::short(&analysis.sources, d), more.join("; "))
    });
    (compiled, lines.collect::<Vec<_>>().join("\n"))
}
