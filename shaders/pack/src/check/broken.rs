//! A broken rule of a record → the error that names its section, its place and the field.

use crate::error::{PackError, Place};
use crate::fault::ElementFault;
use crate::kind::PackRecord;

/// Records a task checks at a time: large enough to hide the cost of a task, small enough to share.
pub(super) const CHUNK: usize = 1 << 14;

/// Field and fault.
pub(super) type Broken = (&'static str, ElementFault);

/// The error for a broken rule of record `index`.
pub(super) fn element<R: PackRecord>(index: usize, (field, fault): Broken) -> PackError {
    let in_record = R::FIELDS.iter().find(|known| known.name == field).map_or(0, |f| f.offset);
    let offset = index * size_of::<R>() + in_record;
    PackError::Element { at: Place { kind: R::KIND, index, offset }, field, fault }
}
