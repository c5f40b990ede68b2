//! A stack of known size for what goes down into a scene, whatever the stack of the caller is.
//!
//! Expressions are at most `syntax::MAX_HEIGHT` high and values refer to each other through at most as
//! many fields, so this much is enough; a text that is nested deeper is refused with E0109.

use std::cell::Cell;
use std::io;

/// Stack of the thread, in bytes: 256 levels of 9 rules, each of some 4 KiB in an unoptimised build, take
/// 9 MiB.
const STACK_BYTES: usize = 16 << 20;

thread_local! {
    static IS_LARGE: Cell<bool> = const { Cell::new(false) };
}

/// Runs something on a thread with enough stack to read and check any scene: on this one if it was
/// started here.
///
/// # Errors
/// When the system has no room for another thread.
pub fn on_large_stack<T: Send>(run: impl FnOnce() -> T + Send) -> io::Result<T> {
    if IS_LARGE.get() {
        return Ok(run());
    }
    std::thread::scope(|scope| {
        let thread = std::thread::Builder::new().stack_size(STACK_BYTES);
        let thread = thread.spawn_scoped(scope, || {
            IS_LARGE.set(true);
            run()
        })?;
        match thread.join() {
            Ok(result) => Ok(result),
            Err(panic) => std::panic::resume_unwind(panic),
        }
    })
}
