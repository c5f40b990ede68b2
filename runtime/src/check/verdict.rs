//! A report → stable or not, and why.

use super::report::{PARTED, Report};

/// Share of paths that may go other ways: rays near edges do.
const PATHS: f64 = 0.01;

/// Mean relative difference of pixels that is no cause for worry: what 256 samples of noise 1 would be off by is
/// sixty times as much.
const MEAN: f64 = 1e-3;

/// What the numbers say.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Verdict {
    /// Why the scene is not stable; empty when it is.
    pub reasons: Vec<String>,
}

impl Verdict {
    /// Judges a report. `strict`: also by single pixels, leaks and overflows.
    #[must_use]
    pub fn of(report: &Report, strict: bool) -> Self {
        let mut reasons = Vec::new();
        let mut fails = |fails: bool, reason: String| {
            if fails {
                reasons.push(reason);
            }
        };
        let bad = report.counters.map(|counters| counters.bad);
        fails(
            bad != [0, 0],
            format!("samples are not finite: {} in f32, {} in f64", bad[0], bad[1]),
        );
        let paths = report.share_of_paths();
        fails(paths > PATHS, format!("{:.2} % of the paths part, more than 1 %", 100.0 * paths));
        let mean = report.mean();
        fails(
            mean > MEAN,
            format!("pixels differ by {mean:.1e} in the mean, more than {MEAN:.0e}"),
        );
        let brightness = report.brightness();
        fails(brightness > MEAN, format!("the image's mean differs by {brightness:.1e}"));
        if strict {
            let largest = report.largest();
            fails(
                largest > PARTED,
                format!("a pixel differs by {largest:.1e}, more than {PARTED:.0e}"),
            );
            let of = |n: [u64; 2], what: &str| format!("{what}: {} in f32, {} in f64", n[0], n[1]);
            let leaks = report.counters.map(|counters| counters.leaks);
            fails(leaks != [0, 0], of(leaks, "media leak"));
            let over = report.counters.map(|counters| counters.overflows);
            fails(over != [0, 0], of(over, "too many media inside each other"));
        }
        Self { reasons }
    }

    /// Whether single precision is enough.
    #[must_use]
    pub fn is_stable(&self) -> bool {
        self.reasons.is_empty()
    }
}
