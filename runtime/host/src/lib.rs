//! A program ⇄ the system it runs on: stack, threads, address space, the wish to stop.
//!
//! What the system does not give is one line and an exit code, never a panic: limits are looked at
//! before they are met, since Rust ends a process that gets no memory. It knows no scenes and no
//! packs.

mod environment;
mod interrupt;
mod limit;
mod memory;

pub use environment::{Uses, prepare};
pub use interrupt::{exit_now, on_interrupt};
pub use limit::{Room, room};
pub use memory::{free, machine};

use std::io::{self, Write as _};
use std::process::ExitCode;
use thiserror::Error;

/// Stack of the thread that a program runs on, in bytes: as usual on Linux, whatever `ulimit -s` says.
const STACK: usize = 8 << 20;
/// Bytes of address space that a program may need before it looks at any input.
const LEAST: u64 = 64 << 20;
/// And for each thread of the pool: its stack, that of a thread that works beside it, and what `malloc`
/// keeps for both.
const LEAST_PER_THREAD: u64 = 8 << 20;
/// A limit of the system stands in the way.
const SYSTEM: u8 = 3;
/// A bug: the program panicked, and said so.
const BUG: u8 = 70;

/// The pool that everything shares does not start.
#[derive(Debug, Error)]
#[error(
    "cannot start {n} threads: {source}; raise the limit (ulimit -u, -v) or give fewer with --threads"
)]
pub struct ThreadsError {
    /// As many as were wanted.
    n: usize,
    /// Why.
    source: io::Error,
}

/// Runs `program` on a stack that no limit of the system makes small, when there is room for it.
pub fn run(program: impl FnOnce() -> ExitCode + Send + 'static) -> ExitCode {
    if let Some(room) = room()
        && room.free < LEAST
    {
        let [limit, free, least] = [room.limit, room.free, LEAST].map(|bytes| bytes >> 20);
        return refuse(&format!(
            "this process may have {limit} MiB of memory (ulimit -v, -d), of which {free} are free: \
             it needs {least}"
        ));
    }
    match std::thread::Builder::new().name("main".to_owned()).stack_size(STACK).spawn(program) {
        Ok(thread) => thread.join().unwrap_or(ExitCode::from(BUG)),
        Err(error) => refuse(&format!(
            "cannot start a thread: {error}; raise the limit of this process (ulimit -u, -v)"
        )),
    }
}

fn refuse(why: &str) -> ExitCode {
    // Nothing is left to do if that cannot be said.
    let _ = writeln!(io::stderr(), "error: {why}");
    ExitCode::from(SYSTEM)
}

/// Threads of a pool where nobody says how many: what `RAYON_NUM_THREADS` says, as everywhere with rayon,
/// or one for each logical CPU.
#[must_use]
pub fn threads() -> usize {
    let said = std::env::var("RAYON_NUM_THREADS").ok().and_then(|n| n.parse().ok());
    let available = || std::thread::available_parallelism().map_or(1, usize::from);
    said.filter(|n| *n > 0).unwrap_or_else(available)
}

/// Starts the pool that everything shares, with `wanted` threads or one for each logical CPU.
/// A pool that is there already stays as it is.
///
/// # Errors
/// When the system does not give them.
pub fn start_pool(wanted: Option<usize>) -> Result<(), ThreadsError> {
    let n = wanted.filter(|n| *n > 0).unwrap_or_else(threads);
    if let Some(room) = room()
        && room.free < LEAST + LEAST_PER_THREAD * n as u64
    {
        let source = io::Error::other(format!("only {} MiB of memory are free", room.free >> 20));
        return Err(ThreadsError { n, source });
    }
    let Err(error) = rayon::ThreadPoolBuilder::new().num_threads(n).build_global() else {
        return Ok(());
    };
    // Only an error of the system has a cause; the other one is that there is a pool.
    match std::error::Error::source(&error).and_then(|cause| cause.downcast_ref::<io::Error>()) {
        None => Ok(()),
        Some(cause) => {
            let source = io::Error::new(cause.kind(), cause.to_string());
            Err(ThreadsError { n, source })
        }
    }
}
