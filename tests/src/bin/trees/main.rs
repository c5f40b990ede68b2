//! `cargo run --release -p tests --bin trees`: builds the tree of one hard scene with every builder, counts what rays
//! cost in each, and rewrites `docs/bvh.md`.
//!
//! With `--embree` its trees and walks are measured, too, in the same rounds; its trees are walked by the same code.
//! Without, their rows are left out.
//!
//! `--ordinary FOLDER` rewrites only the section on ordinary meshes, which are in that folder; without it this section
//! stays as it is.
#![expect(clippy::print_stdout, reason = "a measuring tool reports on standard output")]

mod degenerate;
mod embree_tree;
mod layouts;
mod measure;
mod ordinary;
mod peak;
mod scene;
#[expect(dead_code, clippy::unwrap_used, reason = "what the tests need of it, too")]
#[path = "../../../../compiler/tests/bvh/shapes.rs"]
mod shapes;
mod walk;

use std::error::Error;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use clap::Parser;
use compiler::bvh::Preset;
use tests::embree::{self, Embree};

use measure::{Row, Rows};

/// Measures builders of trees and walks through them, and rewrites docs/bvh.md.
#[derive(Debug, Parser)]
#[command(after_help = "Examples:\n  \
    trees --embree           measures all but ordinary meshes, and Embree in the same rounds\n  \
    trees --ordinary FOLDER  measures meshes that tests/peers/landscape.py has written to FOLDER")]
struct Args {
    /// Measure Embree, too: needs a C++ compiler and libembree-dev 3.
    #[arg(long)]
    embree: bool,
    /// Rewrite only the section on ordinary meshes, which are in this folder.
    #[arg(long, value_name = "FOLDER", conflicts_with = "embree")]
    ordinary: Option<PathBuf>,
}

fn main() -> Result<(), Box<dyn Error>> {
    let [first, second] = [1, 2].map(|i| std::env::args().nth(i));
    if first.as_deref() == Some(peak::CHILD) {
        one_thread()?;
        if let Some(bytes) = peak::child(&second.unwrap_or_default())? {
            println!("{bytes}");
        }
        return Ok(());
    }
    let Args { embree, ordinary } = Args::parse();
    if let Some(folder) = ordinary {
        let section = ordinary::section(&folder)?;
        std::fs::write(
            page_path(),
            with_ordinary(&std::fs::read_to_string(page_path())?, &section),
        )?;
        println!("{section}");
        return Ok(());
    }
    one_thread()?;
    let embree = embree.then(Embree::compile).transpose()?;
    let scene = scene::scene(true);
    let nodes = layouts::all(&scene, embree.as_ref())?;
    let with = measure::all(&scene, embree.as_ref())?;
    let without = measure::all(&scene::scene(false), embree.as_ref())?;
    let text =
        page(&with, &without) + &nodes_section(&nodes) + &memory()? + &degenerate::section()?;
    let text = with_ordinary(&text, ordinary_of(&std::fs::read_to_string(page_path())?));
    std::fs::write(page_path(), &text)?;
    println!("{text}");
    Ok(())
}

fn one_thread() -> Result<(), rayon::ThreadPoolBuildError> {
    rayon::ThreadPoolBuilder::new().num_threads(1).build_global()
}

fn page_path() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/bvh.md")
}

/// How the section begins that comes after the one on ordinary meshes.
const AFTER_ORDINARY: &str = "\n## With the ground\n";

/// The section on ordinary meshes, if the page has one.
fn ordinary_of(page: &str) -> &str {
    match (page.find(ordinary::TITLE), page.find(AFTER_ORDINARY)) {
        (Some(start), Some(end)) => page.get(start..end).unwrap_or(""),
        _ => "",
    }
}

/// The page with `section` in place of its own.
fn with_ordinary(page: &str, section: &str) -> String {
    let without = page.replacen(ordinary_of(page), "", 1);
    without.replacen(AFTER_ORDINARY, &format!("{section}{AFTER_ORDINARY}"), 1)
}

