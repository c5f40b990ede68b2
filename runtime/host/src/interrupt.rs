//! Ctrl-C, SIGTERM, SIGHUP → one call; and the way out of a process that hangs.

use std::io;

/// Calls `handle`, on a thread of its own, whenever the process is asked to end: by Ctrl-C, by
/// SIGTERM, and by SIGHUP unless it is ignored, as `nohup` does. To be called once.
///
/// # Errors
/// When there is no thread for it. Then all signals do what they did before.
#[cfg(unix)]
pub fn on_interrupt(mut handle: impl FnMut() + Send + 'static) -> io::Result<()> {
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
    use signal_hook::iterator::Signals;
    use std::sync::mpsc::channel;

    let mut list = vec![SIGINT, SIGTERM];
    if !is_ignored(SIGHUP) {
        list.push(SIGHUP);
    }
    let (ready, is_ready) = channel();
    // The thread comes first: a signal that is caught with nobody to handle it would be lost.
    std::thread::Builder::new().name("interrupts".to_owned()).spawn(move || {
        let mut signals = match Signals::new(list) {
            Ok(signals) => signals,
            Err(error) => return drop(ready.send(Err(error))),
        };
        drop(ready.send(Ok(())));
        signals.forever().for_each(|_| handle());
    })?;
    is_ready.recv().unwrap_or_else(|_| Err(io::Error::other("the thread of signals is gone")))
}

/// Calls `handle`, on a thread of its own, whenever the process is asked to end by Ctrl-C. To be
/// called once.
///
/// # Errors
/// When there is no thread for it.
#[cfg(not(unix))]
pub fn on_interrupt(handle: impl FnMut() + Send + 'static) -> io::Result<()> {
    ctrlc::set_handler(handle).map_err(io::Error::other)
}

/// Whether whoever started this process has it ignore a signal. Where that is not told it counts as
/// ignored: a render that goes on is less of a loss than one that ends.
#[cfg(unix)]
fn is_ignored(signal: i32) -> bool {
    let status = std::fs::read_to_string("/proc/self/status").ok();
    let mask = status.as_deref().and_then(|status| {
        let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"))?;
        u64::from_str_radix(mask.trim(), 16).ok()
    });
    mask.is_none_or(|mask| mask >> (signal - 1) & 1 == 1)
}

/// Ends the process at once, without the functions that drivers have registered for its end: they
/// may wait for threads that hang.
pub fn exit_now(code: u8) -> ! {
    #[cfg(unix)]
    signal_hook::low_level::exit(i32::from(code));
    #[cfg(not(unix))]
    std::process::exit(i32::from(code));
}
