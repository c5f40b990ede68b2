//! A run on its way ⇄ a file that it can go on from, bit for bit.
//!
//! The file holds the `f64` sums as they are accumulated, after a whole number of canonical batches:
//! going on adds the same numbers in the same order as a run that was never interrupted. A file that
//! was damaged, or that belongs to another picture, is refused in one line. It knows no clock and no
//! thread; see `saver`.
//!
//! ```text
//!  0   8  magic     89 52 54 52 0D 0A 1A 0A
//!  8   4  version   of this layout
//! 12   4  n_text    bytes of text
//! 16  32  hash      BLAKE3 of all other bytes
//! 48  n_text        lines of a name, a space and a value
//!     24 * pixels   sums of radiance, three f64 a pixel, row by row
//! ```
//! All numbers little-endian.

use crate::film::{Counters, Film};
use crate::job::{Job, MAX_PIXELS};
use crate::output::{Identity, parse_bad, parse_ranges, ranges_text};
use crate::region::{Rect, SampleRange};
use crate::scene::Scene;
use crate::zeros::NoMemory;
use files::{FileError, ShowPath as _};
use pack::abi::BATCH;
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::io;
use std::path::{Path, PathBuf};
use thiserror::Error;

const MAGIC: [u8; 8] = [0x89, b'R', b'T', b'R', 0x0d, 0x0a, 0x1a, 0x0a];
/// Of the layout. Another `rtr` may sum other numbers: its version is a line of the text.
const VERSION: u32 = 1;
const HEADER: usize = 48;
const HASH: std::ops::Range<usize> = 16..HEADER;
/// More than every line can take.
const MAX_TEXT: usize = 64 << 10;
const RTR: &str = env!("CARGO_PKG_VERSION");

/// Everything that a render needs to go on.
#[derive(Clone, Debug, PartialEq)]
pub struct Checkpoint {
    /// What picture it is of.
    pub identity: Identity,
    /// Samples that were asked for.
    pub samples: SampleRange,
    /// What was rendered so far: whole batches, all pixels alike.
    pub film: Film,
    /// Devices that rendered it, in order.
    pub device: String,
    /// Seconds of rendering so far.
    pub seconds: f64,
}

/// A checkpoint that cannot be used.
#[derive(Debug, Error)]
pub enum CheckpointError {
    /// The file cannot be read.
    #[error(transparent)]
    File(#[from] FileError),
    /// The file is larger than the memory.
    #[error(transparent)]
    Memory(#[from] NoMemory),
    /// Not the beginning of a checkpoint, or one of another layout.
    #[error("{} is not a checkpoint of this rtr", path.shown())]
    NotOne {
        /// The file.
        path: PathBuf,
    },
    /// The bytes are not those that were written.
    #[error("{} is damaged: {what}; omit --resume to start afresh", path.shown())]
    Damaged {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        what: &'static str,
    },
    /// It belongs to another run.
    #[error(
        "{} belongs to another run: {what} is {found} there and {expected} here; omit --resume to start afresh",
        path.shown()
    )]
    Foreign {
        /// The file.
        path: PathBuf,
        /// What differs.
        what: &'static str,
        /// Its value in the file.
        found: String,
        /// Its value in this run.
        expected: String,
    },
}

impl Checkpoint {
    /// Whether a film can be gone on from: even, and at the end of a canonical batch.
    #[must_use]
    pub fn can_hold(film: &Film, samples: SampleRange) -> bool {
        let whole = match film.ranges.as_slice() {
            [done] => {
                let ends = done.end == samples.end || done.end.is_multiple_of(BATCH);
                done.start == samples.start && done.end <= samples.end && ends
            }
            _ => false,
        };
        whole && film.is_even()
    }

    /// The checkpoint in `path`; `None` when there is no such file.
    pub fn read(path: &Path) -> Result<Option<Self>, CheckpointError> {
        let most = (HEADER + MAX_TEXT) as u64 + 24 * MAX_PIXELS;
        let bytes = match files::read(path, most) {
            Ok(bytes) => bytes,
            Err(FileError::Io { source, .. }) if source.kind() == io::ErrorKind::NotFound => {
                return Ok(None);
            }
            Err(error) => return Err(error.into()),
        };
        decode(&bytes).map(Some).map_err(|fault| fault.of(path))
    }

