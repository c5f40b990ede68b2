//! What `rtr` writes: where pictures go, proven before the first sample, and never lost after the last.
//!
//! Turns arguments and a pack into names and formats, and finished bytes into files. It does not render.

use super::args::RenderArgs;
use super::console::Console;
use super::exit::Exit;
use crate::job::Job;
use crate::output::Format;
use crate::scene::Scene;
use files::{Claims, FileError, Saved, ShowPath as _};
use std::ffi::OsStr;
use std::path::{Component, Path, PathBuf};

/// A picture that is going to be written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Output {
    pub(super) path: PathBuf,
    pub(super) format: Format,
}

/// A file that is read or written, and what it is.
pub(super) struct Use<'a> {
    pub(super) path: &'a Path,
    pub(super) what: &'a str,
}

/// An output and about how many bytes it is going to have.
pub(super) struct Claim<'a> {
    pub(super) file: Use<'a>,
    pub(super) room: u64,
}

impl<'a> Claim<'a> {
    pub(super) fn new(path: &'a Path, what: &'a str, room: u64) -> Self {
        Self { file: Use { path, what }, room }
    }
}

/// Whether every output can be written, and is no input and no other output; the first that is not is told.
pub(super) fn prove(
    console: &Console,
    inputs: &[Use<'_>],
    outputs: &[Claim<'_>],
) -> Result<(), Exit> {
    let mut claims = Claims::new();
    let read = inputs.iter().try_for_each(|input| claims.input(input.path, input.what));
    let claimed = read.and_then(|()| {
        outputs.iter().try_for_each(|output| claims.output(output.file.path, output.file.what))
    });
    claimed.map_err(|clash| console.fail(&clash, Exit::Usage))?;
    let proven = outputs.iter().try_for_each(|output| files::probe(output.file.path, output.room));
    proven.map_err(|error| console.fail(&error, Exit::World))
}

/// Writes a finished result, elsewhere if need be, and says where it is.
pub(super) fn save(console: &Console, path: &Path, bytes: &[u8]) -> Result<(), Exit> {
    tell(console, path, files::save(path, |out| out.write_all(bytes)))
}

/// Says where a result is that was to go to `path`.
pub(super) fn tell(
    console: &Console,
    path: &Path,
    saved: Result<Saved, FileError>,
) -> Result<(), Exit> {
    match saved {
        Ok(Saved::AsAsked) => {
            console.result(&format!("wrote {}", path.shown()));
            Ok(())
        }
        Ok(Saved::Elsewhere(at, error)) => {
            console.warn(&format!("error: {error}; it was saved as {} instead", at.shown()));
            Err(Exit::World)
        }
        Err(error) => Err(console.fail(&error, Exit::World)),
    }
}

/// Bytes of a picture that is not compressed; `residual` as for `output::encode`.
pub(super) fn room(format: Format, job: &Job, residual: bool) -> u64 {
    let pixel = match format {
        Format::Png => 3,
        Format::Png16 => 6,
        Format::Exr => 12 * (1 + u64::from(residual)),
    };
    job.crop.pixels() * pixel
}

/// The format of an output: what the name says, in sixteen bits if that is `wanted`; else `wanted`, else for a stream, whose name says nothing, PNG.
pub(super) fn format(path: &Path, wanted: Option<Format>) -> Result<Format, String> {
    match (Format::of(path), wanted) {
        (Ok(Format::Png), Some(Format::Png16)) => Ok(Format::Png16),
        (Ok(format), _) | (Err(_), Some(format)) => Ok(format),
        (Err(_), None) if files::is_stream(path) => Ok(Format::Png),
        (Err(error), None) => Err(error.to_string()),
    }
}

/// What `-o` says; else what the scene says, if nothing of that name is there; else the pack's name, in the working
/// folder.
pub(super) fn outputs(
    args: &RenderArgs,
    console: &Console,
    pack: &Path,
    scene: &Scene,
) -> Result<Vec<Output>, String> {
    let one = |path: &PathBuf| -> Result<Output, String> {
        Ok(Output { path: path.clone(), format: format(path, args.format)? })
    };
    if !args.output.is_empty() {
        return args.output.iter().map(one).collect();
    }
    let name = match pack {
        pack if pack == Path::new("-") => OsStr::new("picture"),
        pack => pack.file_stem().unwrap_or(OsStr::new("picture")),
    };
    let own = pair(Path::new(name));
    let wanted = scene.pack().manifest().ok().and_then(|manifest| manifest.output);
    let Some(wanted) = wanted.as_deref().and_then(plain_stem).map(|stem| pair(&stem)) else {
        return Ok(own);
    };
    let taken = |output: &Output| std::fs::symlink_metadata(&output.path).is_ok();
    match wanted.iter().find(|output| taken(output)) {
        Some(output) if wanted != own && !args.scene_output => {
            console.note(&format!(
                "the scene names its picture {}, which exists already; --scene-output replaces it",
                output.path.shown()
            ));
            Ok(own)
        }
        _ => Ok(wanted),
    }
}

/// Both formats of one stem.
fn pair(stem: &Path) -> Vec<Output> {
    let of = |(extension, format)| Output { path: with_extension(stem, extension), format };
    [("exr", Format::Exr), ("png", Format::Png)].map(of).into()
}

/// Adds an extension; a dot in the stem stays.
pub(super) fn with_extension(stem: &Path, extension: &str) -> PathBuf {
    let mut name = stem.as_os_str().to_owned();
    name.push(".");
    name.push(extension);
    PathBuf::from(name)
}

/// The name without `.exr` or `.png`. A pack is a stranger's file: it may give a plain visible name only, in the working
/// folder.
fn plain_stem(output: &str) -> Option<PathBuf> {
    let path = Path::new(output);
    let plain = matches!(path.components().collect::<Vec<_>>().as_slice(), [Component::Normal(_)]);
    let visible = !output.starts_with(['.', '-']) && files::escape(output) == output;
    let known = Format::of(path).is_ok();
    let stem = if known { path.with_extension("") } else { path.to_owned() };
    (plain && visible && !output.ends_with('/')).then_some(stem)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pack_may_give_a_plain_name_only() {
        assert_eq!(plain_stem("pic.png"), Some(PathBuf::from("pic")));
        assert_eq!(plain_stem("pic.v2"), Some(PathBuf::from("pic.v2")));
        for name in
            ["", "/etc/pic.png", "../pic.png", "out/pic.exr", "out/", ".bashrc", "-o", "a\u{1b}[2J"]
        {
            assert_eq!(plain_stem(name), None, "{name}");
        }
        assert_eq!(with_extension(Path::new("a/pic.v2"), "exr"), PathBuf::from("a/pic.v2.exr"));
    }

    #[test]
    fn a_stream_is_a_png_unless_another_format_is_wanted() {
        let path = Path::new("-");
        assert_eq!(format(path, None), Ok(Format::Png));
        assert_eq!(format(path, Some(Format::Exr)), Ok(Format::Exr));
        assert_eq!(format(Path::new("a.exr"), Some(Format::Png)), Ok(Format::Exr));
        assert_eq!(format(Path::new("a.png"), Some(Format::Png16)), Ok(Format::Png16));
        assert_eq!(format(Path::new("a.exr"), Some(Format::Png16)), Ok(Format::Exr));
        assert!(format(Path::new("a.tiff"), None).is_err());
    }
}
