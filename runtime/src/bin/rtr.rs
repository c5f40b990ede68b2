//! Wires the command line.

fn main() -> std::process::ExitCode {
    host::without_device_select();
    host::run(|| runtime::cli::run(std::env::args_os()))
}
