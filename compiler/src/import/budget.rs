//! How much memory the files of one compilation may take together.
//!
//! Whoever is about to take memory because a file says so asks here first. What was asked for is given back when
//! it is dropped; what stays until the pack is written is kept. The sums are those of what files claim, so they do
//! not depend on the allocator; they do on what is read at the same time, which only decides whether a scene at
//! the edge of its budget is refused.

use super::error::{ErrorKind, ImportError};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

/// Memory that the files of a scene may take; clones share it.
#[derive(Clone, Debug, Default)]
pub struct Budget(Option<Arc<Purse>>);

#[derive(Debug)]
struct Purse {
    all: u64,
    left: AtomicU64,
}

impl Budget {
    /// Any amount.
    pub const UNLIMITED: Self = Self(None);

    /// At most so many bytes at a time.
    #[must_use]
    pub fn of(bytes: u64) -> Self {
        Self(Some(Arc::new(Purse { all: bytes, left: AtomicU64::new(bytes) })))
    }

    /// Three quarters of what is free now: trees and the pack need some, too. Any amount where the system does
    /// not say what is free.
    #[must_use]
    pub fn usual() -> Self {
        host::free().map_or(Self::UNLIMITED, |free| Self::of(free / 4 * 3))
    }

    /// Bytes that are left.
    pub(super) fn left(&self) -> u64 {
        self.0.as_ref().map_or(u64::MAX, |purse| purse.left.load(Ordering::Relaxed))
    }

    /// A loan of nothing yet.
    pub(super) fn nothing(&self) -> Loan {
        Loan { budget: self.clone(), bytes: 0, due: 0 }
    }

    /// Takes `bytes` for what is at `place`.
    pub(super) fn take(&self, bytes: u64, place: &str) -> Result<Loan, ImportError> {
        let mut loan = self.nothing();
        loan.more(bytes, place)?;
        Ok(loan)
    }
}

/// Memory that was taken; given back when it is dropped.
#[derive(Debug, Default)]
pub(super) struct Loan {
    budget: Budget,
    bytes: u64,
    /// Bytes that are not asked for yet.
    due: u64,
}

/// Bytes of small things for which the budget is asked at once.
const CHARGE: u64 = 1 << 20;

impl Loan {
    /// Takes `bytes` more for one of many small things. The budget is asked each time that [`CHARGE`] bytes are due.
    pub(super) fn charge(&mut self, bytes: u64, place: &str) -> Result<(), ImportError> {
        self.due += bytes;
        if self.due < CHARGE {
            return Ok(());
        }
        let due = std::mem::take(&mut self.due);
        self.more(due, place)
    }

    /// Takes `bytes` more.
    pub(super) fn more(&mut self, bytes: u64, place: &str) -> Result<(), ImportError> {
        let Some(purse) = &self.budget.0 else { return Ok(()) };
        let less = |left: u64| left.checked_sub(bytes);
        purse.left.fetch_update(Ordering::Relaxed, Ordering::Relaxed, less).map_err(|left| {
            let (need, left, all) = (shown(bytes), shown(left), shown(purse.all));
            let message = format!(
                "it needs {need} more of memory, and {left} of {all} are left: allow more with \
                 --memory, or make the file smaller"
            );
            ImportError::new(ErrorKind::Memory, place, message)
        })?;
        self.bytes = self.bytes.saturating_add(bytes);
        Ok(())
    }

    /// What was taken stays taken.
    pub(super) fn keep(mut self) {
        self.bytes = 0;
    }
}

impl Drop for Loan {
    fn drop(&mut self) {
        if let Some(purse) = &self.budget.0 {
            purse.left.fetch_add(self.bytes, Ordering::Relaxed);
        }
    }
}

/// `n` zeros, or an error that says that there is no memory for what is at `place`. Pages that are not written to
/// take none: a file that claims more than it holds costs little.
pub(super) fn zeroed<T: bytemuck::Zeroable>(n: usize, place: &str) -> Result<Vec<T>, ImportError> {
    let found = bytemuck::allocation::try_zeroed_vec(n);
    found.map_err(|()| no_memory(n.saturating_mul(size_of::<T>()), place))
}

/// The system has no memory for what is at `place`.
pub(super) fn no_memory(bytes: usize, place: &str) -> ImportError {
    let message = format!("there is no memory for {} of it", shown(bytes as u64));
    ImportError::new(ErrorKind::Memory, place, message)
}

fn shown(bytes: u64) -> String {
    match bytes {
        0..1_000_000 => format!("{:.1} kB", bytes as f64 / 1e3),
        1_000_000..1_000_000_000 => format!("{:.1} MB", bytes as f64 / 1e6),
        _ => format!("{:.1} GB", bytes as f64 / 1e9),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_taken_is_given_back_unless_it_is_kept() {
        let budget = Budget::of(3_000_000_000);
        let mut loan = budget.take(1_000_000_000, "a").unwrap();
        loan.more(500_000_000, "a").unwrap();
        let error = budget.clone().take(2_000_000_000, "b.png").unwrap_err();
        let expected = "b.png: it needs 2.0 GB more of memory, and 1.5 GB of 3.0 GB are left: \
                        allow more with --memory, or make the file smaller";
        assert_eq!((error.kind, error.to_string().as_str()), (ErrorKind::Memory, expected));
        drop(loan);
        budget.take(2_000_000_000, "b").unwrap().keep();
        assert_eq!(budget.left(), 1_000_000_000);
        assert!(Budget::UNLIMITED.take(u64::MAX, "c").is_ok());
        assert_eq!(zeroed::<u16>(usize::MAX / 2, "d").unwrap_err().kind, ErrorKind::Memory);
    }
}
