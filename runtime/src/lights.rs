//! Film + manifest → the light of each light group in a row of pixels.
//!
//! Lights and things have the group that the scene gives them. The sky is in `sky` if it names none, media and
//! everything else in `rest`. It does not know files.

mod owner;
mod row;
mod walk;

pub(crate) use self::owner::LightGroups;
pub(crate) use self::row::Row;

use crate::job::Precision;
use crate::layers::Group;

/// Adds the light of each group in the pixels of the row.
pub(crate) fn add(lights: &LightGroups<'_>, row: &Row<'_>, groups: &mut [Group]) {
    match row.job.precision {
        Precision::F32 => walk::single::add(lights, row, groups),
        Precision::F64 => walk::double::add(lights, row, groups),
    }
}
