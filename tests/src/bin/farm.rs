//! `cargo run --release -p tests --bin farm`: what the 8K frame of the shrine costs, on one machine and on many. Prints
//! a section of `docs/farm.md` and rewrites `docs/farm-crop.png`. `farm quick` measures less and writes no picture;
//! `farm merging` prints what merging parts of such a frame takes.

use std::error::Error;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use compiler::bvh::Layout;
use runtime::{Rect, Scene};
use tests::farm::cost::Costs;
use tests::farm::merging;
use tests::farm::page::{Measured, page};
use tests::farm::tasks::{self, Merging, Parts, StartUp};
use tests::{console, mapped, scene};

/// The tablet of the gate, before the roof of the hall, in pixels of the frame.
const CROP: Rect = Rect { x: 4341, y: 735, w: 360, h: 360 };

/// How much is measured.
struct Effort {
    n_crops: usize,
    samples: u32,
    crop: Rect,
}

const FULL: Effort = Effort { n_crops: 64, samples: 256, crop: CROP };
const QUICK: Effort = Effort { n_crops: 16, samples: 32, crop: Rect { w: 100, h: 90, ..CROP } };

fn main() -> Result<ExitCode, Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let word = arguments.next();
    match word.as_deref() {
        Some(tasks::CHILD) => Ok(ExitCode::from(tasks::child(arguments))),
        Some(merging::CHILD) => Ok(ExitCode::from(merging::child(arguments))),
        Some("merging") => {
            console::line(&merging::page()?);
            Ok(ExitCode::SUCCESS)
        }
        Some("quick") => measure(&QUICK, None),
        Some(_) => Err("the choices are `quick` and `merging`".into()),
        None => {
            let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs");
            measure(&FULL, Some(docs.join("farm-crop.png")))
        }
    }
}

/// The picture goes to `picture`, or is gone with everything else.
fn measure(effort: &Effort, picture: Option<PathBuf>) -> Result<ExitCode, Box<dyn Error>> {
    let folder = tempfile::tempdir()?;
    let folder = folder.path();
    let pack = folder.join("shrine.pack");
    let example = scenes::catalog::find("shrine").ok_or("there is no shrine")?;
    let compiled = scene::full_example(example, &[("final", "true")], Layout::Wide);
    std::fs::write(&pack, scene::bytes(&compiled))?;
    drop(compiled);
    console::progress("the scene is compiled");
    let start_up = StartUp::measure(&pack, folder, effort.crop)?;
    let opened = Scene::new(mapped::map(&pack)?);
    let costs = Costs::measure(&opened, effort.n_crops, effort.samples)?;
    drop(opened);
    let parts = Parts::render(&pack, folder, effort.crop, effort.samples)?;
    let picture = picture.unwrap_or_else(|| folder.join("crop.png"));
    let pixels = effort.crop.pixels() as f64;
    let merging = Merging::measure(&parts.paths, pixels, folder, &picture)?;
    let size = std::fs::metadata(&pack)?.len() as f64;
    let samples = effort.samples;
    let (crop, pack) = (effort.crop, size);
    let measured = Measured { costs, start_up, pack, crop, parts, merging, samples };
    console::line(&page(&measured));
    Ok(ExitCode::SUCCESS)
}
