//! Pitfalls of path tracing: each module runs the naive form of one thing and ours side by side and turns the
//! difference into rows of numbers; this one turns the rows into `docs/pitfalls.md`.
//!
//! Every number comes from a fixed seed, so the page is the same on every run. Our form is the kernel
//! itself. Nothing here knows the scene language, but [`brightness`], which renders a scene.

pub mod brightness;
pub mod bump;
pub mod coat;
pub mod field;
pub mod fog;
pub mod fresnel;
pub mod fuzz;
pub mod gaps;
pub mod median_tree;
pub mod mixture;
pub mod offsets;
pub mod phase;
pub mod random_walk;
pub mod refraction;
pub mod roulette;
pub mod seeds;
pub mod slab;
pub mod sphere;
pub mod sphere_light;
pub mod traversal;
pub mod triangle;

use std::fmt::Write as _;

use rayon::prelude::*;

use crate::statistics::Mean;

/// What measures one topic.
pub type Measure = fn() -> Topic;

/// Every topic, in the order of the page.
pub const TOPICS: &[Measure] = &[
    sphere_light::topic,
    mixture::topic,
    fuzz::topic,
    brightness::topic,
    roulette::topic,
    seeds::topic,
    fresnel::topic,
    refraction::topic,
    coat::topic,
    triangle::topic,
    offsets::topic,
    sphere::topic,
    traversal::topic,
    gaps::topic,
    phase::topic,
    random_walk::topic,
    fog::topic,
    field::topic,
    bump::topic,
];

/// One line of the table.
#[derive(Clone, Debug)]
pub struct Row {
    /// What was measured, with its setting.
    pub item: String,
    /// What the naive form gives.
    pub naive: String,
    /// What ours gives.
    pub ours: String,
}

/// One pitfall.
#[derive(Clone, Debug)]
pub struct Topic {
    /// A heading.
    pub title: &'static str,
    /// Files with our form, all of which the program has run.
    pub places: &'static [&'static str],
    /// What was measured; never empty.
    pub rows: Vec<Row>,
    /// What goes wrong, and the right form with its source.
    pub fact: &'static str,
}

/// A row.
#[must_use]
pub fn row(item: impl Into<String>, naive: impl Into<String>, ours: impl Into<String>) -> Row {
    Row { item: item.into(), naive: naive.into(), ours: ours.into() }
}

/// Measures everything and writes the page.
#[must_use]
pub fn page() -> String {
    let topics: Vec<Topic> = TOPICS.par_iter().map(|measure| measure()).collect();
    let mut text = header();
    for (n, topic) in topics.iter().enumerate() {
        section(n + 1, topic, &mut text);
    }
    text
}

fn header() -> String {
    "# Pitfalls of path tracing\n\n\
    Made by `cargo run --release -p tests --bin pitfalls`; edit the program, not this page. \
    Seeds are fixed: every run prints the same numbers.\n\n\
    Nineteen mistakes that are easy to make in a path tracer. Each was written out and run beside the form \
    that is used here. Reflectances and radiances are relative to the true value, 1, unless a row says \
    otherwise; `±` is one standard error; \"noise\" is the standard deviation of one sample over the true \
    value. What runs in single precision does so without fused multiply-add.\n"
        .to_owned()
}

fn section(number: usize, topic: &Topic, text: &mut String) {
    let Topic { title, places, rows, fact } = topic;
    let places: Vec<String> = places.iter().map(|path| format!("[`{path}`](../{path})")).collect();
    let _ = write!(
        text,
        "\n## {number}. {title}\n\n{fact}\n\nRight in {}.\n\n| what | naive form | here |\n|---|---|---|\n",
        places.join(", "),
    );
    for Row { item, naive, ours } in rows {
        let _ = writeln!(text, "| {item} | {naive} | {ours} |");
    }
}

/// A mean and its standard error: four decimals, more where the error asks for them; the mean alone where
/// there is no error to speak of.
#[must_use]
pub fn estimate(mean: &Mean) -> String {
    let error = mean.error();
    if error < 1e-6 {
        return format!("{:.6}", mean.value());
    }
    let decimals = [1e-4, 1e-5, 1e-6].iter().take_while(|step| error < **step).count() + 4;
    format!("{:.decimals$} ± {error:.decimals$}", mean.value())
}

/// How far `x` is from `truth`, in percent.
#[must_use]
pub fn off(x: f64, truth: f64) -> String {
    let tenths = (1000.0 * (x / truth - 1.0)).round();
    // No negative zero.
    format!("{:+.1} %", (tenths + 0.0) / 10.0)
}

/// A small number: one power of ten, or 0.
#[must_use]
pub fn tiny(x: f64) -> String {
    if x == 0.0 { "0".to_owned() } else { format!("{x:.1e}") }
}

/// A whole number with its digits in groups of three.
#[must_use]
pub fn grouped(n: u64) -> String {
    let digits = n.to_string();
    let first = digits.len() % 3;
    let mut groups: Vec<&str> = Vec::new();
    if first > 0 {
        groups.push(&digits[..first]);
    }
    groups.extend((first..digits.len()).step_by(3).map(|i| &digits[i..i + 3]));
    groups.join(",")
}

/// A share in percent: two figures, more near the ends.
#[must_use]
pub fn percent(share: f64) -> String {
    let p = 100.0 * share;
    match p.abs() {
        0.0 => "0 %".to_owned(),
        a if a < 0.01 => format!("{p:.1e} %"),
        a if a < 1.0 => format!("{p:.3} %"),
        a if a < 10.0 => format!("{p:.2} %"),
        _ => format!("{p:.1} %"),
    }
}

/// A count of something out of `n`.
#[must_use]
pub fn share(count: usize, n: usize) -> String {
    percent(count as f64 / n as f64)
}
