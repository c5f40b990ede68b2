//! Mixes of materials: both parts come before them in the table. So a kernel finds the material of a point in a bounded
//! number of steps.

use crate::abi::{Material, MaterialKind};
use crate::contents::Contents;
use crate::error::PackError;
use crate::fault::ElementFault;

use super::broken::element;

/// Every mix.
pub(super) fn check(contents: &Contents<'_>) -> Result<(), PackError> {
    let mixes = contents.materials.iter().enumerate();
    for (at, mix) in mixes.filter(|(_, material)| material.kind == MaterialKind::Mix as u32) {
        let wrong = mix.parts().into_iter().find(|part| *part as usize >= at);
        if let Some(found) = wrong {
            let fault = ElementFault::NotBefore { found };
            return Err(element::<Material>(at, ("priority", fault)));
        }
    }
    Ok(())
}
