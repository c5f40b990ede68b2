//! Source files and places in them: byte ranges become files, lines and columns.
//!
//! Names are kept as the user wrote them, for display only. This crate never opens a file: whoever
//! compiles a scene implements [`Loader`] and adds texts to a [`SourceSet`].

mod span;

pub use span::{FileId, Span};

/// Largest source text that is read, in bytes: some 200,000 declarations. Bulk data belongs in meshes and
/// images.
pub const MAX_FILE_BYTES: usize = 16 << 20;

/// Most bytes that all texts of a scene have together.
pub const MAX_SCENE_BYTES: usize = 32 << 20;

/// A place as people count it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Place {
    /// Line, from 1.
    pub line: u32,
    /// Column in characters, from 1.
    pub column: u32,
    /// Column in UTF-16 units, from 1, as editors' protocols count.
    pub column_utf16: u32,
}

/// One text with its name.
#[derive(Clone, Debug)]
struct Source {
    name: String,
    text: String,
    /// The state before every `STEP` bytes of the text, so that no question reads more than that.
    marks: Vec<Mark>,
    /// Line breaks.
    n_breaks: u32,
}

/// Bytes between two marks.
const STEP: usize = 256;

/// A line and how far it has come.
#[derive(Clone, Copy, Debug)]
struct Mark {
    /// Line, from 1.
    line: u32,
    /// Characters of it so far, without a byte order mark.
    chars: u32,
    /// UTF-16 units of it so far.
    units: u32,
}

impl Mark {
    const FIRST: Mark = Mark { line: 1, chars: 0, units: 0 };

    /// Goes on over a byte of the text.
    fn pass(&mut self, byte: u8) {
        if byte == b'\n' {
            *self = Mark { line: self.line + 1, chars: 0, units: 0 };
        } else if byte & 0xc0 != 0x80 {
            self.chars += 1;
            // Four bytes of UTF-8 are two units.
            self.units += if byte >= 0xf0 { 2 } else { 1 };
        }
    }
}

impl Source {
    fn new(name: String, text: String) -> Source {
        let mut mark = Mark::FIRST;
        let mut marks = Vec::with_capacity(text.len() / STEP + 1);
        for (offset, byte) in text.bytes().enumerate() {
            if offset % STEP == 0 {
                marks.push(mark);
            }
            mark.pass(byte);
        }
        Source { name, text, marks, n_breaks: mark.line - 1 }
    }

    /// The state before a byte.
    fn at(&self, byte: usize) -> Mark {
        let index = (byte / STEP).min(self.marks.len().saturating_sub(1));
        let start = index * STEP;
        let mut mark = self.marks.get(index).copied().unwrap_or(Mark::FIRST);
        let bytes = self.text.as_bytes().get(start..byte).unwrap_or(&[]);
        for byte in bytes {
            mark.pass(*byte);
        }
        mark
    }

    /// First byte of a line, counted from 1; the end of the text behind the last one.
    fn line_start(&self, line: u32) -> usize {
        if line <= 1 {
            return 0;
        }
        if line > self.n_breaks + 1 {
            return self.text.len();
        }
        // The line starts between the last mark of an earlier one and the mark after it.
        let index = self.marks.partition_point(|mark| mark.line < line).saturating_sub(1);
        let mut before = self.marks.get(index).map_or(1, |mark| mark.line);
        let start = index * STEP;
        let bytes = self.text.as_bytes().get(start..).unwrap_or(&[]);
        for (byte, offset) in bytes.iter().zip(start..) {
            before += u32::from(*byte == b'\n');
            if before == line {
                return offset + 1;
            }
        }
        self.text.len()
    }

    fn has_order_mark(&self) -> bool {
        self.text.starts_with('\u{feff}')
    }
}

/// All texts of one run.
#[derive(Clone, Debug, Default)]
pub struct SourceSet {
    files: Vec<Source>,
}

impl SourceSet {
    /// An empty set.
    #[must_use]
    pub fn new() -> SourceSet {
        SourceSet::default()
    }

