//! Wires the command line of the compiler.

use std::process::ExitCode;

fn main() -> ExitCode {
    ExitCode::from(compiler::cli::run(std::env::args_os()))
}
