//! `rtc` as a user runs it: in the folder of a scene, with a cache of its own.

use std::path::Path;
use std::process::Command;

/// Compiles `scene.rts` in `folder` to `pack`, with the cache in `folder/cache`; what it said.
///
/// # Panics
/// When it fails.
pub(crate) fn rtc(folder: &Path, cache: &str, pack: &str, args: &[&str]) -> String {
    let output = Command::new(env!("CARGO_BIN_EXE_rtc"))
        .current_dir(folder)
        .env("RTC_CACHE_DIR", folder.join(cache))
        .args(["scene.rts", "-o", pack, "--color", "never"])
        .args(args)
        .output()
        .expect("rtc starts");
    let log = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(0), "{log}");
    log
}
