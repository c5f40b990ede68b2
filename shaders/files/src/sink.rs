//! What an output is written to by those who go back in it.

use std::io::{Seek, Write};

/// A writer that can go back.
pub trait Sink: Write + Seek {}

impl<T: Write + Seek> Sink for T {}
