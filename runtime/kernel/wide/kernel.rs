//! The kernel as the build script wrote it: not written by hand and not edited.
#![allow(
    clippy::all,
    clippy::pedantic,
    dead_code,
    missing_docs,
    unreachable_pub,
    unused,
    non_snake_case,
    non_upper_case_globals,
    reason = "generated"
)]

include!(concat!(env!("OUT_DIR"), "/kernel.rs"));
