//! The rules of a pack, grouped by what they judge: one variant a rule.
//!
//! Turns a broken rule into words; [`crate::PackError`] says where.

mod bvh;
mod element;
mod header;
mod section;
mod words;

pub use bvh::BvhFault;
pub use element::ElementFault;
pub use header::HeaderFault;
pub use section::SectionFault;
