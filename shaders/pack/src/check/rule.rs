//! The rules that a field can be given, one function each.
//!
//! Turns a value into `None` or the fault. No rule knows which record it is used for.

use crate::abi::{NONE, f64_from_bits};
use crate::fault::ElementFault;
use crate::kind::Kind;

type Fault = Option<ElementFault>;

/// A section and its number of elements.
pub(super) type TableRef = (Kind, usize);

/// Values of one or several `f32` lanes.
pub(super) trait Lanes {
    /// The first lane that `bad` says is bad.
    fn first(self, bad: impl Fn(f32) -> bool) -> Option<f32>;
}

impl Lanes for f32 {
    #[inline]
    fn first(self, bad: impl Fn(f32) -> bool) -> Option<f32> {
        bad(self).then_some(self)
    }
}

impl<const N: usize> Lanes for [f32; N] {
    #[inline]
    fn first(self, bad: impl Fn(f32) -> bool) -> Option<f32> {
        // All at once: next to none is bad.
        if !self.iter().fold(false, |any, lane| any | bad(*lane)) {
            return None;
        }
        self.into_iter().find(|lane| bad(*lane))
    }
}

/// Neither NaN nor infinite.
#[inline]
pub(super) fn finite(value: impl Lanes) -> Fault {
    value.first(|lane| !lane.is_finite()).map(ElementFault::NotFinite)
}

#[inline]
fn range(value: impl Lanes, expected: &'static str, inside: impl Fn(f32) -> bool) -> Fault {
    // Written so that NaN is outside.
    let found = value.first(|lane| !inside(lane))?;
    Some(ElementFault::Range { found, expected })
}

/// Finite and not negative: colours, radiances, lengths that may be 0.
#[inline]
pub(super) fn not_negative(value: impl Lanes) -> Fault {
    range(value, "a finite number, 0 or more", |lane| (0.0..f32::INFINITY).contains(&lane))
}

/// Finite and greater than 0.
#[inline]
pub(super) fn positive(value: impl Lanes) -> Fault {
    range(value, "a finite number greater than 0", |lane| lane > 0.0 && lane < f32::INFINITY)
}

/// A step of a grid: as [`positive`], with at most 16 significant bits.
#[inline]
pub(super) fn step(value: [f32; 3]) -> Fault {
    let long = value.into_iter().find(|lane| lane.to_bits() & 0xff != 0);
    positive(value).or_else(|| long.map(ElementFault::Step))
}

/// 0 to 1.
pub(super) fn unit_range(value: impl Lanes) -> Fault {
    range(value, "0 to 1", |lane| (0.0..=1.0).contains(&lane))
}

/// -1 to 1.
pub(super) fn cosine(value: impl Lanes) -> Fault {
    range(value, "-1 to 1", |lane| (-1.0..=1.0).contains(&lane))
}

/// A probability that is not 0.
pub(super) fn probability(value: impl Lanes) -> Fault {
    range(value, "a probability greater than 0, at most 1", |lane| lane > 0.0 && lane <= 1.0)
}

/// A refractive index.
pub(super) fn refractive(value: impl Lanes) -> Fault {
    range(value, "a finite number, 1 or more", |lane| (1.0..f32::INFINITY).contains(&lane))
}

/// A direction of length 1, up to rounding and the three decimals of a careless source.
pub(super) fn direction(value: [f32; 3]) -> Fault {
    let length = value.iter().map(|lane| lane * lane).sum::<f32>().sqrt();
    // Written so that NaN is wrong.
    let unit = (length - 1.0).abs() <= 1e-3;
    (!unit).then_some(ElementFault::NotUnit(length))
}

/// A quaternion of length 1, as `direction`.
pub(super) fn rotation(value: [f32; 4]) -> Fault {
    let length = value.iter().map(|lane| lane * lane).sum::<f32>().sqrt();
    let unit = (length - 1.0).abs() <= 1e-3;
    (!unit).then_some(ElementFault::NotUnit(length))
}

