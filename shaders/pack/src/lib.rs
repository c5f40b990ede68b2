//! The bytes both binaries agree on: records, container, writer, checked reader, the one `mmap`.
//!
//! Turns slices of records into a file and a file back into slices of records. It keeps the
//! invariant that accessors exist only on a pack whose every rule has been checked. It does not
//! know naga, wgpu or the scene language.
//!
//! ```
//! # fn main() -> Result<(), pack::PackError> {
//! # let (render, camera) = pack::doc_example();
//! let mut writer = pack::PackWriter::new();
//! writer.record(&render).record(&camera).kernel("fn main() {}");
//! let bytes = writer.to_bytes()?;
//!
//! let pack = pack::Pack::from_bytes(bytes)?;
//! assert_eq!(pack.render(), &render);
//! assert!(pack.records::<pack::abi::Triangle>().is_empty());
//! # Ok(())
//! # }
//! ```

// A kind that a match forgets is an error, not what the last arm says.
#![warn(clippy::wildcard_enum_match_arm)]

#[cfg(target_endian = "big")]
compile_error!("packs are little-endian and read in place; this machine is big-endian");

pub mod abi;
mod bus;
pub mod bvh;
mod check;
mod contents;
mod describe;
mod error;
mod fault;
pub mod features;
mod header;
mod kind;
pub mod manifest;
mod map;
mod reader;
mod table;
mod writer;

pub use describe::{SectionRow, describe};
pub use error::{Alteration, PackError, Place};
pub use fault::{BvhFault, ElementFault, HeaderFault, SectionFault};
pub use header::{FORMAT_MAJOR, FORMAT_MINOR, MAGIC, layout_id};
pub use kind::{Kind, MAX_INSTANCES, PackRecord, SECTIONS, SectionSpec};
pub use manifest::Manifest;
pub use map::Witness;
pub use reader::{Checked, Pack, Section, Unchecked};
pub use writer::PackWriter;

/// The smallest settings and camera that pass the checks; for the crate's own examples.
#[doc(hidden)]
#[must_use]
pub fn doc_example() -> (abi::RenderSettings, abi::Camera) {
    let render = abi::RenderSettings {
        image_size: [4, 4],
        samples: 1,
        max_depth: 1,
        root: abi::NONE,
        air: abi::NONE,
        fog: abi::NONE,
        inside: [abi::NONE; 4],
        scale_bits: abi::f64_bits(1.0),
        ..abi::RenderSettings::default()
    };
    let camera = abi::Camera {
        right: [1.0, 0.0, 0.0],
        up: [0.0, 1.0, 0.0],
        forward: [0.0, 0.0, -1.0],
        half_width: 1.0,
        half_height: 1.0,
        focus_distance: 1.0,
        ..abi::Camera::default()
    };
    (render, camera)
}
