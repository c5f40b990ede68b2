//! `rtc fmt`: tidies scene texts in place, or the one on standard input on its way to standard output.

use std::ffi::OsStr;
use std::io::Read as _;
use std::path::{Path, PathBuf};

use clap::Args;
use files::ShowPath as _;
use lang::source::{MAX_FILE_BYTES, SourceSet};

use super::args::{IO, OK, ReportArgs, SCENE};
use super::files::read_scene;
use crate::input::Root;
use crate::report::Reporter;

#[derive(Debug, Args)]
pub(super) struct FmtArgs {
    /// Scene texts, folders (every `.rts` file below, without following links), or `-` to format standard
    /// input to standard output.
    #[arg(required = true, value_name = "PATH")]
    paths: Vec<PathBuf>,
    /// Change nothing; exit with 1 if a text is not formatted.
    #[arg(long)]
    check: bool,
    #[command(flatten)]
    report: ReportArgs,
}

pub(super) fn fmt(args: &FmtArgs) -> u8 {
    let reporter = args.report.reporter();
    let code = |path: &PathBuf| {
        if path.as_os_str() == "-" {
            standard_input(args.check, &reporter)
        } else if path.is_dir() {
            folder(path, args.check, &reporter)
        } else {
            file(path, args.check, &reporter)
        }
    };
    args.paths.iter().map(code).max().unwrap_or(OK)
}

fn standard_input(check: bool, reporter: &Reporter) -> u8 {
    const NAME: &str = "standard input";
    let mut bytes = Vec::new();
    let most = MAX_FILE_BYTES as u64;
    if let Err(error) = std::io::stdin().lock().take(most + 1).read_to_end(&mut bytes) {
        reporter.failure(&format!("cannot read {NAME}: {error}"));
        return IO;
    }
    if bytes.len() > MAX_FILE_BYTES {
        reporter.failure(&format!("{NAME} has more than the {most} bytes of a scene text"));
        return IO;
    }
    let text = match String::from_utf8(bytes) {
        Ok(text) => text,
        Err(error) => {
            let at = error.utf8_error().valid_up_to();
            reporter.failure(&format!("{NAME} is not UTF-8 text: wrong byte at offset {at}"));
            return SCENE;
        }
    };
    match tidied(NAME, &text, reporter) {
        Err(code) => code,
        Ok(tidy) if check && tidy != text => SCENE,
        Ok(tidy) if check || reporter.output(&tidy) => OK,
        Ok(_) => IO,
    }
}

/// Every scene text below a folder, in the order of their paths.
fn folder(path: &Path, check: bool, reporter: &Reporter) -> u8 {
    let mut code = OK;
    let mut texts = Vec::new();
    let mut folders = vec![path.to_owned()];
    while let Some(folder) = folders.pop() {
        if let Err(error) = list(&folder, &mut texts, &mut folders) {
            reporter.failure(&format!("cannot read {}: {error}", folder.shown()));
            code = IO;
        }
    }
    texts.sort();
    texts.iter().map(|text| file(text, check, reporter)).fold(code, u8::max)
}

/// Adds the scene texts and the folders that lie in `folder`. Links are neither: what they point to is
/// tidied where it lies, and no circle is walked.
fn list(
    folder: &Path,
    texts: &mut Vec<PathBuf>,
    folders: &mut Vec<PathBuf>,
) -> std::io::Result<()> {
    for entry in std::fs::read_dir(folder)? {
        let entry = entry?;
        let (kind, path) = (entry.file_type()?, entry.path());
        if kind.is_dir() {
            folders.push(path);
        } else if kind.is_file() && path.extension() == Some(OsStr::new("rts")) {
            texts.push(path);
        }
    }
    Ok(())
}

fn file(path: &Path, check: bool, reporter: &Reporter) -> u8 {
    let shown = path.shown();
    let text = match read_scene(path, &Root::ANYWHERE) {
        Ok(text) => text,
        Err(error) => {
            reporter.failure(&format!("cannot read {shown}: {error}"));
            return IO;
        }
    };
    let tidy = match tidied(&shown.to_string(), &text, reporter) {
        Ok(tidy) => tidy,
        Err(code) => return code,
    };
    if tidy == text {
        return OK;
    }
    if check {
        reporter.status(&format!("{shown} is not formatted; `rtc fmt {shown}` would change it"));
        return SCENE;
    }
    match files::write(path, |file| file.write_all(tidy.as_bytes())) {
        Ok(()) => OK,
        Err(error) => {
            reporter.failure(&error.to_string());
            IO
        }
    }
}

/// The text as it should look; what is wrong with one that cannot be read is reported.
fn tidied(name: &str, text: &str, reporter: &Reporter) -> Result<String, u8> {
    lang::format::format(text).map_err(|diagnostics| {
        let mut sources = SourceSet::new();
        sources.add(name, text);
        reporter.diagnostics(&sources, &diagnostics);
        SCENE
    })
}
