//! Failures of the disk on demand, so that tests can look at what every one of them leaves behind.
//!
//! Every operation that changes the disk is a step. A test arms the n-th step to fail, for every n until none is
//! left, as `SQLite` tests its file layer. Unarmed, a step costs one load of an atomic.

use std::io;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

/// Steps until the failure; 0: none comes.
static LEFT: AtomicU64 = AtomicU64::new(0);
/// Whether all steps after the failing one fail, too, as on a disk that is full.
static LASTING: AtomicBool = AtomicBool::new(false);
/// Whether the armed failure has come.
static CAME: AtomicBool = AtomicBool::new(false);
/// Who has armed a failure: one test at a time.
static ONE: Mutex<()> = Mutex::new(());

/// How long a failure lasts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lasts {
    /// One step fails; the next ones succeed.
    Once,
    /// That step and all after it fail.
    Always,
}

/// An armed failure; disarmed when dropped.
#[derive(Debug)]
pub struct Armed {
    _one: std::sync::MutexGuard<'static, ()>,
}

/// Makes step `n` from now, counted from 1, fail in this process.
#[must_use]
pub fn arm(n: u64, lasts: Lasts) -> Armed {
    let one = ONE.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
    CAME.store(false, Ordering::SeqCst);
    LASTING.store(lasts == Lasts::Always, Ordering::SeqCst);
    LEFT.store(n, Ordering::SeqCst);
    Armed { _one: one }
}

impl Armed {
    /// Whether the failure has come: false when fewer steps were taken.
    #[must_use]
    pub fn came(&self) -> bool {
        CAME.load(Ordering::SeqCst)
    }
}

impl Drop for Armed {
    fn drop(&mut self) {
        LEFT.store(0, Ordering::SeqCst);
    }
}

/// One step.
pub(crate) fn step() -> io::Result<()> {
    if LEFT.load(Ordering::Relaxed) == 0 {
        return Ok(());
    }
    let next = |left: u64| match left {
        0 => None,
        1 if LASTING.load(Ordering::SeqCst) => Some(1),
        left => Some(left - 1),
    };
    if LEFT.fetch_update(Ordering::SeqCst, Ordering::SeqCst, next) != Ok(1) {
        return Ok(());
    }
    CAME.store(true, Ordering::SeqCst);
    Err(io::Error::other("the disk failed, for a test"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_armed_step_fails_and_no_other() {
        let run = |n, lasts| {
            let armed = arm(n, lasts);
            let failed: Vec<bool> = (0..4).map(|_| step().is_err()).collect();
            (failed, armed.came())
        };
        assert_eq!(run(2, Lasts::Once), (vec![false, true, false, false], true));
        assert_eq!(run(2, Lasts::Always), (vec![false, true, true, true], true));
        assert_eq!(run(5, Lasts::Once), (vec![false; 4], false));
    }
}
