//! `-D name=value` from the command line becomes expressions with places of their own.

use std::collections::BTreeMap;

use crate::diagnostic::{Code, Diagnostic, Edit, Fix};
use crate::eval::Define;
use crate::parse;
use crate::source::{SourceSet, Span};
use crate::syntax::ItemKind;

/// What is given beside the text.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// `name=value` pairs that replace the values of parameters of the root file, in order; of two
    /// with one name the last counts.
    pub defines: Vec<(String, String)>,
}

/// Reads all definitions; of two with one name the last counts.
pub(super) fn read(
    sources: &mut SourceSet,
    options: &Options,
    diagnostics: &mut Vec<Diagnostic>,
) -> BTreeMap<String, Define> {
    let mut defines = BTreeMap::new();
    for (name, value) in &options.defines {
        // Read as a `let` of a file of its own, so that the value may be any expression.
        let value = value.trim();
        let text = format!("rts 1\nlet {name} = {value}\n");
        let file = sources.add("command line", text);
        let (mut tree, mut faults) = parse::parse(sources, file);
        let one_line = !value.contains(['\n', '\r']) && !name.contains(['\n', '\r']);
        let item = if tree.items.len() == 1 { tree.items.pop() } else { None };
        match item.map(|item| item.kind) {
            Some(ItemKind::Let(binding)) if faults.is_empty() && one_line => {
                let define = Define { value: binding.value, name: binding.name.span };
                defines.insert(name.clone(), define);
            }
            _ if faults.is_empty() => diagnostics.push(malformed(sources, file, name, value)),
            _ => diagnostics.append(&mut faults),
        }
    }
    defines
}

/// Fixes of the command line become advice: only the first `n_files` files can be edited.
pub(super) fn keep_editable(sources: &SourceSet, diagnostic: &mut Diagnostic, n_files: usize) {
    let (keep, advice): (Vec<Fix>, Vec<Fix>) = std::mem::take(&mut diagnostic.fixes)
        .into_iter()
        .partition(|fix| fix.edits.iter().all(|edit| (edit.span.file.0 as usize) < n_files));
    diagnostic.fixes = keep;
    for fix in advice {
        diagnostic.helps.push(match corrected(sources, &fix) {
            Some(argument) => format!("{}: `-D {argument}`", fix.message),
            None => fix.message,
        });
    }
}

/// The argument of `-D` after a fix, as it is typed.
fn corrected(sources: &SourceSet, fix: &Fix) -> Option<String> {
    let file = fix.edits.first()?.span.file;
    let mut text = sources.text(file).to_owned();
    let mut edits: Vec<&Edit> = fix.edits.iter().filter(|edit| edit.span.file == file).collect();
    edits.sort_by_key(|edit| std::cmp::Reverse(edit.span.start));
    for edit in edits {
        let range = edit.span.start as usize..edit.span.end as usize;
        text.get(range.clone())?;
        text.replace_range(range, &edit.replacement);
    }
    let (name, value) = text.strip_prefix("rts 1\nlet ")?.split_once('=')?;
    let argument = format!("{}={}", name.trim(), value.trim());
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "_=.,:%/+-".contains(c);
    match argument.chars().all(is_plain) {
        true => Some(argument),
        false if argument.contains(['\n', '"', '$', '`', '\\']) => None,
        false => Some(format!("\"{argument}\"")),
    }
}

fn malformed(
    sources: &SourceSet,
    file: crate::source::FileId,
    name: &str,
    value: &str,
) -> Diagnostic {
    let length = u32::try_from(sources.text(file).len()).unwrap_or(u32::MAX);
    let span = Span { file, start: 6.min(length), end: length.saturating_sub(1) };
    Diagnostic::error(Code("E0213"), format!("cannot read `-D {name}={value}`"))
        .at(span, "not a name and a value")
        .with_help("write `-D name=value`, for example `-D hour=7h`")
}
