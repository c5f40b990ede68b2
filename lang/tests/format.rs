//! The formatter: one layout, nothing lost, nothing changed, and a second run changes nothing.
//!
//! `tests/syntax/layout.txt` holds pairs: `--- name`, a text, `>>>`, the text formatted. `UPDATE=1`
//! rewrites the second parts.

use std::fmt::Write as _;

use lang::format::format;
use lang::parse::parse;
use lang::source::SourceSet;
use proptest::prelude::*;

fn formatted(text: &str) -> String {
    match format(text) {
        Ok(out) => out,
        Err(diagnostics) => panic!("{diagnostics:#?}\nin\n{text}"),
    }
}

fn comments(text: &str) -> Vec<String> {
    // The generator writes no `//` in strings.
    let mut comments: Vec<String> = text
        .lines()
        .filter_map(|line| line.find("//").map(|at| line[at..].trim_end().to_owned()))
        .collect();
    comments.sort();
    comments
}

#[test]
fn layouts_are_as_agreed() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/syntax/layout.txt");
    let text = std::fs::read_to_string(path).expect("the test's own file");
    let mut rewritten = String::new();
    let update = std::env::var_os("UPDATE").is_some();
    for case in text.split("--- ").skip(1) {
        let (title, rest) = case.split_once('\n').expect("a line with the name");
        let (input, expected) = rest.split_once(">>>\n").expect("two parts");
        let found = formatted(input);
        assert_eq!(formatted(&found), found, "case `{title}` is not stable");
        let _ = write!(rewritten, "--- {title}\n{input}>>>\n{found}");
        if !update {
            assert_eq!(expected, found, "case `{title}`");
        }
    }
    if update {
        std::fs::write(path, rewritten).expect("the test's own file");
    }
}

#[test]
fn the_example_is_laid_out_as_the_formatter_does() {
    let text = include_str!("syntax/shrine.rts");
    assert_eq!(formatted(text), text);
}

#[test]
fn lines_end_as_most_of_them_did_and_marks_go() {
    for (text, expected) in [
        ("\u{feff}rts 1\r\n\r\n\r\n\r\nlet a=1 // b \r\n", "rts 1\r\n\r\nlet a = 1 // b\r\n"),
        ("rts 1\r\n\nlet a = 1\r\n", "rts 1\r\n\r\nlet a = 1\r\n"),
        ("rts 1\r\n\nlet a = 1\r\nlet b = 2\n", "rts 1\n\nlet a = 1\nlet b = 2\n"),
        ("rts 1\rlet a = 1\r", "rts 1\nlet a = 1\n"),
        ("rts 1\r\nlet a = 1", "rts 1\r\nlet a = 1\r\n"),
        ("rts 1", "rts 1\n"),
    ] {
        assert_eq!(formatted(text), expected, "{text:?}");
        assert_eq!(formatted(expected), expected, "{text:?}");
    }
}

#[test]
fn a_text_with_errors_is_left_alone() {
    let errors = format("rts 1\nlet a =\n").expect_err("no value");
    assert_eq!(errors.len(), 1);
}

/// Writes random scenes that are right but ugly; every choice takes a byte.
struct Writer<'a> {
    choices: std::slice::Iter<'a, u8>,
    out: String,
    n_comments: usize,
}