    /// Adds a text under the name that messages will show.
    pub fn add(&mut self, name: impl Into<String>, text: impl Into<String>) -> FileId {
        let id = FileId(u32::try_from(self.files.len()).unwrap_or(u32::MAX));
        self.files.push(Source::new(name.into(), text.into()));
        id
    }

    /// Every file, in the order of addition.
    pub fn ids(&self) -> impl Iterator<Item = FileId> + '_ {
        (0..self.files.len()).map(|i| FileId(u32::try_from(i).unwrap_or(u32::MAX)))
    }

    /// The name given to `add`; `<unknown>` for a file that is not in the set.
    #[must_use]
    pub fn name(&self, file: FileId) -> &str {
        self.source(file).map_or("<unknown>", |s| &s.name)
    }

    /// The whole text; empty for a file that is not in the set.
    #[must_use]
    pub fn text(&self, file: FileId) -> &str {
        self.source(file).map_or("", |s| &s.text)
    }

    /// The text of a span; empty where the span does not lie on character boundaries of the file.
    #[must_use]
    pub fn slice(&self, span: Span) -> &str {
        self.text(span.file).get(span.start as usize..span.end as usize).unwrap_or("")
    }

    /// Line and column of a byte. Offsets past the end are read as the end.
    #[must_use]
    pub fn place(&self, file: FileId, byte: u32) -> Place {
        let Some(source) = self.source(file) else {
            return Place { line: 1, column: 1, column_utf16: 1 };
        };
        let mut byte = (byte as usize).min(source.text.len());
        while !source.text.is_char_boundary(byte) {
            byte -= 1;
        }
        let Mark { line, chars, units, .. } = source.at(byte);
        let order_mark = u32::from(line == 1 && source.has_order_mark());
        Place {
            line,
            column: chars.saturating_sub(order_mark) + 1,
            column_utf16: units.saturating_sub(order_mark) + 1,
        }
    }

    /// Where a span starts.
    #[must_use]
    pub fn start(&self, span: Span) -> Place {
        self.place(span.file, span.start)
    }

    /// The line of a byte, from 1.
    #[must_use]
    pub fn line_of(&self, file: FileId, byte: u32) -> u32 {
        self.source(file).map_or(1, |s| s.at((byte as usize).min(s.text.len())).line)
    }

    /// Number of lines of a file; a final line break does not start another line.
    #[must_use]
    pub fn n_lines(&self, file: FileId) -> u32 {
        self.source(file).map_or(0, |s| {
            let empty_tail = s.text.is_empty() || s.text.ends_with('\n');
            s.n_breaks + u32::from(!empty_tail)
        })
    }

    /// Where a line is, counted from 1, without its line break and a byte order mark; behind the
    /// last line the end of the text.
    #[must_use]
    pub fn line_span(&self, file: FileId, line: u32) -> Span {
        let Some(source) = self.source(file) else { return Span { file, start: 0, end: 0 } };
        let mut start = source.line_start(line);
        if line <= 1 && source.has_order_mark() {
            start = '\u{feff}'.len_utf8();
        }
        let mut end = source.line_start(line.max(1).saturating_add(1)).max(start);
        let has =
            |end: usize, byte| end > start && source.text.as_bytes().get(end - 1) == Some(&byte);
        if has(end, b'\n') {
            end -= 1;
            if has(end, b'\r') {
                end -= 1;
            }
        }
        Span { file, start: byte_offset(start), end: byte_offset(end) }
    }

    /// The text of a line, counted from 1, without its line break and a byte order mark.
    #[must_use]
    pub fn line(&self, file: FileId, line: u32) -> &str {
        if line == 0 { "" } else { self.slice(self.line_span(file, line)) }
    }

    fn source(&self, file: FileId) -> Option<&Source> {
        self.files.get(file.0 as usize)
    }
}

/// Offsets in texts of at most `MAX_FILE_BYTES` fit; longer texts are refused before they are read.
pub(crate) fn byte_offset(offset: usize) -> u32 {
    u32::try_from(offset).unwrap_or(u32::MAX)
}

/// Finds imported texts. Implemented by whoever knows where files are.
pub trait Loader {
    /// The text behind `import "path"` in `importing_file`, with the name that identifies it: two
    /// imports that mean the same file must give the same name, which is also shown in messages.
    /// `importing_file` is such a name, or the name of the root file.
    fn load(&mut self, importing_file: &str, path: &str) -> Result<(String, String), LoadError>;
}

