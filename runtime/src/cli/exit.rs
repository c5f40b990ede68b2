//! How a command ended, as an exit code.

/// How a command ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Exit {
    Done = 0,
    NotFinite = 1,
    Usage = 2,
    World = 3,
    Bug = 70,
    Interrupted = 130,
}
