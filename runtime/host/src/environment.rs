//! Variables that libraries read before `main` → this program, restarted with them where they matter.
//!
//! They must be set before the Vulkan loader and `malloc` look at them; Rust has no safe way to set one in a process
//! that runs.

/// What a program uses that listens to variables.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Uses {
    /// Memory only.
    Memory,
    /// Memory and graphics drivers.
    Drivers,
}

/// Restarts this program where a variable that it needs is missing; else does nothing. To be called before
/// anything else; it does not come back if the program starts.
///
/// - Mesa's device-select layer asks the window system for its GPU whenever somebody lists the Vulkan adapters, and
///   libwayland then writes `error: XDG_RUNTIME_DIR is invalid or not set` to stderr itself: without a window system
///   the layer is turned off.
/// - `malloc` of glibc sets 64 MiB of address space aside for each thread. Where that is limited (`ulimit -v`), threads
///   would soon find none for their stacks: they share what is set aside.
#[cfg(target_os = "linux")]
pub fn prepare(uses: Uses) {
    use std::os::unix::process::CommandExt as _;

    let unset = |name: &str| std::env::var_os(name).is_none();
    let folder = std::env::var_os("XDG_RUNTIME_DIR").unwrap_or_default();
    let no_window = !folder.as_encoded_bytes().starts_with(b"/");
    let wanted = [
        ("NODEVICE_SELECT", uses == Uses::Drivers && no_window),
        ("MALLOC_ARENA_MAX", crate::room().is_some()),
    ];
    let missing: Vec<&str> = wanted
        .iter()
        .filter(|(name, wanted)| *wanted && unset(name))
        .map(|(name, _)| *name)
        .collect();
    let mut arguments = std::env::args_os();
    if missing.is_empty() {
        return;
    }
    if let (Ok(program), Some(name)) = (std::env::current_exe(), arguments.next()) {
        let mut again = std::process::Command::new(program);
        again.arg0(name).args(arguments).envs(missing.into_iter().map(|name| (name, "1")));
        // If it does not start, this one goes on as it is.
        drop(again.exec());
    }
}

/// Nothing: the variables are Linux's.
#[cfg(not(target_os = "linux"))]
pub fn prepare(_uses: Uses) {}
