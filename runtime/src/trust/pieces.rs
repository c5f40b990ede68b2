//! Linked kernel text → its declarations, one piece of text each.
//!
//! Shared with the build script, so that both cut in the same places. A wrong cut can only make a
//! kernel unknown, never trusted: what is compared afterwards is the whole text of every piece.

/// The declarations of a linked kernel: everything but blank lines and the lines `// ---- name`
/// between modules. `Err` with the number of a line, from 1, that does not belong in such a text.
pub(crate) fn pieces(text: &str) -> Result<Vec<(usize, &str)>, usize> {
    let mut found = Vec::new();
    let mut begin: Option<(usize, usize)> = None;
    let mut depth = 0_i32;
    let mut at = 0;
    for (line, number) in text.split_inclusive('\n').zip(1..) {
        // Other characters may end a line, and so a comment, for some readers of WGSL.
        if !line.trim_end_matches('\n').bytes().all(|byte| (b' '..=b'~').contains(&byte)) {
            return Err(number);
        }
        let is_blank = line.trim().is_empty();
        let between = begin.is_none() && (is_blank || line.starts_with("// ---- "));
        if is_blank
            && depth == 0
            && let Some((number, start)) = begin.take()
        {
            found.push((number, text[start..at].trim_end()));
        } else if !between {
            begin.get_or_insert((number, at));
            let code = line.split("//").next().unwrap_or_default();
            depth += count(code, '{') - count(code, '}');
        }
        at += line.len();
    }
    if let Some((number, start)) = begin {
        found.push((number, text[start..].trim_end()));
    }
    Ok(found)
}

fn count(text: &str, wanted: char) -> i32 {
    text.chars().map(|c| i32::from(c == wanted)).sum()
}

/// The name of a declaration: the word after `fn`, `struct`, `const`, `alias` or `var<…>`.
pub(crate) fn name_of(text: &str) -> Option<&str> {
    let code =
        text.lines().find(|line| !line.starts_with("//") && !line.starts_with("@compute"))?;
    let keyword = ["fn ", "struct ", "const ", "alias ", "var<"];
    let start = keyword.iter().filter_map(|k| code.find(k).map(|i| i + k.len())).min()?;
    let rest = &code[start..];
    let rest = if code[..start].ends_with("var<") { rest.split_once("> ")?.1 } else { rest };
    let end = rest.find(|c: char| c != '_' && !c.is_ascii_alphanumeric()).unwrap_or(rest.len());
    (end > 0).then(|| &rest[..end])
}
