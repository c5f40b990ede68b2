//! The bytes both binaries agree on: records, container, writer, checked reader, the one `mmap`.
//!
//! Turns slices of records into a file and a file back into slices of records. It keeps the
//! invariant that accessors exist only on a pack whose every rule has been checked. It does not
//! know naga, wgpu or the scene language.

pub mod abi;