    /// Writes it beside `path` and renames: whoever is killed meanwhile leaves the one before.
    pub fn write(&self, path: &Path) -> Result<(), FileError> {
        let text = self.text();
        let sums: &[u8] = bytemuck::cast_slice(&self.film.sums);
        let mut head = Vec::with_capacity(HEADER);
        head.extend(MAGIC);
        head.extend(VERSION.to_le_bytes());
        head.extend(u32::try_from(text.len()).unwrap_or(u32::MAX).to_le_bytes());
        let hash = checksum(&head, text.as_bytes(), sums);
        head.extend(hash.as_bytes());
        files::write(path, |out| {
            out.write_all(&head)?;
            out.write_all(text.as_bytes())?;
            out.write_all(sums)
        })
    }

    /// Whether it is of this run; the first thing that differs is the error.
    pub fn check(&self, path: &Path, scene: &Scene, job: &Job) -> Result<(), CheckpointError> {
        let found = self.identity.rows().into_iter().chain([row(self.samples)]);
        let expected = Identity::of(scene, job).rows().into_iter().chain([row(job.samples)]);
        for ((what, found), (_, expected)) in found.zip(expected) {
            if found != expected {
                let path = path.to_owned();
                return Err(CheckpointError::Foreign { path, what, found, expected });
            }
        }
        Ok(())
    }

    fn text(&self) -> String {
        let Counters { rays, bad, first_bad, depth, overflows, leaks, removed } =
            self.film.counters;
        let mut text = format!("rtr {RTR}\n");
        let mut line = |name: &str, value: &str| {
            // Writing to a string cannot fail.
            let _ = writeln!(text, "{name} {}", value.replace('\n', " "));
        };
        for (name, value) in self.identity.rows() {
            line(name, &value);
        }
        line("samples", &self.samples.to_string());
        line("done", &ranges_text(&self.film.ranges));
        line("device", &self.device);
        line("seconds", &self.seconds.to_string());
        for (name, n) in [
            ("rays", rays),
            ("bad", bad),
            ("depth", u64::from(depth)),
            ("overflows", overflows),
            ("leaks", leaks),
        ] {
            line(name, &n.to_string());
        }
        if removed > 0.0 {
            line("removed", &removed.to_string());
        }
        if let Some(first) = first_bad {
            line("first_bad", &first.to_string());
        }
        text
    }
}

fn row(samples: SampleRange) -> (&'static str, String) {
    ("samples", samples.to_string())
}

fn checksum(head: &[u8], text: &[u8], sums: &[u8]) -> blake3::Hash {
    let mut hasher = blake3::Hasher::new();
    hasher.update(&head[..HASH.start]).update(text).update(sums);
    hasher.finalize()
}