fn page(with: &Rows, without: &Rows) -> String {
    let mut text = String::from("# Trees over triangles\n\n");
    text += "Made by `cargo run --release -p tests --bin trees -- --embree`; edit the program, not this page.\n\n";
    text += "What `rtc --bvh` chooses between, on a scene that is hard on trees: ";
    for (name, n) in scene::PARTS {
        let _ = write!(text, "{n} triangles of {name}, ");
    }
    let _ = writeln!(
        text,
        "and {} of the ground, which are up to 4 km long; sizes from 1 cm, long thin triangles through \
         one another. One thread; CPU seconds (user + system) are medians of {} interleaved rounds and \
         depend on the machine and what else it does: compare rows, not pages. The other columns are \
         the same on every machine. Rows of Embree are made \
         by `tests/peers/embree.cpp`, which calls `rtcBuildBVH`, with room for half as many references again where it \
         splits, and `rtcIntersect1`.\n",
        scene::GROUND,
        measure::ROUNDS,
    );
    for (preset, what) in [
        (
            Preset::Fast,
            "surface-area heuristic between 16 bins, exact up to 24 triangles; every triangle in one leaf",
        ),
        (
            Preset::Default,
            "the same with spatial splits where they pay: long triangles are in several leaves, at most 1.3 places a triangle",
        ),
        (
            Preset::Extreme,
            "as `default` with twice the planes, tried in more nodes, and at most 1.6 places a triangle",
        ),
        (Preset::ObjectMedian, "halves by number, for comparison"),
        (Preset::SpatialMedian, "halves by space, for comparison"),
    ] {
        let _ = writeln!(text, "- `{preset}`: {what}.");
    }
    text += "\nThe picture is the same with each, to the last bit. A spatial split is looked for where the \
             children of the best other split overlap by 0.1 of their parent's area, is made if it costs 1.5 % less, and takes \
             from a budget of its node alone, which subtrees share by the lengths of their triangles. `default` stops \
             looking after 6 in vain, one below the other; nodes of more than 2048 triangles go on to ask a sample. Neither \
             looks along an axis where less than 1.5 % could be gained if cut triangles counted once. Triangles that move while the shutter is open are never split.\n";
    text += "\nReferences: triangles in leaves over triangles. Cost: surface-area heuristic, step and test 1, \
             in units of the root. Steps and tests: inner nodes visited and triangles tested by a ray, \
             mean over cosine-distributed rays from what four cameras see.\n";
    text += "\n## With the ground\n\n";
    text += &table(with);
    text += "\n## Without the ground\n\nForty giant triangles less.\n\n";
    text += &table(without);
    text += "\n## What giants cost\n\nSteps a ray with the ground over steps without.\n\n| tree | steps |\n|---|---|\n";
    for (a, b) in with.rows.iter().zip(&without.rows) {
        let _ = writeln!(
            text,
            "| {} | {:.3} |",
            a.name,
            a.per_ray(a.cost.steps) / b.per_ray(b.cost.steps)
        );
    }
    text
}

fn table(rows: &Rows) -> String {
    let mut text = String::from(
        "| tree | CPU s | CPU s per M | references | cost | steps | tests | largest leaf | depth |\n\
         |---|---|---|---|---|---|---|---|---|\n",
    );
    for row in &rows.rows {
        let Row { name, cpu, shape, .. } = row;
        let _ = writeln!(
            text,
            "| {name} | {cpu:.2} | {:.2} | {:.3} | {:.2} | {:.1} | {:.1} | {} | {} |",
            cpu / rows.n_triangles as f64 * 1e6,
            row.references as f64 / rows.n_triangles as f64,
            shape.cost,
            row.per_ray(row.cost.steps),
            row.per_ray(row.cost.tests),
            shape.largest_leaf,
            shape.depth,
        );
    }
    text
}

