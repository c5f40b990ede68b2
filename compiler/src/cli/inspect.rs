//! `rtc inspect`: the sections of a pack as a table, and which features its kernel has; the latter is what
//! `rtc build --explain-features` prints, too.

mod document;

use files::ShowPath as _;
use std::collections::BTreeSet;
use std::fmt::Write;
use std::path::{Path, PathBuf};

use clap::Args;
use pack::abi::{Instance, Node, WideNode};
use pack::bvh::InnerNode;
use pack::manifest::{Feature, KernelSize};
use pack::{Checked, Manifest, Pack};

use super::args::{BUG, IO, OK, printed};
use super::mapped;
use crate::bvh::Layout;
use crate::pipeline::{CompileError, full_kernel_size};
use crate::report::{Color, ErrorFormat, Reporter};

#[derive(Debug, Args)]
pub(super) struct InspectArgs {
    /// A pack that `rtc` wrote.
    pack: PathBuf,
    /// Also verify the hash of every section.
    #[arg(long)]
    verify: bool,
    /// Print one JSON object instead (docs/json.md).
    #[arg(long)]
    json: bool,
}

pub(super) fn inspect(args: &InspectArgs) -> u8 {
    let format = if args.json { ErrorFormat::Json } else { ErrorFormat::Human };
    let reporter = Reporter::new(format, Color::Auto, usize::MAX);
    let opened = mapped::map(&args.pack).and_then(|pack| {
        if args.verify {
            pack.verify_hashes()?;
        }
        Ok(pack)
    });
    match opened {
        Ok(pack) if args.json => report_json(&args.pack, &pack, &reporter),
        Ok(pack) => report(&pack, &reporter),
        Err(error) => {
            reporter.failure(&format!("{}: {error}", args.pack.shown()));
            IO
        }
    }
}

/// Prints the sections, which features the kernel has, and how large it is.
pub(super) fn report(pack: &Pack<Checked>, reporter: &Reporter) -> u8 {
    let (table, manifest) = (table(pack), pack.manifest());
    let manifest = match mapped::unchanged(pack).and(manifest) {
        Ok(manifest) => manifest,
        Err(error) => {
            reporter.failure(&error.to_string());
            return IO;
        }
    };
    if !reporter.output(&table) {
        return IO;
    }
    match full_kernel_size() {
        Ok(full) => printed(reporter, &explanation(&manifest, full)),
        Err(error) => bug(&error, reporter),
    }
}

/// The same for programs.
fn report_json(path: &Path, pack: &Pack<Checked>, reporter: &Reporter) -> u8 {
    let full = match full_kernel_size() {
        Ok(full) => full,
        Err(error) => return bug(&error, reporter),
    };
    let manifest = pack.manifest();
    let document = manifest
        .map(|manifest| document::document((path, &hex(&pack.render_id())), pack, &manifest, full));
    match mapped::unchanged(pack).and(document) {
        Ok(document) if reporter.document(&document) => OK,
        Ok(_) => IO,
        Err(error) => {
            reporter.failure(&format!("{}: {error}", path.shown()));
            IO
        }
    }
}

fn bug(error: &CompileError, reporter: &Reporter) -> u8 {
    reporter.failure(&format!("{error}\nThis is a bug of rtc, not of your scene."));
    BUG
}

/// Every feature of the kernel; `full`: the size of the kernel that has all of them.
fn explanation(manifest: &Manifest, full: KernelSize) -> String {
    let (kept, left) = (&manifest.features_kept, &manifest.features_left_out);
    let all = kept.len() + left.len();
    let mut text = format!("features kept: {} of {all}\n", kept.len());
    text.extend(kept.iter().map(|feature| line(manifest, feature)));
    let _ = writeln!(text, "features left out: {} of {all}", left.len());
    text.extend(left.iter().map(|feature| line(manifest, feature)));
    let KernelSize { lines, words } = manifest.kernel;
    let share = |part: u32, whole: u32| 100.0 * f64::from(part) / f64::from(whole.max(1));
    let _ = writeln!(
        text,
        "kernel: {lines} lines of WGSL, {:.1} % of the {} with all features; {words} words of SPIR-V, {:.1} % of {}",
        share(lines, full.lines),
        full.lines,
        share(words, full.words),
        full.words,
    );
    text
}

/// One line: the name, where the declaration is, the reason, the name of the declaration.
fn line(manifest: &Manifest, feature: &Feature) -> String {
    let Feature { name, reason, by } = feature;
    let place = by.as_ref().and_then(|by| manifest.place(by)).unwrap_or_else(|| "-".to_owned());
    let about = by.as_ref().map_or(String::new(), |by| format!(": `{}`", by.name));
    format!("  {name:<24} {place:<24} {reason}{about}\n")
}

fn table(pack: &Pack<Checked>) -> String {
    let render = pack.render();
    let [width, height] = render.image_size;
    let features = pack::features::names(pack.features()).join(", ");
    let mut text = format!(
        "render id   {}\nimage       {width} x {height} px, {} samples, depth {}\nnodes       {}\nstack need  {}\nholds       {features}\n{}\n",
        hex(&pack.render_id()),
        render.samples,
        render.depth().map_or_else(|| "unlimited".to_owned(), |depth| depth.to_string()),
        nodes(pack),
        render.stack_need,
        instances(pack),
    );
    let _ = writeln!(
        text,
        "{:<9} {:>12} {:>6} {:>15} {:>7}  blake3",
        "section", "elements", "size", "bytes", "binding"
    );
    for row in pack::describe(pack) {
        let kind = row.kind;
        let _ = writeln!(
            text,
            "{kind:<9} {:>12} {:>6} {:>15} {:>7}  {}",
            row.count,
            row.elem_size,
            row.bytes,
            row.binding.map_or("host".to_owned(), |binding| binding.to_string()),
            row.hash
        );
    }
    text
}

/// How many meshes are stored once, and how often they are shown; nothing where there is none.
fn instances(pack: &Pack<Checked>) -> String {
    let instances = pack.records::<Instance>();
    if instances.is_empty() {
        return String::new();
    }
    let meshes: BTreeSet<u32> = instances.iter().map(|instance| instance.root).collect();
    let counted = |name: &str| {
        let manifest = pack.manifest().ok()?;
        manifest.counters.into_iter().find(|(known, _)| known == name).map(|(_, count)| count)
    };
    let triangles = match (counted("triangles"), counted("triangles shown")) {
        (Some(stored), Some(shown)) => format!("; {stored} triangles stored, {shown} shown"),
        _ => String::new(),
    };
    format!("instances   {} of {} meshes{triangles}\n", instances.len(), meshes.len())
}

/// The layout of the nodes and how full they are.
fn nodes(pack: &Pack<Checked>) -> String {
    let (binary, wide) = (pack.records::<Node>(), pack.records::<WideNode>());
    let n_children: usize = wide.iter().map(|node| node.children().count()).sum();
    match (binary.len(), wide.len()) {
        (0, 0) => "none".to_owned(),
        (n, 0) => format!("{n} {}, 2 children each", Layout::Binary),
        (_, n) => {
            format!("{n} {}, {:.2} children each", Layout::Wide, n_children as f64 / n as f64)
        }
    }
}

fn hex(bytes: &[u8]) -> String {
    bytes.iter().fold(String::new(), |mut text, byte| {
        let _ = write!(text, "{byte:02x}");
        text
    })
}
