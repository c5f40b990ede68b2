//! How both programs touch the disk: the one way to read an input and to write an output.
//!
//! Turns paths into bytes and bytes into files. It keeps these promises:
//! - An output is there whole or not at all, follows symbolic links, keeps the mode and the owner of the file that
//!   it replaces, and never takes the place of a device, a pipe or a folder ([`write()`]).
//! - An output is no input and no other output ([`Claims`]).
//! - An input is a regular file, of a bounded size ([`open_regular`], [`read`]).
//! - What is shown of a name cannot steer a terminal ([`ShowPath`], [`escape`]).
//!
//! It does not know what the bytes mean.

mod claims;
mod error;
pub mod inject;
mod probe;
mod read;
mod replace;
mod rescue;
mod show;
mod sink;
mod steps;
mod target;
mod write;

pub use claims::{Claims, Clash};
pub use error::FileError;
pub use probe::probe;
pub use read::{open_regular, read, read_open};
pub use rescue::{Saved, save};
pub use show::{ShowPath, Shown, escape, escape_lines};
pub use sink::Sink;
pub use target::is_stream;
pub use write::{write, write_seekable, write_stdout};
