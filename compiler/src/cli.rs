//! The command line of `rtc`: words become a command, a command becomes an exit code.
//!
//! Exit codes: 0 done, 1 the scene is wrong, 2 the command line is wrong, 3 a file cannot be read
//! or written, 70 a bug of ours.

mod build;
mod cache;
mod compile;
mod explain;
mod files;
mod fmt;
mod inspect;
mod mapped;
mod outputs;
mod record;
mod show;
mod summary;
mod watch;

use std::ffi::OsString;
use std::path::{Path, PathBuf};

use ::files::ShowPath as _;
use clap::error::ContextKind;
use clap::{Args, CommandFactory, Parser, Subcommand};
use lang::stack::on_large_stack;

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

const EXAMPLES: &str = "\
Examples:
  rtc scene.rts -o scene.pack        compile a scene; then: rtr scene.pack
  rtc scene.rts --watch              compile again whenever a file of the scene changes
  rtc scene.rts -o - | rtr - -o a.png   without a file in between
  rtc scene.rts --depfile scene.d    also write what the pack depends on, for make or ninja
  rtc check scene.rts                only look for errors
  rtc scene.rts -D hour=7h           override a `param` of the scene
  rtc fmt scene.rts                  tidy the text; `rtc fmt .` every one below, `rtc fmt -` standard input
  rtc scene.rts --explain-features   what its kernel can do, which line needs that, what was left out
  rtc explain E0301                  what an error means, with an example
  rtc show --resolved scene.rts      every value, defaults included
  rtc inspect scene.pack             what is in a pack";

/// Compiles a text scene into a render pack.
#[derive(Debug, Parser)]
#[command(name = "rtc", version, about, after_help = EXAMPLES, max_term_width = 100)]
#[command(override_usage = "rtc [build] [OPTIONS] <SCENE>\n       rtc <COMMAND>")]
#[command(arg_required_else_help = true)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Compile a scene; the default command.
    Build(build::BuildArgs),
    /// Look for errors without writing anything.
    Check(build::CheckArgs),
    /// Tidy scene texts in place; comments and numbers stay as written.
    Fmt(fmt::FmtArgs),
    /// Explain an error code (`E0301`) or a kind (`material.diffuse`).
    Explain(explain::ExplainArgs),
    /// Print a scene as the compiler understands it.
    Show(show::ShowArgs),
    /// Print what a pack contains.
    Inspect(inspect::InspectArgs),
    /// Look at or clear the BVH cache.
    Cache(cache::CacheArgs),
}

/// How to report; the same for every command that reads scenes.
#[derive(Debug, Clone, Args)]
struct ReportArgs {
    /// How errors look.
    #[arg(long, value_enum, default_value_t, value_name = "FORMAT")]
    error_format: ErrorFormat,
    /// Colours on the terminal.
    #[arg(long, value_enum, default_value_t, value_name = "WHEN")]
    color: Color,
    /// Errors shown, and as many warnings; 0 shows all.
    #[arg(long, default_value_t = 50, value_name = "N")]
    max_errors: usize,
}

/// Prints what the user asked for; gives the exit code.
fn printed(reporter: &Reporter, text: &str) -> u8 {
    if reporter.output(text) { OK } else { IO }
}

impl ReportArgs {
    fn reporter(&self) -> Reporter {
        let max = if self.max_errors == 0 { usize::MAX } else { self.max_errors };
        Reporter::new(self.error_format, self.color, max)
    }
}

/// A scene and the values that override its parameters.
#[derive(Debug, Clone, Args)]
struct SceneArgs {
    /// The scene text (`.rts`).
    scene: PathBuf,
    /// Override a `param`, as in `-D hour=7h`; may be given several times.
    #[arg(short = 'D', value_name = "NAME=VALUE", value_parser = parse_define)]
    define: Vec<(String, String)>,
    /// Refuse files of the scene that lie outside of this folder once all links are resolved; absolute paths may
    /// lead into it [default: any file].
    #[arg(long, value_name = "DIR")]
    root: Option<PathBuf>,
    /// Memory that meshes and images may take together, as in `8GB` [default: three quarters of what is free].
    #[arg(long, value_name = "SIZE", value_parser = parse_bytes)]
    memory: Option<u64>,
}

