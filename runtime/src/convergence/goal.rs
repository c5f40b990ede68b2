//! What is wanted of a run that is measured: when the picture is good enough, and what it converges to.

use super::reference::Reference;
use std::fmt;
use std::str::FromStr;
use std::sync::Arc;

/// What is wanted of a run that is measured.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Measure {
    /// When the picture is good enough; `None`: only samples and time end the run.
    pub goal: Option<Goal>,
    /// Whether parts of the picture whose error is small already get fewer samples.
    pub adaptive: bool,
    /// What the picture converges to, where that is known.
    pub reference: Option<Arc<Reference>>,
}

/// Which error is to become small.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// `Noise::rel`, with its standard error.
    Rel,
    /// `Noise::p95`.
    P95,
}

/// When a picture is good enough: from 64 samples on, when the quantity is at most `limit`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Goal {
    /// What is looked at.
    pub quantity: Quantity,
    /// How large it may be.
    pub limit: f64,
}

impl fmt::Display for Goal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = match self.quantity {
            Quantity::Rel => "rel",
            Quantity::P95 => "p95",
        };
        write!(f, "{name} {}", self.limit)
    }
}

impl FromStr for Goal {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (quantity, number) = match text.split_once(':') {
            None => (Quantity::Rel, text),
            Some(("rel", number)) => (Quantity::Rel, number),
            Some(("p95", number)) => (Quantity::P95, number),
            Some(_) => return Err("write it as 0.01 or p95:0.05".to_owned()),
        };
        match number.parse() {
            Ok(limit) if limit > 0.0 && limit < f64::INFINITY => Ok(Self { quantity, limit }),
            _ => Err("write it as 0.01 or p95:0.05".to_owned()),
        }
    }
}
