//! Drivers that print → drivers that do not.

/// Starts this program anew without Mesa's device-select layer, where there is no window system. To be
/// called before anything else; it does not come back if it starts.
///
/// That layer asks the window system for its GPU whenever somebody lists the Vulkan adapters, and
/// libwayland then writes `error: XDG_RUNTIME_DIR is invalid or not set` to stderr itself. The layer is
/// turned off by a variable, which must be set before the Vulkan loader is; Rust has no safe way to set
/// one in a process that runs.
#[cfg(target_os = "linux")]
pub fn without_device_select() {
    use std::os::unix::process::CommandExt as _;
    const OFF: &str = "NODEVICE_SELECT";

    let folder = std::env::var_os("XDG_RUNTIME_DIR").unwrap_or_default();
    if folder.as_encoded_bytes().starts_with(b"/") || std::env::var_os(OFF).is_some() {
        return;
    }
    let mut arguments = std::env::args_os();
    if let (Ok(program), Some(name)) = (std::env::current_exe(), arguments.next()) {
        let mut again = std::process::Command::new(program);
        // If it does not start, a line too many is printed.
        drop(again.arg0(name).args(arguments).env(OFF, "1").exec());
    }
}

/// Nothing: the layer is Linux's.
#[cfg(not(target_os = "linux"))]
pub fn without_device_select() {}