/// What is wrong with the bytes.
enum Fault {
    NotOne,
    Damaged(&'static str),
    Rtr(String),
    Memory(NoMemory),
}

impl Fault {
    fn of(self, path: &Path) -> CheckpointError {
        let path = path.to_owned();
        match self {
            Self::Memory(error) => error.into(),
            Self::NotOne => CheckpointError::NotOne { path },
            Self::Damaged(what) => CheckpointError::Damaged { path, what },
            Self::Rtr(found) => {
                let (what, expected) = ("the version of rtr", RTR.to_owned());
                CheckpointError::Foreign { path, what, found, expected }
            }
        }
    }
}

fn decode(bytes: &[u8]) -> Result<Checkpoint, Fault> {
    let Some((head, rest)) = bytes.split_first_chunk::<HEADER>() else {
        let cut = bytes.len() >= MAGIC.len() && bytes[..MAGIC.len()] == MAGIC;
        return Err(if cut { Fault::Damaged("it is cut short") } else { Fault::NotOne });
    };
    let word = |at: usize| u32::from_le_bytes([head[at], head[at + 1], head[at + 2], head[at + 3]]);
    if head[..8] != MAGIC || word(8) != VERSION {
        return Err(Fault::NotOne);
    }
    let n_text = usize::try_from(word(12)).unwrap_or(usize::MAX);
    let Some((text, sums)) = rest.split_at_checked(n_text) else {
        return Err(Fault::Damaged("it is cut short"));
    };
    if checksum(head, text, sums).as_bytes()[..] != head[HASH] {
        return Err(Fault::Damaged("its checksum is wrong"));
    }
    let lines: BTreeMap<&str, &str> = std::str::from_utf8(text)
        .map_err(|_| Fault::Damaged("its text is none"))?
        .lines()
        .filter_map(|line| line.split_once(' '))
        .collect();
    match lines.get("rtr") {
        Some(&RTR) => {}
        found => return Err(Fault::Rtr((*found.unwrap_or(&"none")).to_owned())),
    }
    let parsed = parse(&lines, sums).ok_or(Fault::Damaged("its text is malformed"))?;
    parsed.map_err(Fault::Memory)
}

/// `None`: malformed.
fn parse(lines: &BTreeMap<&str, &str>, bytes: &[u8]) -> Option<Result<Checkpoint, NoMemory>> {
    let number = |name: &str| lines.get(name)?.parse::<u64>().ok();
    let small = |name: &str| lines.get(name)?.parse::<u32>().ok();
    let numbers = |name: &str, by: char| -> Option<Vec<u32>> {
        lines.get(name)?.split(by).map(|part| part.parse().ok()).collect()
    };
    let image_size: [u32; 2] = numbers("size", 'x')?.try_into().ok()?;
    let [x, y, w, h] = numbers("crop", ',')?.try_into().ok()?;
    let crop = Rect { x, y, w, h };
    let samples = *parse_ranges(lines.get("samples")?)?.first()?;
    let fits = crop.fits(image_size) && crop.pixels() <= MAX_PIXELS;
    if !fits || bytes.len() as u64 != 24 * crop.pixels() {
        return None;
    }
    let mut film = match Film::try_new(image_size, crop) {
        Ok(film) => film,
        Err(error) => return Some(Err(error)),
    };
    film.ranges = parse_ranges(lines.get("done")?)?;
    film.counts.fill(film.ranges.iter().map(|range| range.count()).sum());
    bytemuck::cast_slice_mut(&mut film.sums).copy_from_slice(bytes);
    film.counters = Counters {
        rays: number("rays")?,
        bad: number("bad")?,
        first_bad: lines.get("first_bad").and_then(|text| parse_bad(text)),
        depth: small("depth")?,
        overflows: number("overflows")?,
        leaks: number("leaks")?,
        removed: lines.get("removed").map_or(Some(0.0), |text| text.parse().ok())?,
    };
    let identity = Identity {
        render_id: (*lines.get("render_id")?).to_owned(),
        image_size,
        crop,
        seed: small("seed")?,
        estimator: small("estimator")?,
        clamp_indirect: (*lines.get("clamp_indirect").unwrap_or(&"off")).to_owned(),
        precision: (*lines.get("precision")?).to_owned(),
    };
    let device = (*lines.get("device")?).to_owned();
    let seconds = lines.get("seconds")?.parse().ok().filter(|s: &f64| *s >= 0.0)?;
    let seconds = f64::min(seconds, 1e12);
    Checkpoint::can_hold(&film, samples).then_some(Ok(Checkpoint {
        identity,
        samples,
        film,
        device,
        seconds,
    }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::BadSample;

    fn checkpoint() -> Checkpoint {
        let crop = Rect { x: 1, y: 2, w: 5, h: 3 };
        let mut film = Film::new([9, 8], crop);
        film.ranges = vec![SampleRange { start: 3, end: 32 }];
        film.counts.fill(29);
        for (i, sum) in film.sums.iter_mut().enumerate() {
            // Numbers that f32 cannot hold, infinities and NaN among them.
            *sum = [1.0 / (i as f64 + 3.0), [f64::INFINITY, f64::NAN][i % 2], -0.0];
        }
        let first_bad = Some(BadSample { x: 2, y: 3, sample: 4 });
        film.counters = Counters {
            rays: 1 << 40,
            bad: 2,
            first_bad,
            depth: 7,
            overflows: 1,
            leaks: 5,
            removed: 0.1,
        };
        let identity = Identity {
            render_id: "00ff".to_owned(),
            image_size: [9, 8],
            crop,
            seed: u32::MAX,
            estimator: 1,
            clamp_indirect: "2.5".to_owned(),
            precision: "f64".to_owned(),
        };
        let samples = SampleRange { start: 3, end: 100 };
        let (device, seconds) = ("CPU kernel (f64, 2 threads)".to_owned(), 1.25);
        Checkpoint { identity, samples, film, device, seconds }
    }

    fn bytes() -> Vec<u8> {
        let file = tempfile::NamedTempFile::new().unwrap();
        checkpoint().write(file.path()).unwrap();
        std::fs::read(file.path()).unwrap()
    }

    /// As `bytes`, with another text and the checksum renewed.
    fn forged(change: impl Fn(&str) -> String) -> Vec<u8> {
        let bytes = bytes();
        let n_text = u32::from_le_bytes(bytes[12..16].try_into().unwrap()) as usize;
        let (head, rest) = bytes.split_at(HEADER);
        let (text, sums) = rest.split_at(n_text);
        let text = change(std::str::from_utf8(text).unwrap());
        let mut out = head[..12].to_vec();
        out.extend(u32::try_from(text.len()).unwrap().to_le_bytes());
        let hash = checksum(&out, text.as_bytes(), sums);
        out.extend(hash.as_bytes());
        out.extend(text.as_bytes());
        out.extend(sums);
        out
    }

    #[test]
    fn what_was_written_is_read_bit_for_bit() {
        let read = decode(&bytes()).ok().unwrap();
        let written = checkpoint();
        let bits = |c: &Checkpoint| -> Vec<u64> {
            c.film.sums.iter().flatten().map(|x| x.to_bits()).collect()
        };
        assert_eq!(bits(&read), bits(&written));
        assert_eq!(
            (&read.film.counts, &read.film.ranges),
            (&written.film.counts, &written.film.ranges)
        );
        assert_eq!(read.film.counters, written.film.counters);
        assert_eq!((read.identity, read.samples), (written.identity, written.samples));
        assert_eq!((read.device, read.seconds), (written.device, written.seconds));
    }

    #[test]
    fn every_flipped_bit_and_every_other_length_is_noticed() {
        let good = bytes();
        for bit in 0..8 * good.len() {
            let mut bytes = good.clone();
            bytes[bit / 8] ^= 1 << (bit % 8);
            assert!(decode(&bytes).is_err(), "bit {bit}");
        }
        for len in 0..good.len() {
            assert!(decode(&good[..len]).is_err(), "length {len}");
        }
        assert!(decode(&[good.as_slice(), &[0]].concat()).is_err());
    }

    #[test]
    fn a_text_that_no_rtr_writes_is_refused() {
        assert!(decode(&forged(str::to_owned)).is_ok());
        for (from, to) in [
            ("done 3..32", "done 3..31"),
            ("done 3..32", "done 3..112"),
            ("done 3..32", "done 3..16,32..48"),
            ("done 3..32", "done "),
            ("samples 3..100", "samples 0..100"),
            ("crop 1,2,5,3", "crop 5,2,5,3"),
            ("crop 1,2,5,3", "crop 1,2,5,4"),
            ("size 9x8", "size 9"),
            ("seconds 1.25", "seconds -1"),
            ("rays 1", "rays x"),
            ("rtr 0", "rtr 99"),
            ("precision", "decision"),
        ] {
            let text = forged(|text| text.replacen(from, to, 1));
            assert_ne!(text, bytes(), "{from} occurs");
            assert!(decode(&text).is_err(), "{from} -> {to}");
        }
    }
}
