//! `cargo demo`: generates what a scene needs, runs `rtc`, runs `rtr`, says where the pictures are.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Parser;
use scenes::catalog::{self, EXAMPLES, Example};
use scenes::console;
use scenes::generate::{Extent, Generated};

const EXAMPLES_HELP: &str = "\
Examples:
  cargo demo                          compile and render the default scene
  cargo demo cornell_sphere           another one; --list names them all
  cargo demo mesh --spp 512           more samples
  cargo demo weekend --size 320x180   a quick look";

/// Renders one of the example scenes, from text to picture.
#[derive(Debug, Parser)]
#[command(name = "demo", bin_name = "cargo demo", version, after_help = EXAMPLES_HELP)]
struct Args {
    /// Which scene.
    #[arg(default_value = EXAMPLES[0].name)]
    scene: String,
    /// Name the scenes and stop.
    #[arg(long)]
    list: bool,
    /// Where pack and pictures go.
    #[arg(long, default_value = "out", value_name = "DIR")]
    out: PathBuf,
    /// Image size instead of the scene's own.
    #[arg(long, value_name = "WxH")]
    size: Option<String>,
    /// Samples per pixel instead of the scene's own.
    #[arg(long)]
    spp: Option<String>,
    /// `auto`, `cpu`, `gpu` or part of an adapter's name.
    #[arg(long)]
    device: Option<String>,
}

fn main() -> ExitCode {
    let args = Args::parse();
    if args.list {
        for example in EXAMPLES {
            console::line(&format!("{:<16} {}", example.name, example.about));
        }
        return ExitCode::SUCCESS;
    }
    let Some(example) = catalog::find(&args.scene) else {
        let names: Vec<&str> = EXAMPLES.iter().map(|example| example.name).collect();
        console::problem(&format!("no scene `{}`; there are {}", args.scene, names.join(", ")));
        return ExitCode::from(2);
    };
    match run(example, &args) {
        Ok(code) => code,
        Err(error) => {
            console::problem(&error.to_string());
            ExitCode::from(3)
        }
    }
}

fn run(example: &Example, args: &Args) -> std::io::Result<ExitCode> {
    let scenes = scenes_dir();
    std::fs::create_dir_all(&args.out)?;
    for Generated { path, holds } in example.generate(&scenes, Extent::Full)? {
        let what = holds.map(|w| {
            format!(
                ": {} image files, and parts of {} triangles, some of which are placed more than once",
                w.textures, w.triangles
            )
        });
        console::line(&format!("generated {}{}", path.display(), what.unwrap_or_default()));
    }
    let pack = args.out.join(example.name).with_extension("pack");
    let source = example.source(&scenes);
    let compile = ["rtc".into(), source.into_os_string(), "-o".into(), pack.clone().into()];
    echo(&compile);
    let code = compiler::cli::run(compile);
    if code != 0 {
        return Ok(ExitCode::from(code));
    }
    let mut render = vec!["rtr".into(), pack.clone().into_os_string()];
    for extension in ["exr", "png"] {
        render.extend(["-o".into(), pack.with_extension(extension).into_os_string()]);
    }
    for (flag, value) in [("--size", &args.size), ("--spp", &args.spp), ("--device", &args.device)]
    {
        if let Some(value) = value {
            render.extend([flag.into(), value.into()]);
        }
    }
    echo(&render);
    Ok(runtime::cli::run(render))
}

/// The folder of the scenes: where cargo says this package is, now or when it was built.
fn scenes_dir() -> PathBuf {
    let now = std::env::var_os("CARGO_MANIFEST_DIR").map(PathBuf::from);
    let dir = now.unwrap_or_else(|| PathBuf::from(env!("CARGO_MANIFEST_DIR")));
    // Shorter names in messages when the demo runs where people run it: at the root.
    let here = std::env::current_dir().ok();
    let short = here.and_then(|here| dir.strip_prefix(here).map(Path::to_owned).ok());
    short.unwrap_or(dir)
}

/// Shows a command as one would type it.
fn echo(command: &[std::ffi::OsString]) {
    let words: Vec<_> = command.iter().map(|word| word.to_string_lossy()).collect();
    console::line(&format!("\n$ {}", words.join(" ")));
}
