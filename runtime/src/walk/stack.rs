//! The children that a ray may still enter.

use pack::abi::MAX_STACK;

/// By how much the far end of a box grows; see `box_enter`.
pub(super) const FAR_END: f32 = 1.000_001;
/// The deepest stack that a pack may need, and what is written above it.
const LENGTH: usize = MAX_STACK as usize + 4;

/// A child whose box the ray meets.
#[derive(Clone, Copy)]
pub(super) struct Waiting {
    /// Its reference.
    pub(super) child: u32,
    /// Bits of a distance before which the ray does not enter the box.
    pub(super) distance: u32,
}

/// Those that wait; the top is the next.
pub(super) struct Stack {
    entries: [Waiting; LENGTH],
    n: usize,
}

impl Stack {
    #[inline(always)]
    pub(super) fn new() -> Self {
        Self { entries: [Waiting { child: 0, distance: 0 }; LENGTH], n: 0 }
    }

    /// Pushes the first `n` of four, at most 3.
    #[inline(always)]
    pub(super) fn push(&mut self, children: [Waiting; 4], n: usize) {
        // All four are written, so that nothing depends on how many count. No pack that passed its checks
        // needs more room.
        if let Some(room) = self.entries.get_mut(self.n..self.n + 4) {
            room.copy_from_slice(&children);
            self.n += n;
        }
    }

    /// Pushes one.
    #[inline(always)]
    pub(super) fn push_one(&mut self, waiting: Waiting) {
        self.push([waiting; 4], 1);
    }

    /// The last child that the ray may enter before `t_max`; those above are dropped.
    #[inline(always)]
    pub(super) fn pop(&mut self, t_max: f32) -> Option<u32> {
        loop {
            self.n = self.n.checked_sub(1)?;
            let top = self.entries.get(self.n)?;
            if f32::from_bits(top.distance) <= t_max * FAR_END {
                return Some(top.child);
            }
        }
    }
}
