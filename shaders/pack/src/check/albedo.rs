//! Tables of directional albedo: there are those that materials read, and their values are numbers of their size.

use crate::abi::albedo_words;
use crate::contents::Contents;
use crate::error::{PackError, Place};
use crate::fault::ElementFault;
use crate::kind::Kind;

/// Largest value: shares are at most 1, ratios of shares 2.
const MOST: f32 = 2.0;

/// Checks number and values.
pub(super) fn check(contents: &Contents<'_>) -> Result<(), PackError> {
    let (words, values) = (albedo_words(contents.materials), contents.albedo);
    if words == 0 && !values.is_empty() {
        let because = ", no material reads a table";
        return Err(PackError::Unwanted { kind: Kind::ALBEDO, because });
    }
    if values.len() != 4 * words {
        return Err(PackError::CountMismatch {
            left: "the number of ALBEDO values",
            left_count: values.len() as u64,
            right: "what the materials read",
            right_count: 4 * words as u64,
        });
    }
    let broken = values.iter().position(|value| value.is_nan() || value.abs() > MOST);
    broken.map_or(Ok(()), |index| {
        let at = Place { kind: Kind::ALBEDO, index: index / 4, offset: 4 * index };
        let expected = "-2 to 2";
        let found = values[index];
        Err(PackError::Element {
            at,
            field: "value",
            fault: ElementFault::Range { found, expected },
        })
    })
}