/// An integer in a range.
pub(super) fn count<const N: usize>(value: [u32; N], min: u32, max: u32) -> Fault {
    let found = value.into_iter().find(|found| !(min..=max).contains(found))?;
    Some(ElementFault::Count { found, min, max })
}

/// The tag of a known variant, 0 to `known - 1`.
pub(super) fn tag(found: u32, known: usize) -> Fault {
    let last = u32::try_from(known).ok()?.checked_sub(1)?;
    (found > last).then_some(ElementFault::Tag { found, last })
}

/// Known flag bits only.
pub(super) fn bits(found: u32, known: u32) -> Fault {
    (found & !known != 0).then_some(ElementFault::Bits { found, known })
}

/// Padding, which must be zero so that it can get a meaning later.
#[inline]
pub(super) fn unused(value: u32) -> Fault {
    (value != 0).then_some(ElementFault::Unused(value))
}

/// Halves of a finite `f64`.
pub(super) fn finite64(bits: [u32; 2]) -> Fault {
    let value = f64_from_bits(bits);
    (!value.is_finite()).then_some(ElementFault::NotFinite64(value))
}

/// Halves of a positive, normal `f64` without mantissa.
pub(super) fn power_of_two(bits: [u32; 2]) -> Fault {
    const MANTISSA: u64 = (1 << 52) - 1;
    let value = f64_from_bits(bits);
    let ok = value.is_normal() && value > 0.0 && value.to_bits() & MANTISSA == 0;
    (!ok).then_some(ElementFault::PowerOfTwo(value))
}

/// An index into a table.
#[inline]
pub(super) fn index(found: u32, table: TableRef) -> Fault {
    let (target, count) = table;
    (found as usize >= count).then_some(ElementFault::Index { found, target, count })
}

/// An index into a table, or `NONE`.
#[inline]
pub(super) fn index_or_none(found: u32, table: TableRef) -> Fault {
    if found == NONE { None } else { index(found, table) }
}

/// Indices into a table, or `NONE`.
pub(super) fn indices_or_none(found: [u32; 4], table: TableRef) -> Fault {
    found.into_iter().find_map(|found| index_or_none(found, table))
}

/// A welded vertex id: below three a triangle.
#[inline]
pub(super) fn corner(found: u32, triangles: usize) -> Fault {
    let corners = triangles * 3;
    (found as usize >= corners).then_some(ElementFault::Corner { found, corners })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::abi::f64_bits;

    #[test]
    fn nan_and_infinity_break_every_float_rule() {
        for bad in [f32::NAN, -f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
            let rules: [fn(f32) -> Fault; 7] =
                [finite, not_negative, positive, unit_range, cosine, probability, refractive];
            for rule in rules {
                assert!(rule(bad).is_some(), "{bad}");
            }
            assert!(direction([bad, 0.0, 1.0]).is_some());
            assert!(power_of_two(f64_bits(bad.into())).is_some());
            assert!(finite64(f64_bits(bad.into())).is_some());
        }
    }

    #[test]
    fn limits_are_where_the_texts_say() {
        assert!(not_negative(0.0).is_none() && not_negative(-1e-30).is_some());
        assert!(positive(f32::MIN_POSITIVE).is_none() && positive(0.0).is_some());
        assert!(unit_range(1.0).is_none() && unit_range(1.000_001).is_some());
        assert!(probability(1.0).is_none() && probability(0.0).is_some());
        assert!(refractive(1.0).is_none() && refractive(0.999).is_some());
        assert!(count([1, 7], 1, 7).is_none() && count([1, 8], 1, 7).is_some());
        assert!(tag(2, 3).is_none() && tag(3, 3).is_some());
        assert!(corner(5, 2).is_none() && corner(6, 2).is_some() && corner(0, 0).is_some());
        assert!(power_of_two(f64_bits(0.25)).is_none() && power_of_two(f64_bits(0.3)).is_some());
        assert!(power_of_two(f64_bits(-0.5)).is_some() && power_of_two([1, 0]).is_some());
    }
}
