//! Wires the command line of the compiler.

fn main() -> std::process::ExitCode {
    host::prepare(host::Uses::Memory);
    host::run(|| std::process::ExitCode::from(compiler::cli::run(std::env::args_os())))
}
