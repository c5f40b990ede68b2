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
    /// The frame in pixels.
    pub size: [u32; 2],
    /// Pixels of the crops that the frame is cut into, as far as it goes; `None`: a task renders the whole frame.
    pub tile: Option<[u32; 2]>,
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
    pub fn tasks(&self) -> u64 {
        u64::from(self.tiles()) * u64::from(self.batches().div_ceil(self.chunk))
    }

    /// How many crops there are.
    #[must_use]
    pub fn tiles(&self) -> u32 {
        let [columns, rows] = self.grid();
        columns * rows
    }

    /// Columns and rows of crops: at most as many as pixels.
    fn grid(&self) -> [u32; 2] {
        let [w, h] = self.tile.unwrap_or(self.size);
        [self.size[0].div_ceil(w.max(1)), self.size[1].div_ceil(h.max(1))]
    }

    /// Lines of a shell that find the samples of `task`, from `first` to `end`, and its crop. Every crop has its first
    /// samples before any has more, so that a picture can be merged early.
    pub(super) fn task_lines(&self, task: &str) -> Vec<String> {
        let step = self.samples_of_task();
        let chunk = match self.tile {
            Some(_) => format!("{task} / {}", self.tiles()),
            None => task.to_owned(),
        };
        let samples = self.samples;
        let mut lines = vec![
            format!("first=$(({chunk} * {step}))"),
            format!("end=$((first + {step}))"),
            format!("if [ \"$end\" -gt {samples} ]; then end={samples}; fi"),
        ];
        lines.extend(self.tile_lines(&format!("{task} % {}", self.tiles())));
        lines
    }

    /// Lines of a shell that find the crop of tile `tile`: `x`, `y`, `w` and `h`. None, where there is only one.
    pub(super) fn tile_lines(&self, tile: &str) -> Vec<String> {
        let Some([tile_width, tile_height]) = self.tile else { return Vec::new() };
        let ([width, height], [columns, _]) = (self.size, self.grid());
        vec![
            format!("tile=$(({tile}))"),
            format!(
                "x=$((tile % {columns} * {tile_width})) y=$((tile / {columns} * {tile_height}))"
            ),
            format!("w=$(({width} - x)) h=$(({height} - y))"),
            format!("if [ \"$w\" -gt {tile_width} ]; then w={tile_width}; fi"),
            format!("if [ \"$h\" -gt {tile_height} ]; then h={tile_height}; fi"),
        ]
    }

    /// The flag of a task that renders the crop which those lines find.
    pub(super) fn crop_flag(&self) -> &'static str {
        if self.tile.is_some() { " --crop \"$x,$y,$w,$h\"" } else { "" }
    }

    /// The flag of the merge that all crops must be there for.
    pub(super) fn frame_flag(&self) -> String {
        let [w, h] = self.size;
        if self.tile.is_some() { format!(" --crop 0,0,{w},{h}") } else { String::new() }
    }

    /// What a task renders, as people read it.
    #[must_use]
    pub fn task_text(&self) -> String {
        let (batches, samples) = (self.chunk, self.samples_of_task());
        match self.tile {
            Some([w, h]) => format!("{batches} batches ({samples} samples) of {w}x{h} pixels"),
            None => format!("{batches} batches ({samples} samples)"),
        }
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

/// Batches of a task that takes about `wanted`, where its pixels took `measured` for a batch.
#[must_use]
pub fn chunk_for(measured: Duration, wanted: Duration, batches: u32) -> u32 {
    let fits = wanted.as_secs_f64() / measured.as_secs_f64().max(1e-9);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped")]
    let chunk = fits.round().clamp(1.0, f64::from(batches.max(1))) as u32;
    chunk
}

/// Lines, each with this much in front of it.
pub(super) fn indented(lines: &[String], indent: &str) -> String {
    lines.iter().flat_map(|line| [indent, line, "\n"]).collect()
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
        let (size, tile) = ([640, 360], None);
        let (name, pack) = ("a".into(), "a.pack".into());
        Plan { name, pack, size, tile, samples, chunk, flags: Vec::new() }
    }

    #[test]
    fn tiles_cover_the_frame() {
        let tiled = |tile| Plan { tile: Some(tile), ..plan(256, 4) };
        assert_eq!((tiled([640, 360]).tiles(), tiled([640, 360]).tasks()), (1, 4));
        assert_eq!((tiled([320, 200]).tiles(), tiled([320, 200]).tasks()), (4, 16));
        assert_eq!(tiled([639, 359]).tiles(), 4);
        assert_eq!(tiled([1, 1]).tasks(), 4 * 640 * 360);
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
