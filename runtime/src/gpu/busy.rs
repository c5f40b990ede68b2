//! Submissions that have ended → how long the device was at work, as a line for the user.

use std::time::{Duration, Instant};

/// How long the device was at work, submission after submission.
pub(super) struct Busy {
    began: Instant,
    last_end: Instant,
    total: Duration,
    /// Submissions that the device timed itself, and all.
    timed: [u32; 2],
}

impl Busy {
    pub(super) fn new(now: Instant) -> Self {
        Self { began: now, last_end: now, total: Duration::ZERO, timed: [0; 2] }
    }

    /// A submission has ended; `own` is what the device says that it took. Without that it was busy
    /// from the submission, or from the end of the one before, until now.
    pub(super) fn ended(
        &mut self,
        submitted: Instant,
        now: Instant,
        own: Option<Duration>,
    ) -> Duration {
        let wall = now.saturating_duration_since(submitted.max(self.last_end));
        let time = own.unwrap_or(wall);
        self.last_end = now;
        self.total += time;
        self.timed[0] += u32::from(own.is_some());
        self.timed[1] += 1;
        time
    }

    /// One line for the user; `None` when there was no submission.
    pub(super) fn text(&self, now: Instant) -> Option<String> {
        let [timed, all] = self.timed;
        let run = now.saturating_duration_since(self.began).as_secs_f64();
        let how = if timed == all { "its timestamps" } else { "wall time" };
        let share = 100.0 * self.total.as_secs_f64() / run.max(1e-9);
        (all > 0).then(|| {
            format!("the GPU was busy for {share:.0} % of {run:.2}s, {all} submissions, by {how}")
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_device_that_does_not_say_is_timed_by_the_wall() {
        let ms = Duration::from_millis;
        let start = Instant::now();
        let mut busy = Busy::new(start);
        assert_eq!(busy.text(start), None);
        // Both were submitted at once: the second began when the first ended.
        assert_eq!(busy.ended(start, start + ms(30), None), ms(30));
        assert_eq!(busy.ended(start, start + ms(50), None), ms(20));
        assert_eq!(busy.ended(start + ms(60), start + ms(80), Some(ms(15))), ms(15));
        let text = busy.text(start + ms(100));
        let expected = "the GPU was busy for 65 % of 0.10s, 3 submissions, by wall time";
        assert_eq!(text.as_deref(), Some(expected));
    }
}
