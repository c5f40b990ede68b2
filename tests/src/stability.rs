//! Inputs at the edge of what numbers can hold → what the renderer makes of them, in `f32` and in `f64`.
//!
//! The 53 cases are one table. `tests/extreme.rs` asserts that each row holds; [`page()`] writes them down as
//! `docs/stability.md`. A row that does not hold is kept with its reason ([`Row::known`]), and the test fails
//! as soon as it does hold. What takes minutes or gigabytes is in [`heavy`]: measured by hand, its results are
//! a file. Seeds are fixed, and no row depends on the clock.

#[macro_use]
pub mod tools;
pub mod geometry;
pub mod heavy;
pub mod import;
pub mod lights;
pub mod materials;
pub mod media;
pub mod motion;
pub mod page;
pub mod shading;
pub mod shapes;
pub mod transport;

use crate::picture::Estimate;

pub use self::page::page;

/// One input that is hard.
#[derive(Clone, Copy, Debug)]
pub struct Case {
    /// `X01` to `X53`.
    pub id: &'static str,
    /// What is put in.
    pub input: &'static str,
    /// What must come out, and how near.
    pub must: &'static str,
    /// What came out.
    pub measure: fn() -> Vec<Row>,
}

/// One number, or one fact, of a case.
#[derive(Clone, Debug)]
pub struct Row {
    /// What was measured.
    pub what: String,
    /// What it should be, with the tolerance.
    pub expected: String,
    /// What it is in `f32`.
    pub single: String,
    /// What it is in `f64`; `-` where there is nothing to compute.
    pub double: String,
    /// Whether it is as it should be.
    pub holds: bool,
    /// Why it is not, where that is known and accepted for now.
    pub known: Option<&'static str>,
}

impl Row {
    /// Something that is so or is not.
    #[must_use]
    pub fn fact(what: impl Into<String>, expected: &str, found: &str, holds: bool) -> Self {
        Self {
            what: what.into(),
            expected: expected.to_owned(),
            single: found.to_owned(),
            double: "-".to_owned(),
            holds,
            known: None,
        }
    }

    /// Numbers that are to be within `tolerance` of `expected`.
    #[must_use]
    pub fn near(what: impl Into<String>, expected: f64, tolerance: f64, found: [f64; 2]) -> Self {
        let good = |x: f64| (x - expected).abs() <= tolerance;
        Self {
            what: what.into(),
            expected: format!("{} ± {}", number(expected), number(tolerance)),
            single: number(found[0]),
            double: number(found[1]),
            holds: found.into_iter().all(good),
            known: None,
        }
    }

    /// Numbers that are to be at most `bound`.
    #[must_use]
    pub fn below(what: impl Into<String>, bound: f64, found: [f64; 2]) -> Self {
        Self {
            what: what.into(),
            expected: format!("≤ {}", number(bound)),
            single: number(found[0]),
            double: number(found[1]),
            holds: found.into_iter().all(|x| x <= bound),
            known: None,
        }
    }

    /// How often something happened that must not, out of so many.
    #[must_use]
    pub fn never(what: impl Into<String>, of: u64, found: [u64; 2]) -> Self {
        Self {
            what: what.into(),
            expected: format!("0 of {of}"),
            single: found[0].to_string(),
            double: found[1].to_string(),
            holds: found == [0, 0],
            known: None,
        }
    }

    /// Means that are to be within four standard errors of `expected`, and `rounding` of it.
    #[must_use]
    pub fn mean(
        what: impl Into<String>,
        expected: f64,
        rounding: f64,
        found: [Estimate; 2],
    ) -> Self {
        let good =
            |e: Estimate| (e.mean - expected).abs() <= 4.0 * e.error + rounding * expected.abs();
        let shown = |e: Estimate| format!("{} ± {}", number(e.mean), number(e.error));
        Self {
            what: what.into(),
            expected: format!("{}, 4 se", number(expected)),
            single: shown(found[0]),
            double: shown(found[1]),
            holds: found.into_iter().all(good),
            known: None,
        }
    }

    /// Kept although it does not hold: `why`.
    #[must_use]
    pub fn known(self, why: &'static str) -> Self {
        Self { known: Some(why), ..self }
    }

    /// Nothing, or what is to be said: a row must hold, unless it is known not to.
    ///
    /// # Errors
    /// The row, when it is not as it is said to be.
    pub fn judge(&self) -> Result<(), String> {
        let Self { what, expected, single, double, .. } = self;
        let shown = format!("{what}: expected {expected}, f32 {single}, f64 {double}");
        match (self.holds, self.known) {
            (true, None) | (false, Some(_)) => Ok(()),
            (false, None) => Err(shown),
            (true, Some(why)) => Err(format!("{shown}\n  holds now; take away that {why}")),
        }
    }
}

/// Up to seven digits, short.
#[must_use]
pub fn number(x: f64) -> String {
    if x == 0.0 || (1e-3..1e6).contains(&x.abs()) {
        let text = format!("{x:.7}");
        let text = text.trim_end_matches('0').trim_end_matches('.');
        return if text.is_empty() || text == "-0" { "0".to_owned() } else { text.to_owned() };
    }
    format!("{x:.2e}")
}

/// All of them, in order.
#[must_use]
pub fn cases() -> Vec<Case> {
    let groups = [
        geometry::CASES,
        shapes::CASES,
        import::CASES,
        motion::CASES,
        materials::CASES,
        shading::CASES,
        media::CASES,
        lights::CASES,
        transport::CASES,
    ];
    let mut all = groups.concat();
    all.sort_by_key(|case| case.id);
    all
}