impl SceneArgs {
    /// Where files may lie; a folder that is not there is reported and becomes an exit code.
    fn root(&self, reporter: &Reporter) -> Result<Root, u8> {
        let Some(folder) = &self.root else { return Ok(Root::ANYWHERE) };
        Root::new(folder).map_err(|error| {
            reporter.failure(&format!("--root {}: {error}", folder.shown()));
            USAGE
        })
    }

    /// What files may be. Asked once a compilation: free memory changes.
    fn limits(&self, reporter: &Reporter) -> Result<Limits, u8> {
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

/// Runs `rtc` with these arguments, the program's name first; returns the exit code.
pub fn run<I, T>(arguments: I) -> u8
where
    I: IntoIterator<Item = T>,
    T: Into<OsString> + Clone,
{
    let arguments: Vec<OsString> = arguments.into_iter().map(Into::into).collect();
    // A scene may be nested deeper than a small stack allows, which is no fault of the scene.
    on_large_stack(|| run_here(arguments)).unwrap_or_else(|error| {
        let reporter = Reporter::new(ErrorFormat::Human, Color::Auto, usize::MAX);
        reporter.failure(&format!("cannot start a thread: {error}"));
        IO
    })
}

fn run_here(arguments: Vec<OsString>) -> u8 {
    let arguments = with_default_command(arguments);
    let cli = match Cli::try_parse_from(arguments) {
        Ok(cli) => cli,
        Err(error) => {
            // clap prints help and version on standard output, mistakes on standard error.
            let _ = error.print();
            return if error.use_stderr() { USAGE } else { OK };
        }
    };
    let wanted = match &cli.command {
        Command::Build(args) => args.threads,
        _ => None,
    };
    if let Err(error) = host::start_pool(wanted) {
        let report = ReportArgs {
            error_format: ErrorFormat::default(),
            color: Color::default(),
            max_errors: 1,
        };
        report.reporter().failure(&error.to_string());
        return IO;
    }
    match cli.command {
        Command::Build(args) => build::build(&args),
        Command::Check(args) => build::check(&args),
        Command::Fmt(args) => fmt::fmt(&args),
        Command::Explain(args) => explain::explain(&args),
        Command::Show(args) => show::show(&args),
        Command::Inspect(args) => inspect::inspect(&args),
        Command::Cache(args) => cache::cache(&args),
    }
}

/// `rtc scene.rts` is short for `rtc build scene.rts`: what is neither a command nor a question about
/// the program belongs to `build`.
fn with_default_command(mut arguments: Vec<OsString>) -> Vec<OsString> {
    let own = ["help", "-h", "--help", "-V", "--version"];
    let program = Cli::command();
    let known = |word: &str| own.contains(&word) || program.find_subcommand(word).is_some();
    if arguments.get(1).is_some_and(|word| {
        !word.to_str().is_some_and(|word| known(word) || is_misspelled_command(word))
    }) {
        arguments.insert(1, "build".into());
    }
    arguments
}

/// Whether a word is one for which clap proposes a command, and not the name of a file that is there.
fn is_misspelled_command(word: &str) -> bool {
    if !word.chars().all(char::is_alphabetic) || Path::new(word).exists() {
        return false;
    }
    let error = Cli::try_parse_from(["rtc", word]).err();
    error.is_some_and(|error| error.get(ContextKind::SuggestedSubcommand).is_some())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_no_command_is_a_scene_unless_it_is_nearly_one() {
        let second = |word: &str| {
            let arguments = ["rtc", word, "d.rts"].map(OsString::from).to_vec();
            with_default_command(arguments)[1].clone()
        };
        for word in ["chek", "biuld", "shwo", "inspct", "explian", "check", "help"] {
            assert_eq!(second(word), word);
        }
        for word in ["check.rts", "chek.rts", "-D", "scene", "a/chek", "", "é"] {
            assert_eq!(second(word), "build", "{word}");
        }
    }

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

    #[test]
    fn a_misspelled_command_is_answered_with_the_one_that_is_meant() {
        let arguments = with_default_command(["rtc", "chek", "d.rts"].map(OsString::from).to_vec());
        let message = Cli::try_parse_from(arguments).unwrap_err().to_string();
        assert!(message.contains("unrecognized subcommand 'chek'"), "{message}");
        assert!(message.contains("'check'"), "{message}");
    }
}
