//! The f64 twin of a golden: the f32 text with other types and literals, and the lines that are more than that.

/// The text for f64 as the rules make it: `Real` and its vectors are f64, and so are literals.
///
/// `exceptions` is the text of `generated/f64.txt`; its lines for `stem` stand instead of what the rules make.
pub(crate) fn twin(stem: &str, single: &str, exceptions: &str) -> String {
    let mut lines: Vec<String> = single.lines().map(by_rules).collect();
    let mut place = None;
    for line in exceptions.lines() {
        if let Some(expected) = line.strip_prefix("+ ") {
            if let Some(line) = place.and_then(|idx: usize| lines.get_mut(idx)) {
                expected.clone_into(line);
            }
        } else if !line.starts_with("- ") {
            let number = line.strip_prefix(stem).and_then(|rest| rest.strip_prefix(' '));
            place = number.and_then(|n| n.parse::<usize>().ok()?.checked_sub(1));
        }
    }
    lines.iter().flat_map(|line| [line, "\n"]).collect()
}

/// A line of the f32 text, for f64.
pub(crate) fn by_rules(line: &str) -> String {
    if line == "pub type Real = f32;" {
        return "pub type Real = f64;".to_owned();
    }
    if line.starts_with("pub type ") {
        return line.replace("glam::", "glam::D");
    }
    let mut out = String::new();
    for piece in line.split_inclusive("f32") {
        match piece.strip_suffix("f32") {
            Some(start) if start.ends_with(|c: char| c.is_ascii_digit()) => {
                out += start;
                out += "f64";
            }
            _ => out += piece,
        }
    }
    out
}