/// What builds need beside the scene.
fn memory() -> Result<String, Box<dyn Error>> {
    let mut text = String::from(
        "\n## Memory\n\nThe most that a build with the ground has beside the triangles it is given, bytes a triangle: a process of its own \
         each, by what the system says is resident.\n\n| tree | bytes a triangle |\n|---|---|\n",
    );
    let n: usize = scene::PARTS.iter().map(|(_, n)| n).sum::<usize>() + scene::GROUND;
    for preset in Preset::ALL {
        let peak = peak::of(preset)?;
        let shown = peak.map_or("–".to_owned(), |bytes| format!("{:.0}", bytes / n as f64));
        let _ = writeln!(text, "| `{preset}` | {shown} |");
    }
    Ok(text)
}

/// The layouts of nodes, and who walks them.
fn nodes_section(all: &layouts::Groups) -> String {
    let mut text = format!(
        "\n## Layouts of nodes\n\nWhat `rtc --nodes` chooses between, with the ground. `binary` holds the boxes of two \
         children in 24 bytes each; `wide` up to four, in 6 bytes each on a grid of the node's own, rounded outwards. \
         The wide tree is made from the finished binary one: of all ways to dissolve nodes into their parents, the \
         one with the least area of nodes that are left; leaves stay as they are. CPU seconds to make it, on one \
         thread. Bytes: of nodes, a triangle of the scene. Visits and tests: as above, nodes of any width. CPU seconds a \
         million rays: `trace` of the CPU kernel, generated from the WGSL or written by hand, which has a tree of its own \
         and the widest instructions that the processor has; one thread, median of {} interleaved runs of the same {} rays, \
         which have the same hits, bit for bit. Stack: entries that the worst ray needs.\n\n\
         | tree | nodes | walk | made in s | bytes | visits | tests | CPU s a Mray | against the first | stack |\n\
         |---|---|---|---|---|---|---|---|---|---|\n",
        layouts::ROUNDS,
        all.n_rays,
    );
    let per_ray = |n: u64| n as f64 / all.n_rays as f64;
    let per_mray = |cpu: f64| cpu / all.n_rays as f64 * 1e6;
    for group in &all.by_preset {
        let first = group.rows[0].cpu;
        for row in &group.rows {
            let _ = writeln!(
                text,
                "| `{}` | `{}` | {} | {} | {:.1} | {:.1} | {:.1} | {:.2} | {:.2} | {} |",
                group.preset,
                row.layout,
                row.walk,
                if row.made > 0.0 { format!("{:.2}", row.made) } else { "–".to_owned() },
                row.node_bytes as f64 / all.n_triangles as f64,
                per_ray(row.cost.steps),
                per_ray(row.cost.tests),
                per_mray(row.cpu),
                row.cpu / first,
                row.stack,
            );
        }
        for other in &group.others {
            let cpu = per_mray(other.cpu);
            let _ = writeln!(
                text,
                "| {} | its own | `rtcIntersect1` | – | – | – | – | {cpu:.2} | {:.2} | – |",
                other.name,
                other.cpu / first,
            );
        }
    }
    text + &speeds(all)
}

/// Our best walk beside others', where there are any.
fn speeds(all: &layouts::Groups) -> String {
    let mut text = String::new();
    for group in &all.by_preset {
        let Some(ours) = group.rows.last() else { continue };
        for other in &group.others {
            let _ = write!(
                text,
                " {}: {:.2} times its rays a CPU second with `{}`; {} rays hit something else, or more than {} of \
                 the distance away.",
                other.name,
                other.cpu / ours.cpu,
                group.preset,
                other.differ,
                embree::SAME_HIT,
            );
        }
    }
    if text.is_empty() {
        return text;
    }
    format!(
        "\nThe walk by hand beside Embree's, which has trees and triangles of its own making; its CPU seconds are \
         those of a loop over the same rays, in the same rounds:{text}\n"
    )
}
