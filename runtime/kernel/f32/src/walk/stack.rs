//! The children that a ray may still enter.

/// By how much the far end of a box grows; see `box_enter`.
pub const FAR_END: f32 = 1.000_001;

/// A child whose box the ray meets.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Waiting {
    /// Its reference.
    pub(super) child: u32,
    /// Before this distance the ray does not enter the box.
    pub(super) distance: f32,
}

/// Those that wait; the top is the next. It is as long as the tree needs, and used by one ray after another.
#[derive(Debug, Default)]
pub(super) struct Stack {
    entries: Vec<Waiting>,
    n: usize,
}

impl Stack {
    /// With room for `need` children.
    pub(super) fn new(need: usize) -> Self {
        Self { entries: vec![Waiting::default(); need], n: 0 }
    }

    /// For the next ray.
    #[inline(always)]
    pub(super) fn clear(&mut self) {
        self.n = 0;
    }

    /// Pushes a child; says where it lies.
    #[inline(always)]
    pub(super) fn push(&mut self, waiting: Waiting) -> usize {
        let at = self.n;
        // No tree needs more room than was made.
        if let Some(entry) = self.entries.get_mut(at) {
            *entry = waiting;
            self.n += 1;
        }
        at
    }

    /// Pushes a child below those nearer, down to `bottom`.
    #[inline(always)]
    pub(super) fn insert(&mut self, waiting: Waiting, bottom: usize) {
        let mut at = self.push(waiting);
        while at > bottom {
            match self.entries.get_mut(at - 1..=at) {
                Some([below, above]) if below.distance < above.distance => {
                    core::mem::swap(below, above);
                }
                _ => break,
            }
            at -= 1;
        }
    }

    /// The last child that the ray may enter before `t_max`; those above are dropped.
    #[inline(always)]
    pub(super) fn pop(&mut self, t_max: f32) -> Option<u32> {
        loop {
            self.n = self.n.checked_sub(1)?;
            let top = self.entries.get(self.n)?;
            if top.distance <= t_max * FAR_END {
                return Some(top.child);
            }
        }
    }
}
