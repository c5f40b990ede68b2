//! What commands have in common: exit codes, how to report, and a scene with its files.

use std::path::PathBuf;

use ::files::ShowPath as _;
use clap::Args;

use crate::import::{Budget, Limits};
use crate::input::Root;
use crate::report::{Color, ErrorFormat, Reporter};

/// Done.
pub const OK: u8 = 0;
/// The scene has errors.
pub const SCENE: u8 = 1;
/// The command line has errors.
pub const USAGE: u8 = 2;
/// A file cannot be read or written.
pub const IO: u8 = 3;
/// A bug of ours.
pub const BUG: u8 = 70;

/// How to report; the same for every command that reads scenes.
#[derive(Debug, Clone, Args)]
pub(super) struct ReportArgs {
    /// Format of diagnostics.
    #[arg(long, value_enum, default_value_t, value_name = "FORMAT")]
    pub(super) error_format: ErrorFormat,
    /// When to colour the output.
    #[arg(long, value_enum, default_value_t, value_name = "WHEN")]
    pub(super) color: Color,
    /// Errors to print, and as many warnings; 0 prints all.
    #[arg(long, default_value_t = 50, value_name = "N")]
    pub(super) max_errors: usize,
}

/// Prints what the user asked for; gives the exit code.
pub(super) fn printed(reporter: &Reporter, text: &str) -> u8 {
    if reporter.output(text) { OK } else { IO }
}

impl ReportArgs {
    /// For programs: everything as JSON.
    pub(super) fn json() -> Self {
        Self { error_format: ErrorFormat::Json, color: Color::Never, max_errors: 0 }
    }

    pub(super) fn reporter(&self) -> Reporter {
        let max = if self.max_errors == 0 { usize::MAX } else { self.max_errors };
        Reporter::new(self.error_format, self.color, max)
    }
}

/// A scene and the values that override its parameters.
#[derive(Debug, Clone, Args)]
pub(super) struct SceneArgs {
    /// The scene text (`.rts`).
    pub(super) scene: PathBuf,
    /// Override a `param`, as in `-D hour=7h`; repeatable.
    #[arg(short = 'D', value_name = "NAME=VALUE", value_parser = parse_define)]
    pub(super) define: Vec<(String, String)>,
    /// Refuse scene files outside this folder, links resolved; absolute paths may lead into it [default: any
    /// file].
    #[arg(long, value_name = "DIR")]
    root: Option<PathBuf>,
    /// Memory limit for meshes and images, such as `8GB` [default: three quarters of free memory].
    #[arg(long, value_name = "SIZE", value_parser = parse_bytes)]
    memory: Option<u64>,
}

impl SceneArgs {
    /// Where files may lie; a folder that is not there is reported and becomes an exit code.
    pub(super) fn root(&self, reporter: &Reporter) -> Result<Root, u8> {
        let Some(folder) = &self.root else { return Ok(Root::ANYWHERE) };
        Root::new(folder).map_err(|error| {
            reporter.failure(&format!("--root {}: {error}", folder.shown()));
            USAGE
        })
    }

    /// What files may be. Asked once a compilation: free memory changes.
    pub(super) fn limits(&self, reporter: &Reporter) -> Result<Limits, u8> {
        let memory = self.memory.map_or_else(Budget::usual, Budget::of);
        Ok(Limits { memory, root: self.root(reporter)?, ..Limits::default() })
    }
}

/// `8GB`, `500 MB`, `2GiB`: bytes.
fn parse_bytes(text: &str) -> Result<u64, String> {
    let units = [
        ("TiB", 1 << 40),
        ("GiB", 1 << 30),
        ("MiB", 1 << 20),
        ("KiB", 1 << 10),
        ("TB", 1_000_000_000_000),
        ("GB", 1_000_000_000),
        ("MB", 1_000_000),
        ("kB", 1_000),
        ("B", 1_u64),
    ];
    let found = units.iter().find_map(|(unit, bytes)| Some((text.strip_suffix(unit)?, *bytes)));
    let bytes = found.and_then(|(number, unit)| {
        let number = number.trim().parse::<f64>().ok()?;
        let bytes = number * unit as f64;
        // A float becomes the nearest integer that there is.
        #[expect(clippy::cast_possible_truncation, reason = "checked just before")]
        (number.is_finite() && (1.0..=1e18).contains(&bytes)).then_some(bytes as u64)
    });
    bytes.ok_or_else(|| "write a number and a unit, as in 8GB, 500MB or 2GiB".to_owned())
}

fn parse_define(text: &str) -> Result<(String, String), String> {
    match text.split_once('=') {
        Some((name, value)) if !name.is_empty() && !value.is_empty() => {
            Ok((name.trim().to_owned(), value.trim().to_owned()))
        }
        _ => Err("write it as NAME=VALUE, for instance -D hour=7h".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_have_units() {
        for (text, bytes) in
            [("8GB", 8_000_000_000), ("1.5 MB", 1_500_000), ("2GiB", 2 << 30), ("7B", 7)]
        {
            assert_eq!(parse_bytes(text), Ok(bytes));
        }
        for text in ["", "8", "GB", "-1GB", "0B", "1e40GB", "nanGB", "8gb", "infGB"] {
            assert!(parse_bytes(text).is_err(), "{text}");
        }
    }
}
