//! The command line of `rtc`: words become a command, a command becomes an exit code.
//!
//! Exit codes: 0 done, 1 the scene is wrong, 2 the command line is wrong, 3 a file cannot be read
//! or written, 70 a bug of ours.

mod args;
mod assets;
mod bounds;
mod build;
mod cache;
mod check;
mod compile;
mod explain;
mod files;
mod fmt;
mod inspect;
mod last;
mod mapped;
mod outputs;
mod show;
mod summary;
mod watch;

use std::ffi::OsString;
use std::path::Path;

use clap::error::ContextKind;
use clap::{CommandFactory, Parser, Subcommand};
use lang::stack::on_large_stack;

use crate::report::{Color, ErrorFormat, Reporter};
use args::ReportArgs;

pub use args::{BUG, IO, OK, SCENE, USAGE};

const EXAMPLES: &str = "\
Examples:
  rtc scene.rts -o scene.pack        compile a scene; then: rtr scene.pack
  rtc scene.rts --watch              recompile whenever a file of the scene changes
  rtc scene.rts -o - | rtr - -o a.png   compile and render through a pipe
  rtc scene.rts --depfile scene.d    also write what the pack depends on, for make or ninja
  rtc check scene.rts                report errors without compiling
  rtc check scene.rts --json         the same as one JSON object, for programs
  rtc scene.rts -D hour=7h           override a `param` of the scene
  rtc fmt scene.rts                  format the text; `rtc fmt .` a folder, `rtc fmt -` standard input
  rtc scene.rts --explain-features   explain which features the kernel has, and which lines need them
  rtc explain E0301                  explain an error, with an example
  rtc show --resolved scene.rts      print every value, defaults included
  rtc show --bounds scene.rts        print where everything is
  rtc inspect scene.pack             print what a pack contains; with --json for programs";

/// Compile a text scene into a render pack.
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
    /// Report errors without writing anything.
    Check(check::CheckArgs),
    /// Format scene texts in place; comments and numbers are kept.
    Fmt(fmt::FmtArgs),
    /// Explain an error code (`E0301`) or a kind (`material.diffuse`).
    Explain(explain::ExplainArgs),
    /// Print a scene as the compiler understands it.
    Show(show::ShowArgs),
    /// Print what a pack contains.
    Inspect(inspect::InspectArgs),
    /// Show or clear the cache.
    Cache(cache::CacheArgs),
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
        Command::Check(args) => check::check(&args),
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
    fn a_misspelled_command_is_answered_with_the_one_that_is_meant() {
        let arguments = with_default_command(["rtc", "chek", "d.rts"].map(OsString::from).to_vec());
        let message = Cli::try_parse_from(arguments).unwrap_err().to_string();
        assert!(message.contains("unrecognized subcommand 'chek'"), "{message}");
        assert!(message.contains("'check'"), "{message}");
    }
}
