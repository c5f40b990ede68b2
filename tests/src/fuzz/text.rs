//! Any bytes as a scene: the parser returns, every place lies inside the text, and what has no faults
//! has a layout that does not change when it is formatted again.

use std::path::Path;

use lang::diagnostic::Diagnostic;
use lang::format::{format, format_file};
use lang::parse::parse;
use lang::source::{LoadError, Loader, SourceSet};
use lang::{Options, analyze};

pub(super) const WORDS: &[&[u8]] = &[
    b"(",
    b")",
    b"{",
    b"}",
    b"[",
    b"]",
    b"..",
    b" like ",
    b" none ",
    b" default ",
    b"if ",
    b" then ",
    b" else ",
    b"\"",
    b"#ffffff",
    b"+x",
    b"\n",
    b"let a = b\n",
    b"let b = a\n",
    b"pub ",
    b"deg",
    b"%",
    b"W/m2/sr",
    b"// ",
    b"srgb(",
    b"import \"std:materials\" { glass }\n",
    b"[i in 0..1000000000]",
    b"\xef\xbb\xbf",
    b"\r\n",
    b"\0",
    b"\x1b[2J",
    b"\xe2\x80\xae",
    b"texture ",
    b"image(\"a.png\")",
    b"-",
    b"*",
    b"/",
    b"<",
    b"assert ",
    b"param ",
    b"render r: path { }\n",
];

/// There are no other files.
struct Alone;

impl Loader for Alone {
    fn load(&mut self, _: &str, _: &str) -> Result<(String, String), LoadError> {
        Err(LoadError::NotFound)
    }
}

pub(super) fn check(_: &Path, bytes: &[u8]) -> Result<(), String> {
    let mut sources = SourceSet::new();
    let file = sources.add("fuzz.rts", String::from_utf8_lossy(bytes));
    let (tree, diagnostics) = parse(&sources, file);
    assert_eq!(tree.has_errors, !diagnostics.is_empty());
    assert_places(&sources, &diagnostics);
    if diagnostics.is_empty() {
        let once = format_file(&sources, file).expect("a text without faults has a layout");
        assert_eq!(format(&once).expect("a layout can be formatted"), once);
    }
    let text = std::str::from_utf8(bytes).map_err(|_| "no UTF-8".to_owned())?;
    let analysis = analyze("fuzz.rts", text, &mut Alone, &Options { defines: Vec::new() });
    assert_places(&analysis.sources, &analysis.diagnostics);
    if let Some(scene) = analysis.scene {
        assert!(!lang::resolved(&scene).is_empty());
        return Ok(());
    }
    let first = analysis.diagnostics.first().expect("a reason for no scene");
    let start = first.message.chars().map(|c| if c.is_control() { ' ' } else { c }).take(80);
    Err(format!("{}: {}", first.code.0, start.collect::<String>()))
}

fn assert_places(sources: &SourceSet, diagnostics: &[Diagnostic]) {
    for label in diagnostics.iter().flat_map(|d| &d.labels) {
        let range = label.span.start as usize..label.span.end as usize;
        assert!(sources.text(label.span.file).get(range).is_some(), "a label outside the text");
    }
}
