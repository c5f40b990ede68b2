//! Any bytes: the parser returns, every place lies inside the text, and what has no faults has a
//! layout that does not change when it is formatted again.
#![no_main]

use lang::format::{format, format_file};
use lang::parse::parse;
use lang::source::SourceSet;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let mut sources = SourceSet::new();
    let (file, not_text) = sources.add_bytes("fuzz.rts", bytes);
    let (tree, diagnostics) = parse(&sources, file);
    assert_eq!(tree.has_errors, !diagnostics.is_empty());
    for label in diagnostics.iter().flat_map(|d| &d.labels) {
        let range = label.span.start as usize..label.span.end as usize;
        assert!(sources.text(file).get(range).is_some());
    }
    if diagnostics.is_empty() && not_text.is_none() {
        let once = format_file(&sources, file).expect("a text without faults has a layout");
        assert_eq!(format(&once).expect("a layout can be formatted"), once);
    }
});
