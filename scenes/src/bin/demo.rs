//! Wires the command line.
fn main() {}
