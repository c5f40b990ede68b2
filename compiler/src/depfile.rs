//! Files that a pack was made from → a rule that `make` and `ninja` read.
//!
//! The first rule names them all; an empty rule for each of them keeps `make` going when one is
//! deleted together with the line that named it. Names are escaped as compilers do: space, tab and
//! `#` after a backslash, `$` doubled, `:` after a backslash where the file system allows it.

use files::ShowPath as _;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

/// A name that no rule can hold.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{} cannot be written to a depfile: the name {why}", path.shown())]
pub struct UnspeakableName {
    path: PathBuf,
    why: &'static str,
}

/// The text of the depfile of `target`.
///
/// # Errors
/// When a name holds a line break, or is not UTF-8.
pub fn depfile<'a>(
    target: &Path,
    files: impl IntoIterator<Item = &'a Path>,
) -> Result<String, UnspeakableName> {
    let files: Vec<String> = files.into_iter().map(escape).collect::<Result<_, _>>()?;
    let mut text = escape(target)? + ":";
    for file in &files {
        // Writing to a string cannot fail.
        let _ = write!(text, " \\\n  {file}");
    }
    text.push('\n');
    for file in &files {
        let _ = writeln!(text, "\n{file}:");
    }
    Ok(text)
}

fn escape(path: &Path) -> Result<String, UnspeakableName> {
    let unspeakable = |why| UnspeakableName { path: path.to_owned(), why };
    let name = path.to_str().ok_or_else(|| unspeakable("is not UTF-8"))?;
    let mut out = String::with_capacity(name.len());
    let mut backslashes = 0;
    for c in name.chars() {
        match c {
            '\n' | '\r' => return Err(unspeakable("holds a line break")),
            ' ' | '\t' | '#' => {
                // Backslashes before an escaped character stand for themselves when doubled.
                out.extend(std::iter::repeat_n('\\', backslashes + 1));
            }
            '$' => out.push('$'),
            ':' if !cfg!(windows) => out.push('\\'),
            _ => {}
        }
        backslashes = if c == '\\' { backslashes + 1 } else { 0 };
        out.push(c);
    }
    Ok(out)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rule_names_every_file_and_each_has_an_empty_rule() {
        let files = ["a.rts", "parts/my $5 chair #2.obj"].map(Path::new);
        let text = depfile(Path::new("out dir/a.pack"), files).unwrap();
        let expected = "out\\ dir/a.pack: \\\n  a.rts \\\n  parts/my\\ $$5\\ chair\\ \\#2.obj\n\n\
                        a.rts:\n\nparts/my\\ $$5\\ chair\\ \\#2.obj:\n";
        assert_eq!(text, expected);
    }

    #[test]
    fn backslashes_are_doubled_only_where_they_would_escape() {
        let of = |name: &str| escape(Path::new(name)).unwrap();
        assert_eq!(of(r"a\b"), r"a\b");
        assert_eq!(of(r"a\ b"), r"a\\\ b");
        assert_eq!(of(r"a\\#"), r"a\\\\\#");
    }

    #[test]
    fn a_line_break_is_refused() {
        let error = depfile(Path::new("a.pack"), [Path::new("a\nb")]).unwrap_err();
        assert!(error.to_string().ends_with("the name holds a line break"), "{error}");
    }
}
