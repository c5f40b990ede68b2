//! Turns a panic of a decoder into `None`, without a word on the terminal.
//!
//! Decoders of other people are fed with files of other people. Where one of them panics on damaged
//! data (the B44 decoder of `exr` does, in builds that check overflow), that must neither end the
//! compiler nor print a backtrace over its messages.

use std::cell::Cell;
use std::panic::{AssertUnwindSafe, catch_unwind, set_hook, take_hook};
use std::sync::Once;

thread_local! {
    /// A panic on this thread is caught by `quietly`.
    static QUIET: Cell<bool> = const { Cell::new(false) };
}

/// Wraps the panic hook once for the process; panics elsewhere are reported as before.
static HOOK: Once = Once::new();

/// The result of `work`, or `None` if it panicked. `work` must stay on this thread.
pub(super) fn quietly<T>(work: impl FnOnce() -> T) -> Option<T> {
    HOOK.call_once(|| {
        let loud = take_hook();
        set_hook(Box::new(move |info| {
            if !QUIET.get() {
                loud(info);
            }
        }));
    });
    let before = QUIET.replace(true);
    // Nothing that `work` has borrowed mutably is looked at after a panic.
    let result = catch_unwind(AssertUnwindSafe(work));
    QUIET.set(before);
    result.ok()
}

#[cfg(test)]
mod tests {
    #[test]
    fn panics_become_none_and_values_pass() {
        assert_eq!(super::quietly(|| 7), Some(7));
        let empty: &[u8] = &[];
        assert_eq!(super::quietly(|| empty[std::hint::black_box(0)]), None);
    }
}
