//! Mixes of materials: both parts come before them in the table. So a kernel finds the material of a point in a bounded
//! number of steps.

use crate::abi::{Material, MaterialKind};
use crate::contents::Contents;
use crate::error::PackError;
use crate::kind::Kind;

use super::broken::element;
use super::rule::index;

/// Every mix.
pub(super) fn check(contents: &Contents<'_>) -> Result<(), PackError> {
    let mixes = contents.materials.iter().enumerate();
    for (at, mix) in mixes.filter(|(_, material)| material.kind == MaterialKind::Mix as u32) {
        let wrong = mix.parts().into_iter().find_map(|part| index(part, (Kind::MATERIAL, at)));
        if let Some(fault) = wrong {
            return Err(element::<Material>(at, ("priority", fault)));
        }
    }
    Ok(())
}
