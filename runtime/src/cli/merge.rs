//! `rtr merge`: parts of a picture → its files, a few rows at a time.

use super::console::Console;
use super::denoise;
use super::exit::Exit;
use super::merge_args::MergeArgs;
use super::outputs::{self, Claim, Use, prove, save, tell};
use crate::denoise::Denoiser;
use crate::output::{
    self, Expected, ExrFile, Format, Merge, MergeError, Missing, OutputError, PngRows,
};
use files::ShowPath as _;
use std::cell::RefCell;
use std::io;
use std::path::{Path, PathBuf};

/// Commands that are told where parts are missing.
const MOST: usize = 8;

pub(super) fn command(args: &MergeArgs) -> Exit {
    let console = Console::with_progress(args.quiet).beside(&args.output);
    let merged = merge(args, &console);
    console.end_progress();
    match merged {
        Ok(()) => Exit::Done,
        Err(exit) => exit,
    }
}

fn merge(args: &MergeArgs, console: &Console) -> Result<(), Exit> {
    let formats = args.output.iter().map(|path| outputs::format(path, args.format));
    let formats = formats.collect::<Result<Vec<_>, String>>().map_err(|text| {
        console.warn(&format!("error: {text}"));
        Exit::World
    })?;
    let inputs: Vec<_> = args.parts.iter().map(|path| Use { path, what: "a part" }).collect();
    let claims = args.output.iter().map(|path| Claim::new(path, "the merged picture", 0));
    prove(console, &inputs, &claims.collect::<Vec<_>>())?;
    let denoiser = denoise::open(&args.denoise, console, &formats, None)?;
    let parts = args.parts.iter().map(|path| ExrFile::open(path)).collect::<Result<Vec<_>, _>>();
    let parts = parts.map_err(|error| console.fail(&error, Exit::World))?;
    let expected = Expected { samples: args.samples, crop: args.crop };
    let merge = Merge::new(parts, expected).map_err(|error| explain(args, console, &error))?;
    let outputs: Vec<_> = args.output.iter().map(PathBuf::as_path).zip(formats).collect();
    match &denoiser {
        Some(denoiser) => write_denoised(args, console, &merge, (denoiser, &outputs)),
        None => write(args, console, &merge, &outputs),
    }
}

/// Writes the picture as its rows come. PNGs see those of an EXR, if there is one.
fn write(
    args: &MergeArgs,
    console: &Console,
    merge: &Merge<ExrFile>,
    outputs: &[(&Path, Format)],
) -> Result<(), Exit> {
    let fresh = || -> Vec<PngRows> {
        let pngs = outputs.iter().filter(|(_, format)| *format != Format::Exr);
        pngs.map(|(_, format)| PngRows::new(merge.head(), *format == Format::Png16)).collect()
    };
    let height = merge.head().film.region.h;
    let pngs = RefCell::new(fresh());
    let seen = |rows: &output::Picture| {
        pngs.borrow_mut().iter_mut().for_each(|png| png.add(rows));
        let region = rows.film.region;
        let done = region.y + region.h - merge.head().film.region.y;
        console.advance(f64::from(done) / f64::from(height), "of the rows are merged");
    };
    let mut exit = Ok(());
    let exrs = outputs.iter().filter(|(_, format)| *format == Format::Exr);
    for (path, _) in exrs {
        let failed: RefCell<Option<MergeError>> = RefCell::new(None);
        let saved = files::save(path, |out| {
            // A part that could not be read is no reason to write elsewhere.
            if failed.borrow().is_some() {
                return Err(io::Error::other("a part cannot be read"));
            }
            *pngs.borrow_mut() = fresh();
            merge.write_exr(out, seen).map_err(|error| {
                let text = error.to_string();
                if !matches!(error, MergeError::Part(OutputError::Encode { .. })) {
                    *failed.borrow_mut() = Some(error);
                }
                io::Error::other(text)
            })
        });
        if let Some(error) = failed.into_inner() {
            return Err(explain(args, console, &error));
        }
        exit = tell(console, path, saved).and(exit);
    }
    // Without an EXR, or if that could not be written, nobody has seen the rows.
    if !pngs.borrow().iter().all(PngRows::is_whole) {
        *pngs.borrow_mut() = fresh();
        merge.each(seen).map_err(|error| explain(args, console, &error))?;
    }
    let paths = outputs.iter().filter(|(_, format)| *format != Format::Exr).map(|(path, _)| path);
    for (path, png) in paths.zip(pngs.into_inner()) {
        let bytes = png.finish().map_err(|error| console.fail(&error, Exit::Bug))?;
        exit = save(console, path, &bytes).and(exit);
    }
    exit
}

/// Denoises the whole picture, and writes it.
fn write_denoised(
    args: &MergeArgs,
    console: &Console,
    merge: &Merge<ExrFile>,
    (denoiser, outputs): (&Denoiser, &[(&Path, Format)]),
) -> Result<(), Exit> {
    let mut picture = merge.read().map_err(|error| explain(args, console, &error))?;
    let mut exit = denoise::denoise(console, denoiser, &mut picture);
    for (path, format) in outputs {
        let bytes = output::encode(*format, &picture, true);
        let bytes = bytes.map_err(|error| console.fail(&error, Exit::Bug))?;
        exit = save(console, path, &bytes).and(exit);
    }
    exit
}

/// Says why the parts are not the picture, and what helps.
fn explain(args: &MergeArgs, console: &Console, error: &MergeError) -> Exit {
    if let MergeError::Missing(missing) = error {
        console.fail(error, Exit::World);
        missing.iter().take(MOST).for_each(|missing| console.warn(&help(args, missing)));
        return Exit::World;
    }
    if !matches!(error, MergeError::Part(_) | MergeError::NoMemory(_)) {
        for (i, path) in (1..).zip(&args.parts) {
            console.note(&format!("part {i} is {}", path.shown()));
        }
    }
    console.fail(error, Exit::World)
}

/// The command that renders what is missing.
fn help(args: &MergeArgs, Missing { crop, samples }: &Missing) -> String {
    let folder = args.parts.first().and_then(|part| part.parent()).unwrap_or(Path::new(""));
    let (flag, name) = match crop {
        Some(crop) => (
            format!(" --crop {crop}"),
            format!("crop-{}-{}-{}-{}-", crop.x, crop.y, crop.w, crop.h),
        ),
        None => (String::new(), String::new()),
    };
    let part = folder.join(format!("{name}samples-{}-{}.exr", samples.start, samples.end));
    format!(
        "help: render them with the flags of the other parts: rtr SCENE.pack{flag} --samples {samples} -o {}",
        part.shown()
    )
}
