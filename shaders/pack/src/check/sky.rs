//! The sky as a light: record, light table and SKYTABLE belong together.
//!
//! The kernel searches the table without looking left or right, and divides by its steps: sums must rise to
//! exactly 1, and the rows' edges must fall from 1 to -1.

use rayon::prelude::*;

use crate::abi::{Light, LightKind, NONE, Sky, sky_table_values};
use crate::contents::Contents;
use crate::error::{PackError, Place};
use crate::fault::ElementFault;
use crate::kind::Kind;

use super::broken::element;

/// Checks everything about it.
pub(super) fn check(contents: &Contents<'_>) -> Result<(), PackError> {
    let is_sky = |light: &Light| light.kind == LightKind::Sky as u32;
    let light = contents.sky.map_or(NONE, |sky| sky.light);
    for (index, found) in contents.lights.iter().enumerate() {
        if is_sky(found) && index != light as usize {
            return Err(element::<Light>(index, ("kind", ElementFault::NotOfSky(light))));
        }
    }
    let Some(sky) = contents.sky.filter(|sky| sky.light != NONE) else {
        return if contents.sky_table.is_empty() {
            Ok(())
        } else {
            let because = ", the sky is no light";
            Err(PackError::Unwanted { kind: Kind::SKYTABLE, because })
        };
    };
    if !is_sky(&contents.lights[light as usize]) {
        let fault = ElementFault::NotASky(light);
        return Err(element::<Sky>(0, ("light", fault)));
    }
    table(sky, contents.sky_table)
}

/// The values have the promised number, and each part has its order.
fn table(sky: &Sky, values: &[f32]) -> Result<(), PackError> {
    let needed = sky_table_values(sky.rows, sky.columns).div_ceil(4) * 4;
    if sky.rows == 0 || sky.columns == 0 || needed != values.len() as u64 {
        return Err(PackError::CountMismatch {
            left: "the number of SKYTABLE values",
            left_count: values.len() as u64,
            right: "what SKY.rows and SKY.columns need",
            right_count: needed,
        });
    }
    let (rows, columns) = (sky.rows as usize, sky.columns as usize);
    sums(values, 0, rows)?;
    edges(values, rows)?;
    let first = 2 * rows + 1;
    let broken = (0..rows)
        .into_par_iter()
        .find_map_first(|row| sums(values, first + row * columns, columns).err());
    broken.map_or(Ok(()), Err)?;
    for (index, value) in values.iter().enumerate().skip(first + rows * columns) {
        if value.to_bits() != 0 {
            return fault(index, ElementFault::Unused(value.to_bits()));
        }
    }
    Ok(())
}

/// `n` values from `first` on rise from 0 or more to exactly 1.
fn sums(values: &[f32], first: usize, n: usize) -> Result<(), PackError> {
    let mut before = 0.0;
    for (index, &found) in (first..).zip(&values[first..first + n]) {
        // Written so that NaN falls.
        let rises = found >= before;
        if !rises {
            return fault(index, ElementFault::Falling { found, before });
        }
        before = found;
    }
    if before.to_bits() == 1.0f32.to_bits() {
        Ok(())
    } else {
        fault(first + n - 1, ElementFault::LastCdf(before))
    }
}

/// The edges of the rows fall from 1 to -1.
fn edges(values: &[f32], rows: usize) -> Result<(), PackError> {
    let edges = &values[rows..=2 * rows];
    for (index, expected) in [(0, 1.0f32), (rows, -1.0)] {
        if edges[index].to_bits() != expected.to_bits() {
            return fault(rows + index, ElementFault::Edge { found: edges[index], expected });
        }
    }
    for (index, pair) in edges.windows(2).enumerate() {
        let (before, found) = (pair[0], pair[1]);
        // Written so that NaN does not fall.
        let falls = found < before;
        if !falls {
            return fault(rows + index + 1, ElementFault::Rising { found, before });
        }
    }
    Ok(())
}

/// The error for value `index`.
fn fault<T>(index: usize, fault: ElementFault) -> Result<T, PackError> {
    let at = Place { kind: Kind::SKYTABLE, index: index / 4, offset: 4 * index };
    Err(PackError::Element { at, field: "value", fault })
}
