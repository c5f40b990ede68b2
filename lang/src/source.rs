//! Source files and places in them: byte ranges become files, lines and columns.
//!
//! Names are kept as the user wrote them, for display only. This crate never opens a file: whoever
//! compiles a scene implements [`Loader`] and adds texts to a [`SourceSet`].

use crate::diagnostic::{Code, Diagnostic, Label};

/// Largest source text that is read, in bytes. Bulk data belongs in meshes and images.
pub const MAX_FILE_BYTES: usize = 64 << 20;

/// Index of a file in a `SourceSet`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct FileId(pub u32);

/// A byte range in one file.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Span {
    /// The file.
    pub file: FileId,
    /// First byte.
    pub start: u32,
    /// One past the last byte.
    pub end: u32,
}

impl Span {
    /// From the start of `self` to the end of `other`. Spans of different files cannot be joined;
    /// `self` is returned then.
    #[must_use]
    pub fn to(self, other: Span) -> Span {
        if self.file != other.file {
            return self;
        }
        Span { file: self.file, start: self.start.min(other.start), end: self.end.max(other.end) }
    }

    /// The empty span just before this one.
    #[must_use]
    pub fn before(self) -> Span {
        Span { end: self.start, ..self }
    }

    /// The empty span just after this one.
    #[must_use]
    pub fn after(self) -> Span {
        Span { start: self.end, ..self }
    }
}

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
    /// Byte offset of each line's first byte.
    line_starts: Vec<u32>,
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
        let text = text.into();
        let starts = text.bytes().enumerate().filter(|&(_, b)| b == b'\n');
        let line_starts =
            std::iter::once(0).chain(starts.map(|(i, _)| byte_offset(i + 1))).collect();
        let id = FileId(u32::try_from(self.files.len()).unwrap_or(u32::MAX));
        self.files.push(Source { name: name.into(), text, line_starts });
        id
    }

    /// Adds bytes that should be UTF-8. Where they are not, the wrong bytes are shown as `\u{fffd}`
    /// and the diagnostic says where they are.
    pub fn add_bytes(
        &mut self,
        name: impl Into<String>,
        bytes: &[u8],
    ) -> (FileId, Option<Diagnostic>) {
        match std::str::from_utf8(bytes) {
            Ok(text) => (self.add(name, text), None),
            Err(error) => {
                let start = error.valid_up_to();
                let file = self.add(name, String::from_utf8_lossy(bytes));
                let end = byte_offset(start + '\u{fffd}'.len_utf8());
                let span = Span { file, start: byte_offset(start), end };
                let byte = bytes.get(start).copied().unwrap_or_default();
                let diagnostic = Diagnostic::error(Code("E0107"), "this file is not UTF-8 text")
                    .with_label(Label::primary(span, format!("byte 0x{byte:02x} here")))
                    .with_help("save the file as UTF-8");
                (file, Some(diagnostic))
            }
        }
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
        let line = source.line_starts.partition_point(|&start| start <= byte).max(1);
        let start = source.line_starts.get(line - 1).copied().unwrap_or(0) as usize;
        let mut end = (byte as usize).min(source.text.len());
        while !source.text.is_char_boundary(end) {
            end -= 1;
        }
        let before = source.text.get(start..end).unwrap_or("").trim_start_matches('\u{feff}');
        let units: usize = before.chars().map(char::len_utf16).sum();
        Place {
            line: byte_offset(line),
            column: byte_offset(before.chars().count() + 1),
            column_utf16: byte_offset(units + 1),
        }
    }

    /// Where a span starts.
    #[must_use]
    pub fn start(&self, span: Span) -> Place {
        self.place(span.file, span.start)
    }

    /// Number of lines of a file; a final line break does not start another line.
    #[must_use]
    pub fn n_lines(&self, file: FileId) -> u32 {
        self.source(file).map_or(0, |s| {
            let empty_tail = s.text.is_empty() || s.text.ends_with('\n');
            byte_offset(s.line_starts.len() - usize::from(empty_tail))
        })
    }

    /// The text of a line, counted from 1, without its line break and a byte order mark.
    #[must_use]
    pub fn line(&self, file: FileId, line: u32) -> &str {
        let Some(source) = self.source(file) else { return "" };
        let index = (line as usize).wrapping_sub(1);
        let Some(&start) = source.line_starts.get(index) else { return "" };
        let end = source.line_starts.get(index + 1).map_or(source.text.len(), |&e| e as usize);
        let line = source.text.get(start as usize..end).unwrap_or("");
        line.trim_start_matches('\u{feff}').trim_end_matches(['\n', '\r'])
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

#[cfg(test)]
mod tests {
    use super::{FileId, SourceSet};

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
    fn an_unknown_file_is_no_guess() {
        let sources = SourceSet::new();
        assert_eq!((sources.name(FileId(3)), sources.text(FileId(3))), ("<unknown>", ""));
        assert_eq!(sources.place(FileId(3), 9).line, 1);
    }
}
