//! Stands by while a pack is used: compares its hashes while rendering has begun, and looks whether its file changes.
//!
//! Turns damage and change into one line and exit code 3, before anything is written. A kernel may run for ever on
//! nodes that nobody has checked; then the process ends from here. It does not know what is made of the pack.

use super::args::Verify;
use super::console::Console;
use super::exit::Exit;
use crate::control::Control;
use pack::{Checked, Pack, PackError, Witness};
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind, set_hook, take_hook};
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, Once, PoisonError};
use std::time::{Duration, Instant};

/// Between two looks at the file.
const POLL: Duration = Duration::from_millis(100);
/// Between two looks whether the first tile is there.
const TICK: Duration = Duration::from_millis(2);
/// After this time the hashes are compared, whether or not there is a tile.
const PATIENCE: Duration = Duration::from_secs(5);
/// What a run that was cancelled has to end by itself.
const GRACE: Duration = Duration::from_secs(1);

/// The system gives no thread.
#[derive(Debug, thiserror::Error)]
#[error("cannot start a thread: {0}; raise the limit of this process (ulimit -u, -v)")]
pub(super) struct ThreadError(pub(super) std::io::Error);

/// What is known of a pack.
enum State {
    /// Its hashes are yet to be compared.
    Pending,
    Good,
    Bad(PackError),
    /// Nobody wants to know any more.
    Abandoned,
}

struct Verdict {
    state: Mutex<State>,
    told: Condvar,
    witness: Option<Witness>,
}

/// Stands by one pack.
pub(super) struct Guard<'a> {
    console: Console,
    path: &'a Path,
    pack: &'a Pack<Checked>,
    verify: Verify,
    verdict: Arc<Verdict>,
}

impl<'a> Guard<'a> {
    /// Compares the hashes at once if that is wanted.
    pub(super) fn new(
        console: &Console,
        path: &'a Path,
        pack: &'a Pack<Checked>,
        verify: Verify,
    ) -> Result<Self, Exit> {
        let state = match verify {
            Verify::First => match pack.verify_hashes() {
                Ok(()) => State::Good,
                Err(error) => return Err(console.fail_about(path, &error, Exit::World)),
            },
            Verify::Background => State::Pending,
            Verify::Off => State::Good,
        };
        let witness = pack.witness();
        witness.iter().for_each(silence_panics);
        let verdict = Verdict { state: Mutex::new(state), told: Condvar::new(), witness };
        Ok(Self { console: console.clone(), path, pack, verify, verdict: Arc::new(verdict) })
    }

    /// Does `work` with the pack, which `control` cancels. Fails, and has said why, unless the pack was good all the
    /// time; so what `work` gives may be written.
    pub(super) fn during<T>(&self, control: &Control, work: impl FnOnce() -> T) -> Result<T, Exit> {
        let over = AtomicBool::new(false);
        let done = std::thread::scope(|scope| {
            let watcher = std::thread::Builder::new().name("rtr-guard".to_owned());
            let watcher = watcher
                .spawn_scoped(scope, || self.watch(control, &over))
                .map_err(|error| self.console.fail(&ThreadError(error), Exit::World))?;
            // It is over for `watch` also when `work` panics. Nothing that it has borrowed is looked at then.
            let done = catch_unwind(AssertUnwindSafe(work));
            over.store(true, Ordering::Release);
            watcher.thread().unpark();
            Ok(done)
        })?;
        self.settle()?;
        done.or_else(|panic| resume_unwind(panic))
    }

    /// What was made of the pack is not wanted.
    pub(super) fn abandon(&self) {
        self.verdict.leave(State::Abandoned);
    }