/// Why an imported text could not be had.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum LoadError {
    /// There is no such file.
    NotFound,
    /// There is one whose name differs in upper and lower case; its real name.
    WrongCase(String),
    /// The file is there, but its bytes are not UTF-8; the first wrong byte's offset.
    NotText(u64),
    /// Anything else, in words.
    Unreadable(String),
}

/// Does a text say that it is a scene: is `rts` the first word, after blanks and comments? Of files
/// that do not, nothing is shown: a scene may name any file that its reader can read.
#[must_use]
pub fn is_scene_text(text: &str) -> bool {
    let mut rest = text.strip_prefix('\u{feff}').unwrap_or(text);
    loop {
        rest = rest.trim_start_matches([' ', '\t', '\n', '\r']);
        let Some(comment) = rest.strip_prefix("//") else { break };
        rest = comment.find(['\n', '\r']).and_then(|end| comment.get(end..)).unwrap_or("");
    }
    let after = rest.strip_prefix("rts").map(|after| after.chars().next());
    after.is_some_and(|next| next.is_none_or(|c| !c.is_ascii_alphanumeric() && c != '_'))
}

#[cfg(test)]
mod tests {
    use super::{FileId, SourceSet, is_scene_text};

    #[test]
    fn places_count_characters_and_utf16_units() {
        let mut sources = SourceSet::new();
        let file = sources.add("a", "\u{feff}ab\r\n\u{1f600}é = 1\n");
        let at = |byte| {
            let place = sources.place(file, byte);
            (place.line, place.column, place.column_utf16)
        };
        assert_eq!(at(4), (1, 2, 2));
        assert_eq!(at(7), (2, 1, 1));
        assert_eq!(at(11), (2, 2, 3));
        assert_eq!(at(12), (2, 2, 3), "inside a character is at its start");
        assert_eq!(at(13), (2, 3, 4));
        assert_eq!(at(1000), (3, 1, 1));
        assert_eq!((sources.n_lines(file), sources.line(file, 1)), (2, "ab"));
        assert_eq!(sources.line(file, 3), "");
    }

    #[test]
    fn lines_and_columns_are_found_far_into_a_text() {
        let mut sources = SourceSet::new();
        let lines: Vec<String> = (0..900).map(|i| "é\u{1f600}x".repeat(i % 700)).collect();
        let text = lines.join("\r\n");
        let file = sources.add("a", text.as_str());
        let mut start = 0;
        for (text, line) in lines.iter().zip(1..) {
            let end = start + u32::try_from(text.len()).unwrap();
            let span = sources.line_span(file, line);
            assert_eq!((span.start, span.end), (start, end), "line {line}");
            assert_eq!(sources.line(file, line), text);
            let place = sources.place(file, end);
            let n_chars = u32::try_from(text.chars().count()).unwrap();
            let n_units = u32::try_from(text.encode_utf16().count()).unwrap();
            let found = (place.line, place.column, place.column_utf16);
            assert_eq!(found, (line, n_chars + 1, n_units + 1));
            assert_eq!(sources.line_of(file, end), line);
            start = end + 2;
        }
        assert_eq!(sources.n_lines(file), 900);
        assert_eq!(sources.line_span(file, 901).start as usize, text.len());
    }

    #[test]
    fn a_scene_text_says_so_first() {
        for text in ["rts 1", "rts", "\u{feff}// a\n\r\n\t rts 2\n", "// a\rrts\n"] {
            assert!(is_scene_text(text), "{text:?}");
        }
        for text in ["", "root:x:0:0", "rts1", "rts_a", "# rts 1", "// rts 1", "let a = 1\nrts 1"] {
            assert!(!is_scene_text(text), "{text:?}");
        }
    }

    #[test]
    fn an_unknown_file_is_no_guess() {
        let sources = SourceSet::new();
        assert_eq!((sources.name(FileId(3)), sources.text(FileId(3))), ("<unknown>", ""));
        assert_eq!(sources.place(FileId(3), 9).line, 1);
    }
}
