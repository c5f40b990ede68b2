//! Single bits of packs flipped → what `rtr`, the program itself, makes of them.
//!
//! Every bit of header and table, and bits anywhere, each in a file of its own that is rendered as a user would. A
//! pack must be refused in one line, or give the same picture; another picture, a crash or a run without end is a
//! failure of ours. Which bits are chosen depends on nothing but their number.

use std::collections::BTreeMap;
use std::error::Error;
use std::fmt::Write as _;
use std::fs::File;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use rayon::prelude::*;
use runtime::Film;
use runtime::output::read_exr;

use crate::scene;
use crate::statistics::stream::Stream;

/// Examples that have, together, every large section: meshes with textures, spheres, instances, light trees.
const SCENES: [&str; 3] = ["gltf", "materials", "mesh"];
/// A run that takes longer has no end.
const PATIENCE: Duration = Duration::from_mins(1);
/// Bytes of a header, and of a row of the table after it.
const HEAD: (usize, usize) = (128, 64);

/// What became of a pack.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Outcome {
    /// A rule of the format is broken.
    RefusedByRule,
    /// The hash of a section is another.
    RefusedByHash,
    /// The bit has no meaning for the picture.
    SamePicture,
    /// Silently wrong.
    OtherPicture,
    /// Killed, panicked, or an exit code of another kind.
    Crash,
    /// Still running after a minute.
    Endless,
}

impl Outcome {
    const ALL: [(Self, &'static str); 6] = [
        (Self::RefusedByRule, "refused: a rule"),
        (Self::RefusedByHash, "refused: a hash"),
        (Self::SamePicture, "same picture"),
        (Self::OtherPicture, "another picture"),
        (Self::Crash, "crash"),
        (Self::Endless, "endless"),
    ];

    /// Whether it may be.
    #[must_use]
    pub fn is_fine(self) -> bool {
        self <= Self::SamePicture
    }
}

/// Flips `tries` bits of packs and renders each. Gives a table, and how many outcomes must not be.
///
/// # Errors
/// When the program is not there or files cannot be written.
pub fn table(program: &Path, tries: usize) -> Result<(String, usize), Box<dyn Error>> {
    let folder = tempfile::tempdir()?;
    let mut text = "| scene | pack | place | bits |".to_owned();
    for (_, name) in Outcome::ALL {
        let _ = write!(text, " {name} |");
    }
    let _ = write!(text, "\n|{}", "---|".repeat(4 + Outcome::ALL.len()));
    let mut wrong = 0;
    for name in SCENES {
        let example = scenes::catalog::find(name).ok_or("there is no such example")?;
        let bytes = scene::bytes(&scene::example(example, &[]));
        let subject = Subject::new(program, folder.path(), &bytes)?;
        let n_rows = pack::Pack::from_bytes(bytes.clone())?.sections().count();
        let head = (HEAD.0 + HEAD.1 * n_rows) * 8;
        let share = tries / SCENES.len();
        let mut random = Stream::new(1, 0);
        let mut pick = |from: usize, n: usize| -> Vec<usize> {
            (0..n).map(|_| from + random.index(bytes.len() * 8 - from)).collect()
        };
        // Half of the tries are in the few bytes that say what the others mean.
        let step = (head * 2 / share.max(1)).max(1);
        let in_head: Vec<usize> = (0..head).step_by(step).collect();
        let anywhere = pick(head, share.saturating_sub(in_head.len()));
        for (place, bits) in [("header, table", in_head), ("anywhere else", anywhere)] {
            let outcomes = bits
                .par_iter()
                .map(|bit| subject.flip(*bit).map_err(|error| error.to_string()))
                .collect::<Result<Vec<_>, _>>()?;
            let mut counts: BTreeMap<Outcome, usize> = BTreeMap::new();
            for outcome in outcomes {
                *counts.entry(outcome).or_default() += 1;
            }
            let _ =
                write!(text, "\n| `{name}` | {} bytes | {place} | {} |", bytes.len(), bits.len());
            for (outcome, _) in Outcome::ALL {
                let count = counts.get(&outcome).copied().unwrap_or(0);
                let _ = write!(text, " {count} |");
                wrong += if outcome.is_fine() { 0 } else { count };
            }
        }
    }
    Ok((text, wrong))
}

/// A pack and its picture.
struct Subject<'a> {
    program: &'a Path,
    folder: &'a Path,
    bytes: &'a [u8],
    film: Film,
}

impl<'a> Subject<'a> {
    fn new(program: &'a Path, folder: &'a Path, bytes: &'a [u8]) -> Result<Self, Box<dyn Error>> {
        let film = Film::new([1; 2], runtime::Rect::whole([1; 2]));
        let mut subject = Self { program, folder, bytes, film };
        let (outcome, film) = subject.render("whole", bytes)?;
        subject.film = film.ok_or(format!("the pack itself: {outcome:?}"))?;
        Ok(subject)
    }

    fn flip(&self, bit: usize) -> Result<Outcome, Box<dyn Error>> {
        let mut bytes = self.bytes.to_vec();
        bytes[bit / 8] ^= 1 << (bit % 8);
        Ok(self.render(&bit.to_string(), &bytes)?.0)
    }

    /// Renders a pack; what became of it, and the picture if there is one.
    fn render(&self, name: &str, bytes: &[u8]) -> Result<(Outcome, Option<Film>), Box<dyn Error>> {
        let file = |extension: &str| self.folder.join(format!("{name}.{extension}"));
        let (pack, picture, log) = (file("pack"), file("exr"), file("log"));
        std::fs::write(&pack, bytes)?;
        let mut child = Command::new(self.program)
            .arg(&pack)
            .arg("-o")
            .arg(&picture)
            .args(["--device", "cpu", "--threads", "1", "--size", "32x18", "--spp", "1", "--quiet"])
            .args(["--checkpoint-every", "1ms"])
            .stdout(Stdio::null())
            .stderr(File::create(&log)?)
            .spawn()?;
        let began = Instant::now();
        let status = loop {
            match child.try_wait()? {
                Some(status) => break Some(status),
                None if began.elapsed() > PATIENCE => break None,
                None => std::thread::sleep(Duration::from_millis(1)),
            }
        };
        if status.is_none() {
            child.kill()?;
            child.wait()?;
        }
        let said = std::fs::read_to_string(&log)?;
        let film = picture.is_file().then(|| read_exr(&picture)).transpose()?.map(|p| p.film);
        let outcome = match (status.map(|status| status.code()), &film) {
            (None, _) => Outcome::Endless,
            (Some(Some(0)), Some(film)) if name == "whole" || *film == self.film => {
                Outcome::SamePicture
            }
            (Some(Some(0)), Some(_)) => Outcome::OtherPicture,
            // One line, and no picture.
            (Some(Some(3)), None) if said.lines().count() == 1 => {
                if said.contains("do not match their hash") {
                    Outcome::RefusedByHash
                } else {
                    Outcome::RefusedByRule
                }
            }
            _ => Outcome::Crash,
        };
        for path in [pack, picture, log] {
            match std::fs::remove_file(&path) {
                Err(error) if error.kind() != std::io::ErrorKind::NotFound => {
                    return Err(error.into());
                }
                _ => {}
            }
        }
        Ok((outcome, film))
    }
}
