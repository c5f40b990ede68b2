//! `rtc inspect`: the sections of a pack as a table.

use std::collections::BTreeSet;
use std::fmt::Write;
use std::path::PathBuf;

use clap::Args;
use pack::abi::{Instance, Node, WideNode};
use pack::bvh::InnerNode;
use pack::{Checked, MapMode, Pack};

use super::{IO, OK};
use crate::bvh::Layout;
use crate::report::{Color, ErrorFormat, Reporter};

#[derive(Debug, Args)]
pub(super) struct InspectArgs {
    /// A pack that `rtc` wrote.
    pack: PathBuf,
    /// Also compare every section with its hash.
    #[arg(long)]
    verify: bool,
}

pub(super) fn inspect(args: &InspectArgs) -> u8 {
    let reporter = Reporter::new(ErrorFormat::Human, Color::Auto, usize::MAX);
    let opened = Pack::open(&args.pack, MapMode::Map).and_then(|pack| {
        if args.verify {
            pack.verify_hashes()?;
        }
        Ok(pack)
    });
    match opened {
        Ok(pack) => {
            reporter.output(&table(&pack));
            OK
        }
        Err(error) => {
            reporter.failure(&format!("{}: {error}", args.pack.display()));
            IO
        }
    }
}

fn table(pack: &Pack<Checked>) -> String {
    let render = pack.render();
    let [width, height] = render.image_size;
    let features = pack::features::names(pack.features()).join(", ");
    let mut text = format!(
        "render id   {}\nimage       {width} x {height} px, {} samples, depth {}\nnodes       {}\nstack need  {}\nholds       {features}\n{}\n",
        hex(&pack.render_id()),
        render.samples,
        render.max_depth,
        nodes(pack),
        render.stack_need,
        instances(pack),
    );
    let _ =
        writeln!(text, "{:<9} {:>12} {:>6} {:>15}  blake3", "section", "elements", "size", "bytes");
    for row in pack::describe(pack) {
        let kind = row.kind;
        let _ = writeln!(
            text,
            "{kind:<9} {:>12} {:>6} {:>15}  {}",
            row.count, row.elem_size, row.bytes, row.hash
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
