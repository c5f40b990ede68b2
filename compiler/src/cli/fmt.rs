//! `rtc fmt`: tidies scene texts in place.

use files::ShowPath as _;
use std::path::{Path, PathBuf};

use clap::Args;
use lang::source::SourceSet;

use super::files::read_text;
use super::{IO, OK, ReportArgs, SCENE};
use crate::report::Reporter;

#[derive(Debug, Args)]
pub(super) struct FmtArgs {
    /// Scene texts.
    #[arg(required = true)]
    scenes: Vec<PathBuf>,
    /// Change nothing; exit with 1 if a text is not tidy.
    #[arg(long)]
    check: bool,
    #[command(flatten)]
    report: ReportArgs,
}

pub(super) fn fmt(args: &FmtArgs) -> u8 {
    let reporter = args.report.reporter();
    let codes = args.scenes.iter().map(|path| one(path, args.check, &reporter));
    codes.max().unwrap_or(OK)
}

fn one(path: &Path, check: bool, reporter: &Reporter) -> u8 {
    let shown = path.shown();
    let text = match read_text(path) {
        Ok(text) => text,
        Err(error) => {
            reporter.failure(&format!("cannot read {shown}: {error}"));
            return IO;
        }
    };
    let tidy = match lang::format::format(&text) {
        Ok(tidy) => tidy,
        Err(diagnostics) => {
            let mut sources = SourceSet::new();
            sources.add(shown.to_string(), text);
            reporter.diagnostics(&sources, &diagnostics);
            return SCENE;
        }
    };
    if tidy == text {
        return OK;
    }
    if check {
        reporter.status(&format!("{shown} is not tidy; `rtc fmt {shown}` would change it"));
        return SCENE;
    }
    match files::write(path, |file| file.write_all(tidy.as_bytes())) {
        Ok(()) => OK,
        Err(error) => {
            reporter.failure(&format!("{error}"));
            IO
        }
    }
}