impl Writer<'_> {
    fn choose(&mut self, n: usize) -> usize {
        self.choices.next().map_or(0, |&byte| usize::from(byte) % n)
    }

    fn pick(&mut self, texts: &[&str]) {
        let text = texts[self.choose(texts.len())];
        self.out.push_str(text);
    }

    fn blank(&mut self) {
        self.pick(&["", " ", "  ", "\t", " "]);
    }

    /// Where a line may end.
    fn gap(&mut self) {
        match self.choose(12) {
            0 => self.out.push('\n'),
            1 => self.out.push_str("\n\n\n  "),
            2 => self.comment(),
            3 => self.out.push_str("\r\n"),
            _ => self.blank(),
        }
    }

    fn comment(&mut self) {
        self.n_comments += 1;
        let start = ["//", "// ", "/// ", "\n//"][self.choose(4)];
        let _ = writeln!(self.out, " {start}c{} #A, {{ ]  ", self.n_comments);
    }

    fn name(&mut self) {
        self.pick(&["a", "x", "y", "hour", "cedar_red", "sun_range", "in_", "e"]);
    }

    fn unit(&mut self) {
        self.pick(&["", "", "m", "mm", "%", "kcd/m2", "/m", "deg"]);
    }

    fn list(&mut self, brackets: [&str; 2], least: usize, entry: impl Fn(&mut Self)) {
        self.out.push_str(brackets[0]);
        let n = least + self.choose(4);
        for i in 0..n {
            self.gap();
            entry(self);
            self.gap();
            if i + 1 < n || (n > 1 && self.choose(2) == 0) {
                self.out.push(',');
            }
        }
        self.gap();
        self.out.push_str(brackets[1]);
    }

    fn expr(&mut self, depth: usize) {
        let n = if depth == 0 { 7 } else { 16 };
        match self.choose(n) {
            0..2 => {
                self.pick(&["1", "0.42", ".5", "40_000", "1e-3", "2.5E7", "12"]);
                self.unit();
            }
            2 => self.pick(&["#C79a6B", "#000000", "\"a b.png\"", "\"\""]),
            3 => self.pick(&["true", "false", "default", "none"]),
            4 => self.pick(&["+x", "-z", "- x", "-  y", "-x.y", "--x", "- -x"]),
            5 => self.name(),
            6 => {
                self.name();
                self.pick(&[".", " .", ". "]);
                self.name();
            }
            7 => {
                self.list(["(", ")"], 2, |w| w.expr(depth - 1));
                self.unit();
            }
            8 => self.list(["[", "]"], 0, |w| w.expr(depth - 1)),
            9 => self.list(["[", "]"], 1, |w| {
                w.expr(depth - 1);
                w.blank();
                w.out.push(':');
                w.blank();
                w.expr(depth - 1);
            }),
            10 => {
                self.name();
                self.blank();
                self.list(["(", ")"], 0, |w| w.arg(depth - 1));
                self.pick(&["", "", ".rgb"]);
            }
            11 => {
                self.out.push('(');
                self.gap();
                self.expr(depth - 1);
                self.gap();
                self.out.push(')');
            }
            12 => {
                self.out.push('-');
                self.blank();
                self.list(["(", ")"], 2, |w| w.expr(depth - 1));
            }
            13 => self.condition(depth - 1),
            14 => self.operation(depth - 1),
            _ => {
                self.out.push('(');
                self.operand(depth - 1);
                self.blank();
                self.pick(&["..", " ..", "..  "]);
                self.operand(depth - 1);
                self.out.push(')');
            }
        }
    }

    fn arg(&mut self, depth: usize) {
        if self.choose(2) == 0 {
            self.name();
            self.pick(&[":", " : ", ":  "]);
        }
        self.expr(depth);
    }

    fn condition(&mut self, depth: usize) {
        self.out.push_str("if ");
        self.expr(depth);
        self.pick(&[" then ", "  then\t"]);
        self.expr(depth);
        self.out.push_str(" else ");
        self.expr(depth);
    }

    /// An operand in parentheses, so that precedence does not matter.
    fn operand(&mut self, depth: usize) {
        self.out.push('(');
        self.expr(depth);
        self.out.push(')');
    }

    fn operation(&mut self, depth: usize) {
        self.out.push('(');
        self.operand(depth);
        for _ in 0..=self.choose(3) {
            self.blank();
            self.pick(&["+", "-", "*", "/", " / ", "- -"]);
            self.blank();
            self.operand(depth);
        }
        if self.choose(3) == 0 {
            self.blank();
            self.pick(&["<", "<=", ">", ">=", "==", "!="]);
            self.blank();
            self.operand(depth);
        }
        self.out.push(')');
    }

    fn field(&mut self) {
        self.name();
        self.pick(&["", ".grain", ".x"]);
        self.pick(&["=", " = ", "  =  "]);
        self.expr(2);
    }

    fn declaration(&mut self) {
        self.pick(&["", "", "pub "]);
        self.pick(&["material ", "instance  ", "light\t", "film "]);
        self.name();
        if self.choose(4) == 0 {
            self.pick(&["[i in ", " [ i  in "]);
            self.operand(1);
            self.pick(&["..6]", " .. 6 ]"]);
        }
        self.pick(&["", ":wood", " : wood.fine ", " like cedar", " like  car.material( \"a b\") "]);
        self.pick(&[" ", "", " // why\n", "\n"]);
        self.out.push('{');
        for _ in 0..self.choose(4) {
            self.gap();
            self.field();
            match self.choose(3) {
                0 => self.out.push(','),
                1 => self.out.push('\n'),
                _ => self.comment(),
            }
        }
        self.gap();
        self.out.push('}');
    }

    fn item(&mut self) {
        match self.choose(8) {
            0 => {
                self.pick(&["import \"b.rts\" as ", "import  \"std:a\"  as  "]);
                self.name();
            }
            1 => {
                self.out.push_str("import \"a.rts\"");
                self.list(["{", "}"], 1, Self::name);
            }
            2 => {
                self.out.push_str("param hour :time= ");
                self.expr(1);
                self.out.push_str(" in 5h ..9h");
            }
            3 => {
                self.pick(&["let ", "pub let ", "asset ", "pub texture  "]);
                self.name();
                self.pick(&["=", " = "]);
                self.expr(3);
            }
            4 => {
                self.out.push_str("assert ");
                self.expr(2);
                self.pick(&[",\"why\"", " , \"why\""]);
            }
            _ => self.declaration(),
        }
    }

    fn scene(mut self) -> String {
        self.out.push_str("rts  1\n");
        for _ in 0..=self.choose(6) {
            self.pick(&["", "\n", "\n\n\n", "/// doc\n", " // own line\n", "\t\n"]);
            self.item();
            self.pick(&["\n", " // behind\n", "   \n", "\r\n"]);
        }
        self.out
    }
}

fn tree(text: &str) -> String {
    let mut sources = SourceSet::new();
    let file = sources.add("", text);
    let (tree, diagnostics) = parse(&sources, file);
    assert!(diagnostics.is_empty(), "{diagnostics:#?}\nin\n{text}");
    let mut items: Vec<String> =
        tree.without_places().items.iter().map(|item| format!("{item:?}")).collect();
    // Imports may change places.
    items.sort();
    items.join("\n")
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 1000,
        failure_persistence: None,
        rng_seed: proptest::test_runner::RngSeed::Fixed(20_260_412),
        ..ProptestConfig::default()
    })]

    #[test]
    fn formatting_keeps_the_meaning_and_the_comments(choices in prop::collection::vec(any::<u8>(), 0..400)) {
        let writer = Writer { choices: choices.iter(), out: String::new(), n_comments: 0 };
        let text = writer.scene();
        let once = formatted(&text);
        prop_assert_eq!(formatted(&once), once.clone(), "twice is not once for\n{}", text);
        prop_assert_eq!(tree(&text), tree(&once));
        prop_assert_eq!(comments(&text), comments(&once));
        let trailing = once.lines().find(|line| line.ends_with([' ', '\t']));
        prop_assert_eq!(trailing, None);
    }
}
