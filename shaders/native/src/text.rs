//! Pieces of Rust text: indented lines, and parentheses where they are needed.

/// Lines of Rust with their indentation.
#[derive(Debug, Default)]
pub(crate) struct Text {
    out: String,
    depth: usize,
}

impl Text {
    /// Starts at `depth` levels of indentation.
    pub(crate) fn at_depth(depth: usize) -> Self {
        Self { out: String::new(), depth }
    }

    /// Adds one line.
    pub(crate) fn line(&mut self, line: &str) {
        for _ in 0..if line.is_empty() { 0 } else { self.depth } {
            self.out.push_str("    ");
        }
        self.out.push_str(line);
        self.out.push('\n');
    }

    /// Adds several lines.
    pub(crate) fn lines(&mut self, lines: &[String]) {
        for line in lines {
            self.line(line);
        }
    }

    /// Adds a line that opens a block.
    pub(crate) fn open(&mut self, line: &str) {
        self.line(line);
        self.depth += 1;
    }

    /// Adds a line that closes a block.
    pub(crate) fn close(&mut self, line: &str) {
        self.depth -= 1;
        self.line(line);
    }

    /// Adds a line that closes a block and opens another.
    pub(crate) fn reopen(&mut self, line: &str) {
        self.close(line);
        self.depth += 1;
    }

    /// Adds lines that carry their own indentation.
    pub(crate) fn raw(&mut self, lines: &str) {
        self.out.push_str(lines);
    }

    /// All lines.
    pub(crate) fn finish(self) -> String {
        self.out
    }
}

/// `text` as an operand: in parentheses unless it already binds as tightly as a name.
pub(crate) fn wrap(text: &str) -> String {
    if is_tight(text) { text.to_owned() } else { format!("({text})") }
}

/// Whether `.method()` may follow `text`: no prefix operator, no space outside brackets.
fn is_tight(text: &str) -> bool {
    if text.starts_with(['-', '!', '*', '&']) {
        return false;
    }
    let mut depth = 0_u32;
    for c in text.chars() {
        match c {
            '(' | '[' | '{' => depth += 1,
            ')' | ']' | '}' => depth = depth.saturating_sub(1),
            ' ' if depth == 0 => return false,
            _ => {}
        }
    }
    true
}

/// `text` without the parentheses that surround all of it, if any.
pub(crate) fn unwrap(text: &str) -> &str {
    let Some(inner) = text.strip_prefix('(').and_then(|t| t.strip_suffix(')')) else {
        return text;
    };
    let mut depth = 0_i32;
    for c in inner.chars() {
        match c {
            '(' => depth += 1,
            ')' => depth -= 1,
            ',' if depth == 0 => return text,
            _ => {}
        }
        if depth < 0 {
            return text;
        }
    }
    inner
}

/// A call of `function` with `arguments`.
pub(crate) fn call(function: &str, arguments: &[String]) -> String {
    let arguments: Vec<&str> = arguments.iter().map(|a| unwrap(a)).collect();
    format!("{function}({})", arguments.join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parentheses_only_where_needed() {
        assert_eq!(wrap("a"), "a");
        assert_eq!(wrap("a + b"), "(a + b)");
        assert_eq!(wrap("f(a + b).x"), "f(a + b).x");
        assert_eq!(wrap("-1.0f32"), "(-1.0f32)");
        assert_eq!(unwrap("(a + b)"), "a + b");
        assert_eq!(unwrap("(a) + (b)"), "(a) + (b)");
        assert_eq!(call("f", &["(a + b)".into(), "c".into()]), "f(a + b, c)");
    }
}
