//! Every binary of this crate: libFuzzer calls the target that has the binary's name.
#![no_main]

use libfuzzer_sys::fuzz_target;
use std::cell::LazyCell;
use tests::fuzz::{Runner, target};

thread_local! {
    static RUNNER: LazyCell<Runner> = LazyCell::new(|| {
        let target = target(env!("CARGO_BIN_NAME")).expect("binaries are named after targets");
        Runner::new(target).expect("a temporary folder")
    });
}

fuzz_target!(|bytes: &[u8]| drop(RUNNER.with(|runner| runner.run(bytes))));
