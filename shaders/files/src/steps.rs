//! An open file or stream → a writer that gathers bytes, and of which every write is a step.

use std::io::{self, BufWriter, Seek, SeekFrom, Write};

use crate::inject::step;

/// Bytes that are gathered before the system is asked to write them.
const BUFFER: usize = 1 << 20;

/// A writer of which every write is a step.
pub(crate) struct Steps<W>(pub(crate) W);

impl<W: Write> Write for Steps<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        step()?;
        self.0.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.0.flush()
    }
}

impl<W: Seek> Seek for Steps<W> {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        self.0.seek(to)
    }
}

/// Gathers what is written to `out`.
pub(crate) fn gather<W: Write>(out: W) -> BufWriter<Steps<W>> {
    BufWriter::with_capacity(BUFFER, Steps(out))
}
