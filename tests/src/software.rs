//! Mesa's software adapter for Vulkan: whether there is one, and tests that want it without its optimiser.

use std::env;
use std::process::Command;

use runtime::DeviceChoice;

/// Part of its name.
const NAME: &str = "llvmpipe";

/// Switches off its optimiser, which takes most of the time for large kernels and changes no bit. It is read when
/// the driver is loaded: hence a process of its own.
const NO_OPTIMISER: (&str, &str) = ("GALLIVM_PERF", "nopt");

/// The adapter, if there is one; says so where there is none.
#[must_use]
pub fn device() -> Option<DeviceChoice> {
    let found = runtime::gpu::adapters().iter().any(|adapter| adapter.matches(NAME));
    if !found {
        crate::console::line("skipped: no adapter");
    }
    found.then(|| DeviceChoice::Named(NAME.to_owned()))
}

/// The adapter without its optimiser, for the test called `this`. `None` where there is no adapter, or where a process
/// of its own has run the test.
///
/// # Panics
/// When the test fails in the other process.
#[must_use]
pub fn device_without_optimiser(this: &str) -> Option<DeviceChoice> {
    let device = device()?;
    if env::var_os(NO_OPTIMISER.0).is_some() {
        return Some(device);
    }
    let program = env::current_exe().expect("a test has a program");
    let mut again = Command::new(program);
    again
        .args([this, "--exact", "--nocapture", "--include-ignored"])
        .env(NO_OPTIMISER.0, NO_OPTIMISER.1);
    let output = again.output().expect("a test can be started");
    let text = String::from_utf8_lossy(&output.stdout);
    assert!(text.contains("1 passed"), "{text}{}", String::from_utf8_lossy(&output.stderr));
    None
}
