//! Wires the command line.

fn main() -> std::process::ExitCode {
    host::prepare(host::Uses::Drivers);
    host::run(|| runtime::cli::run(std::env::args_os()))
}
