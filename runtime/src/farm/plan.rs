//! What is to be rendered, into how many tasks it is cut, and what its files are.

use std::time::Duration;

use pack::abi::BATCH;

/// A picture that several machines render.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Plan {
    /// The name of the job and of its files: that of the pack without folder and extension.
    pub name: String,
    /// The pack, as the tasks open it.
    pub pack: String,
    /// Samples a pixel of the whole picture.
    pub samples: u32,
    /// Batches of samples that a task renders, at least 1.
    pub chunk: u32,
    /// Flags of every task beside its samples and its part, such as `--size`, `640x360`.
    pub flags: Vec<String>,
}

impl Plan {
    /// Batches of the whole picture; the last may be shorter than the others.
    #[must_use]
    pub fn batches(&self) -> u32 {
        self.samples.div_ceil(BATCH)
    }

    /// How many tasks there are.
    #[must_use]
    pub fn tasks(&self) -> u32 {
        self.batches().div_ceil(self.chunk)
    }

    /// Samples of a whole task.
    #[must_use]
    pub fn samples_of_task(&self) -> u32 {
        self.chunk * BATCH
    }

    /// The flags as words of a shell.
    #[must_use]
    pub fn flags_text(&self) -> String {
        self.flags.iter().flat_map(|flag| [" ".to_owned(), quoted(flag)]).collect()
    }
}

/// A file of a job.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct JobFile {
    /// Its name.
    pub name: String,
    /// What is in it.
    pub text: String,
}

/// Batches of a task that takes about `wanted`, where the whole frame took `measured` for a batch.
#[must_use]
pub fn chunk_for(measured: Duration, wanted: Duration, batches: u32) -> u32 {
    let fits = wanted.as_secs_f64() / measured.as_secs_f64().max(1e-9);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped")]
    let chunk = fits.round().clamp(1.0, f64::from(batches.max(1))) as u32;
    chunk
}

/// Commands as comments of a script.
pub(super) fn comments(commands: &[String]) -> String {
    commands.iter().flat_map(|line| ["#   ", line, "\n"]).collect()
}

/// A word of a POSIX shell.
pub(super) fn quoted(word: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "-_./:=,%+@".contains(c);
    if !word.is_empty() && word.chars().all(plain) {
        return word.to_owned();
    }
    format!("'{}'", word.replace('\'', "'\\''"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plan(samples: u32, chunk: u32) -> Plan {
        Plan { name: "a".into(), pack: "a.pack".into(), samples, chunk, flags: Vec::new() }
    }

    #[test]
    fn the_last_task_may_be_shorter() {
        assert_eq!((plan(256, 4).batches(), plan(256, 4).tasks()), (16, 4));
        assert_eq!((plan(250, 4).batches(), plan(250, 4).tasks()), (16, 4));
        assert_eq!((plan(1, 4).batches(), plan(1, 4).tasks()), (1, 1));
        assert_eq!(plan(257, 4).tasks(), 5);
    }

    #[test]
    fn a_task_takes_as_long_as_wanted() {
        let seconds = Duration::from_secs;
        assert_eq!(chunk_for(seconds(60), seconds(600), 100), 10);
        assert_eq!(chunk_for(seconds(3600), seconds(600), 100), 1);
        assert_eq!(chunk_for(Duration::ZERO, seconds(600), 100), 100);
    }

    #[test]
    fn words_keep_their_spaces_and_quotes() {
        assert_eq!(quoted("a-b/c.pack"), "a-b/c.pack");
        assert_eq!(quoted("my scene"), "'my scene'");
        assert_eq!(quoted("it's $HOME"), "'it'\\''s $HOME'");
        assert_eq!(quoted(""), "''");
    }
}