    /// For `Control::gated`: waits for the verdict; whether what was rendered so far is of a good pack.
    pub(super) fn gate(&self) -> impl Fn() -> bool + Send + Sync + 'static {
        let verdict = Arc::clone(&self.verdict);
        move || verdict.is_good()
    }

    fn watch(&self, control: &Control, over: &AtomicBool) {
        let is_over = || over.load(Ordering::Acquire);
        let verdict = &self.verdict;
        let looked = || verdict.witness.as_ref().map_or(Ok(()), Witness::look);
        if matches!(*verdict.lock(), State::Pending) {
            let began = Instant::now();
            let has_begun = || {
                let progress = control.progress();
                let begun = progress.done > progress.before || control.is_cancelled();
                is_over() || begun || began.elapsed() > PATIENCE
            };
            while !has_begun() && looked().is_ok() {
                std::thread::park_timeout(TICK);
            }
            let given_up = || matches!(*verdict.lock(), State::Abandoned) || looked().is_err();
            match self.pack.verify_hashes_unless(&given_up) {
                Ok(true) => verdict.leave(State::Good),
                Ok(false) => {}
                Err(error) => return self.condemn(error, control, over),
            }
        }
        loop {
            if let Err(error) = looked() {
                return self.condemn(error, control, over);
            }
            if is_over() {
                return;
            }
            std::thread::park_timeout(POLL);
        }
    }

    /// Ends the run; and the process, if the run does not end.
    fn condemn(&self, error: PackError, control: &Control, over: &AtomicBool) {
        *self.verdict.lock() = State::Bad(error);
        self.verdict.told.notify_all();
        control.cancel();
        let until = Instant::now() + GRACE;
        while !over.load(Ordering::Acquire) {
            let left = until.saturating_duration_since(Instant::now());
            if left.is_zero() {
                // Nothing has been written of this pack but checkpoints, each whole and from before.
                let exit = self.said().err().unwrap_or(Exit::World);
                std::process::exit(exit as i32);
            }
            std::thread::park_timeout(left);
        }
    }

    /// Says what is wrong, if that is known.
    fn said(&self) -> Result<(), Exit> {
        match &*self.verdict.lock() {
            State::Bad(error) => Err(self.console.fail_about(self.path, error, Exit::World)),
            _ => Ok(()),
        }
    }

    /// The last word, before anything is written.
    pub(super) fn settle(&self) -> Result<(), Exit> {
        self.said()?;
        let last = match (&*self.verdict.lock(), self.verify, &self.verdict.witness) {
            (State::Abandoned, _, _) | (_, _, None) => Ok(()),
            (_, Verify::Off, Some(witness)) => witness.look_closely(),
            _ => self.pack.settle(),
        };
        last.map_err(|error| self.console.fail_about(self.path, &error, Exit::World))
    }
}

impl Drop for Guard<'_> {
    fn drop(&mut self) {
        if let Some(mine) = &self.verdict.witness {
            witnesses().retain(|witness| !witness.is(mine));
        }
    }
}

impl Verdict {
    fn lock(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Ends the wait for the verdict, unless it is known.
    fn leave(&self, state: State) {
        let mut now = self.lock();
        if matches!(*now, State::Pending) {
            *now = state;
            self.told.notify_all();
        }
    }

    fn is_good(&self) -> bool {
        let pending = |state: &mut State| matches!(state, State::Pending);
        let state = self.told.wait_while(self.lock(), pending);
        let is_good = matches!(*state.unwrap_or_else(PoisonError::into_inner), State::Good);
        is_good && self.witness.as_ref().is_none_or(|witness| witness.look().is_ok())
    }
}

/// Packs that are in use.
fn witnesses() -> MutexGuard<'static, Vec<Witness>> {
    static ALL: Mutex<Vec<Witness>> = Mutex::new(Vec::new());
    ALL.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Code that meets other bytes than were checked may panic. Once a pack has changed that is no bug, and what is to be
/// said is said by its guard.
fn silence_panics(witness: &Witness) {
    static HOOK: Once = Once::new();
    HOOK.call_once(|| {
        let loud = take_hook();
        set_hook(Box::new(move |info| {
            // No code panics while it holds the list.
            if witnesses().iter().all(|witness| witness.look().is_ok()) {
                loud(info);
            }
        }));
    });
    witnesses().push(witness.clone());
}
