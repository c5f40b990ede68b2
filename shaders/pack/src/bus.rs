//! Mapped files that lose their bytes → zeros and a flag, in place of the end of the process.
//!
//! Where a file was cut off, or its disk cannot be read, touching the mapping raises SIGBUS, which nothing in Rust
//! can turn into a value. The handler here puts zeros in place of the whole mapping and sets a flag; whoever uses
//! the mapping asks for the flag before anything that was read counts. Signals of any other origin go where they
//! went before. It knows ranges of addresses and nothing of files.
//!
//! # Why it is sound
//!
//! - A handler may interrupt anything, so it takes no lock, allocates nothing and calls `mmap`, `sigaction` and
//!   `raise` only. POSIX lists the latter two as safe to call there; `mmap` is a plain system call on every system
//!   with SIGBUS, and is used in handlers in this way by others (systemd's `sigbus.c`). It changes `errno` only when
//!   it fails, and then the process ends.
//! - Only addresses inside of a registered range are remapped, and a range is registered by [`Guarded::new`] alone,
//!   which asks its caller that nothing but the mapping lies there until it is dropped.
//! - A slot is written by who has taken it, and read by handlers at any time. `version` is odd while it is written,
//!   and a handler takes start and end only if the same even version was there before and after. The slot of the
//!   mapping at fault cannot be written meanwhile: the thread at fault reads the mapping, hence borrows it, hence it
//!   is not being dropped.
//! - The flag is set before the zeros appear, both in the one order that all threads agree on (`SeqCst`; a system
//!   call is no weaker), so whoever has read a zero sees the flag afterwards.

use std::io;

#[cfg(not(unix))]
pub(crate) use elsewhere::Guarded;
#[cfg(unix)]
pub(crate) use handler::Guarded;

/// Most files that are mapped at a time.
#[cfg(unix)]
const SLOTS: usize = 256;

#[cfg(not(unix))]
mod elsewhere {
    /// Nothing to guard: a file that is mapped cannot be cut off here.
    #[derive(Debug)]
    pub(crate) struct Guarded;

    impl Guarded {
        /// A guard of nothing.
        ///
        /// # Safety
        ///
        /// None is asked for; the function is unsafe where there are signals.
        #[expect(unsafe_code, reason = "the same signature everywhere")]
        #[expect(clippy::unnecessary_wraps, reason = "the same signature everywhere")]
        pub(crate) unsafe fn new(_: &[u8]) -> super::io::Result<Self> {
            Ok(Self)
        }

        /// Never.
        #[expect(clippy::unused_self, reason = "the same signature everywhere")]
        pub(crate) fn is_lost(&self) -> bool {
            false
        }
    }
}

#[cfg(unix)]
mod handler {
    #![expect(unsafe_code, reason = "signals and mappings; the proof is above")]

