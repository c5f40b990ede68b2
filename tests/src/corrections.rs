//! Where a guide to path tracing errs: each module runs the guide's form of one thing and ours side by
//! side and turns the difference into rows of numbers; this one turns the rows into `docs/corrections.md`.
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
pub mod guide_tree;
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
    /// What the guide's form gives.
    pub guide: String,
    /// What ours gives.
    pub ours: String,
}

/// One difference.
#[derive(Clone, Debug)]
pub struct Topic {
    /// A heading.
    pub title: &'static str,
    /// Section numbers of the guide.
    pub section: &'static str,
    /// Files with our form, all of which the program has run.
    pub places: &'static [&'static str],
    /// What was measured; never empty.
    pub rows: Vec<Row>,
    /// What the guide says.
    pub says: String,
    /// What is wrong with it.
    pub wrong: String,
    /// The right form.
    pub right: String,
}

/// A row.
#[must_use]
pub fn row(item: impl Into<String>, guide: impl Into<String>, ours: impl Into<String>) -> Row {
    Row { item: item.into(), guide: guide.into(), ours: ours.into() }
}

/// Measures everything and writes the page.
#[must_use]
pub fn page() -> String {
    let topics: Vec<Topic> = TOPICS.par_iter().map(|measure| measure()).collect();
    let mut text = header();
    table(&topics, &mut text);
    for (n, topic) in topics.iter().enumerate() {
        section(n + 1, topic, &mut text);
    }
    text
}

fn header() -> String {
    "# Corrections\n\n\
    Made by `cargo run --release -p tests --bin corrections`; edit the program, not this page. \
    Seeds are fixed: every run gives the same numbers.\n\n\
    This project began with a guide, *RayTracer: Rendering of Complex Scenes* (2026, after *Ray Tracing \
    in One Weekend*). It is a good plan for a path tracer, and most of it was followed. Where it was not, \
    this page says why: each form of the guide was written out and run beside ours, and the numbers below \
    are what came back. Reflectances and radiances are relative to the true value, which is 1, unless a row \
    says otherwise; `±` is one standard error; \"noise\" is the standard deviation of one sample over \
    the true value. Rounding is that of the machine: what the guide does in single precision was run in \
    single precision, without fused multiply-add.\n"
        .to_owned()
}

fn table(topics: &[Topic], text: &mut String) {
    text.push_str("\n| | what | guide § | the guide's form | ours |\n|---|---|---|---|---|\n");
    for (n, topic) in topics.iter().enumerate() {
        for (k, row) in topic.rows.iter().enumerate() {
            let number = if k == 0 { format!("[{0}](#{0})", n + 1) } else { String::new() };
            let section = if k == 0 { topic.section } else { "" };
            let Row { item, guide, ours } = row;
            let _ = writeln!(text, "| {number} | {item} | {section} | {guide} | {ours} |");
        }
    }
}

fn section(number: usize, topic: &Topic, text: &mut String) {
    let Topic { title, section, says, wrong, right, .. } = topic;
    let places: Vec<String> =
        topic.places.iter().map(|path| format!("[`{path}`](../{path})")).collect();
    let _ = write!(
        text,
        "\n## <a id=\"{number}\"></a>{number}. {title}\n\n\
        Guide: § {section}. Ours: {}.\n\n\
        **The guide.** {says}\n\n**The trouble.** {wrong}\n\n**The right form.** {right}\n",
        places.join(", "),
    );
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
