//! A URL → the user's browser, if there is one on this machine.

use std::process::{Command, Stdio};

/// Opens a page; false where there is no browser to be opened.
pub(super) fn open(url: &str) -> bool {
    let Some((program, args)) = opener() else { return false };
    let mut command = Command::new(program);
    command.args(args).arg(url);
    let child = command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null()).spawn();
    let Ok(mut child) = child else { return false };
    // Somebody has to wait for it, or it stays as a zombie; it ends with the browser or before.
    let wait = move || child.wait();
    std::thread::Builder::new().name("rtr-browser".to_owned()).spawn(wait).is_ok()
}

#[cfg(target_os = "macos")]
fn opener() -> Option<(&'static str, &'static [&'static str])> {
    Some(("open", &[]))
}

#[cfg(windows)]
fn opener() -> Option<(&'static str, &'static [&'static str])> {
    Some(("rundll32", &["url.dll,FileProtocolHandler"]))
}

/// Without a screen, or at the far end of ssh, a browser would be of no use.
#[cfg(not(any(target_os = "macos", windows)))]
fn opener() -> Option<(&'static str, &'static [&'static str])> {
    let is_set = |name: &str| std::env::var_os(name).is_some_and(|value| !value.is_empty());
    let has_screen = is_set("DISPLAY") || is_set("WAYLAND_DISPLAY");
    (has_screen && !is_set("SSH_CONNECTION")).then_some(("xdg-open", &[]))
}