    use std::ptr;
    use std::sync::OnceLock;
    use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering::SeqCst};

    use libc::{c_int, c_void, siginfo_t};

    use super::{SLOTS, io};

    /// A range of addresses that a handler may remap.
    struct Slot {
        taken: AtomicBool,
        /// Odd while the rest is written.
        version: AtomicUsize,
        start: AtomicUsize,
        end: AtomicUsize,
        lost: AtomicBool,
    }

    static ALL: [Slot; SLOTS] = [const { Slot::new() }; SLOTS];

    /// What was done about the signal before.
    static BEFORE: OnceLock<libc::sigaction> = OnceLock::new();

    impl Slot {
        const fn new() -> Self {
            Self {
                taken: AtomicBool::new(false),
                version: AtomicUsize::new(0),
                start: AtomicUsize::new(0),
                end: AtomicUsize::new(0),
                lost: AtomicBool::new(false),
            }
        }

        /// By who has taken the slot.
        fn write(&self, start: usize, end: usize) {
            self.version.fetch_add(1, SeqCst);
            self.start.store(start, SeqCst);
            self.end.store(end, SeqCst);
            self.lost.store(false, SeqCst);
            self.version.fetch_add(1, SeqCst);
        }

        /// The range, unless it is just being written.
        fn range(&self) -> Option<std::ops::Range<usize>> {
            let version = self.version.load(SeqCst);
            let range = self.start.load(SeqCst)..self.end.load(SeqCst);
            let whole = version.is_multiple_of(2) && self.version.load(SeqCst) == version;
            whole.then_some(range)
        }
    }

    /// A mapping whose loss is survived.
    pub(crate) struct Guarded(&'static Slot);

    impl Guarded {
        /// Guards a mapping.
        ///
        /// # Safety
        ///
        /// `mapping` is the whole of a mapping that may be replaced by zeros, page for page, while others read it. It
        /// lives until the guard has been dropped, and nobody reads it any more when that begins.
        pub(crate) unsafe fn new(mapping: &[u8]) -> io::Result<Self> {
            install()?;
            let free =
                |slot: &&Slot| slot.taken.compare_exchange(false, true, SeqCst, SeqCst).is_ok();
            let slot = ALL.iter().find(free).ok_or_else(|| {
                io::Error::other(format!("{SLOTS} files are mapped, and no more can be guarded"))
            })?;
            let start = mapping.as_ptr().addr();
            slot.write(start, start + mapping.len());
            Ok(Self(slot))
        }

        /// Whether bytes could not be read, and are zeros now.
        pub(crate) fn is_lost(&self) -> bool {
            self.0.lost.load(SeqCst)
        }
    }

    impl Drop for Guarded {
        fn drop(&mut self) {
            self.0.write(0, 0);
            self.0.taken.store(false, SeqCst);
        }
    }

    impl std::fmt::Debug for Guarded {
        fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
            f.debug_struct("Guarded").field("is_lost", &self.is_lost()).finish_non_exhaustive()
        }
    }

    /// Sets the handler, once for the process.
    fn install() -> io::Result<()> {
        static DONE: OnceLock<Result<(), i32>> = OnceLock::new();
        let done = DONE.get_or_init(|| {
            // SAFETY: all zeros is a valid `sigaction`: the default action, an empty set, no flags.
            let (mut new, mut old): (libc::sigaction, libc::sigaction) =
                unsafe { (std::mem::zeroed(), std::mem::zeroed()) };
            let handler: extern "C" fn(c_int, *mut siginfo_t, *mut c_void) = on_bus_error;
            new.sa_sigaction = handler as usize;
            // On the stack that Rust gives each thread for signals, should its own be the reason.
            new.sa_flags = libc::SA_SIGINFO | libc::SA_ONSTACK;
            // SAFETY: both point to whole values, and the handler does what handlers may do (see the module).
            if unsafe { libc::sigaction(libc::SIGBUS, &raw const new, &raw mut old) } != 0 {
                return Err(io::Error::last_os_error().raw_os_error().unwrap_or(0));
            }
            let _ = BEFORE.set(old);
            Ok(())
        });
        done.map_err(io::Error::from_raw_os_error)
    }

    extern "C" fn on_bus_error(signal: c_int, info: *mut siginfo_t, _context: *mut c_void) {
        // SAFETY: the system passes a whole `siginfo_t` to handlers with SA_SIGINFO, and SIGBUS has an address.
        let (at, code) = unsafe { ((*info).si_addr().addr(), (*info).si_code) };
        let mut survived = false;
        for slot in &ALL {
            let Some(range) = slot.range().filter(|range| range.contains(&at)) else { continue };
            slot.lost.store(true, SeqCst);
            let place = ptr::with_exposed_provenance_mut(range.start);
            let flags = libc::MAP_PRIVATE | libc::MAP_ANON | libc::MAP_FIXED;
            // SAFETY: the range is that of a registered mapping, which may be replaced (see `Guarded::new`) and is
            // alive: the thread that this handler interrupts is reading it.
            let zeros = unsafe { libc::mmap(place, range.len(), libc::PROT_READ, flags, -1, 0) };
            survived = zeros != libc::MAP_FAILED;
        }
        if !survived {
            pass_on(signal, code);
        }
    }

    /// The signal is not about a guarded mapping: what would have been done about it is done.
    fn pass_on(signal: c_int, code: c_int) {
        // SAFETY: as in `install`; the default action.
        let default: libc::sigaction = unsafe { std::mem::zeroed() };
        let before = BEFORE.get().unwrap_or(&default);
        // SAFETY: `before` is a whole value that the system gave, or the default action.
        unsafe {
            libc::sigaction(signal, ptr::from_ref(before), ptr::null_mut());
            // A fault comes again as soon as this returns; what a process sent does not.
            if code <= 0 {
                libc::raise(signal);
            }
        }
    }
}
